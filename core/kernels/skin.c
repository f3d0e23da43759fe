/* Where camera rays meet the skin: core/simulation/trace.py in C, row by row of the picture, in single precision. */
#include "algebra.h"
#include "kernels.h"

enum { PARTS = 7, STEPS = 7, CONE = 18 };
static const float FAR_M = 9.0f, SLOWEST_APPROACH = 0.35f;
static const double PROBE_M = 5e-4;

/* One row of the picture: the rays' x, and the distances to palm (0) and the other parts, of each column. */
struct row {
    int cones, left, width, y_row;
    const double *cone;
    const int32_t *box, *part;
    const float *x;
    float y, reach[PARTS], *part_m[PARTS], *own_m;
    int from[PARTS], to[PARTS]; /* columns in which a part may be seen */
};

static inline float least(float a, float b) { return a < b ? a : b; }
static inline float most(float a, float b) { return a > b ? a : b; }

/* Smooth minimum of finite reach: simulation/skin.py, smooth_minimum. */
static inline float fillet(float a, float b, float reach)
{
    const float near = most(reach - fabsf(a - b), 0.0f);
    return least(a, b) - near * near * (0.25f / reach);
}

/* Distance of a cone at the depths z of a row, united with its part; see simulation/skin.py, cone_distance. */
static void unite_cone(struct row *row, int i, const float *restrict z, const double *offset)
{
    const double *c = row->cone + i * CONE, *origin = c + 9;
    const int part = row->part[i], from = row->box[4 * i + 2] - row->left, to = row->box[4 * i + 3] - row->left;
    float lie[3], turn[3], at[3];
    for (int k = 0; k < 3; k++) {
        const double *axis = c + 3 * k;
        lie[k] = (float)axis[0];
        turn[k] = (float)axis[1] * row->y + (float)axis[2];
        at[k] = (float)(origin[k] - (axis[0] * offset[0] + axis[1] * offset[1] + axis[2] * offset[2]));
    }
    const float length = (float)c[12], width = (float)c[13], widening = (float)c[14], radius = (float)c[15];
    const float taper = (float)c[16], lean = (float)c[17], reach = row->reach[0];
    const float lie0 = lie[0], lie1 = lie[1], lie2 = lie[2], turn0 = turn[0], turn1 = turn[1], turn2 = turn[2];
    const float at0 = at[0], at1 = at[1], at2 = at[2];
    const float *restrict x = row->x;
    float *restrict far_m = row->own_m, *restrict out = row->part_m[part];
#pragma omp simd
    for (int j = from; j < to; j++) {
        float along = z[j] * (lie0 * x[j] + turn0) - at0;
        float side = z[j] * (lie1 * x[j] + turn1) - at1;
        const float up = z[j] * (lie2 * x[j] + turn2) - at2;
        const float half = least(most(along, 0.0f), length) * widening + width;
        side -= least(most(side, -half), half);
        const float across2 = up * up + side * side;
        const float foot = least(most(along - lean * sqrtf(across2), 0.0f), length);
        along -= foot;
        far_m[j] = sqrtf(along * along + across2) + foot * taper - radius;
    }
    if (part)
        for (int j = from; j < to; j++)
            out[j] = least(out[j], far_m[j]);
    else
        for (int j = from; j < to; j++)
            out[j] = fillet(out[j], far_m[j], reach);
}

/* Distance to the skin at depths z of a row; the nearest part into `nearest` where it is wanted. */
static void unite(struct row *row, const float *z, const double *offset, float *restrict out, uint8_t *nearest)
{
    const int width = row->width;
    for (int part = 0; part < PARTS; part++)
        for (int j = 0; j < width; j++)
            row->part_m[part][j] = FAR_M;
    for (int i = 0; i < row->cones; i++)
        if (row->box[4 * i] <= row->y_row && row->y_row < row->box[4 * i + 1])
            unite_cone(row, i, z, offset);
    const float *restrict palm = row->part_m[0];
    memcpy(out, palm, width * sizeof(float));
    for (int part = 1; part < PARTS; part++) {
        const float *restrict d = row->part_m[part];
        const float reach = row->reach[part];
        for (int j = row->from[part]; j < row->to[part]; j++)
            out[j] = least(out[j], fillet(palm[j], d[j], reach));
    }
    if (!nearest)
        return;
    for (int j = 0; j < width; j++) {
        float best = palm[j];
        uint8_t which = 0;
        for (int part = 1; part < PARTS; part++)
            if (row->part_m[part][j] < best)
                best = row->part_m[part][j], which = (uint8_t)part;
        nearest[j] = which;
    }
}

static void trace_row(struct row *row, float *room, float start, float fx, float *depth, float *coverage, float *normal,
                      uint8_t *part)
{
    const int width = row->width;
    const double probes[4][3] = {{0.0, 0.0, 0.0}, {PROBE_M, 0.0, 0.0}, {0.0, PROBE_M, 0.0}, {0.0, 0.0, PROBE_M}};
    const float *restrict x = row->x, y2 = 1.0f + row->y * row->y;
    float *restrict z = room, *restrict best = room + width, *restrict stretch = room + 2 * width;
    float *restrict before = room + 3 * width, *restrict distance = room + 4 * width;
    for (int j = 0; j < width; j++)
        z[j] = depth[j] = start, best[j] = FAR_M, stretch[j] = 1.0f, before[j] = FAR_M;
    for (int step = 0; step < STEPS; step++) {
        unite(row, z, probes[0], distance, step == STEPS - 1 ? part : NULL);
        /* The first step is not lengthened. */
        const float lowest = step ? SLOWEST_APPROACH : 1.0f;
#pragma omp simd
        for (int j = 0; j < width; j++) {
            const float d = distance[j], size = fabsf(d);
            depth[j] = size < best[j] ? z[j] : depth[j];
            best[j] = least(size, best[j]);
            const float approach = (before[j] - d) / most(before[j] * stretch[j], 1e-6f);
            stretch[j] = 1.0f / least(most(approach, lowest), 1.0f);
            z[j] += d * stretch[j] / sqrtf(y2 + x[j] * x[j]);
            before[j] = d;
        }
    }
    for (int j = 0; j < width; j++)
        coverage[j] = least(most(1.0f - best[j] / (0.8f * depth[j] / fx), 0.0f), 1.0f);
    unite(row, depth, probes[0], before, NULL);
    for (int k = 0; k < 3; k++) {
        unite(row, depth, probes[k + 1], distance, NULL);
        for (int j = 0; j < width; j++)
            normal[3 * j + k] = distance[j] - before[j];
    }
    for (int j = 0; j < width; j++) {
        float *n = normal + 3 * j;
        const float length = most(sqrtf(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]), 1e-9f);
        n[0] /= length, n[1] /= length, n[2] /= length;
    }
}

KERNEL int skin_traced(
    int cones, const double cone[cones * 18], const int32_t box[cones * 4], const int32_t part_of[cones],
    const double reach[7], int top, int left, int height, int width, const float x[width], const float y[height],
    double start, double fx, float depth[height * width], float coverage[height * width],
    float normal[height * width * 3], uint8_t part[height * width])
{
    struct row row = {.cones = cones, .left = left, .width = width, .cone = cone, .box = box, .part = part_of, .x = x};
    for (int i = 0; i < cones; i++) {
        const int32_t *b = box + 4 * i;
        if (part_of[i] < 0 || part_of[i] >= PARTS || b[0] < top || b[1] > top + height || b[2] < left ||
            b[3] > left + width || b[3] <= b[2])
            return OUTSIDE;
    }
    float *room = malloc((size_t)(6 + PARTS) * width * sizeof(float));
    if (!room)
        return NO_MEMORY;
    row.own_m = room + (size_t)5 * width;
    for (int p = 0; p < PARTS; p++)
        row.reach[p] = (float)reach[p], row.part_m[p] = room + (size_t)(6 + p) * width;
    for (int v = 0; v < height; v++) {
        row.y_row = top + v, row.y = y[v];
        for (int p = 0; p < PARTS; p++)
            row.from[p] = width, row.to[p] = 0;
        for (int i = 0; i < cones; i++) {
            const int p = part_of[i], from = box[4 * i + 2] - left, to = box[4 * i + 3] - left;
            if (box[4 * i] > row.y_row || row.y_row >= box[4 * i + 1])
                continue;
            row.from[p] = from < row.from[p] ? from : row.from[p];
            row.to[p] = to > row.to[p] ? to : row.to[p];
        }
        const size_t at = (size_t)v * width;
        trace_row(&row, room, (float)start, (float)fx, depth + at, coverage + at, normal + 3 * at, part + at);
    }
    free(room);
    return 0;
}
