# What the other compiled modules call of association.py, without Python in between.
cdef void fill_log_odds(
    const double[:, ::1] at, const double[:, :, ::1] wide, const double[:, ::1] blob, const double[:, ::1] noise,
    double prior, double by_depth, double by_outlier, double gate2, double impossible, double[:, ::1] value,
    unsigned char[:, ::1] with_depth) noexcept nogil
