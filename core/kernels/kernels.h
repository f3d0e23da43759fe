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
KERNEL int merged(
    int chains, int modes, int size, const double mean[chains * modes * size],
    const double covariance[chains * modes * size * size], const double probability[chains * modes],
    double whole_mean[chains * size], double whole[chains * size * size]);

/* palm.c */


#endif
