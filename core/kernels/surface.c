/* The back of the hand fitted to its readings: core/tracking/surface_fit.py in C. */
#include "algebra.h"
#include "kernels.h"
#include "palm_state.h"

/* Rotation of one turn, as so3.exp has it. */
void turn_matrix(const double *turn, double *out)
{
    const double x = turn[0], y = turn[1], z = turn[2], angle2 = x * x + y * y + z * z;
    double a = 1.0 - angle2 / 6.0, b = 0.5 - angle2 / 24.0;
    if (!(angle2 < 1e-8)) {
        const double angle = sqrt(angle2);
        a = sin(angle) / angle;
        b = (1.0 - cos(angle)) / angle2;
    }
    const double c = 1.0 - b * angle2;
    out[0] = c + b * x * x, out[1] = b * x * y - a * z, out[2] = b * x * z + a * y;
    out[3] = b * x * y + a * z, out[4] = c + b * y * y, out[5] = b * y * z - a * x;
    out[6] = b * x * z - a * y, out[7] = b * y * z + a * x, out[8] = c + b * z * z;
}

static int inverse33(const double *a, double *out)
{
    const double c0 = a[4] * a[8] - a[5] * a[7], c1 = a[5] * a[6] - a[3] * a[8], c2 = a[3] * a[7] - a[4] * a[6];
    const double det = a[0] * c0 + a[1] * c1 + a[2] * c2;
    if (det == 0.0)
        return NOT_DEFINITE;
    out[0] = c0 / det, out[1] = (a[2] * a[7] - a[1] * a[8]) / det, out[2] = (a[1] * a[5] - a[2] * a[4]) / det;
    out[3] = c1 / det, out[4] = (a[0] * a[8] - a[2] * a[6]) / det, out[5] = (a[2] * a[3] - a[0] * a[5]) / det;
    out[6] = c2 / det, out[7] = (a[1] * a[6] - a[0] * a[7]) / det, out[8] = (a[0] * a[4] - a[1] * a[3]) / det;
    return 0;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double between(double x, double least, double most)
{
    x = x > least ? x : least; /* also of what is not known */
    return x < most ? x : most;
}

/* Less than `least` used: it says nothing. */
int surface_fit(
    int count, const double *pixel, const double *depth, const double *view, const double *estimate_rotation,
    const double *value, int rows, int columns, const double *plane, const double *to_node, const double *middle, int steps,
    double huber, double most, int least, double share_in, double reading_per_m, double turn_sd, double up_sd,
    double goes_on, int *used, double *out_value, double *out_covariance, double *out_slope)
{
    const double fx = view[FX], fy = view[FY], cx = view[CX], cy = view[CY], patch = view[PATCH];
    const double *rotation_w0_cam = view + INTO_CAMERA, *translation = view + CAMERA_AT;
    double *work = malloc(sizeof(double) * (size_t)(16 * count + 1));
    if (!work)
        return NO_MEMORY;
    double *x0 = work, *y0 = x0 + count, *z0 = y0 + count, *own = z0 + count, *over = own + 6 * count,
           *weight = over + count, *u = weight + count, *v = u + count, *weighed = v + count; /* 3 of these */
    for (int i = 0; i < count; i++) {
        const double z = depth[i], in_camera[3] = {(pixel[2 * i] - cx) / fx * z - translation[0],
                                                   (pixel[2 * i + 1] - cy) / fy * z - translation[1],
                                                   z - translation[2]};
        double place[3];
        turned3(rotation_w0_cam, in_camera, place);
        x0[i] = place[0], y0[i] = place[1], z0[i] = place[2];
    }
    double rotation[9], position[3], shifted[3] = {0.0}, turned[3] = {0.0}, inverse[9] = {0.0};
    memcpy(rotation, estimate_rotation, sizeof rotation);
    memcpy(position, value + POSITION, sizeof position);
    int near = 0, failed = 0;
    for (int step = 0; step < steps && !failed; step++) {
        double off[3];
        turned3(rotation, position, off);
        for (int k = 0; k < 3; k++)
            off[k] = -off[k] - middle[k];
        double square[9] = {0.0}, side[3] = {0.0};
        near = 0;
        for (int i = 0; i < count; i++) {
            const double at[3] = {x0[i], y0[i], z0[i]};
            double place[3];
            turned3(rotation, at, place);
            const double x = place[0] + off[0], y = place[1] + off[1], z = place[2] + off[2];
            const double column = x * to_node[0] + y * to_node[2] + z * to_node[4] + to_node[6];
            const double row = x * to_node[1] + y * to_node[3] + z * to_node[5] + to_node[7];
            const int c = (int)between(nearbyint(column), 0.0, columns + 1.0);
            const int r = (int)between(nearbyint(row), 0.0, rows + 1.0);
            const double *n = plane + 4 * ((size_t)r * (columns + 2) + c);
            const double height = x * n[0] + y * n[1] + z * n[2] + n[3], size = fabs(height);
            const int is_near = size < most;
            const double w = is_near ? huber / (size > huber ? size : huber) : 0.0;
            double about[6] = {y * n[2] - z * n[1], z * n[0] - x * n[2], x * n[1] - y * n[0], n[0], n[1], n[2]};
            for (int k = 0; k < 6; k++)
                own[6 * i + k] = about[k];
            over[i] = height;
            weight[i] = w;
            near += is_near;
            const double kept[3] = {about[0], about[1], about[5]};
            for (int a = 0; a < 3; a++) {
                side[a] += kept[a] * w * height;
                for (int b = 0; b < 3; b++)
                    square[3 * a + b] += kept[a] * w * kept[b];
            }
        }
        if (near < least)
            break;
        failed = inverse33(square, inverse);
        if (failed)
            break;
        double found[3], moved[3], by[9], next[9];
        times3(inverse, side, found);
        const double turn[3] = {found[0], found[1], 0.0};
        const double shift[3] = {-found[1] * middle[2], found[0] * middle[2],
                                 found[2] - found[0] * middle[1] + found[1] * middle[0]};
        times3(rotation, shift, moved);
        for (int k = 0; k < 3; k++) {
            shifted[k] += shift[k];
            turned[k] += turn[k];
            position[k] += moved[k];
        }
        turn_matrix(turn, by);
        times33(rotation, by, next);
        memcpy(rotation, next, sizeof rotation);
    }
    *used = near;
    if (failed || near < least) {
        free(work);
        return failed;
    }
    /* Of the last step: how the readings scatter, and which share their errors. */
    double spread2 = 0.0, total = 0.0, by_own[18] = {0.0};
    int m = 0;
    for (int i = 0; i < count; i++) {
        spread2 += weight[i] * over[i] * over[i];
        total += weight[i];
        if (!(fabs(over[i]) < most))
            continue;
        const double *one = own + 6 * i, kept[3] = {one[0] * weight[i], one[1] * weight[i], one[5] * weight[i]};
        for (int a = 0; a < 3; a++) {
            weighed[a * count + m] = kept[a];
            for (int k = 0; k < 6; k++)
                by_own[6 * a + k] += kept[a] * one[k];
        }
        u[m] = pixel[2 * i] * (1.0 / patch);
        v[m] = pixel[2 * i + 1] * (1.0 / patch);
        m++;
    }
    spread2 /= total;
    const double *w0 = weighed, *w1 = weighed + count, *w2 = weighed + 2 * count;
    double alike[9] = {0.0}, alone[9] = {0.0};
    for (int i = 0; i < m; i++) {
        const double ui = u[i], vi = v[i];
        double s0 = 0.0, s1 = 0.0, s2 = 0.0;
#pragma omp simd reduction(+ : s0, s1, s2)
        for (int j = 0; j < m; j++) {
            double across = 1.0 - fabs(u[j] - ui), down = 1.0 - fabs(v[j] - vi);
            across = across > 0.0 ? across : 0.0;
            down = down > 0.0 ? down : 0.0;
            const double both = across * down;
            s0 += both * w0[j];
            s1 += both * w1[j];
            s2 += both * w2[j];
        }
        const double mine[3] = {w0[i], w1[i], w2[i]}, sum[3] = {s0, s1, s2};
        for (int a = 0; a < 3; a++)
            for (int b = 0; b < 3; b++) {
                alike[3 * a + b] += mine[a] * sum[b];
                alone[3 * a + b] += mine[a] * mine[b];
            }
    }
    qsort(memcpy(over, depth, sizeof(double) * (size_t)count), (size_t)count, sizeof(double), by_size);
    const double depth_m = 0.5 * (over[(count - 1) / 2] + over[count / 2]), depth2 = depth_m * depth_m;
    double reading_m = view[READING_FIXED] + view[READING_SQUARE] * depth2;
    if (reading_per_m * depth2 > reading_m)
        reading_m = reading_per_m * depth2;
    const double scatter2 = spread2 > reading_m * reading_m ? spread2 : reading_m * reading_m;
    const double part = view[AVERAGES] != 0.0 ? 1.0 : share_in;
    for (int k = 0; k < 9; k++)
        alike[k] = part * alike[k] + (1.0 - part) * alone[k];
    double half[9];
    times33(inverse, alike, half);
    times33(half, inverse, out_covariance);
    for (int k = 0; k < 9; k++)
        out_covariance[k] *= goes_on * scatter2;
    const double stays_px = view[STAYS_PX];
    const double up_m = stays_px != 0.0 ? view[STAYS_FIXED] + view[STAYS_SQUARE] * depth2 : 0.0;
    const double turn_rad = up_m * fx / ((stays_px > 1.0 ? stays_px : 1.0) * depth_m);
    out_covariance[0] += turn_sd * turn_sd + turn_rad * turn_rad;
    out_covariance[4] += turn_sd * turn_sd + turn_rad * turn_rad;
    out_covariance[8] += up_sd * up_sd + up_m * up_m;
    memset(out_slope, 0, sizeof(double) * 3 * SIZE);
    for (int a = 0; a < 3; a++) {
        double by_pose[6];
        for (int k = 0; k < 6; k++)
            by_pose[k] = inverse[3 * a] * by_own[k] + inverse[3 * a + 1] * by_own[6 + k] + inverse[3 * a + 2] * by_own[12 + k];
        const double *s = by_pose + 3;
        /* by_shift times the transposed matrix of the cross product with the middle. */
        const double by_turn[3] = {by_pose[0] - middle[2] * s[1] + middle[1] * s[2],
                                   by_pose[1] + middle[2] * s[0] - middle[0] * s[2],
                                   by_pose[2] - middle[1] * s[0] + middle[0] * s[1]};
        double *row = out_slope + a * SIZE;
        times3(estimate_rotation, s, row + POSITION);
        memcpy(row + TURN, by_turn, sizeof by_turn);
        row[RELIEF + a] = row[BACK + a] = 1.0;
        out_value[a] = -value[RELIEF + a] - value[BACK + a];
        for (int k = 0; k < 3; k++)
            out_value[a] += s[k] * shifted[k] + by_turn[k] * turned[k];
    }
    free(work);
    return 0;
}
