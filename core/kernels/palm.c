/* What the camera should see of the palm, and the palm after an update: palm_view.py and association.py in C. */
#include "algebra.h"
#include "kernels.h"
#include "palm_state.h"

enum { POSE_SIZE = 6, POINTS = 2 * POSE_SIZE + 1, SEEN = 3 * DISCS };

static const int POSE[POSE_SIZE] = {0, 1, 2, 6, 7, 8};

/* u, v and z of the discs at a pose; `image` leads from w0 to u z, v z, z, applied to rows. */
static void observed(
    const double *position, const double *rotation, const double *place, const double *image, const double *shift,
    double *out)
{
    double at[3];
    turned3(image, position, at);
    for (int d = 0; d < DISCS; d++) {
        double about[3], seen[3];
        times3(rotation, place + 3 * d, about);
        turned3(image, about, seen);
        for (int k = 0; k < 3; k++)
            seen[k] += at[k] + shift[k];
        out[3 * d] = seen[0] / seen[2];
        out[3 * d + 1] = seen[1] / seen[2];
        out[3 * d + 2] = seen[2];
    }
}

int palm_line(
    const double *value, const double *covariance, const double *rotation, const double *palm, const double *hidden,
    const double *image, const double *shift, const double *rotation_w0_cam, double fx, double fy, double cx, double cy,
    double floor, double mean_middle, double mean_other, double spread_middle, double spread_other, double scale,
    double *out_value, double *out_slope, double *out_error)
{
    double root[36], inverse[36], place[SEEN], seen[POINTS * SEEN], half[POSE_SIZE * SEEN], bend[POSE_SIZE * SEEN];
    for (int i = 0; i < POSE_SIZE; i++)
        for (int j = 0; j < POSE_SIZE; j++)
            root[6 * i + j] = covariance[POSE[i] * SIZE + POSE[j]] + (i == j ? floor : 0.0);
    if (root_and_inverse(root, inverse, POSE_SIZE))
        return 1;
    for (int k = 0; k < SEEN; k++)
        place[k] = palm[k] + value[SHAPE + k] + value[SKIN + k];
    observed(value + POSITION, rotation, place, image, shift, seen);
    for (int p = 0; p < POSE_SIZE; p++) {
        /* Row p of the root's upper half: its column p. */
        double step[POSE_SIZE], by[9], back[9], turned[9], position[3];
        for (int k = 0; k < POSE_SIZE; k++)
            step[k] = k < p ? 0.0 : scale * root[6 * p + k];
        turn_matrix(step + 3, by);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                back[3 * i + j] = by[3 * j + i];
        for (int sign = 0; sign < 2; sign++) {
            for (int k = 0; k < 3; k++)
                position[k] = value[POSITION + k] + (sign ? -step[k] : step[k]);
            times33(rotation, sign ? back : by, turned);
            observed(position, turned, place, image, shift, seen + (1 + p + sign * POSE_SIZE) * SEEN);
        }
    }
    for (int k = 0; k < SEEN; k++) {
        double sum = mean_middle * seen[k];
        for (int p = 1; p < POINTS; p++)
            sum += mean_other * seen[p * SEEN + k];
        out_value[k] = sum;
    }
    for (int p = 0; p < POSE_SIZE; p++)
        for (int k = 0; k < SEEN; k++) {
            const double plus = seen[(1 + p) * SEEN + k], minus = seen[(1 + p + POSE_SIZE) * SEEN + k];
            half[p * SEEN + k] = (plus - minus) * (0.5 / scale);
            bend[p * SEEN + k] = 0.5 * (plus + minus) - out_value[k];
        }
    for (int a = 0; a < SEEN; a++)
        for (int b = 0; b <= a; b++) {
            double sum = 0.0;
            for (int p = 0; p < POSE_SIZE; p++)
                sum += bend[p * SEEN + a] * bend[p * SEEN + b];
            sum *= 2.0 * spread_other;
            sum += spread_middle * (seen[a] - out_value[a]) * (seen[b] - out_value[b]);
            out_error[a * SEEN + b] = out_error[b * SEEN + a] = sum;
        }
    memset(out_slope, 0, sizeof(double) * SEEN * SIZE);
    /* Slope by the pose: half' L^-1. */
    for (int a = 0; a < SEEN; a++)
        for (int j = 0; j < POSE_SIZE; j++) {
            double sum = 0.0;
            for (int p = j; p < POSE_SIZE; p++)
                sum += half[p * SEEN + a] * inverse[6 * p + j];
            out_slope[a * SIZE + POSE[j]] = sum;
        }
    double in_camera[9];
    times33(rotation_w0_cam, rotation, in_camera);
    for (int d = 0; d < DISCS; d++) {
        const double u = seen[3 * d], v = seen[3 * d + 1], z = seen[3 * d + 2];
        const double by_place[9] = {fx / z, 0.0, (cx - u) / z, 0.0, fy / z, (cy - v) / z, 0.0, 0.0, 1.0};
        double own[9];
        times33(by_place, in_camera, own);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                double *row = out_slope + (3 * d + i) * SIZE;
                row[SHAPE + 3 * d + j] = row[SKIN + 3 * d + j] = own[3 * i + j];
            }
    }
    for (int d = 0; d < DISCS; d++) {
        double sum = 0.0;
        for (int k = 0; k < SEEN; k++) {
            out_slope[(3 * d + 2) * SIZE + SHAPE + k] -= hidden[d * SEEN + k];
            sum += hidden[d * SEEN + k] * value[SHAPE + k];
        }
        out_value[3 * d + 2] -= sum;
    }
    return 0;
}

/* Of the line, over all modes: where each disc should be seen, and its own covariance. */
int palm_expected(
    int modes, const double *covariance, const double *mean, const double *probability, const double *value,
    const double *slope, const double *error, double *out_mean, double *out_covariance)
{
    double middle[SIZE], cross[SEEN * SIZE];
    product(middle, SIZE, probability, modes, 1, mean, SIZE, 1, modes, SIZE, SET);
    product(cross, SIZE, slope, SIZE, 1, covariance, SIZE, SEEN, SIZE, SIZE, SET);
    for (int a = 0; a < SEEN; a++)
        out_mean[a] = value[a] + dot(slope + a * SIZE, middle, SIZE);
    for (int d = 0; d < DISCS; d++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                const int a = 3 * d + i, b = 3 * d + j;
                out_covariance[9 * d + 3 * i + j] = error[a * SEEN + b] + dot(cross + a * SIZE, slope + b * SIZE, SIZE);
            }
    return 0;
}

/* The bank as errors from its own mean: those of the turn to second order. */
int recentred(
    int modes, const double *mean, const double *covariance, const double *probability, const double *value,
    const double *rotation, double *out_mean, double *out_covariance, double *out_value, double *out_rotation)
{
    double middle[SIZE], by[9];
    merged(1, modes, SIZE, mean, covariance, probability, middle, out_covariance);
    const double *m = middle + TURN;
    for (int k = 0; k < modes; k++) {
        const double *from = mean + k * SIZE, *e = from + TURN;
        double *to = out_mean + k * SIZE;
        for (int j = 0; j < SIZE; j++)
            to[j] = from[j] - middle[j];
        to[TURN] += 0.5 * (e[1] * m[2] - e[2] * m[1]);
        to[TURN + 1] += 0.5 * (e[2] * m[0] - e[0] * m[2]);
        to[TURN + 2] += 0.5 * (e[0] * m[1] - e[1] * m[0]);
    }
    for (int j = 0; j < SIZE; j++)
        out_value[j] = value[j] + middle[j];
    out_value[TURN] = out_value[TURN + 1] = out_value[TURN + 2] = 0.0;
    turn_matrix(m, by);
    times33(rotation, by, out_rotation);
    return 0;
}

int log_odds(
    int markers, int blobs, const double *expected, const double *covariance, const double *measured,
    const double *variance, double prior, double depth_range, double outlier, double gate2, double impossible,
    double *out, uint8_t *with_depth)
{
    for (int j = 0; j < markers; j++) {
        const double *at = expected + 3 * j, *c = covariance + 9 * j;
        for (int i = 0; i < blobs; i++) {
            const double *y = measured + 3 * i, *r = variance + 3 * i;
            const double u = y[0] - at[0], s_u = c[0] + r[0], v_by_u = c[1] / s_u, z_by_u = c[2] / s_u;
            const double v = y[1] - at[1] - v_by_u * u, s_v = c[4] + r[1] - v_by_u * c[1];
            const double vz = c[5] - v_by_u * c[2], z_by_v = vz / s_v;
            const double z = y[2] - at[2] - z_by_u * u - z_by_v * v, s_z = c[8] + r[2] - z_by_u * c[2] - z_by_v * vz;
            const double flat2 = u * u / s_u + v * v / s_v, z2 = z * z / s_z;
            const int has_depth = isfinite(y[2]);
            double flat = prior - 0.5 * (flat2 + log(s_u * s_v));
            double full = flat + depth_range - 0.5 * (z2 + log(s_z));
            if (has_depth)
                flat += outlier;
            if (flat2 > gate2)
                flat = impossible;
            if (!(flat2 + z2 <= gate2))
                full = impossible;
            /* Unknown where either is. */
            out[j * blobs + i] = full >= flat || full != full ? full : flat;
            with_depth[j * blobs + i] = has_depth && full >= flat;
        }
    }
    return 0;
}
