/* What the library does. Matrices are stored row by row; shapes stand in the Python function of the same name, which
   is the oracle. Every kernel returns 0, or 1 where a matrix is not positive definite. Nothing is remembered. */
#ifndef KERNELS_H
#define KERNELS_H

#include <stdint.h>

#if defined(_WIN32)
#define KERNEL __declspec(dllexport)
#else
#define KERNEL __attribute__((visibility("default")))
#endif

KERNEL const char *kernels_digest(void);
KERNEL int kernels_run_wide(void);

/* filter.c */
KERNEL int corrected(
    int chains, int modes, int size, int count, const double *mean, const double *covariance, const double *probability,
    const double *value, const double *slope, const double *error, const double *about, const double *measured,
    const double *variance, const double *shared, const double *share_mean, const double *share_covariance,
    double *out_mean, double *out_covariance, double *out_probability, double *nis, int64_t *dof, double *residual);
KERNEL int carried(
    int modes, int size, int mixing, int settling, const double *change, const double *mean, const double *covariance,
    const double *probability, const double *moving, const double *driven, const double *kept, const double *settled,
    const double *nominal, double *out_mean, double *out_covariance, double *out_probability);
KERNEL int predicted(
    int chains, int modes, int size, const double *change, const double *mean, const double *covariance,
    const double *probability, const double *forward, const double *noise, double *out_mean, double *out_covariance,
    double *out_probability);
KERNEL int merged(
    int chains, int modes, int size, const double *mean, const double *covariance, const double *probability,
    double *whole_mean, double *whole);

/* palm.c */
KERNEL int palm_ahead(
    int modes, int tissues, int resting, int scales, double dt, const double *scale_of, const int64_t *tissue_of,
    const double *settled, const double *between, const double *soft, double dwell, double push,
    double turning, double unseen_scale, const double *unseen, const double *mean, const double *covariance,
    const double *probability, const double *value, const double *rotation, double *out_mean, double *out_covariance,
    double *out_probability, double *out_value, double *out_rotation, double *whole);
KERNEL int palm_line(
    const double *value, const double *covariance, const double *rotation, const double *palm, const double *hidden,
    const double *image, const double *shift, const double *rotation_w0_cam, double fx, double fy, double cx, double cy,
    double floor, double mean_middle, double mean_other, double spread_middle, double spread_other, double scale,
    double *out_value, double *out_slope, double *out_error);
KERNEL int palm_expected(
    int modes, const double *covariance, const double *mean, const double *probability, const double *value,
    const double *slope, const double *error, double *out_mean, double *out_covariance);
KERNEL int recentred(
    int modes, const double *mean, const double *covariance, const double *probability, const double *value,
    const double *rotation, double *out_mean, double *out_covariance, double *out_value, double *out_rotation);
KERNEL int log_odds(
    int markers, int blobs, const double *expected, const double *covariance, const double *measured,
    const double *variance, double prior, double depth_range, double outlier, double gate2, double impossible,
    double *out, uint8_t *with_depth);
KERNEL int wrist_read(
    const double *axes, const double *sensitivity, const double *place, const double *value, const double *rotation,
    const double *covariance, const double *start, const double *stays, double side, double undefined_below,
    double *position, double *shown, double *rate, double *angles, double *sd, double *zyz);
KERNEL int adapted_factors(
    int markers, const double *factor, const double *residual, const uint8_t *measured, double weight, double least,
    double most, double *out);

/* surface.c */
KERNEL int surface_fit(
    int count, const double *pixel, const double *depth, double fx, double fy, double cx, double cy,
    const double *rotation_w0_cam,
    const double *translation, const double *belief_rotation, const double *value, int rows, int columns,
    const double *plane, const double *to_node, const double *middle, int steps, double huber, double most, int least,
    double share_in, double reading_per_m, double reading_fixed, double reading_square, double stays_fixed,
    double stays_square, double stays_px, double patch, int averages, double turn_sd, double up_sd, double goes_on,
    double *used, double *out_value, double *out_covariance, double *out_slope);

/* detection.c */
KERNEL int blobs_measured(
    int blobs, const uint16_t *own, const double *rough, int left, int top, int height, int width,
    const uint16_t *labels, const uint8_t *hsv, int whole_width, const uint8_t *color, const uint16_t *raw, int has_depth,
    double unit_m, int pixels, const int64_t *row, const int64_t *column, const uint8_t *reach, int core, int near,
    int rim_from, int rim_to, const float *wedge, const int64_t *pick, const uint8_t *cell, const uint8_t *is_skin,
    int cells, const double *reference, double low, double high, double fewest_rim, double fewest_core, double iqr_m,
    double valid_share, double fewest_readings, double edge_step, double edge_sd, double slope_share, double fixed_m,
    double square_per_m, double patch, int averages, double *centre, double *area, double *similarity,
    double *skin_share, double *depth, double *depth_sd);
KERNEL int readings_within(
    int height, int width, const uint16_t *raw, double unit_m, int corners, const double *corner, double wider,
    double margin, int step, int most, double *pixel, double *depth, int32_t *found);

/* digits.c */
KERNEL int rays_spread(
    const double *mean, const double *covariance, const double *roots, double floor, double scale, double *disc_m,
    double *unroot, double *along, double *by_constants, double *normal);
KERNEL int rays_forecast(
    const double *disc_m, const double *unroot, const double *along, const double *by_constants, const double *covariance,
    const double *rotation, const double *translation, double fx, double fy, double cx, double cy, double mean_middle,
    double mean_other, double spread_middle, double spread_other, double scale, double *out_value, double *out_slope,
    double *out_error, double *out_spread, double *centre_m, double *by_place);
KERNEL int rays_scene(
    const double *covariance, const double *line_spread, const double *centre_m, const double *by_place,
    const double *normal, const double *rotation, const double *translation, const double *pose_covariance,
    const double *bends, const double *visible, double dt_s, double shown_s, double hidden_s, double steepest,
    double steepest_sd, double least_seen, double most_seen, double least_facing, double fx, double *shift,
    double *out_spread, double *out_visible, double *tilt, double *facing_m2);
KERNEL int digits_measured(
    int blobs, const int64_t *taken, const uint8_t *with_depth, const double *value, const double *blob_variance,
    const double *area_px, const double *whole_px, const double *expected, const double *noise_factor, double whole_from,
    double shade_share, double radius_m, double fx, double crowded_radii, double crowded_px, double pixel_sd,
    double skin_px, double *measured, double *variance);
KERNEL int rays_read(
    const double *mean, const double *covariance, const double *slope, const double *centre_m, const double *by_place,
    const double *roots, const double *rotation, const double *translation, const double *turn_covariance, double fx,
    double fy, double across_m, double depth_stays, double share, double narrow2, int coupled, double *inherited,
    double *centres, double *disc_cam);
KERNEL int rays_limited(
    int modes, int size, const double *mean, const double *covariance, const double *slots, const double *limits,
    const double *direction, double abduction, double soft, double near_sd, double *out_mean, double *out_covariance,
    uint8_t *pulled);

#endif
