/* What the library does. Matrices are stored row by row; shapes stand in the Python function of the same name, which
   is the oracle. Every kernel returns 0, or 1 where a matrix is not positive definite. Nothing is remembered. */
#ifndef KERNELS_H
#define KERNELS_H

#include <stdint.h>

#if defined(_WIN32)
#define KERNEL __declspec(dllexport)
#else
#define KERNEL __attribute__((visibility("default")))
#endif

KERNEL const char *kernels_digest(void);
KERNEL int kernels_run_wide(void);

/* filter.c */
KERNEL int corrected(
    int chains, int modes, int size, int count, const double *mean, const double *covariance, const double *probability,
    const double *value, const double *slope, const double *error, const double *about, const double *measured,
    const double *variance, const double *shared, const double *share_mean, const double *share_covariance,
    double *out_mean, double *out_covariance, double *out_probability, double *nis, int64_t *dof, double *residual);
KERNEL int carried(
    int modes, int size, int mixing, int settling, const double *change, const double *mean, const double *covariance,
    const double *probability, const double *moving, const double *driven, const double *kept, const double *settled,
    const double *nominal, double *out_mean, double *out_covariance, double *out_probability);
KERNEL int predicted(
    int chains, int modes, int size, const double *change, const double *mean, const double *covariance,
    const double *probability, const double *forward, const double *noise, double *out_mean, double *out_covariance,
    double *out_probability);
KERNEL int merged(
    int chains, int modes, int size, const double *mean, const double *covariance, const double *probability,
    double *whole_mean, double *whole);

#endif
