/* Which blob is which disc: association.py in C, for the digits. */
#include <math.h>
#include <string.h>

#include "filter.h"
#include "kernels.h"

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
