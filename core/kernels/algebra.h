/* Small dense matrices, stored row by row. */
#ifndef ALGEBRA_H
#define ALGEBRA_H

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* As many numbers as the processor takes at once. */
#if defined(__AVX2__)
#define LANES 4
#else
#define LANES 2
#endif
typedef double lanes __attribute__((vector_size(8 * LANES), aligned(8), may_alias));

/* y += a x, of n numbers. */
static inline void add_scaled(double *restrict y, double a, const double *restrict x, int n)
{
    for (int j = 0; j < n; j++)
        y[j] += a * x[j];
}

static inline double dot(const double *a, const double *b, int n)
{
    double sum = 0.0;
    for (int j = 0; j < n; j++)
        sum += a[j] * b[j];
    return sum;
}

/* Whether no number of B (count, cols), its rows `wide` apart, is NaN or without end. */
static inline int all_finite(const double *b, int wide, int count, int cols)
{
    lanes sum[4] = {{0}}; /* of zero times each: four, since one would wait for itself */
    double whole = 0.0;
    for (int k = 0; k < count; k++) {
        const double *row = b + (size_t)k * wide;
        int j = 0;
        for (; j + 4 * LANES <= cols; j += 4 * LANES)
            for (int q = 0; q < 4; q++)
                sum[q] += 0.0 * *(const lanes *)(row + j + q * LANES);
        for (; j < cols; j++)
            whole += 0.0 * row[j];
    }
    sum[0] += sum[1] + sum[2] + sum[3];
    for (int q = 0; q < LANES; q++)
        whole += sum[0][q];
    return whole == 0.0;
}

/* What `product` does with what is there, and how much of it: all columns, or those up to the diagonal's block of four. */
enum { SET = 0, ADD = 1, LOWER = 2 };

/* out = A B, or out += A B: A (rows, count) has its numbers `row` and `step` apart, B (count, cols) its rows `wide` apart,
   out `out_wide`. Four rows at a time; of these the columns of A that are zero are skipped, but where B
   is not finite: zero times NaN is NaN. */
static inline void product(
    double *out, int out_wide, const double *a, int row, int step, const double *b, int wide, int rows, int count,
    int cols, int how)
{
    double own[4 * (count > 0 ? count : 1)];
    const double *of[count > 0 ? count : 1];
    int skips = -1; /* whether zeros may be skipped: looked at with the first of them */
    for (int i = 0; i < rows; i += 4) {
        const int here = rows - i < 4 ? rows - i : 4;
        int z = 0, j = 0;
        const int last = (how & LOWER) && i + 4 < cols ? i + 4 : cols;
        for (int k = 0; k < count; k++) {
            double any = 0.0;
            for (int q = 0; q < 4; q++) {
                double x = q < here ? a[(i + q) * row + k * step] : 0.0;
                own[4 * z + q] = x;
                any = x != 0.0 ? 1.0 : any;
            }
            of[z] = b + (size_t)k * wide;
            if (any == 0.0 && skips < 0)
                skips = all_finite(b, wide, count, cols);
            z += any != 0.0 || !skips;
        }
        /* What is left of a row is taken with what was done already, where that can be set again. */
        const int whole = !(how & ADD) && last >= 2 * LANES;
        for (; whole ? j < last : j + 2 * LANES <= last; j += 2 * LANES) {
            if (j + 2 * LANES > last)
                j = last - 2 * LANES;
            lanes s[4] = {{0}}, t[4] = {{0}};
            for (int k = 0; k < z; k++) {
                const lanes x = *(const lanes *)(of[k] + j), y = *(const lanes *)(of[k] + j + LANES);
                for (int q = 0; q < 4; q++) {
                    s[q] += own[4 * k + q] * x;
                    t[q] += own[4 * k + q] * y;
                }
            }
            for (int q = 0; q < 4; q++)
                if (q < here) {
                    lanes *to = (lanes *)(out + (size_t)(i + q) * out_wide + j);
                    if (how & ADD) {
                        s[q] += to[0];
                        t[q] += to[1];
                    }
                    to[0] = s[q];
                    to[1] = t[q];
                }
        }
        for (; j + LANES <= last; j += LANES) {
            lanes s[4] = {{0}};
            for (int k = 0; k < z; k++) {
                const lanes x = *(const lanes *)(of[k] + j);
                for (int q = 0; q < 4; q++)
                    s[q] += own[4 * k + q] * x;
            }
            for (int q = 0; q < 4; q++)
                if (q < here) {
                    lanes *to = (lanes *)(out + (size_t)(i + q) * out_wide + j);
                    *to = how & ADD ? (lanes)(*to + s[q]) : s[q];
                }
        }
        for (; j < last; j++) {
            double s[4] = {0.0};
            for (int k = 0; k < z; k++)
                for (int q = 0; q < 4; q++)
                    s[q] += own[4 * k + q] * of[k][j];
            for (int q = 0; q < 4; q++)
                if (q < here) {
                    double *to = out + (size_t)(i + q) * out_wide + j;
                    *to = how & ADD ? *to + s[q] : s[q];
                }
        }
    }
}

/* The lower half of a symmetric positive definite matrix A = L L' becomes L' in the upper half, row by row, and
   `inverse` L^-1; 1 where A is none. */
static inline int root_and_inverse(double *restrict a, double *restrict inverse, int n)
{
    for (int i = 0; i < n; i++)
        for (int j = i; j < n; j++)
            a[i * n + j] = a[j * n + i];
    memset(inverse, 0, (size_t)(n * n) * sizeof *inverse);
    for (int i = 0; i < n; i++)
        inverse[i * n + i] = 1.0;
    for (int k = 0; k < n; k++) {
        double *own = a + k * n, *back = inverse + k * n;
        if (own[k] <= 0.0) /* what is not known stays unknown */
            return 1;
        const double root = sqrt(own[k]), by = 1.0 / root;
        for (int j = k; j < n; j++)
            own[j] *= by;
        for (int j = 0; j <= k; j++)
            back[j] *= by;
        for (int i = k + 1; i < n; i++) {
            add_scaled(a + i * n + i, -own[i], own + i, n - i);
            add_scaled(inverse + i * n, -own[i], back, k + 1);
        }
    }
    return 0;
}

/* The upper triangle from the lower, in squares of four. */
static inline void mirror(double *a, int n)
{
    for (int i = 0; i < n; i += 4)
        for (int j = 0; j <= i; j += 4)
            for (int r = i; r < i + 4 && r < n; r++)
                for (int c = j; c < j + 4 && c < r; c++)
                    a[c * n + r] = a[r * n + c];
}

/* out (3, 3) = a b, and a b'. */
static inline void times33(const double *a, const double *b, double *out)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] = a[3 * i] * b[j] + a[3 * i + 1] * b[3 + j] + a[3 * i + 2] * b[6 + j];
}

static inline void times33t(const double *a, const double *b, double *out)
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            out[3 * i + j] = a[3 * i] * b[3 * j] + a[3 * i + 1] * b[3 * j + 1] + a[3 * i + 2] * b[3 * j + 2];
}

/* out (3) = a x, and a' x. */
static inline void times3(const double *a, const double *x, double *out)
{
    for (int i = 0; i < 3; i++)
        out[i] = a[3 * i] * x[0] + a[3 * i + 1] * x[1] + a[3 * i + 2] * x[2];
}

static inline void turned3(const double *a, const double *x, double *out)
{
    for (int i = 0; i < 3; i++)
        out[i] = a[i] * x[0] + a[3 + i] * x[1] + a[6 + i] * x[2];
}

#endif
