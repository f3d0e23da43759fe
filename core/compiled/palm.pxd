# What the other compiled modules call of palm.py, without Python in between.
cdef void fill_rotation(double x, double y, double z, double[:, ::1] out) noexcept nogil
cdef void multiply(const double[:, ::1] a, const double[:, ::1] b, double[:, ::1] out) noexcept nogil
