/* A blob's place, likeness and depth from its window: core/detection/detector.py and blobs.py in C, sums in double. */
#include "algebra.h"
#include "kernels.h"

enum { WEDGES = 8 };


static void in_order(double *x, int n)
{
    for (int i = 1; i < n; i++) {
        const double own = x[i];
        int j = i;
        for (; j > 0 && x[j - 1] > own; j--)
            x[j] = x[j - 1];
        x[j] = own;
    }
}

int blobs_measured(
    int blobs, const uint16_t *own, const double *rough, int left, int top, int height, int width,
    const uint16_t *labels, const uint8_t *hsv, int whole_height, int whole_width, const uint8_t *color, const uint16_t *raw, int has_depth,
    double unit_m, int pixels, const int64_t *row, const int64_t *column, const uint8_t *reach, int core, int near,
    int rim_from, int rim_to, const float *wedge, const int64_t *pick, const uint8_t *cell, const uint8_t *is_skin,
    int cells, const double *reference, double low, double high, double fewest_rim, double fewest_core, double iqr_m,
    double valid_share, double fewest_readings, double edge_step, double edge_sd, double slope_share, double fixed_m,
    double square_per_m, double patch, int averages, double *centre, double *area, double *similarity,
    double *skin_share, double *depth, double *depth_sd)
{
    double *work = malloc(sizeof(double) * (size_t)(cells + 2 * pixels) + sizeof(int) * (size_t)(2 * pixels) +
                          2 * (size_t)pixels);
    if (!work)
        return 1;
    double *counts = work, *inner = counts + cells, *ordered = inner + pixels;
    int *at = (int *)(ordered + pixels), *in_whole = at + pixels;
    uint8_t *mine = (uint8_t *)(in_whole + pixels), *free_of = mine + pixels;
    for (int b = 0; b < blobs; b++) {
        const double middle_u = nearbyint(rough[2 * b]), middle_v = nearbyint(rough[2 * b + 1]);
        const int mu = (int)middle_u, mv = (int)middle_v;
        int total = 0;
        memset(counts, 0, sizeof(double) * (size_t)cells);
        for (int p = 0; p < pixels; p++) {
            int u = mu + (int)column[p], v = mv + (int)row[p];
            const int inside = u >= 0 && u < width && v >= 0 && v < height;
            u = u < 0 ? 0 : u >= width ? width - 1 : u;
            v = v < 0 ? 0 : v >= height ? height - 1 : v;
            at[p] = v * width + u;
            in_whole[p] = (v + top) * whole_width + u + left;
            mine[p] = inside && labels[at[p]] == own[b];
            free_of[p] = inside && labels[at[p]] == 0;
            if (mine[p]) {
                const uint8_t *look = hsv + 3 * (size_t)at[p];
                counts[cell[look[0] + 256 * look[1]]] += 1.0;
                total++;
            }
        }
        double alike = 0.0;
        for (int c = 0; c < cells; c++)
            if (counts[c] > 0.0)
                alike += sqrt(counts[c]) * reference[c];
        similarity[b] = alike / sqrt(total > 1 ? total : 1);

        /* Colour: of the rim in eight directions and as a whole, of the core and the whole blob. */
        double ground[WEDGES + 2][4] = {{0.0}}, rim[4] = {0.0}, blob[4] = {0.0};
        int skins = 0;
        for (int p = rim_from; p < rim_to; p++) {
            if (!free_of[p])
                continue;
            const uint8_t *c = color + 3 * (size_t)in_whole[p], *look = hsv + 3 * (size_t)at[p];
            skins += is_skin[look[0] + 256 * look[1]];
            const double seen[4] = {c[0], c[1], c[2], 1.0};
            for (int k = 0; k < 4; k++)
                rim[k] += seen[k];
            for (int w = 0; w < WEDGES; w++)
                if (wedge[(p - rim_from) * WEDGES + w] != 0.0f)
                    for (int k = 0; k < 4; k++)
                        ground[w][k] += seen[k];
        }
        skin_share[b] = skins / (rim[3] > 1.0 ? rim[3] : 1.0);
        for (int p = 0; p < pixels; p++)
            if (mine[p]) {
                const uint8_t *c = color + 3 * (size_t)in_whole[p];
                const double seen[4] = {c[0], c[1], c[2], 1.0};
                for (int k = 0; k < 4; k++) {
                    blob[k] += seen[k];
                    if (p < core)
                        ground[WEDGES][k] += seen[k];
                }
            }
        for (int w = 0; w <= WEDGES; w++) {
            const double fewest = w < WEDGES ? fewest_rim : fewest_core;
            if (ground[w][3] < fewest)
                memcpy(ground[w], w < WEDGES ? rim : blob, sizeof rim);
            const double count = ground[w][3] > 1.0 ? ground[w][3] : 1.0;
            for (int k = 0; k < 3; k++)
                ground[w][k] /= count;
        }
        double unmix[WEDGES][4];
        for (int w = 0; w < WEDGES; w++) {
            double square = 0.0, on_ground = 0.0;
            for (int k = 0; k < 3; k++) {
                unmix[w][k] = ground[WEDGES][k] - ground[w][k];
                square += unmix[w][k] * unmix[w][k];
            }
            for (int k = 0; k < 3; k++) {
                unmix[w][k] /= (high - low) * (square > 1.0 ? square : 1.0);
                on_ground += unmix[w][k] * ground[w][k];
            }
            unmix[w][3] = -low / (high - low) - on_ground;
        }
        double sum = 0.0, sum_u = 0.0, sum_v = 0.0;
        for (int p = 0; p < pixels; p++) {
            if (!mine[p] && !(free_of[p] && reach[p]))
                continue;
            const uint8_t *c = color + 3 * (size_t)in_whole[p];
            const double *by = unmix[pick[p] - (int64_t)p * WEDGES];
            double share = c[0] * by[0] + c[1] * by[1] + c[2] * by[2] + by[3];
            share = share > 0.0 ? share : 0.0;
            share = share < 1.0 ? share : 1.0;
            sum += share;
            sum_u += share * column[p];
            sum_v += share * row[p];
        }
        area[b] = sum > 1e-9 ? sum : 1e-9;
        centre[2 * b] = middle_u + sum_u / area[b] + left;
        centre[2 * b + 1] = middle_v + sum_v / area[b] + top;

        depth[b] = depth_sd[b] = NAN;
        if (!has_depth)
            continue;
        int valid = 0, all = 0, close = 0, other = 0;
        for (int p = 0; p < core; p++) {
            all += mine[p];
            inner[p] = mine[p] ? raw[in_whole[p]] * unit_m : 0.0;
            if (inner[p] > 0.0)
                ordered[valid++] = inner[p];
        }
        const double enough = valid_share * all > fewest_readings ? valid_share * all : fewest_readings;
        if (valid < enough || valid == 0)
            continue;
        in_order(ordered, valid);
        const double lower = ordered[(valid - 1) >> 2], half = ordered[2 * (valid - 1) >> 2],
                     upper = ordered[3 * (valid - 1) >> 2], wide = upper - lower;
        if (!(wide <= iqr_m))
            continue;
        double whole = 0.0;
        for (int p = 0; p < core; p++)
            if (inner[p] > 0.0 && fabs(inner[p] - half) <= iqr_m) {
                whole += inner[p];
                close++;
            }
        const double z = whole / (close > 1 ? close : 1);
        for (int p = 0; p < near; p++)
            other += fabs(raw[in_whole[p]] * unit_m - z) > edge_step;
        const double edge = edge_sd / near * other, slope = slope_share / 1.35 * wide;
        double sd = fixed_m + square_per_m * z * z;
        if (averages) {
            const double apart = close / (patch * patch);
            sd /= sqrt(apart > 1.0 ? apart : 1.0);
        }
        depth[b] = z;
        depth_sd[b] = sqrt(sd * sd + slope * slope + edge * edge);
    }
    free(work);
    return 0;
}

/* Readings on a lattice within an outline, never more than `most`: core/detection/surface_samples.py. `found` tells how
   many; -1 where the outline lies off the picture. */
int readings_within(
    int height, int width, const uint16_t *raw, double unit_m, int corners, const double *corner, double wider,
    double margin, int step, int most, double *pixel, double *depth, int32_t *found)
{
    double middle[2] = {0.0, 0.0}, outline[2 * corners], angle[corners], along[2 * corners], least[corners];
    for (int i = 0; i < corners; i++)
        for (int k = 0; k < 2; k++)
            middle[k] += corner[2 * i + k] / corners;
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < corners; i++) {
        double at[2];
        for (int k = 0; k < 2; k++) {
            at[k] = middle[k] + wider * (corner[2 * i + k] - middle[k]);
            low[k] = at[k] < low[k] ? at[k] : low[k];
            high[k] = at[k] > high[k] ? at[k] : high[k];
        }
        const double own = atan2(at[1] - middle[1], at[0] - middle[0]);
        int j = i;
        for (; j > 0 && angle[j - 1] > own; j--) {
            angle[j] = angle[j - 1];
            memcpy(outline + 2 * j, outline + 2 * j - 2, 2 * sizeof(double));
        }
        angle[j] = own;
        memcpy(outline + 2 * j, at, sizeof at);
    }
    for (int i = 0; i < corners; i++) {
        const double *from = outline + 2 * i, *to = outline + 2 * ((i + 1) % corners);
        along[2 * i] = to[0] - from[0];
        along[2 * i + 1] = to[1] - from[1];
        least[i] = margin * (hypot(along[2 * i], along[2 * i + 1]) + 1e-9);
    }
    const double left = low[0] - margin > 0.0 ? low[0] - margin : 0.0, top = low[1] - margin > 0.0 ? low[1] - margin : 0.0;
    const double right = floor(high[0] + margin), bottom = floor(high[1] + margin);
    const int first_u = left < width ? step * (int)ceil(left / step) : width;
    const int first_v = top < height ? step * (int)ceil(top / step) : height;
    const int last_u = right < width - 1 ? (int)(right > -1.0 ? right : -1.0) : width - 1;
    const int last_v = bottom < height - 1 ? (int)(bottom > -1.0 ? bottom : -1.0) : height - 1;
    *found = -1;
    if (last_u < first_u || last_v < first_v)
        return 0;
    const int columns = (last_u - first_u) / step + 1, rows = (last_v - first_v) / step + 1;
    int32_t *kept = malloc(sizeof *kept * (size_t)columns * (size_t)rows);
    if (!kept)
        return 1;
    int n = 0;
    for (int v = first_v; v <= last_v; v += step)
        for (int u = first_u; u <= last_u; u += step) {
            int inside = raw[(size_t)v * width + u] > 0;
            for (int i = 0; inside && i < corners; i++)
                inside = along[2 * i] * (v - outline[2 * i + 1]) + least[i] >= along[2 * i + 1] * (u - outline[2 * i]);
            if (inside)
                kept[n++] = v * width + u;
        }
    const int taken = n > most ? most : n;
    for (int k = 0; k < taken; k++) {
        const int at = kept[n <= most ? k : k == most - 1 ? n - 1 : (int)(k * ((n - 1) / (double)(most - 1)))];
        pixel[2 * k] = at % width;
        pixel[2 * k + 1] = at / width;
        depth[k] = (float)(raw[at] * unit_m); /* as they are stored */
    }
    free(kept);
    *found = taken;
    return 0;
}
