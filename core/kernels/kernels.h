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

/* assignment.c */
KERNEL int least_assignment(int rows, int columns, const double cost[rows * columns], int64_t column_of[rows]);

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
KERNEL int transitioned(
    int modes, int size, int mixing, int relaxing, const double change[modes * modes],
    const double mean[modes * size], const double covariance[modes * size * size], const double probability[modes],
    const double moving[mixing * mixing], const double driven[modes * mixing * mixing],
    const double kept[modes * size], const double stationary[modes * relaxing * relaxing], const double nominal[size],
    double out_mean[modes * size], double out_covariance[modes * size * size], double out_probability[modes]);
KERNEL int predicted(
    int chains, int modes, int size, const double change[modes * modes], const double mean[chains * modes * size],
    const double covariance[chains * modes * size * size], const double probability[chains * modes],
    const double forward[chains * size * size], const double noise[chains * modes * size * size],
    double out_mean[chains * modes * size], double out_covariance[chains * modes * size * size],
    double out_probability[chains * modes]);
KERNEL int merged(
    int chains, int modes, int size, const double mean[chains * modes * size],
    const double covariance[chains * modes * size * size], const double probability[chains * modes],
    double whole_mean[chains * size], double whole[chains * size * size]);

/* palm.c */
KERNEL int palm_ahead(
    int modes, int tissues, int resting, int scales, double dt, const double *scale_of, const int64_t *tissue_of,
    const double *stationary, const double *between, const double *soft, double dwell, double push,
    double turning, double unseen_scale, const double *unseen, const double *mean, const double *covariance,
    const double *probability, const double *value, const double *rotation, double *out_mean, double *out_covariance,
    double *out_probability, double *out_value, double *out_rotation, double *whole);
KERNEL int palm_linearised(
    const double *value, const double *covariance, const double *rotation, const double *palm, const double *hidden,
    const double *image, const double *shift, const double *rotation_w0_cam, double fx, double fy, double cx, double cy,
    double floor, double mean_middle, double mean_other, double spread_middle, double spread_other, double scale,
    double *out_value, double *out_slope, double *out_error);
KERNEL int palm_expected(
    int modes, const double *covariance, const double *mean, const double *probability, const double *value,
    const double *slope, const double *error, double *out_mean, double *out_covariance);
KERNEL int error_reset(
    int modes, const double *mean, const double *covariance, const double *probability, const double *value,
    const double *rotation, double *out_mean, double *out_covariance, double *out_value, double *out_rotation);
KERNEL int log_odds(
    int markers, int blobs, const double expected[markers * 3], const double covariance[markers * 9],
    const double measured[blobs * 3], const double variance[blobs * 3], double prior, double depth_range,
    double outlier, double gate2, double impossible, double out[markers * blobs], uint8_t with_depth[markers * blobs]);
KERNEL int wrist_read(
    const double *axes, const double *sensitivity, const double *place, const double *value, const double *rotation,
    const double *covariance, const double *start, const double *stays, double side, double undefined_below,
    double *position, double *shown, double *rate, double *angles, double *sd, double *zyz);
KERNEL int adapted_factors(
    int markers, const double factor[markers * 3], const double residual[markers * 3],
    const uint8_t measured[markers * 3], double weight, double least, double most, double out[markers * 3]);

KERNEL int discs_in_camera(
    const double value[54], const double rotation[9], const double palm[18], const double rotation_w0_cam[9],
    const double translation[3], double out[18]);
KERNEL int blobs_worth(
    int blobs, const double pixel[blobs * 2], const double depth[blobs], const double depth_sd[blobs],
    const double area[blobs], int use_depth, double radius_px, double shade, double whole_from, double pixel_sd,
    double depth_ratio, double fixed_m, double square_per_m, int averages, double share, double patch,
    double stays_fixed, double stays_square, double value[blobs * 3], double variance[blobs * 3]);

/* surface.c */
KERNEL int surface_fit(
    int count, const double *pixel, const double *depth, double fx, double fy, double cx, double cy,
    const double *rotation_w0_cam,
    const double *translation, const double *estimate_rotation, const double *value, int rows, int columns,
    const double *plane, const double *to_node, const double *middle, int steps, double huber, double most, int least,
    double share_in, double reading_per_m, double reading_fixed, double reading_square, double stays_fixed,
    double stays_square, double stays_px, double patch, int averages, double turn_sd, double up_sd, double goes_on,
    double *used, double *out_value, double *out_covariance, double *out_slope);

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
    double centre[blobs * 2], double area[blobs], double similarity[blobs], double skin_share[blobs],
    double depth[blobs], double depth_sd[blobs]);
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

/* digits.c */
KERNEL int digits_spread(
    const double *mean, const double *covariance, const double *roots, double floor, double scale, double *disc_m,
    double *unroot, double *along, double *by_constants, double *normal);
KERNEL int digits_linearised(
    const double *disc_m, const double *unroot, const double *along, const double *by_constants, const double *covariance,
    const double *rotation, const double *translation, double fx, double fy, double cx, double cy, double mean_middle,
    double mean_other, double spread_middle, double spread_other, double scale, double *out_value, double *out_slope,
    double *out_error, double *out_spread, double *centre_m, double *by_place);
KERNEL int digits_scene(
    const double *covariance, const double *line_spread, const double *centre_m, const double *by_place,
    const double *normal, const double *rotation, const double *translation, const double *pose_covariance,
    const double *bends, const double *visible, double dt_s, double shown_s, double hidden_s, double steepest,
    double steepest_sd, double least_seen, double most_seen, double least_facing, double fx, double *shift,
    double *out_spread, double *out_visible, double *tilt, double *facing_m2);
KERNEL int digits_measured(
    int blobs, const int64_t *assigned, const uint8_t *with_depth, const double *value, const double *blob_variance,
    const double *area_px, const double *whole_px, const double *expected, const double *noise_factor, double whole_from,
    double shade_share, double radius_m, double fx, double crowded_radii, double crowded_px, double pixel_sd,
    double skin_px, double *measured, double *variance);
KERNEL int digits_read(
    const double *mean, const double *covariance, const double *slope, const double *centre_m, const double *by_place,
    const double *roots, const double *rotation, const double *translation, const double *turn_covariance, double fx,
    double fy, double across_m, double depth_stays, double share, double narrow2, int coupled, double *inherited,
    double *centres, double *disc_cam);
KERNEL int digits_limited(
    int modes, int size, const double *mean, const double *covariance, const double *slots, const double *limits,
    const double *direction, double abduction, double soft, double near_sd, double *out_mean, double *out_covariance,
    uint8_t *pulled);
KERNEL int knuckles_bent(
    int count, const int64_t asked[count], const double mean[105], const double root[15], const double rotation[9],
    const double translation[3], double fx, double fy, double cx, double cy, int readings,
    const double pixel[readings * 2], const double depth[readings], double step, int bends, const double bend[bends],
    int shares, const double share[shares], double near, double steep, double facing_share, double most_past,
    double most_before, double nothing, double most_sd, double least_sd, double alike, double value[5],
    double variance[5]);
KERNEL int digits_image(
    const double disc_m[585], const double rotation[9], const double translation[3], double fx, double fy, double cx,
    double cy, double scale, double pixel[30], double covariance[60], double depth[15]);
KERNEL int best_posture(
    int postures, int blobs, const double disc[postures * 9], const double point[blobs * 3], double near2,
    double nearness, double score[1], int64_t best[1], int64_t used[3], int64_t found[1]);

/* skin.c */
KERNEL int skin_traced(
    int cones, const double cone[cones * 18], const int32_t box[cones * 4], const int32_t part_of[cones],
    const double reach[7], int top, int left, int height, int width, const float x[width], const float y[height],
    double start, double fx, float depth[height * width], float coverage[height * width],
    float normal[height * width * 3], uint8_t part[height * width]);

#endif
