/* Blobs of the paper's colour, taken apart where discs touch, and the place, likeness and depth of each from its window:
   what core/detection/detector.py does with OpenCV and NumPy, sums of colours in double. */
#include "algebra.h"
#include "kernels.h"

#if defined(__clang__)
#define NOT_CONTRACTED
#pragma clang fp contract(off)
#else
#define NOT_CONTRACTED __attribute__((optimize("fp-contract=off")))
#endif

enum { WEDGES = 8, HSV_BITS = 12 };


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

/* OpenCV's table of whole numbers: `whole` over 1 to 255, in parts of 4096; of nothing none. */
static void parts_of(int whole, int32_t *table)
{
    table[0] = 0;
    for (int i = 1; i < 256; i++)
        table[i] = (int32_t)nearbyint((double)(whole << HSV_BITS) / i);
}

/* Of each pixel of a row hue 0-179 and saturation 0-255 as one number of two bytes, bit for bit OpenCV's, and whether it
   is of paper and lit. */
static void looked_at(
    const uint8_t *restrict color, int width, const int32_t *restrict by_value, const int32_t *restrict by_chroma,
    const uint8_t *restrict is_paper, int darkest, uint16_t *restrict look, uint8_t *restrict mask)
{
    for (int u = 0; u < width; u++) {
        const int r = color[3 * u], g = color[3 * u + 1], b = color[3 * u + 2];
        int most = r > g ? r : g, least = r < g ? r : g;
        most = most > b ? most : b;
        least = least < b ? least : b;
        const int chroma = most - least, half = 1 << (HSV_BITS - 1);
        const int saturation = (chroma * by_value[most] + half) >> HSV_BITS;
        int hue = most == r ? g - b : most == g ? b - r + 2 * chroma : r - g + 4 * chroma;
        hue = (hue * by_chroma[chroma] + half) >> HSV_BITS;
        hue += hue < 0 ? 180 : 0;
        look[u] = (uint16_t)(hue | saturation << 8);
        mask[u] = most > darkest;
    }
    for (int u = 0; u < width; u++)
        mask[u] &= is_paper[look[u]];
}

/* Opened by a cross: of `mask` what is of it with its four neighbours, and their neighbours; the picture's edge takes
   nothing away. `inner` as large. */
static void opened(uint8_t *restrict mask, uint8_t *restrict inner, int width, int height)
{
    for (int v = 0; v < height; v++) {
        const uint8_t *own = mask + (size_t)v * width, *above = v ? own - width : own,
                      *below = v + 1 < height ? own + width : own;
        uint8_t *to = inner + (size_t)v * width;
        for (int u = 0; u < width; u++)
            to[u] = own[u] & above[u] & below[u];
        for (int u = 0; u + 1 < width; u++)
            to[u] &= own[u + 1];
        for (int u = 1; u < width; u++)
            to[u] &= own[u - 1];
    }
    for (int v = 0; v < height; v++) {
        const uint8_t *own = inner + (size_t)v * width, *above = v ? own - width : own,
                      *below = v + 1 < height ? own + width : own;
        uint8_t *to = mask + (size_t)v * width;
        for (int u = 0; u < width; u++)
            to[u] = own[u] | above[u] | below[u];
        for (int u = 0; u + 1 < width; u++)
            to[u] |= own[u + 1];
        for (int u = 1; u < width; u++)
            to[u] |= own[u - 1];
    }
}

/* Pixels of one row that lie side by side: from `left` to just before `right`. */
typedef struct {
    int row, left, right, parent;
} run;

typedef struct {
    int64_t order, area, sum_u, sum_v;
    int left, top, right, bottom, label;
    double u, v, radius;
} blob;

static int first_of(run *runs, int i)
{
    while (runs[i].parent != i)
        i = runs[i].parent = runs[runs[i].parent].parent;
    return i;
}

/* Runs of a mask, joined where they touch, also at a corner; how many. */
static int runs_of(const uint8_t *mask, int width, int height, run *runs)
{
    int count = 0, above = 0, here = 0;
    for (int v = 0; v < height; v++, above = here, here = count) {
        const uint8_t *own = mask + (size_t)v * width, *end = own + width;
        for (const uint8_t *from = own; from < end && (from = memchr(from, 1, (size_t)(end - from)));) {
            const uint8_t *to = memchr(from, 0, (size_t)(end - from));
            to = to ? to : end;
            const int i = count++;
            runs[i] = (run){v, (int)(from - own), (int)(to - own), i};
            while (above < here && runs[above].right < runs[i].left)
                above++;
            for (int j = above; j < here && runs[j].left <= runs[i].right; j++) {
                const int one = first_of(runs, i), other = first_of(runs, j);
                if (one < other)
                    runs[other].parent = one;
                else
                    runs[one].parent = other;
            }
            from = to;
        }
    }
    return count;
}

static int in_blocks(const void *one, const void *other)
{
    const int64_t a = ((const blob *)one)->order, b = ((const blob *)other)->order;
    return (a > b) - (a < b);
}

static int by_area(const void *one, const void *other)
{
    const blob *a = one, *b = other;
    return a->area != b->area ? (a->area < b->area) - (a->area > b->area) : (a->label > b->label) - (a->label < b->label);
}

/* For each pixel of a box that is labelled `own` the nearest of `count` middles (u, v), these following; 0 where one of
   them would have no pixel. */
NOT_CONTRACTED
static int about(
    const int32_t *box, int width, int wide, int high, int own, double *middle, int count, int rounds, uint8_t *part)
{
    int64_t sum[3 * count];
    for (int round = 0; round < rounds; round++) {
        int changed = 0;
        memset(sum, 0, sizeof sum);
        for (int v = 0; v < high; v++)
            for (int u = 0; u < wide; u++) {
                if (box[(size_t)v * width + u] != own)
                    continue;
                int nearest = 0;
                double least = INFINITY;
                for (int k = 0; k < count; k++) {
                    const double x = u - middle[2 * k], y = v - middle[2 * k + 1], apart = sqrt(x * x + y * y);
                    if (apart < least)
                        least = apart, nearest = k;
                }
                changed += part[(size_t)v * wide + u] != nearest;
                part[(size_t)v * wide + u] = (uint8_t)nearest;
                sum[3 * nearest]++, sum[3 * nearest + 1] += u, sum[3 * nearest + 2] += v;
            }
        for (int k = 0; k < count; k++)
            if (!sum[3 * k])
                return 0;
        if (round && !changed)
            break;
        for (int k = 0; k < count; k++) {
            middle[2 * k] = (double)sum[3 * k + 1] / (double)sum[3 * k];
            middle[2 * k + 1] = (double)sum[3 * k + 2] / (double)sum[3 * k];
        }
    }
    return rounds > 0;
}

/* Of the parts in the mean: 0 for discs, 1 for lines. */
NOT_CONTRACTED
static double elongation(
    const int32_t *box, int width, int wide, int high, int own, const uint8_t *part, int count)
{
    int64_t sum[6 * count];
    double total = 0.0;
    memset(sum, 0, sizeof sum);
    for (int v = 0; v < high; v++)
        for (int u = 0; u < wide; u++)
            if (box[(size_t)v * width + u] == own) {
                int64_t *of = sum + 6 * part[(size_t)v * wide + u];
                of[0]++, of[1] += u, of[2] += v;
                of[3] += (int64_t)u * u, of[4] += (int64_t)v * v, of[5] += (int64_t)u * v;
            }
    for (int k = 0; k < count; k++) {
        const double n = (double)sum[6 * k], su = (double)sum[6 * k + 1], sv = (double)sum[6 * k + 2];
        const double uu = (double)sum[6 * k + 3] - su * su / n, vv = (double)sum[6 * k + 4] - sv * sv / n,
                     uv = (double)sum[6 * k + 5] - su * sv / n, both = uu + vv;
        total += hypot(uu - vv, 2.0 * uv) / (both > 1e-12 ? both : 1e-12);
    }
    return total / count;
}

/* The parts of a blob that is longer than a disc: a part's number for every pixel of its box that is its own, in one of
   two buffers; how many parts, one where it is none of a few discs. As core/detection/components.py to the last bit: at
   what lies just between two parts a rounding would tell. */
NOT_CONTRACTED
static int parted(
    const blob *whole, const int32_t *labels, int width, double long_axis, double edge, int rounds, int most_parts,
    uint8_t *buffer[2], uint8_t **out)
{
    const int wide = whole->right - whole->left, high = whole->bottom - whole->top, own = whole->label;
    const int32_t *box = labels + (size_t)whole->top * width + whole->left;
    int64_t su = 0, sv = 0, suu = 0, suv = 0, svv = 0;
    for (int v = 0; v < high; v++)
        for (int u = 0; u < wide; u++)
            if (box[(size_t)v * width + u] == own) {
                su += u, sv += v;
                suu += (int64_t)u * u, suv += (int64_t)u * v, svv += (int64_t)v * v;
            }
    const double n = (double)whole->area, mu = (double)su / n, mv = (double)sv / n;
    const double xx = (double)suu / n - mu * mu, xy = (double)suv / n - mu * mv, yy = (double)svv / n - mv * mv;
    const double half_gap = hypot(0.5 * (xx - yy), xy), radius = whole->radius;
    if (sqrt(0.5 * (xx + yy) + half_gap) <= long_axis * (radius + edge))
        return 1;
    const double tilt = 0.5 * atan2(2.0 * xy, xx - yy), across = cos(tilt), down = sin(tilt);
    double low = INFINITY, top = -INFINITY, least = INFINITY;
    for (int v = 0; v < high; v++)
        for (int u = 0; u < wide; u++)
            if (box[(size_t)v * width + u] == own) {
                const double along = u * across + v * down;
                low = along < low ? along : low;
                top = along > top ? along : top;
            }
    const double by_length = nearbyint((top - low - 2.0 * radius) / (2.0 * radius)) + 1.0;
    if (by_length > most_parts + 1)
        return 1;
    const int longest = by_length > 2.0 ? (int)by_length : 2, most = longest < most_parts ? longest : most_parts;
    int best = 1, into = 0;
    for (int count = longest > 2 ? longest - 1 : 2; count <= most; count++) {
        uint8_t *part = buffer[into];
        if (count == 2) {
            const double middle = 0.5 * (top + low);
            for (int v = 0; v < high; v++)
                for (int u = 0; u < wide; u++)
                    part[(size_t)v * wide + u] = u * across + v * down > middle;
        } else {
            const double gap = (top - low - 2.0 * radius) / (count - 1);
            const double begin = low + radius - (mu * across + mv * down);
            double middle[2 * count];
            for (int k = 0; k < count; k++) {
                const double along = begin + gap * k;
                middle[2 * k] = mu + along * across;
                middle[2 * k + 1] = mv + along * down;
            }
            if (!about(box, width, wide, high, own, middle, count, rounds, part))
                continue;
        }
        const double own_elongation = elongation(box, width, wide, high, own, part, count);
        if (own_elongation < least) {
            least = own_elongation, best = count, *out = part;
            into = 1 - into;
        }
    }
    return best;
}

int blobs_found(
    int whole_height, int whole_width, const uint8_t *color, const uint16_t *raw, int has_depth, double unit_m, int left,
    int top, int width, int height, const uint8_t *is_paper, int darkest, double disc_px_m, double usual_m,
    double nearest_m, double long_side, double long_axis, double edge_px, int rounds, int most_parts, double least_area,
    double most_area, int most, int32_t *labels, uint16_t *look, int32_t *own, double *rough, double *radius,
    int32_t *found)
{
    if (left < 0 || top < 0 || left + width > whole_width || top + height > whole_height)
        return OUTSIDE;
    const size_t pixels = (size_t)width * height, runs_at_most = (size_t)height * ((width + 1) / 2);
    int32_t by_value[256], by_chroma[256];
    parts_of(255, by_value);
    parts_of(30, by_chroma);
    *found = 0;
    uint8_t *mask = malloc(2 * pixels + 1);
    run *runs = malloc(sizeof *runs * (runs_at_most + 1));
    blob *blobs = NULL;
    int failed = NO_MEMORY;
    if (!mask || !runs)
        goto done;
    for (int v = 0; v < height; v++)
        looked_at(color + 3 * ((size_t)(v + top) * whole_width + left), width, by_value, by_chroma, is_paper, darkest,
                  look + (size_t)v * width, mask + (size_t)v * width);
    opened(mask, mask + pixels, width, height);
    memset(labels, 0, sizeof *labels * pixels);
    const int many = runs_of(mask, width, height, runs);
    int count = 0;
    for (int i = 0; i < many; i++)
        count += runs[i].parent == i;
    blobs = malloc(sizeof *blobs * ((size_t)count * (size_t)(most_parts > 1 ? most_parts : 1) + 1));
    int32_t *blob_of = (int32_t *)malloc(sizeof *blob_of * (2 * (size_t)many + 1)), *place = blob_of + many;
    if (!blobs || !blob_of) {
        free(blob_of);
        goto done;
    }
    /* Numbered as OpenCV does: by the first block of two by two pixels, row by row. */
    const int64_t blocks = (width + 1) / 2;
    for (int i = 0, next = 0; i < many; i++) {
        const int first = first_of(runs, i);
        if (first == i) {
            blob_of[i] = next;
            blobs[next++] = (blob){INT64_MAX, 0, 0, 0, width, height, 0, 0, i, 0.0, 0.0, 0.0};
        }
        blob *b = blobs + (blob_of[i] = blob_of[first]);
        const int from = runs[i].left, to = runs[i].right, v = runs[i].row;
        const int64_t order = (v / 2) * blocks + from / 2;
        b->order = order < b->order ? order : b->order;
        b->area += to - from;
        b->sum_u += (int64_t)(to - from) * (from + to - 1) / 2;
        b->sum_v += (int64_t)(to - from) * v;
        b->left = from < b->left ? from : b->left;
        b->right = to > b->right ? to : b->right;
        b->top = v < b->top ? v : b->top;
        b->bottom = v + 1;
    }
    qsort(blobs, (size_t)count, sizeof *blobs, in_blocks);
    for (int b = 0; b < count; b++) {
        place[blobs[b].label] = b + 1;
        blobs[b].label = b + 1;
    }
    for (int i = 0; i < many; i++) {
        const int label = place[first_of(runs, i)];
        int32_t *row = labels + (size_t)runs[i].row * width;
        for (int u = runs[i].left; u < runs[i].right; u++)
            row[u] = label;
    }
    free(blob_of);
    for (int b = 0; b < count; b++) {
        blob *one = blobs + b;
        one->u = (double)one->sum_u / (double)one->area;
        one->v = (double)one->sum_v / (double)one->area;
        double depth = 0.0;
        if (has_depth)
            depth = raw[((size_t)nearbyint(one->v) + top) * whole_width + (size_t)nearbyint(one->u) + left] * unit_m;
        one->radius = disc_px_m / (depth > nearest_m ? depth : usual_m);
    }
    int following = count;
    for (int b = 0; b < count; b++) {
        blob *one = blobs + b;
        const int wide = one->right - one->left, high = one->bottom - one->top;
        if (!((wide > high ? wide : high) > long_side * (one->radius + edge_px)))
            continue;
        uint8_t *part = mask, *buffer[2] = {mask, mask + pixels}; /* no longer needed, and large enough */
        const int parts = parted(one, labels, width, long_axis, edge_px, rounds, most_parts, buffer, &part);
        if (parts < 2)
            continue;
        int64_t sum[3 * parts];
        memset(sum, 0, sizeof sum);
        for (int v = 0; v < high; v++)
            for (int u = 0; u < wide; u++) {
                int32_t *at = labels + (size_t)(one->top + v) * width + one->left + u;
                const int k = part[(size_t)v * wide + u];
                if (*at != one->label)
                    continue;
                sum[3 * k]++, sum[3 * k + 1] += one->left + u, sum[3 * k + 2] += one->top + v;
                *at = k ? following + k : one->label;
            }
        for (int k = 0; k < parts; k++) {
            blob *to = k ? blobs + following + k - 1 : one;
            *to = (blob){.area = sum[3 * k], .label = k ? following + k : one->label, .radius = one->radius};
            to->u = (double)sum[3 * k + 1] / (double)sum[3 * k];
            to->v = (double)sum[3 * k + 2] / (double)sum[3 * k];
        }
        following += parts - 1;
    }
    int fits = 0;
    for (int b = 0; b < following; b++) {
        const double ratio = (double)blobs[b].area / (M_PI * (blobs[b].radius * blobs[b].radius));
        if (ratio >= least_area && ratio <= most_area)
            blobs[fits++] = blobs[b];
    }
    if (fits > most)
        qsort(blobs, (size_t)fits, sizeof *blobs, by_area);
    *found = fits < most ? fits : most;
    for (int b = 0; b < *found; b++) {
        own[b] = blobs[b].label;
        rough[2 * b] = blobs[b].u;
        rough[2 * b + 1] = blobs[b].v;
        radius[b] = blobs[b].radius;
    }
    failed = 0;
done:
    free(blobs);
    free(runs);
    free(mask);
    return failed;
}

int blobs_measured(
    int blobs, const int32_t *own, const double *rough, int left, int top, int height, int width,
    const int32_t *labels, const uint16_t *look, int whole_height, int whole_width, const uint8_t *color, const uint16_t *raw, int has_depth,
    double unit_m, int pixels, const int64_t *row, const int64_t *column, const uint8_t *reach, int core, int near,
    int rim_from, int rim_to, const float *wedge, const int64_t *pick, const uint8_t *cell, const uint8_t *is_skin,
    int cells, const double *reference, double low, double high, double fewest_rim, double fewest_core, double iqr_m,
    double valid_share, double fewest_readings, double edge_step, double edge_sd, double slope_share, double fixed_m,
    double square_per_m, double patch, int averages, double least_similarity, double least_skin, double *centre,
    double *area, double *similarity, double *depth, double *depth_sd, int32_t *kept)
{
    if (left < 0 || top < 0 || left + width > whole_width || top + height > whole_height)
        return OUTSIDE;
    double *work = malloc(sizeof(double) * (size_t)(cells + 2 * pixels) + sizeof(int) * (size_t)(2 * pixels) +
                          2 * (size_t)pixels);
    if (!work)
        return NO_MEMORY;
    double *counts = work, *inner = counts + cells, *ordered = inner + pixels;
    int *at = (int *)(ordered + pixels), *in_whole = at + pixels;
    uint8_t *mine = (uint8_t *)(in_whole + pixels), *free_of = mine + pixels;
    *kept = 0;
    for (int found = 0; found < blobs; found++) {
        const int b = *kept;
        const double middle_u = nearbyint(rough[2 * found]), middle_v = nearbyint(rough[2 * found + 1]);
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
            mine[p] = inside && labels[at[p]] == own[found];
            free_of[p] = inside && labels[at[p]] == 0;
            if (mine[p]) {
                counts[cell[look[at[p]]]] += 1.0;
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
            const uint8_t *c = color + 3 * (size_t)in_whole[p];
            skins += is_skin[look[at[p]]];
            const double seen[4] = {c[0], c[1], c[2], 1.0};
            for (int k = 0; k < 4; k++)
                rim[k] += seen[k];
            for (int w = 0; w < WEDGES; w++)
                if (wedge[(p - rim_from) * WEDGES + w] != 0.0f)
                    for (int k = 0; k < 4; k++)
                        ground[w][k] += seen[k];
        }
        /* Those that look like a disc and lie on skin. */
        if (!(similarity[b] >= least_similarity) || !(skins / (rim[3] > 1.0 ? rim[3] : 1.0) >= least_skin))
            continue;
        ++*kept;
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
        return NO_MEMORY;
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

/* The number that would stand at `place` were they in order; they are moved. */
static double at_place(double *number, int count, int place)
{
    int low = 0, high = count - 1;
    while (low < high) {
        const double middle = number[low + (high - low) / 2];
        int i = low, j = high;
        while (i <= j) {
            while (number[i] < middle)
                i++;
            while (number[j] > middle)
                j--;
            if (i <= j) {
                const double kept = number[i];
                number[i++] = number[j];
                number[j--] = kept;
            }
        }
        if (place <= j)
            high = j;
        else if (place >= i)
            low = i;
        else
            break;
    }
    return number[place];
}

int readings_about(
    int height, int width, const uint16_t *raw, double unit_m, int discs, const double *disc, double margin, int step,
    int most, double *pixel, double *depth, int32_t *found)
{
    const int size[2] = {width, height};
    int first[2], count[2];
    *found = -1;
    for (int k = 0; k < 2; k++) {
        double low = INFINITY, high = -INFINITY;
        for (int i = 0; i < discs; i++) {
            low = disc[2 * i + k] < low ? disc[2 * i + k] : low;
            high = disc[2 * i + k] > high ? disc[2 * i + k] : high;
        }
        low = floor((low - margin) / step) * step;
        high = ceil((high + margin) / step) * step;
        if (!(low < size[k]) || !(high >= 0.0))
            return 0;
        first[k] = low > 0.0 ? (int)low : 0;
        const int last = high < size[k] - 1 ? (int)high : size[k] - 1;
        if (last < first[k])
            return 0;
        count[k] = (last - first[k]) / step + 1;
    }
    const int columns = count[0], rows = count[1];
    const size_t all = (size_t)columns * (size_t)rows;
    int32_t *kept = malloc(sizeof *kept * all);
    double *apart = malloc(sizeof *apart * (2 * all + (size_t)columns * ((size_t)discs + 1)));
    if (!kept || !apart) {
        free(kept);
        free(apart);
        return NO_MEMORY;
    }
    int n = 0;
    for (int r = 0; r < rows; r++)
        for (int c = 0; c < columns; c++) {
            const int at = (first[1] + r * step) * width + first[0] + c * step;
            kept[n] = at;
            n += raw[at] > 0;
        }
    double farthest = INFINITY;
    if (n > most) {
        /* Too many: those nearest to a disc tell most. How near goes with the column and with the row. */
        double *along = apart + 2 * all, *line = along + (size_t)columns * (size_t)discs, *sorted = apart + all;
        for (int i = 0; i < discs; i++)
            for (int c = 0; c < columns; c++)
                along[i * columns + c] = fabs(first[0] + c * step - disc[2 * i]);
        for (int k = 0, row = -1; k < n; k++) {
            const int v = kept[k] / width;
            if (v != row) {
                row = v;
                for (int c = 0; c < columns; c++)
                    line[c] = INFINITY;
                for (int i = 0; i < discs; i++) {
                    const double down = fabs(v - disc[2 * i + 1]), *own = along + i * columns;
                    for (int c = 0; c < columns; c++)
                        line[c] = down + own[c] < line[c] ? down + own[c] : line[c];
                }
            }
            apart[k] = line[(kept[k] % width - first[0]) / step];
        }
        memcpy(sorted, apart, sizeof *apart * (size_t)n);
        farthest = at_place(sorted, n, most - 1);
    }
    int taken = 0;
    for (int k = 0; k < n && taken < most; k++)
        if (n <= most || apart[k] <= farthest) {
            pixel[2 * taken] = kept[k] % width;
            pixel[2 * taken + 1] = kept[k] / width;
            depth[taken++] = (float)(raw[kept[k]] * unit_m); /* as they are stored */
        }
    free(kept);
    free(apart);
    *found = taken > 0 ? taken : -1;
    return 0;
}

/* Left, top, right and bottom of what discs may cover: detector.py, region_about. What is not known stays so. */
int discs_reach(
    int discs, const double *pixel, const double *covariance, const double *depth, double disc_px_m, double region_sd,
    double most_unsure, double nearest_m, double *out)
{
    out[0] = out[1] = INFINITY;
    out[2] = out[3] = -INFINITY;
    for (int i = 0; i < discs; i++)
        for (int k = 0; k < 2; k++) {
            const double variance = covariance[4 * i + 3 * k], at = pixel[2 * i + k];
            double reach = region_sd * sqrt(variance < 0.0 ? 0.0 : variance);
            reach = reach > most_unsure ? most_unsure : reach;
            reach += 2.2 * disc_px_m / (depth[i] < nearest_m ? nearest_m : depth[i]) + 3.0;
            out[k] = at - reach < out[k] || isnan(at - reach) ? at - reach : out[k];
            out[2 + k] = at + reach > out[2 + k] || isnan(at + reach) ? at + reach : out[2 + k];
        }
    return 0;
}
