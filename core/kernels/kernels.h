/* What the library does. Matrices are stored row by row; shapes stand in the Python function of the same name, which
   is the oracle. Every kernel returns 0 or what is wrong. Nothing is remembered. Where calls differ in size, the sizes of
   the arrays are declared: another is refused before anything is read. */
#ifndef KERNELS_H
#define KERNELS_H

#include <stdint.h>

#if defined(_WIN32)
#define KERNEL __declspec(dllexport)
#else
#define KERNEL __attribute__((visibility("default")))
#endif

/* What a kernel returns: choice.py raises by it. */
enum { NOT_DEFINITE = 1, NO_MEMORY = 2, OUTSIDE = 3 };

KERNEL const char *kernels_digest(void);
KERNEL int kernels_run_wide(void);

/* filter.c */
KERNEL int corrected(
    int chains, int modes, int size, int count, const double mean[chains * modes * size],
    const double covariance[chains * modes * size * size], const double probability[chains * modes],
    const double value[chains * count], const double slope[chains * count * size],
    const double error[chains * count * count], const double about[chains * size],
    const double measured[chains * count], const double variance[chains * count],
    const double shared[chains * count * count], const double share[size],
    double out_mean[chains * modes * size],
    double out_covariance[chains * modes * size * size], double out_probability[chains * modes], double nis[chains],
    int64_t dof[chains], double residual[chains * count]);
KERNEL int merged(
    int chains, int modes, int size, const double mean[chains * modes * size],
    const double covariance[chains * modes * size * size], const double probability[chains * modes],
    double whole_mean[chains * size], double whole[chains * size * size]);

/* palm.c */


/* detection.c */
KERNEL int blobs_found(
    int whole_height, int whole_width, const uint8_t color[whole_height * whole_width * 3],
    const uint16_t raw[whole_height * whole_width], int has_depth, double unit_m, int left, int top, int width, int height,
    const uint8_t is_paper[65536], int darkest, double disc_px_m, double usual_m, double nearest_m, double long_side,
    double long_axis, double edge_px, int rounds, int most_parts, double least_area, double most_area, int most,
    int32_t labels[height * width], uint16_t look[height * width], int32_t own[most], double rough[most * 2],
    double radius[most], int32_t found[1]);
KERNEL int blobs_measured(
    int blobs, const int32_t own[blobs], const double rough[blobs * 2], int left, int top, int height, int width,
    const int32_t labels[height * width], const uint16_t look[height * width], int whole_height, int whole_width,
    const uint8_t color[whole_height * whole_width * 3], const uint16_t raw[whole_height * whole_width],
    int has_depth, double unit_m, int pixels, const int64_t row[pixels], const int64_t column[pixels],
    const uint8_t reach[pixels], int core, int near, int rim_from, int rim_to,
    const float wedge[(rim_to - rim_from) * 8], const int64_t pick[pixels], const uint8_t cell[65536],
    const uint8_t is_skin[65536], int cells, const double reference[cells], double low, double high,
    double fewest_rim, double fewest_core, double iqr_m, double valid_share, double fewest_readings, double edge_step,
    double edge_sd, double slope_share, double fixed_m, double square_per_m, double patch, int averages,
    double least_similarity, double least_skin, double centre[blobs * 2], double area[blobs], double similarity[blobs],
    double depth[blobs], double depth_sd[blobs], int32_t *kept);
KERNEL int readings_within(
    int height, int width, const uint16_t raw[height * width], double unit_m, int corners,
    const double corner[corners * 2], double wider, double margin, int step, int most, double pixel[most * 2],
    double depth[most], int32_t *found);
KERNEL int readings_about(
    int height, int width, const uint16_t raw[height * width], double unit_m, int discs, const double disc[discs * 2],
    double margin, int step, int most, double pixel[most * 2], double depth[most], int32_t found[1]);

KERNEL int discs_reach(
    int discs, const double pixel[discs * 2], const double covariance[discs * 4], const double depth[discs],
    double disc_px_m, double region_sd, double most_unsure, double nearest_m, double out[4]);

#endif
