# What the other compiled modules call of small_matrices.py, without Python in between.
cdef void add_product(const double[:, ::1] a, const double[:, ::1] b, double[:, ::1] out) noexcept nogil
cdef bint inverse_root(double[:, ::1] root, double[:, ::1] inverse) noexcept nogil
cdef double zero_times(const double[:, ::1] a) noexcept nogil
