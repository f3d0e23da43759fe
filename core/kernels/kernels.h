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
KERNEL int palm_sighted(
    int modes, const double mean[modes * 54], const double *probability, const double *value, const double *covariance,
    const double *rotation, const double *view, const double *weights, double floor, double *line, double *slope,
    double *error, double *out_mean, double *out_covariance);
KERNEL int palm_predicted(
    int modes, int tissues, int resting, int scales, double dt,
    const double motion[7 + 2 * modes + tissues * (462 + tissues)], double thumb, double fingers, double news, double stale,
    const double *view, const double *weights, double floor, const double *unseen, const double mean[modes * 54],
    const double *covariance, const double *probability, const double *value, const double *rotation, double *out_mean,
    double *out_covariance, double *out_probability, double *out_value, double *out_rotation, double *whole,
    double *partial, double *line, double *slope, double *error, double *expected, double *expected_covariance);
KERNEL int palm_named(
    int modes, int blobs, const double *expected, const double *covariance, const double value[blobs * 3],
    const double variance[blobs * 3], const double *noise_factor, double prior, double depth_range, double outlier,
    double gate2, double impossible, int enough, const double *most_nis, int most_outliers, double outlier_sd,
    const double mean[modes * 54], const double *wide, const double *probability, const double *line, const double *slope,
    const double *error, const double *partial, double *out_mean, double *out_covariance, double *out_probability,
    int64_t *assigned, uint8_t *used, double *residual, double *raw, double *nis, int64_t *dof, uint8_t *ordinary);
KERNEL int palm_reset(
    int modes, const double mean[modes * 54], const double *covariance, const double *probability, const double *value,
    const double *rotation, int count, const double pixel[count * 2], const double depth[count], const double *view, int rows,
    int columns, const double *plane, const double *to_node, const double *middle, int steps, double huber, double most,
    int least, double share_in, double reading_per_m, double turn_sd, double up_sd, double goes_on, double most_nis,
    const double *partial, double *out_mean, double *out_covariance, double *out_probability, double *whole,
    double *out_value, double *out_rotation, uint8_t *levelled);
KERNEL int wrist_read(
    const double *known, const double *sensitivity, const double *about, double most_m, const double *place,
    const double *value, const double *rotation, const double *covariance, const double *start, const double *stays,
    double side, double undefined_below, double *axes, double *position, double *shown, double *rate, double *angles,
    double *sd, double *zyz, uint8_t *is_near);
KERNEL int palm_seat(
    const double *known, const double *sensitivity, const double *about, double most_m, const double *disc,
    double metacarpal_m, double mirror, const double *value, const double *rotation, const double *covariance,
    const double *view, double *axes, double *origin, double *disc_m, double *cup, double *cup_sd, double *to_camera,
    double *at, double *pose, double *turn_covariance, uint8_t *is_near);
KERNEL int markers_told(
    int markers, int blobs, const int64_t source[markers], const int64_t *palm_blob, const double *palm_expected,
    const double *palm_covariance, const double *palm_off, const double *value, const double *rotation, const double *view,
    const int64_t *digit_blob, const double *digit_expected, const double *digit_covariance, const double *digit_off,
    const double *digit_m, const double pixel[blobs * 2], const double depth[blobs], double pixel_sd,
    int64_t blob[markers], double seen_px[markers * 2], double seen_m[markers], double expected_px[markers * 2],
    double expected_px2[markers * 4], double disc_m[markers * 3], int64_t *worst);
KERNEL int adapted_factors(
    int markers, const double factor[markers * 3], const double residual[markers * 3],
    const uint8_t measured[markers * 3], double weight, double least, double most, double out[markers * 3]);

KERNEL int blobs_worth(
    int blobs, const double pixel[blobs * 2], const double depth[blobs], const double depth_sd[blobs],
    const double area[blobs], int use_depth, double radius_px, double shade, double whole_from, double pixel_sd,
    double depth_ratio, double fixed_m, double square_per_m, int averages, double share, double patch,
    double stays_fixed, double stays_square, double value[blobs * 3], double variance[blobs * 3]);

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
