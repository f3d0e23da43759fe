/* Thumb and fingers: core/tracking/hand_geometry.py, digit_filter.py, digit_association.py and finger_model.py in C. */
#include "algebra.h"
#include "filter.h"
#include "kernels.h"

enum { CHAINS = 5, DIGIT = 21, SLOTS = 5, BENT = 6, OTHER = 10, JOINED = 16, POINTS = 2 * BENT + 1, SEEN = 9 };
enum { LENGTH = 5, FAN = 8, ROLL = 9, ROOT = 10, HEIGHT = 13 }; /* in slots and constants side by side */

static const double DIP_PER_PIP = 2.0 / 3.0;
static const int BENT_AT[BENT] = {0, 1, 2, 3, 4, 14};
static const int OTHER_AT[OTHER] = {10, 11, 12, 13, 15, 16, 17, 18, 19, 20};

/* Slots and constants (16) of a digit's state (21). */
static void joined(const double *state, double *out)
{
    memcpy(out, state, sizeof(double) * SLOTS);
    memcpy(out + SLOTS, state + 2 * SLOTS, sizeof(double) * (JOINED - SLOTS));
}

/* Discs (3, 3) of a digit in W. */
static void discs_of(int chain, const double *s, const double *root, double *out)
{
    double ahead[3], aside[3], up[3];
    const double azimuth = s[0] + s[FAN], c0 = cos(azimuth), s0 = sin(azimuth);
    if (chain == 0) {
        const double c1 = cos(s[1]), s1 = -sin(s[1]), c2 = cos(s[2]), s2 = -sin(s[2]), c3 = cos(s[3]), s3 = sin(s[3]);
        const double c4 = cos(s[4]), s4 = -sin(s[4]), c5 = cos(0.5 * s[4]), s5 = -sin(0.5 * s[4]);
        const double cr = cos(s[ROLL]), sr = sin(s[ROLL]);
        const double along[3] = {0.0, s[LENGTH + 1] - s[HEIGHT + 1] * s5,
                                 s[LENGTH + 1] + s[LENGTH + 2] * c4 - s[HEIGHT + 2] * s4};
        const double over[3] = {0.0, s[HEIGHT + 1] * c5, s[LENGTH + 2] * s4 + s[HEIGHT + 2] * c4};
        for (int d = 0; d < 3; d++) {
            double forth = 0.0, high = s[HEIGHT], across = 0.0;
            if (d) {
                const double straight = along[d] * c3;
                across = along[d] * s3;
                forth = straight * c2 - over[d] * s2;
                high = straight * s2 + over[d] * c2;
            }
            const double rolled = high * cr - across * sr;
            aside[d] = high * sr + across * cr;
            ahead[d] = (s[LENGTH] + forth) * c1 - rolled * s1;
            up[d] = (s[LENGTH] + forth) * s1 + rolled * c1;
        }
    } else {
        const double pitch[3] = {-s[1], -s[1] - s[2], -s[1] - (1.0 + DIP_PER_PIP) * s[2] - s[3]};
        const double normal[3] = {-s[1] - 0.5 * s[2], -s[1] - (1.0 + 0.5 * DIP_PER_PIP) * s[2] - 0.5 * s[3], pitch[2]};
        double forth = 0.0, high = 0.0;
        for (int d = 0; d < 3; d++) {
            forth += s[LENGTH + d] * cos(pitch[d]);
            high += s[LENGTH + d] * sin(pitch[d]);
            ahead[d] = forth - s[HEIGHT + d] * sin(normal[d]);
            up[d] = high + s[HEIGHT + d] * cos(normal[d]);
            aside[d] = 0.0;
        }
    }
    for (int d = 0; d < 3; d++) {
        out[3 * d] = ahead[d] * c0 - aside[d] * s0 + root[0] + s[ROOT];
        out[3 * d + 1] = ahead[d] * s0 + aside[d] * c0 + root[1] + s[ROOT + 1];
        out[3 * d + 2] = up[d] + root[2] - s[ROOT + 2];
    }
}

/* Directions of the bones and normals of the discs, (3, 3) each. */
static void frames_of(int chain, const double *s, double *direction, double *normal)
{
    const double azimuth = s[0] + s[FAN], c0 = cos(azimuth), s0 = sin(azimuth);
    if (chain) {
        const double pitch[3] = {s[1], s[1] + s[2], s[1] + (1.0 + DIP_PER_PIP) * s[2] + s[3]};
        const double tilt[3] = {s[1] + 0.5 * s[2], s[1] + (1.0 + 0.5 * DIP_PER_PIP) * s[2] + 0.5 * s[3], pitch[2]};
        for (int d = 0; d < 3; d++) {
            const double c = cos(pitch[d]), n = sin(tilt[d]);
            direction[3 * d] = c * c0, direction[3 * d + 1] = c * s0, direction[3 * d + 2] = -sin(pitch[d]);
            normal[3 * d] = n * c0, normal[3 * d + 1] = n * s0, normal[3 * d + 2] = cos(tilt[d]);
        }
        return;
    }
    const double c1 = cos(s[1]), s1 = sin(s[1]), c2 = cos(s[2]), s2 = sin(s[2]), c3 = cos(s[3]), s3 = sin(s[3]);
    const double cr = cos(s[ROLL]), sr = sin(s[ROLL]), cb = cos(s[4]), sb = sin(s[4]);
    const double ch = cos(0.5 * s[4]), sh = sin(0.5 * s[4]);
    const double phalanx[3] = {c3 * c2, -c3 * s2, s3}, lifted[3] = {s2, c2, 0.0};
    const double in[6][2] = {{0.0, 0.0}, {1.0, 0.0}, {cb, -sb}, {0.0, 0.0}, {sh, ch}, {sb, cb}};
    for (int k = 0; k < 6; k++) {
        double *to = k < 3 ? direction + 3 * k : normal + 3 * (k - 3);
        double x = k == 0, y = k == 3, z = 0.0;
        if (k != 0 && k != 3) {
            x = in[k][0] * phalanx[0] + in[k][1] * lifted[0];
            y = in[k][0] * phalanx[1] + in[k][1] * lifted[1];
            z = in[k][0] * phalanx[2] + in[k][1] * lifted[2];
        }
        const double over = cr * y - sr * z, across = sr * y + cr * z, ahead = x * c1 + over * s1;
        to[0] = ahead * c0 - across * s0, to[1] = ahead * s0 + across * c0, to[2] = over * c1 - x * s1;
    }
}

/* Joint centres (4, 3) from the root's to the tip. */
static void joints_of(const double *s, const double *root, const double *direction, double *out)
{
    out[0] = root[0] + s[ROOT], out[1] = root[1] + s[ROOT + 1], out[2] = root[2] - s[ROOT + 2];
    for (int d = 0; d < 3; d++)
        for (int k = 0; k < 3; k++)
            out[3 * (d + 1) + k] = out[3 * d + k] + s[LENGTH + d] * direction[3 * d + k];
}

int digits_spread(
    const double *mean, const double *covariance, const double *roots, double floor, double scale, double *disc_m,
    double *unroot, double *along, double *by_constants, double *normal)
{
    for (int r = 0; r < CHAINS; r++) {
        const double *wide = covariance + r * DIGIT * DIGIT, *root_m = roots + 3 * r;
        double root[BENT * BENT], other[BENT * OTHER], *inverse = unroot + r * BENT * BENT, *goes = along + r * BENT * OTHER;
        for (int i = 0; i < BENT; i++) {
            for (int j = 0; j < BENT; j++)
                root[i * BENT + j] = wide[BENT_AT[i] * DIGIT + BENT_AT[j]] + (i == j ? floor : 0.0);
            for (int j = 0; j < OTHER; j++)
                other[i * OTHER + j] = wide[BENT_AT[i] * DIGIT + OTHER_AT[j]];
        }
        if (root_and_inverse(root, inverse, BENT))
            return NOT_DEFINITE;
        product(goes, OTHER, inverse, BENT, 1, other, OTHER, BENT, BENT, OTHER, SET);
        double middle[DIGIT], moved[DIGIT], s[JOINED];
        memcpy(middle, mean + r * DIGIT, sizeof middle);
        joined(middle, s);
        double *discs = disc_m + r * POINTS * 9;
        discs_of(r, s, root_m, discs);
        double direction[9], joint[12], *facing = normal + 9 * r;
        frames_of(r, s, direction, facing);
        joints_of(s, root_m, direction, joint);
        for (int d = 0; d < 3; d++) {
            double slope[3][11] = {{0.0}}, lever[3];
            for (int k = 0; k < 3; k++) {
                for (int b = 0; b <= d; b++)
                    slope[k][b] = direction[3 * b + k];
                slope[k][5 + k] = k < 2 ? 1.0 : -1.0;
                slope[k][8 + d] = facing[3 * d + k];
                lever[k] = joint[3 * (d + 1) + k] + s[HEIGHT + d] * facing[3 * d + k] - joint[k];
            }
            slope[0][3] = -lever[1];
            slope[1][3] = lever[0];
            double *to = by_constants + (size_t)(3 * r + d) * 3 * OTHER;
            for (int k = 0; k < 3; k++)
                for (int j = 0; j < OTHER; j++)
                    to[k * OTHER + j] = slope[k][j < 4 ? j : j + 1];
        }
        for (int p = 0; p < BENT; p++)
            for (int sign = 0; sign < 2; sign++) {
                const double by = sign ? -scale : scale;
                memcpy(moved, middle, sizeof moved);
                for (int i = p; i < BENT; i++)
                    moved[BENT_AT[i]] += by * root[p * BENT + i];
                for (int j = 0; j < OTHER; j++)
                    moved[OTHER_AT[j]] += by * goes[p * OTHER + j];
                joined(moved, s);
                discs_of(r, s, root_m, discs + (1 + p + sign * BENT) * 9);
            }
    }
    return 0;
}

int digits_linearised(
    const double *disc_m, const double *unroot, const double *along, const double *by_constants, const double *covariance,
    const double *rotation, const double *translation, double fx, double fy, double cx, double cy,
    const double *weights, double *out_value, double *out_slope, double *out_error, double *out_spread,
    double *centre_m, double *by_place)
{
    const double mean_middle = weights[0], mean_other = weights[1], spread_middle = weights[2];
    const double spread_other = weights[3], scale = weights[4];
    for (int r = 0; r < CHAINS; r++) {
        double image[POINTS][SEEN], half[BENT * SEEN], bend[BENT][SEEN], constants[SEEN * OTHER];
        double *value = out_value + r * SEEN, *slope = out_slope + r * SEEN * DIGIT, *error = out_error + r * SEEN * SEEN;
        for (int p = 0; p < POINTS; p++)
            for (int d = 0; d < 3; d++) {
                double at[3];
                times3(rotation, disc_m + ((size_t)r * POINTS + p) * 9 + 3 * d, at);
                for (int k = 0; k < 3; k++)
                    at[k] += translation[k];
                if (p == 0)
                    memcpy(centre_m + 9 * r + 3 * d, at, sizeof at);
                image[p][3 * d] = at[0] * (fx / at[2]) + cx;
                image[p][3 * d + 1] = at[1] * (fy / at[2]) + cy;
                image[p][3 * d + 2] = at[2];
            }
        for (int k = 0; k < SEEN; k++) {
            value[k] = mean_middle * image[0][k];
            for (int p = 1; p < POINTS; p++)
                value[k] += mean_other * image[p][k];
            for (int p = 0; p < BENT; p++) {
                half[p * SEEN + k] = (image[1 + p][k] - image[1 + p + BENT][k]) * (0.5 / scale);
                bend[p][k] = 0.5 * (image[1 + p][k] + image[1 + p + BENT][k]) - value[k];
            }
        }
        for (int a = 0; a < SEEN; a++)
            for (int b = 0; b <= a; b++) {
                double sum = 0.0;
                for (int p = 0; p < BENT; p++)
                    sum += bend[p][a] * bend[p][b];
                sum = 2.0 * spread_other * sum + spread_middle * (image[0][a] - value[a]) * (image[0][b] - value[b]);
                error[a * SEEN + b] = error[b * SEEN + a] = sum;
            }
        for (int d = 0; d < 3; d++) {
            const double u = image[0][3 * d], v = image[0][3 * d + 1], z = image[0][3 * d + 2];
            const double own[9] = {fx / z, 0.0, (cx - u) / z, 0.0, fy / z, (cy - v) / z, 0.0, 0.0, 1.0};
            double turned[9];
            memcpy(by_place + (size_t)(3 * r + d) * 9, own, sizeof own);
            times33(own, rotation, turned);
            product(constants + 3 * d * OTHER, OTHER, turned, 3, 1, by_constants + (size_t)(3 * r + d) * 3 * OTHER, OTHER, 3,
                    3, OTHER, SET);
        }
        memset(slope, 0, sizeof(double) * SEEN * DIGIT);
        for (int a = 0; a < SEEN; a++) {
            double own[BENT];
            for (int p = 0; p < BENT; p++)
                own[p] = half[p * SEEN + a] - dot(along + (r * BENT + p) * OTHER, constants + a * OTHER, OTHER);
            for (int i = 0; i < BENT; i++) {
                double sum = 0.0;
                for (int p = 0; p < BENT; p++)
                    sum += own[p] * unroot[(r * BENT + p) * BENT + i];
                slope[a * DIGIT + BENT_AT[i]] = sum;
            }
            for (int j = 0; j < OTHER; j++)
                slope[a * DIGIT + OTHER_AT[j]] = constants[a * OTHER + j];
        }
        double cross[SEEN * DIGIT], turned[DIGIT * SEEN];
        product(cross, DIGIT, slope, DIGIT, 1, covariance + r * DIGIT * DIGIT, DIGIT, SEEN, DIGIT, DIGIT, SET);
        for (int a = 0; a < SEEN; a++)
            for (int j = 0; j < DIGIT; j++)
                turned[j * SEEN + a] = slope[a * DIGIT + j];
        double *spread = out_spread + r * SEEN * SEEN;
        memcpy(spread, error, sizeof(double) * SEEN * SEEN);
        product(spread, SEEN, cross, DIGIT, 1, turned, SEEN, SEEN, DIGIT, SEEN, ADD);
    }
    return 0;
}

static double between(double x, double least, double most)
{
    return x < least ? least : x > most ? most : x;
}

/* by_place times the matrix of the cross product with (from - at), (3, 3). */
static void by_turn(const double *by_place, const double *from, const double *at, double *out)
{
    const double x = from[0] - at[0], y = from[1] - at[1], z = from[2] - at[2];
    for (int k = 0; k < 3; k++) {
        const double *e = by_place + 3 * k;
        out[3 * k] = e[1] * z - e[2] * y;
        out[3 * k + 1] = e[2] * x - e[0] * z;
        out[3 * k + 2] = e[0] * y - e[1] * x;
    }
}

static void scene(
    const double *covariance, const double *line_spread, const double *centre_m, const double *by_place,
    const double *normal, const double *rotation, const double *translation, const double *pose_covariance,
    const double *bends, const double *visible, double dt_s, double shown_s, double hidden_s, double steepest,
    double steepest_sd, double least_seen, double most_seen, double least_facing, double fx, double *shift,
    double *out_spread, double *out_visible, double *tilt, double *facing_m2)
{
    const double stays = exp(-dt_s / shown_s), comes = -expm1(-dt_s / hidden_s);
    for (int r = 0; r < CHAINS; r++) {
        double flat[SEEN * 6], half[SEEN * 6], turned[6 * SEEN], variance = 0.0;
        for (int slot = 0; slot < 2; slot++)
            variance += covariance[(r * DIGIT + slot) * DIGIT + slot] * bends[SLOTS * r + slot];
        for (int d = 0; d < 3; d++) {
            const double *at = centre_m + 9 * r + 3 * d, *place = by_place + (size_t)(3 * r + d) * 9;
            double by[9], facing[3];
            by_turn(place, translation, at, by);
            for (int k = 0; k < 3; k++)
                for (int j = 0; j < 3; j++) {
                    flat[(3 * d + k) * 6 + j] = place[3 * k + j];
                    flat[(3 * d + k) * 6 + 3 + j] = by[3 * k + j];
                }
            times3(rotation, normal + 9 * r + 3 * d, facing);
            const double across = facing[0] * at[0] + facing[1] * at[1] + facing[2] * at[2];
            const double distance = sqrt(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
            const double tilted = acos(between(-across / distance, -1.0, 1.0));
            variance += covariance[(r * DIGIT + d + 2) * DIGIT + d + 2] * bends[SLOTS * r + d + 2];
            const double sd = sqrt(variance + steepest_sd * steepest_sd), seen = visible[3 * r + d];
            const double chance = 1.0 / (1.0 + exp(between(1.7 * (tilted - steepest) / sd, -30.0, 30.0)));
            out_visible[3 * r + d] = between((seen * stays + (1.0 - seen) * comes) * chance, least_seen, most_seen);
            tilt[3 * r + d] = tilted;
            const double faces = cos(tilted), across_px = fx / at[2];
            facing_m2[3 * r + d] = (faces < least_facing ? least_facing : faces) * across_px * across_px;
        }
        for (int a = 0; a < SEEN; a++)
            for (int k = 0; k < 6; k++)
                turned[k * SEEN + a] = flat[a * 6 + k];
        product(half, 6, flat, 6, 1, pose_covariance, 6, SEEN, 6, 6, SET);
        product(shift + r * SEEN * SEEN, SEEN, half, 6, 1, turned, SEEN, SEEN, 6, SEEN, SET);
        for (int k = 0; k < SEEN * SEEN; k++)
            out_spread[r * SEEN * SEEN + k] = line_spread[r * SEEN * SEEN + k] + shift[r * SEEN * SEEN + k];
    }
}

static const double PI = 3.14159265358979323846;

/* A blob larger than its disc measures a neighbour without one as well; of one digit. */
static void unresolved(
    const int64_t *assigned, const double *area_px, const double *whole_px, const double *disc_m2, const double *visible,
    const double *expected, const double *spread, double fx, double was_seen, double merged_from, double merged_share,
    double *measured, double *variance)
{
    int alone[3];
    for (int d = 0; d < 3; d++)
        alone[d] = assigned[d] < 0;
    for (int d = 0; d < 3; d++) {
        const double *at = expected + 3 * d, across = fx / at[2], face = disc_m2[d] * (across * across);
        if (assigned[d] < 0 || visible[d] < was_seen || !(area_px[assigned[d]] > merged_from * face))
            continue;
        const int other = d < 2 && alone[d + 1] ? d + 1 : d > 0 && alone[d - 1] ? d - 1 : -1;
        if (other < 0)
            continue;
        alone[other] = 0;
        const double more = (area_px[assigned[d]] - whole_px[d]) / face;
        const double half = sqrt(face / PI) * (more < 2.0 ? more : 2.0);
        double gap[2], far2 = 0.0, shifted2 = 0.0, unsure2 = 0.0;
        for (int k = 0; k < 2; k++) {
            const int i = 3 * d + k, j = 3 * other + k;
            gap[k] = expected[j] - expected[i];
            far2 += gap[k] * gap[k];
            unsure2 += spread[i * SEEN + i] + spread[j * SEEN + j] - 2.0 * spread[i * SEEN + j];
        }
        const double by = half / sqrt(far2 + unsure2);
        for (int k = 0; k < 2; k++)
            shifted2 += gap[k] * by * (gap[k] * by);
        const double stray2 = half * half * (1.0 + merged_share * merged_share) - shifted2;
        for (int k = 0; k < 2; k++) {
            measured[3 * other + k] = measured[3 * d + k] + gap[k] * by;
            variance[3 * other + k] = variance[3 * d + k] + stray2;
            measured[3 * d + k] -= gap[k] * by;
            variance[3 * d + k] += stray2;
        }
        const double deep = 2.0 * half * at[2] / fx;
        variance[3 * d + 2] += deep * deep;
    }
}

/* What the blobs as named measure of the discs, and how surely. */
static int digits_measured(
    int blobs, const int64_t *assigned, const uint8_t *with_depth, const double *value, const double *blob_variance,
    const double *area_px, const double *whole_px, const double *disc_m2, const uint8_t *has_discs, const double *visible,
    const double *expected, const double *spread, const double *noise_factor, double whole_from, double shade_share,
    double radius_m, double fx, double crowded_radii, double crowded_px, double was_seen, double merged_from,
    double merged_share, double pixel_sd, double skin_px, double *measured, double *variance)
{
    for (int r = 0; r < CHAINS; r++) {
        double radius[3];
        int crowded[3] = {0};
        for (int d = 0; d < 3; d++)
            radius[d] = radius_m * fx / expected[SEEN * r + 3 * d + 2];
        for (int d = 1; d < 3; d++) {
            const double *one = expected + SEEN * r + 3 * d, u = one[0] - one[-3], v = one[1] - one[-2];
            const double far = crowded_radii * radius[d];
            if (u * u + v * v < far * far)
                crowded[d] = crowded[d - 1] = 1;
        }
        for (int d = 0; d < 3; d++) {
            const int disc = 3 * r + d;
            const int64_t blob = assigned[disc];
            double *y = measured + 3 * disc, *of = variance + 3 * disc;
            y[0] = y[1] = y[2] = NAN;
            of[0] = of[1] = of[2] = 1.0;
            if (blob >= 0 && blob < blobs) {
                memcpy(y, value + 3 * blob, 3 * sizeof(double));
                memcpy(of, blob_variance + 3 * blob, 3 * sizeof(double));
                if (!with_depth[disc])
                    y[2] = NAN;
                const double missing = whole_from - area_px[blob] / whole_px[disc];
                const double wander = shade_share * sqrt(whole_px[disc] / PI) * (missing < 0.0 ? 0.0 : missing);
                const double close = crowded[d] ? crowded_px : 0.0;
                const double own = pixel_sd * pixel_sd + skin_px * skin_px + wander * wander + close * close;
                if (isfinite(own))
                    of[0] = of[1] = own;
            }
        }
        if (has_discs[r] && blobs)
            unresolved(assigned + 3 * r, area_px, whole_px + 3 * r, disc_m2 + 3 * r, visible + 3 * r, expected + SEEN * r,
                       spread + SEEN * SEEN * r, fx, was_seen, merged_from, merged_share, measured + SEEN * r,
                       variance + SEEN * r);
        for (int k = 0; k < SEEN; k++)
            variance[SEEN * r + k] *= noise_factor[SEEN * r + k];
    }
    return 0;
}

/* The digits a step ahead, their modes mixed before, and sigma points of them all: finger_model.py and digit_filter.py.
   `motion` has what is fixed: how fast slots with a variance in the long run return, how long modes last, rates are
   remembered, and slots take to be anywhere; of each slot the density, that variance, whether it moves and its variance
   over its range; the constants' drift; and the modes' scales, squared. */
int digits_ahead(
    int modes, double dt, const double *motion, const double *unseen_s, const double *mean, const double *covariance,
    const double *probability, const double *roots, double floor, double scale, double *out_mean, double *out_covariance,
    double *out_probability, double *whole_mean, double *whole, double *disc_m, double *unroot, double *along,
    double *by_constants, double *normal)
{
    enum { ALL = CHAINS * SLOTS, CONSTANTS = DIGIT - 2 * SLOTS };
    const double settles_s = motion[0], dwell_s = motion[1], memory_s = motion[2], anywhere_s = motion[3];
    const double *density = motion + 4, *stationary = density + ALL, *moves = stationary + ALL, *range2 = moves + ALL;
    const double *drift = range2 + ALL, *scales2 = drift + CHAINS * CONSTANTS;
    const double leave = 1.0 - exp(-dt / dwell_s), remembered = exp(-dt / memory_s);
    double change[modes * modes], forward[CHAINS * DIGIT * DIGIT] = {0.0}, noise[CHAINS * modes * DIGIT * DIGIT];
    for (int i = 0; i < modes; i++)
        for (int j = 0; j < modes; j++)
            change[i * modes + j] = modes == 1 ? 1.0 : i == j ? 1.0 - leave : leave / (modes - 1);
    memset(noise, 0, sizeof noise);
    for (int r = 0; r < CHAINS; r++) {
        double *ahead = forward + r * DIGIT * DIGIT;
        for (int j = 0; j < DIGIT; j++)
            ahead[j * (DIGIT + 1)] = 1.0;
        for (int s = 0; s < SLOTS; s++) {
            const int at = r * SLOTS + s, rate = SLOTS + s;
            const double stays = stationary[at] > 0.0 ? exp(-dt / settles_s) : 1.0;
            double keep = 1.0, angle2 = 0.0, rate2 = 0.0;
            if (unseen_s[at] > 0.0 && moves[at] != 0.0) {
                const double before = fmin(unseen_s[at], anywhere_s) / anywhere_s;
                const double after = fmin(unseen_s[at] + dt, anywhere_s) / anywhere_s;
                double speed = 0.0;
                for (int k = 0; k < modes; k++)
                    speed += probability[r * modes + k] * mean[(r * modes + k) * DIGIT + rate];
                keep = remembered;
                angle2 = range2[at] * (after * after * after - before * before * before +
                                       (before >= 1.0 ? dt / anywhere_s : 0.0));
                rate2 = (1.0 - keep * keep) * speed * speed;
            }
            ahead[s * DIGIT + s] = stays;
            ahead[s * DIGIT + rate] = keep * dt;
            ahead[rate * DIGIT + rate] = keep;
            for (int k = 0; k < modes; k++) {
                double *own = noise + (size_t)(r * modes + k) * DIGIT * DIGIT;
                own[s * DIGIT + s] = density[at] * (dt * dt * dt / 3.0) * scales2[k] + stationary[at] * (1.0 - stays * stays) + angle2;
                own[s * DIGIT + rate] = own[rate * DIGIT + s] = density[at] * (0.5 * dt * dt) * scales2[k];
                own[rate * DIGIT + rate] = density[at] * dt * scales2[k] + rate2;
            }
        }
        for (int k = 0; k < modes; k++)
            for (int j = 0; j < CONSTANTS; j++)
                noise[((size_t)(r * modes + k) * DIGIT + 2 * SLOTS + j) * DIGIT + 2 * SLOTS + j] = drift[r * CONSTANTS + j] * dt;
    }
    predicted(CHAINS, modes, DIGIT, change, mean, covariance, probability, forward, noise, out_mean, out_covariance,
              out_probability);
    if (!whole)
        return 0;
    merged(CHAINS, modes, DIGIT, out_mean, out_covariance, out_probability, whole_mean, whole);
    return digits_spread(whole_mean, whole, roots, floor, scale, disc_m, unroot, along, by_constants, normal);
}

/* What the camera should see of the digits and how surely, each disc named by itself, and all digits corrected as named:
   fingers.py. `ordinary` where all odds are known; where not, only the first of it is done. `settled` where nothing of it
   is doubted: all are jointly compatible, and no disc is named that was not seen a moment ago, nor the end of the thumb
   alone. Of the digits come in turn: `nine` what is expected, measured, its variance, the residuals; `square` covariances of
   what is not linear, of the images by the digits, by the palm, by both; `rows` of the discs the chance to be seen, the
   tilt, pixels for each square metre, and the area in pixels and in square metres. */
int digits_named(
    int modes, int blobs, const double *disc_m, const double *unroot, const double *along, const double *by_constants,
    const double *normal, const double *whole_mean, const double *whole, const double *rotation, const double *translation,
    const double *pose_covariance, double fx, double fy, double cx, double cy, const double *weights, const double *bends,
    const double *visible, double dt, double shown_s, double hidden_s, double steepest, double steepest_sd,
    double least_seen, double most_seen, double least_facing, const double *value, const double *variance,
    const double *area, const uint8_t *is_free, const double *disc_m2, const double *noise_factor, const uint8_t *has_discs,
    double prior, double depth_range, double outlier, double gate2, double impossible, double assumed, double whole_from,
    double shade_share, double radius_m, double crowded_radii, double crowded_px, double merged_from, double merged_share,
    double pixel_sd, double skin_px, double flat, double learning, const double *mean, const double *covariance, const double *probability, double *nine,
    double *square, double *rows, double *slope, double *centre_m, double *by_place, double *out_mean,
    double *out_covariance, double *out_probability, int64_t *assigned, uint8_t *with_depth, double *nis, int64_t *dof,
    const double *most_nis, double was_seen, uint8_t *ordinary, uint8_t *settled)
{
    enum { ALL = CHAINS * 3, NINE = CHAINS * SEEN, SQUARE = CHAINS * SEEN * SEEN };
    const int most = blobs > 0 ? blobs : 1;
    double *expected = nine, *measured = nine + NINE, *noise = measured + NINE, *residual = noise + NINE;
    double *error = square, *by_digits = square + SQUARE, *by_palm = by_digits + SQUARE, *by_both = by_palm + SQUARE;
    double *seen = rows, *tilt = rows + ALL, *facing = tilt + ALL, *whole_px = facing + ALL, *out_m2 = whole_px + ALL;
    double odds[ALL * most], own[ALL * 9], left[3 * most], left_variance[3 * most], share[DIGIT];
    uint8_t deep[ALL * most];
    int64_t blob_of[most];
    int free_blobs = 0;
    digits_linearised(disc_m, unroot, along, by_constants, whole, rotation, translation, fx, fy, cx, cy, weights, expected,
                      slope, error, by_digits, centre_m, by_place);
    scene(whole, by_digits, centre_m, by_place, normal, rotation, translation, pose_covariance, bends, visible, dt, shown_s,
          hidden_s, steepest, steepest_sd, least_seen, most_seen, least_facing, fx, by_palm, by_both, seen, tilt, facing);
    *ordinary = 0;
    *settled = 1;
    for (int d = 0; d < ALL; d++)
        whole_px[d] = disc_m2[d] * facing[d];
    for (int b = 0; b < blobs; b++)
        if (is_free[b]) {
            memcpy(left + 3 * free_blobs, value + 3 * b, 3 * sizeof *left);
            memcpy(left_variance + 3 * free_blobs, variance + 3 * b, 3 * sizeof *left);
            blob_of[free_blobs++] = b;
        }
    for (int d = 0; d < ALL; d++)
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++)
                own[9 * d + 3 * i + j] = by_both[81 * (d / 3) + (3 * (d % 3) + i) * SEEN + 3 * (d % 3) + j];
    log_odds(ALL, free_blobs, expected, own, left, left_variance, prior, depth_range, outlier, gate2, impossible, odds, deep);
    for (int d = 0; d < ALL; d++)
        for (int b = 0; b < free_blobs; b++)
            odds[d * free_blobs + b] =
                has_discs[d / 3] ? odds[d * free_blobs + b] + (log(seen[d] / (1.0 - seen[d])) - assumed) : impossible;
    if (!resolved(ALL, free_blobs, odds, assigned))
        return 0;
    for (int d = 0; d < ALL; d++) {
        with_depth[d] = assigned[d] >= 0 && deep[d * free_blobs + assigned[d]];
        assigned[d] = assigned[d] >= 0 ? blob_of[assigned[d]] : -1;
    }
    for (int d = 0; d < ALL; d++) {
        const int64_t *digit = assigned + d / 3 * 3;
        const int resolved = digit[0] >= 0 && digit[1] >= 0 && digit[2] >= 0;
        out_m2[d] = resolved && tilt[d] < flat ? area[assigned[d]] / facing[d] : NAN;
    }
    digits_measured(blobs, assigned, with_depth, value, variance, area, whole_px, disc_m2, has_discs, seen, expected,
                    by_both, noise_factor, whole_from, shade_share, radius_m, fx, crowded_radii, crowded_px, was_seen,
                    merged_from, merged_share, pixel_sd, skin_px, measured, noise);
    for (int j = 0; j < DIGIT; j++)
        share[j] = j < 2 * SLOTS ? 1.0 : learning;
    const int failed = corrected(CHAINS, modes, DIGIT, SEEN, mean, covariance, probability, expected, slope, error, whole_mean,
                                 measured, noise, by_palm, share, out_mean, out_covariance, out_probability, nis, dof, residual);
    *ordinary = !failed;
    for (int r = 0; r < CHAINS; r++) {
        int back = !r && assigned[2] >= 0 && assigned[1] < 0;
        for (int d = 3 * r; d < 3 * r + 3; d++)
            back |= assigned[d] >= 0 && seen[d] < was_seen;
        if (back || (dof[r] && !(nis[r] <= most_nis[dof[r]])))
            *settled = 0;
    }
    return failed;
}

/* X of A X = B, A (n, n) and B (n, m) spoilt, by elimination with pivots; 1 where A is singular. */
static int solved(double *a, double *b, int n, int m)
{
    for (int k = 0; k < n; k++) {
        int best = k;
        for (int i = k + 1; i < n; i++)
            if (fabs(a[i * n + k]) > fabs(a[best * n + k]))
                best = i;
        if (a[best * n + k] == 0.0)
            return NOT_DEFINITE;
        for (int j = 0; j < n && best != k; j++) {
            const double own = a[k * n + j];
            a[k * n + j] = a[best * n + j], a[best * n + j] = own;
        }
        for (int j = 0; j < m && best != k; j++) {
            const double own = b[k * m + j];
            b[k * m + j] = b[best * m + j], b[best * m + j] = own;
        }
        for (int i = k + 1; i < n; i++) {
            const double by = a[i * n + k] / a[k * n + k];
            add_scaled(a + i * n + k, -by, a + k * n + k, n - k);
            add_scaled(b + i * m, -by, b + k * m, m);
        }
    }
    for (int k = n - 1; k >= 0; k--) {
        for (int i = k + 1; i < n; i++)
            add_scaled(b + k * m, -a[k * n + i], b + i * m, m);
        for (int j = 0; j < m; j++)
            b[k * m + j] /= a[k * n + k];
    }
    return 0;
}

/* Joint angles, how sure and how fast; places of joints and discs: finger_model.py, read. */
int digits_read(
    const double *mean, const double *covariance, const double *slope, const double *centre_m, const double *by_place,
    const double *palm_m, const double *rotation, const double *translation, const double *turn_covariance,
    const double *cup, const double *cup_sd, const double *settings, int joints_read,
    const int64_t *chain, const double *weight, int sites_read, const int64_t *site, double *angle, double *sd, double *rate,
    double *place, double *disc_cam)
{
    enum { FLEXION = 1, SITES = 1 + 4 * CHAINS };
    const double fx = settings[0], fy = settings[1], across_m = settings[2], depth_stays = settings[3], share = settings[4];
    const double narrow2 = settings[5], wrist_m = settings[7], mirror = settings[8], *roots = palm_m + 3;
    const int coupled = settings[6] != 0.0;
    double inherited[CHAINS * SLOTS * SLOTS], centres[3 * SITES] = {0.0, 0.0, -wrist_m};
    for (int r = 0; r < CHAINS; r++) {
        double s[JOINED], direction[9], normal[9], joint[12], bound[9];
        joined(mean + r * DIGIT, s);
        frames_of(r, s, direction, normal);
        joints_of(s, roots + 3 * r, direction, joint);
        memcpy(centres + 3 + 12 * r, joint, sizeof joint);
        double unit[SEEN], by[SEEN * SLOTS], root_m[3], turned[SEEN * 3], seen[SEEN];
        times3(rotation, roots + 3 * r, root_m);
        for (int k = 0; k < 3; k++)
            root_m[k] += translation[k];
        for (int d = 0; d < 3; d++) {
            const double *at = centre_m + 9 * r + 3 * d, *place = by_place + (size_t)(3 * r + d) * 9;
            double tip[3], in_camera[3], moved[3], whole[9];
            unit[3 * d] = at[2] / (fx * across_m);
            unit[3 * d + 1] = at[2] / (fy * across_m);
            unit[3 * d + 2] = 1.0 / depth_stays;
            for (int k = 0; k < 3; k++)
                tip[k] = joint[3 * (d + 1) + k] + s[HEIGHT + d] * normal[3 * d + k];
            times3(rotation, tip, in_camera);
            for (int k = 0; k < 3; k++)
                disc_cam[9 * r + 3 * d + k] = in_camera[k] + translation[k];
            times3(rotation, normal + 3 * d, in_camera);
            for (int k = 0; k < 3; k++)
                moved[k] = -in_camera[2] * in_camera[k] + (k == 2);
            by_turn(place, root_m, at, whole);
            for (int k = 0; k < 3; k++) {
                const int row = 3 * d + k;
                for (int j = 0; j < SLOTS; j++)
                    by[row * SLOTS + j] = slope[((size_t)r * SEEN + row) * DIGIT + j] * unit[row];
                for (int j = 0; j < 3; j++)
                    turned[3 * row + j] = whole[3 * k + j] * unit[row];
                seen[row] = (place[3 * k] * moved[0] + place[3 * k + 1] * moved[1] + place[3 * k + 2] * moved[2]) *
                            (depth_stays * unit[row]);
            }
        }
        double joints[SLOTS * SLOTS], doubt[SLOTS * SLOTS] = {0.0}, response[SLOTS * SEEN];
        for (int i = 0; i < SLOTS; i++) {
            for (int j = 0; j < SLOTS; j++)
                joints[i * SLOTS + j] = covariance[(r * DIGIT + i) * DIGIT + j] + (i == j ? narrow2 : 0.0);
            doubt[i * SLOTS + i] = share;
        }
        if (solved(joints, doubt, SLOTS, SLOTS))
            return NOT_DEFINITE;
        for (int i = 0; i < SLOTS; i++) {
            for (int j = 0; j < SLOTS; j++)
                for (int a = 0; a < SEEN; a++)
                    doubt[i * SLOTS + j] += by[a * SLOTS + i] * by[a * SLOTS + j];
            for (int a = 0; a < SEEN; a++)
                response[i * SEEN + a] = by[a * SLOTS + i];
        }
        if (solved(doubt, response, SLOTS, SEEN))
            return NOT_DEFINITE;
        double own[SLOTS * 3] = {0.0}, half[SLOTS * 3], by_disc[SLOTS * 3] = {0.0};
        for (int i = 0; i < SLOTS; i++)
            for (int a = 0; a < SEEN; a++) {
                for (int j = 0; j < 3; j++)
                    own[3 * i + j] += response[i * SEEN + a] * turned[3 * a + j];
                by_disc[3 * i + a / 3] += response[i * SEEN + a] * seen[a];
            }
        product(half, 3, own, 3, 1, turn_covariance, 3, SLOTS, 3, 3, SET);
        for (int i = 0; i < SLOTS; i++)
            for (int j = 0; j < SLOTS; j++)
                inherited[(r * SLOTS + i) * SLOTS + j] =
                    dot(half + 3 * i, own + 3 * j, 3) + dot(by_disc + 3 * i, by_disc + 3 * j, 3);
        if (coupled && r) {
            s[3] = 0.0;
            frames_of(r, s, bound, normal);
            joints_of(s, roots + 3 * r, bound, centres + 3 + 12 * r);
        }
    }
    for (int j = 0; j < joints_read; j++) {
        const int r = (int)chain[j];
        const double *by = weight + SLOTS * j, *at = mean + r * DIGIT, *wide = covariance + (size_t)r * DIGIT * DIGIT;
        double variance = 0.0;
        if (r < 0 || r >= CHAINS)
            return OUTSIDE;
        /* A knuckle's flexion is against its own metacarpal. */
        angle[j] = dot(by, at, SLOTS) - by[FLEXION] * cup[r];
        rate[j] = dot(by, at + SLOTS, SLOTS);
        for (int i = 0; i < SLOTS; i++)
            for (int l = 0; l < SLOTS; l++) {
                double own = wide[i * DIGIT + l] + inherited[(r * SLOTS + i) * SLOTS + l];
                own += i == l ? settings[9] + (i == FLEXION ? cup_sd[r] * cup_sd[r] : 0.0) : 0.0;
                variance += by[i] * own * by[l];
            }
        sd[j] = sqrt(variance < 0.0 ? 0.0 : variance);
    }
    for (int m = 0; m < sites_read; m++) {
        if (site[m] < 0 || site[m] >= SITES)
            return OUTSIDE;
        memcpy(place + 3 * m, centres + 3 * site[m], 3 * sizeof *place);
        place[3 * m + 1] *= mirror;
    }
    return 0;
}

/* exp(x^2) times what is left of the normal curve beyond x. */
static double scaled_tail(double x)
{
    if (x < 20.0)
        return exp(x * x) * erfc(x);
    const double y = 1.0 / (x * x);
    return (1.0 - y * (0.5 - y * (0.75 - y * (1.875 - y * (6.5625 - y * 29.53125))))) / (x * 1.7724538509055160273);
}

/* Mean and variance after multiplication by a soft step up at the edge. */
static void softened(double *mean, double *variance, double edge, double soft)
{
    const double total = *variance + soft * soft, root = sqrt(total), z = (*mean - edge) / root;
    const double ratio = 0.79788456080286535588 / scaled_tail((-z > -20.0 ? -z : -20.0) * 0.70710678118654752440);
    *mean += *variance * ratio / root;
    *variance -= *variance * *variance * ratio * (z + ratio) / total;
}

/* Lowest and highest of the angles of a digit: joint_limits.py, slot_limits_rad. */
static void limits_of(int chain, const double *slots, const double *limits, double abduction, double edge[SLOTS][2])
{
    memcpy(edge, limits + chain * SLOTS * 2, sizeof(double) * SLOTS * 2);
    if (chain) {
        const double bent = cos(slots[1]);
        edge[0][1] = abduction * (bent < 0.0 ? 0.0 : bent);
        edge[0][0] = -edge[0][1];
    }
}

/* The digits with the limits of their joints taken into account, and merged; `misread` of each whether a picture has bent
   it as no finger bends: finger_model.py, within_reach. */
int digits_settled(
    int modes, const double *mean, const double *covariance, const double *probability, const double *limits,
    const double *direction, double abduction, double soft, double near_sd, double most_beyond, double *out_mean,
    double *out_covariance, double *whole_mean, double *whole, uint8_t *misread)
{
    const int n = DIGIT, nn = n * n;
    uint8_t pulled[CHAINS], any = 0;
    merged(CHAINS, modes, n, mean, covariance, probability, whole_mean, whole);
    for (int r = 0; r < CHAINS; r++) {
        double edge[SLOTS][2], across[modes][n * SLOTS], shared[modes][SLOTS * SLOTS], angle[modes][SLOTS];
        uint8_t near[modes][SLOTS];
        const double *turn = direction + r * SLOTS * SLOTS;
        limits_of(r, whole_mean + r * n, limits, abduction, edge);
        pulled[r] = 0;
        for (int k = 0; k < modes; k++) {
            const double *at = mean + (r * modes + k) * n, *wide = covariance + (size_t)(r * modes + k) * nn;
            for (int i = 0; i < n; i++)
                for (int j = 0; j < SLOTS; j++)
                    across[k][i * SLOTS + j] = dot(wide + i * n, turn + j * SLOTS, SLOTS);
            for (int j = 0; j < SLOTS; j++) {
                angle[k][j] = dot(at, turn + j * SLOTS, SLOTS);
                for (int l = 0; l < SLOTS; l++) {
                    shared[k][j * SLOTS + l] = 0.0;
                    for (int s = 0; s < SLOTS; s++)
                        shared[k][j * SLOTS + l] += turn[j * SLOTS + s] * across[k][s * SLOTS + l];
                }
                const double reach = near_sd * sqrt(shared[k][j * SLOTS + j] + soft * soft);
                near[k][j] = angle[k][j] - reach < edge[j][0] || angle[k][j] + reach > edge[j][1];
                pulled[r] |= near[k][j];
            }
        }
        memcpy(out_mean + r * modes * n, mean + r * modes * n, sizeof(double) * (size_t)(modes * n));
        memcpy(out_covariance + (size_t)r * modes * nn, covariance + (size_t)r * modes * nn,
               sizeof(double) * (size_t)modes * nn);
        for (int k = 0; pulled[r] && k < modes; k++) {
            double *at = out_mean + (r * modes + k) * n, *wide = out_covariance + (size_t)(r * modes + k) * nn;
            double precision[SLOTS], pull[SLOTS], inner[SLOTS * SLOTS], gain[SLOTS * n];
            for (int j = 0; j < SLOTS; j++) {
                const double variance = shared[k][j * SLOTS + j];
                precision[j] = pull[j] = 0.0;
                if (!near[k][j] || !(variance > 1e-9))
                    continue;
                double lowered = angle[k][j], narrow = variance;
                softened(&lowered, &narrow, edge[j][0], soft);
                lowered = -lowered;
                softened(&lowered, &narrow, -edge[j][1], soft);
                precision[j] = 1.0 / narrow - 1.0 / variance;
                precision[j] = precision[j] < 0.0 ? 0.0 : precision[j];
                pull[j] = -lowered / narrow - angle[k][j] / variance - precision[j] * angle[k][j];
            }
            /* The gain is across times the inverse of 1 + precision times shared: solved turned about. */
            for (int i = 0; i < SLOTS; i++) {
                for (int j = 0; j < SLOTS; j++)
                    inner[j * SLOTS + i] = (i == j) + precision[i] * shared[k][i * SLOTS + j];
                for (int a = 0; a < n; a++)
                    gain[i * n + a] = across[k][a * SLOTS + i];
            }
            if (solved(inner, gain, SLOTS, n))
                return NOT_DEFINITE;
            for (int j = 0; j < SLOTS; j++) {
                add_scaled(at, pull[j], gain + j * n, n);
                for (int a = 0; precision[j] != 0.0 && a < n; a++)
                    for (int b = 0; b < n; b++)
                        wide[a * n + b] -= gain[j * n + a] * precision[j] * across[k][b * SLOTS + j];
            }
        }
        any |= pulled[r];
    }
    if (any)
        merged(CHAINS, modes, n, out_mean, out_covariance, probability, whole_mean, whole);
    for (int r = 0; r < CHAINS; r++) {
        double edge[SLOTS][2];
        limits_of(r, whole_mean + r * n, limits, abduction, edge);
        misread[r] = 0;
        for (int j = 0; j < SLOTS; j++) {
            const double angle = dot(direction + (r * SLOTS + j) * SLOTS, whole_mean + r * n, SLOTS);
            misread[r] |= angle - edge[j][1] > most_beyond || edge[j][0] - angle > most_beyond;
        }
    }
    return 0;
}

int knuckles_bent(
    int count, const int64_t *asked, const double *mean, const double *root, const double *rotation,
    const double *translation, double fx, double fy, double cx, double cy, int readings, const double *pixel,
    const double *depth, double step, int bends, const double *bend, int shares, const double *share, double near,
    double steep, double facing_share, double most_past, double most_before, double nothing, double most_sd,
    double least_sd, double alike, double *value, double *variance)
{
    /* A lattice of the readings, one wider than they reach. */
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < 2 * readings; i++) {
        const double cell = rint(pixel[i] / step);
        if (!isfinite(cell))
            return OUTSIDE;
        low[i % 2] = cell < low[i % 2] ? cell : low[i % 2];
        high[i % 2] = cell > high[i % 2] ? cell : high[i % 2];
    }
    if (!readings || bends < 1)
        return OUTSIDE;
    const double wide = high[0] - low[0] + 3.0, tall = high[1] - low[1] + 3.0;
    if (wide * tall > 1e8)
        return NO_MEMORY;
    const int columns = (int)wide, rows = (int)tall;
    double *lattice = malloc(sizeof *lattice * ((size_t)columns * (size_t)rows + (size_t)bends));
    if (!lattice)
        return NO_MEMORY;
    double *total = lattice + (size_t)columns * (size_t)rows;
    for (int i = 0; i < columns * rows; i++)
        lattice[i] = NAN;
    for (int i = 0; i < readings; i++) {
        const int column = (int)(rint(pixel[2 * i] / step) - low[0]) + 1;
        lattice[((int)(rint(pixel[2 * i + 1] / step) - low[1]) + 1) * columns + column] = depth[i];
    }
    for (int a = 0; a < count; a++) {
        if (asked[a] < 0 || asked[a] >= CHAINS) {
            free(lattice);
            return OUTSIDE;
        }
        const int chain = (int)asked[a];
        double s[JOINED], least = INFINITY, weight = 0.0, middle = 0.0, spread = 0.0;
        joined(mean + chain * DIGIT, s);
        const double azimuth = s[FAN] + s[0], ahead_x = cos(azimuth), ahead_y = sin(azimuth);
        const double knuckle[3] = {root[3 * chain] + s[ROOT], root[3 * chain + 1] + s[ROOT + 1],
                                   root[3 * chain + 2] - s[ROOT + 2]};
        for (int q = 0; q < bends; q++) {
            const double over = sin(bend[q]), on = cos(bend[q]);
            const double along[3] = {on * ahead_x, on * ahead_y, -over}, normal[3] = {over * ahead_x, over * ahead_y, on};
            const double facing = -(rotation[6] * normal[0] + rotation[7] * normal[1] + rotation[8] * normal[2]);
            const double stray = facing > facing_share ? near : steep;
            total[q] = 0.0;
            for (int p = 0; p < shares; p++) {
                const double reach = share[p] * s[LENGTH];
                double place[3], seen[3];
                for (int k = 0; k < 3; k++)
                    place[k] = knuckle[k] + reach * along[k] + s[HEIGHT] * normal[k];
                for (int k = 0; k < 3; k++)
                    seen[k] = rotation[3 * k] * place[0] + rotation[3 * k + 1] * place[1] +
                              rotation[3 * k + 2] * place[2] + translation[k];
                const double c = rint((seen[0] * (fx / seen[2]) + cx) / step) - low[0] + 1.0;
                const double r = rint((seen[1] * (fy / seen[2]) + cy) / step) - low[1] + 1.0;
                const int column = c > 0.0 ? (c < columns - 1 ? (int)c : columns - 1) : 0;
                const int row = r > 0.0 ? (r < rows - 1 ? (int)r : rows - 1) : 0;
                const double past = lattice[row * columns + column] - seen[2], cost = 0.5 * (past / stray) * (past / stray);
                const double limit = past > 0.0 ? most_past : most_before;
                total[q] += !isfinite(past) ? nothing : cost < limit ? cost : limit;
            }
            least = total[q] < least ? total[q] : least;
        }
        for (int q = 0; q < bends; q++) {
            total[q] = exp(least - total[q]);
            weight += total[q];
            middle += total[q] * bend[q];
        }
        middle /= weight;
        for (int q = 0; q < bends; q++)
            spread += total[q] * (bend[q] - middle) * (bend[q] - middle);
        spread /= weight;
        if (spread < most_sd * most_sd) {
            value[chain] = middle;
            variance[chain] = alike * (spread > least_sd * least_sd ? spread : least_sd * least_sd);
        }
    }
    free(lattice);
    return 0;
}
