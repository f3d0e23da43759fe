/* What the kernels share of the filter and of naming: filter.c and palm.c. */
#ifndef FILTER_H
#define FILTER_H

#include <stdint.h>

int log_odds(
    int markers, int blobs, const double *expected, const double *covariance,
    const double *measured, const double *variance, double prior, double depth_range,
    double outlier, double gate2, double impossible, double *out, uint8_t *with_depth);
int resolved(int markers, int blobs, const double *odds, int64_t *assigned);
void transitioned(
    int modes, int size, int mixing, int relaxing, const double *change, const double *mean, const double *covariance,
    const double *probability, const double *moving, const double *driven, const double *kept, const double *stationary,
    const double *nominal, double *out_mean, double *out_covariance, double *out_probability);
void predicted(
    int chains, int modes, int size, const double *change, const double *mean, const double *covariance,
    const double *probability, const double *forward, const double *noise, double *out_mean, double *out_covariance,
    double *out_probability);

#endif
