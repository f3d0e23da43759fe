/* Where the palm's numbers stand: core/tracking/palm_state.py. */
#ifndef PALM_STATE_H
#define PALM_STATE_H

enum { POSITION = 0, VELOCITY = 3, TURN = 6, RATE = 9, SHAPE = 12, BACK = 30, SKIN = 33, RELIEF = 51, SIZE = 54, DISCS = 6 };

/* What is fixed about how a camera sees a palm, in one row: palm_state.py, View. */
enum {
    FX, FY, CX, CY, IMAGE, SHIFT = IMAGE + 9, INTO_CAMERA = SHIFT + 3, CAMERA_AT = INTO_CAMERA + 9, PATCH = CAMERA_AT + 3,
    READING_FIXED, READING_SQUARE, STAYS_FIXED, STAYS_SQUARE, STAYS_PX, AVERAGES, PALM, HIDDEN = PALM + 3 * DISCS, VIEW = HIDDEN + 3 * DISCS * DISCS
};

void turn_matrix(const double *turn, double *out);
int surface_fit(
    int count, const double *pixel, const double *depth, const double *view, const double *estimate_rotation,
    const double *value, int rows, int columns, const double *plane, const double *to_node, const double *middle, int steps,
    double huber, double most, int least, double share_in, double reading_per_m, double turn_sd, double up_sd,
    double goes_on, int *used, double *out_value, double *out_covariance, double *out_slope);

#endif
