/* Where the palm's numbers stand: core/tracking/palm_state.py. */
#ifndef PALM_STATE_H
#define PALM_STATE_H

enum { POSITION = 0, VELOCITY = 3, TURN = 6, RATE = 9, SHAPE = 12, BACK = 30, SKIN = 33, RELIEF = 51, SIZE = 54, DISCS = 6 };

void turn_matrix(const double *turn, double *out);

#endif
