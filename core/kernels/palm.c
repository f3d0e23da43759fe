/* What the camera should see of the palm, and the palm after an update: palm_state.py and association.py in C. */
#include "algebra.h"
#include "filter.h"
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

static int linearised(
    const double *value, const double *covariance, const double *rotation, const double *view, const double *weights,
    double floor, double *out_value, double *out_slope, double *out_error)
{
    const double *palm = view + PALM, *hidden = view + HIDDEN, *image = view + IMAGE, *shift = view + SHIFT;
    const double fx = view[FX], fy = view[FY], cx = view[CX], cy = view[CY];
    const double mean_middle = weights[0], mean_other = weights[1], spread_middle = weights[2];
    const double spread_other = weights[3], scale = weights[4];
    double root[36], inverse[36], place[SEEN], seen[POINTS * SEEN], half[POSE_SIZE * SEEN], bend[POSE_SIZE * SEEN];
    for (int i = 0; i < POSE_SIZE; i++)
        for (int j = 0; j < POSE_SIZE; j++)
            root[6 * i + j] = covariance[POSE[i] * SIZE + POSE[j]] + (i == j ? floor : 0.0);
    if (root_and_inverse(root, inverse, POSE_SIZE))
        return NOT_DEFINITE;
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
    times33(view + INTO_CAMERA, rotation, in_camera);
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

int palm_sighted(
    int modes, const double *mean, const double *probability, const double *value, const double *covariance,
    const double *rotation, const double *view, const double *weights, double floor, double *line, double *slope,
    double *error, double *out_mean, double *out_covariance)
{
    if (linearised(value, covariance, rotation, view, weights, floor, line, slope, error))
        return NOT_DEFINITE;
    double middle[SIZE], cross[SEEN * SIZE];
    product(middle, SIZE, probability, modes, 1, mean, SIZE, 1, modes, SIZE, SET);
    product(cross, SIZE, slope, SIZE, 1, covariance, SIZE, SEEN, SIZE, SIZE, SET);
    for (int a = 0; a < SEEN; a++)
        out_mean[a] = line[a] + dot(slope + a * SIZE, middle, SIZE);
    for (int d = 0; d < DISCS; d++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                const int a = 3 * d + i, b = 3 * d + j;
                out_covariance[9 * d + 3 * i + j] = error[a * SEEN + b] + dot(cross + a * SIZE, slope + b * SIZE, SIZE);
            }
    return 0;
}

/* Jr of one turn, as so3.right_jacobian has it. */
static void right_jacobian(const double *turn, double *out)
{
    const double x = turn[0], y = turn[1], z = turn[2], angle2 = x * x + y * y + z * z;
    double b = 0.5 - angle2 / 24.0, c = 1.0 / 6.0 - angle2 / 120.0;
    if (!(angle2 < 1e-6)) {
        const double angle = sqrt(angle2);
        b = (1.0 - cos(angle)) / angle2;
        c = (angle - sin(angle)) / (angle2 * angle);
    }
    const double d = 1.0 - c * angle2;
    out[0] = d + c * x * x, out[1] = c * x * y + b * z, out[2] = c * x * z - b * y;
    out[3] = c * x * y - b * z, out[4] = d + c * y * y, out[5] = c * y * z + b * x;
    out[6] = c * x * z + b * y, out[7] = c * y * z - b * x, out[8] = d + c * z * z;
}

enum { SOFT = SIZE - SKIN, MOVING = SHAPE };
/* What is fixed about how a palm moves, in one row: motion.py, PalmMotion. Of each mode its scale and its tissue, of each
   tissue how long its numbers last, the rates to the others, and its stationary covariance follow. */
enum { DWELL, PUSH, TURNING, UNSEEN_SCALE, TURNING_RATE, LASTS_RAD, LEAVING_RAD, BY_MODE };
enum { HOME = 0, WRIST_MOVES = 5 };

/* How likely tissue goes over from row to column mode in a step, and what is left of its numbers: soft_tissue.py. */
static void tissue_ahead(
    int tissues, int resting, double dt, const double *motion, const double *lasts, const double *rates,
    const double *speeds, double *between, double *soft)
{
    const double turning = speeds[0], thumb = speeds[1], fingers = speeds[2];
    const int follows = isfinite(motion[LASTS_RAD]);
    double fastest = turning > thumb ? turning : thumb, pace = turning / motion[TURNING_RATE];
    fastest = fastest > fingers ? fastest : fingers;
    pace = 0.2 + (pace < 3.0 ? pace : 3.0);
    for (int i = 0; i < tissues; i++) {
        double total = 0.0, *row = between + i * tissues;
        for (int j = 0; j < tissues; j++) {
            row[j] = rates[i * tissues + j];
            if (follows && i == HOME && j != HOME)
                row[j] += motion[LEAVING_RAD] * fastest;
            else if (!follows && i < resting && j == WRIST_MOVES)
                row[j] *= pace;
            total += row[j];
        }
        const double leave = -expm1(-total * dt);
        for (int j = 0; j < tissues; j++)
            row[j] = i == j ? 1.0 - leave : row[j] * (leave / (total > 1e-12 ? total : 1e-12));
        for (int k = 0; k < SOFT; k++) {
            const double speed = k < 3 ? turning : k < 6 ? thumb : k < 3 * DISCS ? fingers : fastest;
            const double fading = dt / lasts[i * SOFT + k] + (follows ? dt / motion[LASTS_RAD] * speed : 0.0);
            soft[i * SOFT + k] = exp(-fading);
        }
    }
}

/* Where the discs are in camera axes. */
static void in_camera(const double *value, const double *rotation, const double *view, double *out)
{
    for (int d = 0; d < DISCS; d++) {
        double place[3], in_w0[3];
        for (int k = 0; k < 3; k++)
            place[k] = view[PALM + 3 * d + k] + value[SHAPE + 3 * d + k] + value[SKIN + 3 * d + k];
        times3(rotation, place, in_w0);
        for (int k = 0; k < 3; k++)
            in_w0[k] += value[POSITION + k];
        times3(view + INTO_CAMERA, in_w0, out + 3 * d);
        for (int k = 0; k < 3; k++)
            out[3 * d + k] += view[CAMERA_AT + k];
    }
}

/* How far the depths' errors are other ones than in the picture before: predicted_measurement.py. */
static double fresh_share(const double *before, const double *after, const double *view)
{
    double moved[3] = {0.0}, depth = 0.0;
    for (int d = 0; d < DISCS; d++) {
        for (int k = 0; k < 3; k++)
            moved[k] += fabs(after[3 * d + k] - before[3 * d + k]) / DISCS;
        depth += after[3 * d + 2] / DISCS;
    }
    const double windows = hypot(moved[0], moved[1]) * view[FX] / depth / view[PATCH];
    return 1.0 - exp(-2.0 * windows - moved[2] / (view[READING_FIXED] + view[READING_SQUARE] * depth * depth));
}

static void ahead(
    int modes, int tissues, int resting, int scales, double dt, const double *motion, const double *speeds,
    const double *unseen, const double *mean, const double *covariance, const double *probability, const double *value,
    const double *rotation, double *out_mean, double *out_covariance, double *out_probability, double *out_value,
    double *out_rotation, double *whole)
{
    const double *scale_of = motion + BY_MODE, *tissue_of = scale_of + modes, *lasts = tissue_of + modes;
    const double *rates = lasts + tissues * SOFT, *stationary = rates + tissues * tissues;
    const double dwell = motion[DWELL], push = motion[PUSH], turning = motion[TURNING];
    const double unseen_scale = motion[UNSEEN_SCALE];
    double between[tissues * tissues + 1], soft[tissues * SOFT + 1];
    tissue_ahead(tissues, resting, dt, motion, lasts, rates, speeds, between, soft);
    double change[modes * modes];
    double kept[modes * SIZE], driven[modes * MOVING * MOVING], relaxing[modes * SOFT * SOFT];
    double moving[MOVING * MOVING] = {0.0}, turn[3], turned[9], jr[9], across[9], middle[SIZE];
    for (int k = 0; k < 3; k++)
        turn[k] = value[RATE + k] * dt;
    turn_matrix(turn, turned);
    right_jacobian(turn, jr);

    /* Which mode follows which: of motion and of tissue at once, as long as that rests. */
    const int at_rest = scales * resting;
    const double leave = 1.0 - exp(-dt / dwell);
    for (int i = 0; i < modes; i++)
        for (int j = 0; j < modes; j++) {
            double chance = between[(int)tissue_of[i] * tissues + (int)tissue_of[j]];
            if (j < at_rest && i >= at_rest)
                chance /= scales;
            else if (j < at_rest && scales > 1)
                chance *= i / resting == j / resting ? 1.0 - leave : leave / (scales - 1);
            change[i * modes + j] = chance;
        }

    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            moving[(TURN + i) * MOVING + TURN + j] = turned[3 * j + i];
            moving[(TURN + i) * MOVING + RATE + j] = dt * jr[3 * i + j];
        }
    for (int k = 0; k < 3; k++) {
        moving[(POSITION + k) * (MOVING + 1)] = moving[(VELOCITY + k) * (MOVING + 1)] = 1.0;
        moving[(RATE + k) * (MOVING + 1)] = 1.0;
        moving[(POSITION + k) * MOVING + VELOCITY + k] = dt;
    }
    double on_the_way[9], along[9], unseen_way[9];
    times33t(jr, jr, on_the_way);
    if (unseen) {
        times33(jr, unseen, along);
        times33t(along, along, unseen_way);
    }
    memset(driven, 0, sizeof driven);
    for (int k = 0; k < modes; k++) {
        const double by = scale_of[k] * scale_of[k], *own = soft + (int)tissue_of[k] * SOFT;
        const double *rest = stationary + (int)tissue_of[k] * SOFT * SOFT;
        double *pushed = driven + k * MOVING * MOVING, *left = kept + k * SIZE;
        for (int i = 0; i < 3; i++) {
            pushed[(POSITION + i) * (MOVING + 1)] = by * (push * dt * dt * dt / 3.0);
            pushed[(POSITION + i) * MOVING + VELOCITY + i] = by * (push * dt * dt / 2.0);
            pushed[(VELOCITY + i) * MOVING + POSITION + i] = by * (push * dt * dt / 2.0);
            pushed[(VELOCITY + i) * (MOVING + 1)] = by * (push * dt);
        }
        double more = unseen_scale * unseen_scale - by;
        more = unseen && more > 0.0 ? more : 0.0;
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                const int at = 3 * i + j;
                double *both = pushed + (TURN + i) * MOVING, *rate = pushed + (RATE + i) * MOVING;
                both[TURN + j] = turning * dt * dt * dt / 3.0 * (by * on_the_way[at] + (more ? more * unseen_way[at] : 0.0));
                across[at] = turning * dt * dt / 2.0 * (by * jr[at] + (more ? more * along[at] : 0.0));
                both[RATE + j] = across[at];
                pushed[(RATE + j) * MOVING + TURN + i] = across[at];
                rate[RATE + j] = turning * dt * ((i == j ? by : 0.0) + (more ? more * unseen[at] : 0.0));
            }
        for (int j = 0; j < SIZE; j++)
            left[j] = j < SKIN ? 1.0 : own[j - SKIN];
        for (int i = 0; i < SOFT; i++)
            for (int j = 0; j < SOFT; j++)
                relaxing[(k * SOFT + i) * SOFT + j] = rest[i * SOFT + j] * (1.0 - own[i] * own[j]);
    }
    transitioned(modes, SIZE, MOVING, SOFT, change, mean, covariance, probability, moving, driven, kept, relaxing, value,
            out_mean, out_covariance, out_probability);
    merged(1, modes, SIZE, out_mean, out_covariance, out_probability, middle, whole);
    memcpy(out_value, value, sizeof(double) * SIZE);
    for (int k = 0; k < 3; k++) {
        out_value[POSITION + k] += value[VELOCITY + k] * dt;
        out_value[TURN + k] = 0.0;
    }
    times33(rotation, turned, out_rotation);
}

int palm_predicted(
    int modes, int tissues, int resting, int scales, double dt, const double *motion, double thumb, double fingers,
    double news, double stale, const double *view, const double *weights, double floor, const double *unseen, const double *mean,
    const double *covariance, const double *probability, const double *value, const double *rotation, double *out_mean,
    double *out_covariance, double *out_probability, double *out_value, double *out_rotation, double *whole,
    double *partial, double *line, double *slope, double *error, double *expected, double *expected_covariance)
{
    const double speeds[3] = {sqrt(dot(value + RATE, value + RATE, 3)), thumb, fingers};
    double before[3 * DISCS], after[3 * DISCS];
    ahead(modes, tissues, resting, scales, dt, motion, speeds, unseen, mean, covariance, probability, value, rotation,
          out_mean, out_covariance, out_probability, out_value, out_rotation, whole);
    in_camera(value, rotation, view, before);
    in_camera(out_value, out_rotation, view, after);
    const double fresh = fresh_share(before, after, view), learnt = 1.0 - sqrt(1.0 - news * (fresh < stale ? stale : fresh));
    for (int j = 0; j < SIZE; j++)
        partial[j] = j < SHAPE || j >= SKIN ? 1.0 : learnt;
    return palm_sighted(modes, out_mean, out_probability, out_value, whole, out_rotation, view, weights, floor, line,
                        slope, error, expected, expected_covariance);
}

/* The mixture as errors from its own mean: those of the turn to second order. */
static void error_reset(
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
}

int palm_reset(
    int modes, const double *mean, const double *covariance, const double *probability, const double *value,
    const double *rotation, int count, const double *pixel, const double *depth, const double *view, int rows, int columns,
    const double *plane, const double *to_node, const double *middle, int steps, double huber, double most, int least,
    double share_in, double reading_per_m, double turn_sd, double up_sd, double goes_on, double most_nis,
    const double *partial, double *out_mean, double *out_covariance, double *out_probability, double *whole,
    double *out_value, double *out_rotation, uint8_t *levelled)
{
    error_reset(modes, mean, covariance, probability, value, rotation, out_mean, whole, out_value, out_rotation);
    int used = 0;
    double told[3], spread[9], slope[3 * SIZE], off[modes * SIZE], about[SIZE] = {0.0}, none[3] = {0.0}, residual[3], nis;
    double variance[3] = {1e-12, 1e-12, 1e-12}, from[SIZE], turned[9]; /* its covariance is all the noise there is */
    int64_t dof;
    *levelled = 0;
    if (!pixel)
        return 0;
    int failed = surface_fit(count, pixel, depth, view, out_rotation, out_value, rows, columns, plane, to_node, middle, steps,
                             huber, most, least, share_in, reading_per_m, turn_sd, up_sd, goes_on, &used, told, spread, slope);
    if (failed || used < least)
        return failed;
    failed = corrected(1, modes, SIZE, 3, out_mean, covariance, probability, none, slope, spread, about, told, variance, 0,
                       partial, off, out_covariance, out_probability, &nis, &dof, residual);
    if (failed || nis > most_nis) /* so far off it is another surface */
        return failed;
    *levelled = 1;
    memcpy(from, out_value, sizeof from);
    memcpy(turned, out_rotation, sizeof turned);
    error_reset(modes, off, out_covariance, out_probability, from, turned, out_mean, whole, out_value, out_rotation);
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

/* The blob of each marker or -1, by the one-to-one names of greatest worth in all; 0 where an odd is no number. The
   likeliest of each where these are all others, else by augmenting paths over blobs and, of each marker, its own place to
   stay unnamed (Kuhn, Munkres): association.py, resolve. */
int resolved(int markers, int blobs, const double *odds, int64_t *assigned)
{
    const int places = blobs + markers;
    double by_marker[markers + 1], by_place[places + 1], least[places + 1];
    int taken[places + 1], before[places + 1], clash = 0;
    uint8_t is_used[places + 1];
    for (int m = 0; m < markers; m++) {
        int best = 0;
        for (int b = 0; b < blobs; b++) {
            if (!(odds[m * blobs + b] < INFINITY))
                return 0;
            best = odds[m * blobs + b] > odds[m * blobs + best] ? b : best;
        }
        assigned[m] = blobs && odds[m * blobs + best] > 0.0 ? best : -1;
        for (int other = 0; other < m; other++)
            clash |= assigned[m] >= 0 && assigned[other] == assigned[m];
    }
    if (!clash)
        return 1;
    memset(by_marker, 0, sizeof by_marker);
    memset(by_place, 0, sizeof by_place);
    memset(taken, 0, sizeof taken);
    for (int m = 1; m <= markers; m++) {
        int at = 0;
        taken[0] = m;
        memset(is_used, 0, sizeof is_used);
        for (int p = 0; p <= places; p++)
            least[p] = INFINITY;
        do {
            const int row = taken[at];
            double step = INFINITY;
            int next = 0;
            is_used[at] = 1;
            for (int p = 1; p <= places; p++) {
                if (is_used[p])
                    continue;
                const double odd = p <= blobs ? odds[(row - 1) * blobs + p - 1] : 0.0;
                const double cost = -(odd > 0.0 ? odd : 0.0) - by_marker[row] - by_place[p];
                if (cost < least[p])
                    least[p] = cost, before[p] = at;
                if (least[p] < step)
                    step = least[p], next = p;
            }
            for (int p = 0; p <= places; p++)
                if (is_used[p])
                    by_marker[taken[p]] += step, by_place[p] -= step;
                else
                    least[p] -= step;
            at = next;
        } while (taken[at]);
        for (; at; at = before[at])
            taken[at] = taken[before[at]];
    }
    for (int m = 0; m < markers; m++)
        assigned[m] = -1;
    for (int p = 1; p <= blobs; p++)
        if (taken[p] && odds[(taken[p] - 1) * blobs + p - 1] > 0.0)
            assigned[taken[p] - 1] = p - 1;
    return 1;
}

/* The ordinary case of palm_association.py, associate_and_update; any other is told by `ordinary`, and left to that. */
int palm_named(
    int modes, int blobs, const double *expected, const double *covariance, const double *value, const double *variance,
    const double *noise_factor, double prior, double depth_range, double outlier, double gate2, double impossible,
    int enough, const double *most_nis, int most_outliers, double outlier_sd, const double *mean,
    const double *wide, const double *probability, const double *line, const double *slope, const double *error,
    const double *partial, double *out_mean, double *out_covariance, double *out_probability, int64_t *assigned,
    uint8_t *used, double *residual, double *raw, double *nis, int64_t *dof, uint8_t *ordinary)
{
    double odds[DISCS * (blobs > 0 ? blobs : 1)], seen[SEEN], noise[SEEN], about[SIZE] = {0.0}, factor[SEEN];
    uint8_t with_depth[DISCS * (blobs > 0 ? blobs : 1)], deep[DISCS];
    int named = 0;
    *ordinary = 0;
    log_odds(DISCS, blobs, expected, covariance, value, variance, prior, depth_range, outlier, gate2, impossible, odds,
             with_depth);
    if (!resolved(DISCS, blobs, odds, assigned))
        return 0;
    for (int d = 0; d < DISCS; d++) {
        named += assigned[d] >= 0;
        deep[d] = assigned[d] >= 0 && with_depth[d * blobs + assigned[d]];
        if (assigned[d] >= 0 && !deep[d] && isfinite(value[3 * assigned[d] + 2]))
            return 0; /* whether others bear it out is asked elsewhere */
    }
    if (!named || (named < enough && named < blobs))
        return 0;
    memcpy(factor, noise_factor, sizeof factor);
    for (int k = 0; k < SEEN; k++) {
        const int64_t blob = assigned[k / 3];
        used[k] = blob >= 0 && (k % 3 < 2 || deep[k / 3]);
        seen[k] = used[k] ? value[3 * blob + k % 3] : NAN;
    }
    for (int round = 0; round <= most_outliers; round++) {
        for (int k = 0; k < SEEN; k++)
            noise[k] = used[k] ? variance[3 * assigned[k / 3] + k % 3] * factor[k] : 1.0;
        if (corrected(1, modes, SIZE, SEEN, mean, wide, probability, line, slope, error, about, seen, noise, 0, partial,
                      out_mean, out_covariance, out_probability, nis, dof, residual))
            return NOT_DEFINITE;
        if (!round) {
            if (*dof && !(*nis <= most_nis[*dof]))
                return 0;
            memcpy(raw, residual, sizeof factor);
        }
        /* The worst measurement is given the noise that its residual shows. */
        int worst = 0;
        for (int k = 0; k < SEEN; k++)
            worst = fabs(residual[k]) > fabs(residual[worst]) ? k : worst;
        const double size = fabs(residual[worst]);
        if (!(size > outlier_sd))
            break;
        const int first = worst / 3 * 3 + (worst % 3 == 2 ? 2 : 0), last = worst / 3 * 3 + (worst % 3 == 2 ? 3 : 2);
        for (int k = first; k < last; k++)
            factor[k] *= size * size;
    }
    *ordinary = 1;
    return 0;
}

/* The axes as the shape has refined them since they were worked out `about` another, to first order; 0 where the shape
   has moved too far for that: core/tracking/readout.py. */
static int axes_now(
    const double *axes, const double *sensitivity, const double *about, double most_m, const double *value, double *out)
{
    double moved[3 * DISCS], turn[3], by[9];
    for (int k = 0; k < 3 * DISCS; k++) {
        moved[k] = value[SHAPE + k] - about[k];
        if (fabs(moved[k]) > most_m)
            return 0;
    }
    for (int k = 0; k < 3; k++)
        turn[k] = dot(sensitivity + 3 * DISCS * k, moved, 3 * DISCS);
    turn_matrix(turn, by);
    times33(axes, by, out);
    return 1;
}

/* The palm for the fingers, and how the camera sees it: Readout.seat. */
int palm_seat(
    const double *known, const double *sensitivity, const double *about, double most_m, const double *disc,
    double metacarpal_m, double mirror, const double *value, const double *rotation, const double *covariance,
    const double *view, double *axes, double *origin, double *disc_m, double *cup, double *cup_sd, double *to_camera,
    double *at, double *pose, double *turn_covariance, uint8_t *is_near)
{
    enum { READ = SHAPE + 3 * DISCS - TURN, LOOSE = 4 };
    double unmirrored[9], error[3 * READ] = {0.0}, cross[3 * READ], spread[9], in_body[3 * DISCS];
    double body_cam[9], half[9], both[36] = {0.0}, own[36], part[36], in_w0[3], from[3];
    *is_near = (uint8_t)axes_now(known, sensitivity, about, most_m, value, unmirrored);
    if (!*is_near)
        return 0;
    for (int k = 0; k < 9; k++)
        axes[k] = k % 3 == 1 ? mirror * unmirrored[k] : unmirrored[k];
    for (int i = 0; i < 3; i++) {
        error[i * READ + i] = 1.0;
        for (int k = 0; k < 3; k++)
            add_scaled(error + i * READ + SHAPE - TURN, unmirrored[3 * i + k], sensitivity + k * 3 * DISCS, 3 * DISCS);
    }
    product(cross, READ, error, READ, 1, covariance + TURN * SIZE + TURN, SIZE, 3, READ, READ, SET);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            spread[3 * i + j] = dot(cross + i * READ, error + j * READ, READ);
    for (int d = 0; d < DISCS; d++)
        for (int k = 0; k < 3; k++)
            in_body[3 * d + k] =
                disc[3 * d + k] + value[SHAPE + 3 * d + k] + (d >= LOOSE && k ? value[SKIN + 3 * d + k] : 0.0);
    memcpy(origin, in_body, 3 * sizeof *origin);
    for (int d = 0; d < DISCS; d++) {
        for (int k = 0; k < 3; k++)
            from[k] = in_body[3 * d + k] - in_body[k];
        turned3(axes, from, disc_m + 3 * d);
    }
    for (int c = 0; c < 5; c++) {
        const int down = SKIN + 3 * (c + 1) + 2;
        cup[c] = c > 2 ? -value[down] / metacarpal_m : 0.0;
        cup_sd[c] = c > 2 ? sqrt(covariance[down * SIZE + down]) / metacarpal_m : 0.0;
    }
    times33(view + INTO_CAMERA, rotation, body_cam);
    times33(body_cam, axes, to_camera);
    times3(body_cam, origin, at);
    times3(view + INTO_CAMERA, value + POSITION, in_w0);
    for (int k = 0; k < 3; k++)
        at[k] += in_w0[k] + view[CAMERA_AT + k];
    for (int i = 0; i < 3; i++) {
        memcpy(both + 6 * i, view + INTO_CAMERA + 3 * i, 3 * sizeof(double));
        memcpy(both + 6 * (3 + i) + 3, body_cam + 3 * i, 3 * sizeof(double));
    }
    for (int i = 0; i < POSE_SIZE; i++)
        for (int j = 0; j < POSE_SIZE; j++)
            own[6 * i + j] = covariance[POSE[i] * SIZE + POSE[j]];
    product(part, 6, both, 6, 1, own, 6, 6, 6, 6, SET);
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 6; j++)
            pose[6 * i + j] = dot(part + 6 * i, both + 6 * j, 6);
    times33(body_cam, spread, half);
    times33t(half, body_cam, turn_covariance);
    return 0;
}

/* What a frame's row says of every marker: tracker.py. Of marker m the row `source` of the palm's and, after them,
   the digits' discs. */
int markers_told(
    int markers, int blobs, const int64_t *source, const int64_t *palm_blob, const double *palm_expected,
    const double *palm_covariance, const double *palm_off, const double *value, const double *rotation, const double *view,
    const int64_t *digit_blob, const double *digit_expected, const double *digit_covariance, const double *digit_off,
    const double *digit_m, const double *pixel, const double *depth, double pixel_sd, int64_t *blob, double *seen_px,
    double *seen_m, double *expected_px, double *expected_px2, double *disc_m, int64_t *worst)
{
    double palm_m[3 * DISCS], most = -1.0;
    in_camera(value, rotation, view, palm_m);
    *worst = 0;
    for (int m = 0; m < markers; m++) {
        const int s = (int)source[m], d = s - DISCS, on_palm = s < DISCS;
        if (s < 0 || s >= 21 || (!on_palm && !digit_blob))
            return OUTSIDE;
        const double *off = on_palm ? palm_off + 3 * s : digit_off + 3 * d;
        const double *wide = on_palm ? palm_covariance + 9 * s : digit_covariance + 81 * (d / 3) + 30 * (d % 3);
        const int step = on_palm ? 3 : 9;
        blob[m] = on_palm ? palm_blob[s] : digit_blob[d];
        memcpy(disc_m + 3 * m, on_palm ? palm_m + 3 * s : digit_m + 3 * d, 3 * sizeof(double));
        memcpy(expected_px + 2 * m, on_palm ? palm_expected + 3 * s : digit_expected + 3 * d, 2 * sizeof(double));
        for (int k = 0; k < 4; k++)
            expected_px2[4 * m + k] = wide[k / 2 * step + k % 2] + (k % 3 ? 0.0 : pixel_sd * pixel_sd);
        const int is_seen = blob[m] >= 0 && blob[m] < blobs;
        seen_px[2 * m] = is_seen ? pixel[2 * blob[m]] : NAN;
        seen_px[2 * m + 1] = is_seen ? pixel[2 * blob[m] + 1] : NAN;
        seen_m[m] = is_seen ? depth[blob[m]] : NAN;
        const double surprise = off[0] * off[0] + off[1] * off[1] + off[2] * off[2];
        if (surprise > most) {
            most = surprise;
            *worst = m;
        }
    }
    return 0;
}

/* The wrist's pose and clinical angles: core/tracking/readout.py and core/hand/clinical_angles.py. */
int wrist_read(
    const double *known, const double *sensitivity, const double *about, double most_m, const double *place,
    const double *value, const double *rotation, const double *covariance, const double *start, const double *stays,
    double side, double undefined_below, double *axes, double *position, double *shown, double *rate, double *angles,
    double *sd, double *zyz, uint8_t *is_near)
{
    enum { READ = SHAPE + 3 * DISCS - TURN, SHAPES = 3 * DISCS };
    double in_body[3], half[9], own[9], error[3 * READ] = {0.0}, cross[3 * READ], spread[9], axes_turned[9];
    *is_near = (uint8_t)axes_now(known, sensitivity, about, most_m, value, axes);
    if (!*is_near)
        return 0;
    for (int k = 0; k < 3; k++)
        in_body[k] = place[k] + value[SHAPE + k] + value[SKIN + k];
    times3(rotation, in_body, position);
    for (int k = 0; k < 3; k++)
        position[k] += value[POSITION + k];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            axes_turned[3 * i + j] = axes[3 * j + i];
    times33(axes_turned, rotation, half);
    times33(half, axes, own);
    turned3(axes, value + RATE, rate);
    for (int i = 0; i < 3; i++) {
        memcpy(error + i * READ, axes_turned + 3 * i, 3 * sizeof(double));
        for (int k = 0; k < 3; k++)
            add_scaled(error + i * READ + SHAPE - TURN, (i == k) - own[3 * k + i], sensitivity + k * SHAPES, SHAPES);
    }
    product(cross, READ, error, READ, 1, covariance + TURN * SIZE + TURN, SIZE, 3, READ, READ, SET);
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            spread[3 * i + j] = dot(cross + i * READ, error + j * READ, READ);
    if (stays) {
        double in_axes[9];
        times33(axes_turned, stays, half);
        times33(half, axes, in_axes);
        for (int k = 0; k < 9; k++)
            spread[k] += in_axes[k];
    }
    if (start)
        times33(start, own, shown);
    else
        memcpy(shown, own, sizeof own);
    const double sine = -shown[6] > 1.0 ? 1.0 : -shown[6] < -1.0 ? -1.0 : -shown[6];
    const double psi = atan2(shown[3], shown[0]), theta = asin(sine), phi = atan2(shown[7], shown[8]);
    const double sx = sin(phi), cx = cos(phi), cosine = cos(theta), c = fabs(cosine) < 1e-6 ? 1e-6 : cosine;
    const double t = side * sin(theta) / c;
    const double by_turn[9] = {0.0, side * sx / c, side * cx / c, 0.0, cx, -sx, side, sx * t, cx * t};
    angles[0] = side * psi;
    angles[1] = theta + 0.0;
    angles[2] = side * phi;
    for (int i = 0; i < 3; i++) {
        double along[3];
        turned3(spread, by_turn + 3 * i, along);
        const double variance = along[0] * by_turn[3 * i] + along[1] * by_turn[3 * i + 1] + along[2] * by_turn[3 * i + 2];
        sd[i] = sqrt(variance < 0.0 ? 0.0 : variance);
    }
    const double beta = atan2(hypot(shown[2], shown[5]), shown[8]);
    const int is_known = beta >= undefined_below;
    zyz[0] = is_known ? atan2(shown[5], shown[2]) : NAN;
    zyz[1] = is_known ? beta : NAN;
    zyz[2] = is_known ? atan2(shown[7], -shown[6]) : NAN;
    return 0;
}

/* Variance factors of u, v and depth after one more frame: core/tracking/predicted_measurement.py. */
int adapted_factors(
    int markers, const double *factor, const double *residual, const uint8_t *measured, double weight, double least,
    double most, double *out)
{
    for (int m = 0; m < markers; m++) {
        double square[3];
        for (int k = 0; k < 3; k++) {
            const double own = residual[3 * m + k] * residual[3 * m + k];
            square[k] = measured[3 * m + k] ? (own > most ? most : own) : 1.0;
        }
        square[0] = square[1] = 0.5 * (square[0] + square[1]);
        for (int k = 0; k < 3; k++) {
            const int at = 3 * m + k;
            const double grown = factor[at] * (1.0 + weight * (square[k] - 1.0));
            out[at] = !measured[at] ? factor[at] : grown < least ? least : grown > most ? most : grown;
        }
    }
    return 0;
}

/* Blobs as measurements: palm_association.py, measurements_of. */
int blobs_worth(
    int blobs, const double *pixel, const double *depth, const double *depth_sd, const double *area, int use_depth,
    double radius_px, double shade, double whole_from, double pixel_sd, double depth_ratio, double fixed_m,
    double square_per_m, int averages, double share, double patch, double stays_fixed, double stays_square,
    double *value, double *variance)
{
    for (int i = 0; i < blobs; i++) {
        const double hidden = whole_from - area[i] / (M_PI * radius_px * radius_px);
        const double wander_px = shade * radius_px * (hidden < 0.0 ? 0.0 : hidden);
        const int known = use_depth && isfinite(depth[i]);
        const double at_m = known ? depth[i] : 1.0, sd_m = known ? depth_sd[i] : 1.0, at2 = at_m * at_m;
        const double patches = share * area[i] / (patch * patch);
        double book_m = fixed_m + square_per_m * at2;
        if (averages)
            book_m /= sqrt(patches < 1.0 ? 1.0 : patches);
        const double book2 = book_m * book_m, beyond2 = sd_m * sd_m - book2, stays_m = stays_fixed + stays_square * at2;
        value[3 * i] = pixel[2 * i];
        value[3 * i + 1] = pixel[2 * i + 1];
        value[3 * i + 2] = use_depth ? depth[i] : NAN;
        variance[3 * i] = variance[3 * i + 1] = pixel_sd * pixel_sd + wander_px * wander_px;
        variance[3 * i + 2] = depth_ratio * depth_ratio * book2 + (beyond2 < 0.0 ? 0.0 : beyond2) + stays_m * stays_m;
    }
    return 0;
}
