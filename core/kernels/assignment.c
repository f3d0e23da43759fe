/* Who belongs to whom, one to one: shortest augmenting paths with potentials (Jonker and Volgenant, as for rectangles by
   Crouse 2016). Where several are the best, the one that SciPy names: it looks at columns in the same order. */
#include <math.h>
#include <stdlib.h>

#include "kernels.h"

/* The free column in which the cheapest path from a row ends, and what it costs; -1 where there is none. */
static int path_to_free(
    int columns, const double *cost, const double *of_row, const double *of_column, const int64_t *row_of, int row,
    int *before, double *shortest, uint8_t *row_seen, uint8_t *column_seen, int *open, double *cheapest)
{
    int left = columns, sink = -1;
    for (int i = 0; i < columns; i++) {
        open[i] = columns - 1 - i;
        shortest[i] = INFINITY;
    }
    *cheapest = 0.0;
    while (sink < 0) {
        int next = -1;
        double lowest = INFINITY;
        row_seen[row] = 1;
        for (int i = 0; i < left; i++) {
            const int column = open[i];
            const double through = *cheapest + cost[(size_t)row * columns + column] - of_row[row] - of_column[column];
            if (through < shortest[column]) {
                before[column] = row;
                shortest[column] = through;
            }
            if (shortest[column] < lowest || (shortest[column] == lowest && row_of[column] < 0)) {
                lowest = shortest[column];
                next = i;
            }
        }
        *cheapest = lowest;
        if (next < 0 || isinf(lowest))
            return -1;
        const int column = open[next];
        column_seen[column] = 1;
        open[next] = open[--left];
        if (row_of[column] < 0)
            sink = column;
        else
            row = (int)row_of[column];
    }
    return sink;
}

/* column_of[r] belongs to row r; there are at least as many columns as rows. */
KERNEL int least_assignment(int rows, int columns, const double cost[rows * columns], int64_t column_of[rows])
{
    if (rows > columns)
        return OUTSIDE;
    for (size_t i = 0; i < (size_t)rows * (size_t)columns; i++)
        if (isnan(cost[i]) || cost[i] == -INFINITY)
            return OUTSIDE;
    const size_t all = (size_t)rows + (size_t)columns;
    double *potential = calloc(all + (size_t)columns, sizeof *potential);
    int64_t *row_of = malloc(sizeof *row_of * ((size_t)columns + 1));
    int *before = malloc(sizeof *before * (2 * (size_t)columns + 1));
    uint8_t *seen = malloc(all + 1);
    int failed = potential && row_of && before && seen ? 0 : NO_MEMORY;
    if (failed)
        goto done;
    double *of_column = potential + rows, *shortest = of_column + columns;
    for (int i = 0; i < columns; i++)
        row_of[i] = -1;
    for (int row = 0; row < rows; row++)
        column_of[row] = -1;
    for (int row = 0; row < rows; row++) {
        double cheapest;
        for (size_t i = 0; i < all; i++)
            seen[i] = 0;
        int column = path_to_free(columns, cost, potential, of_column, row_of, row, before, shortest, seen, seen + rows,
                                  before + columns, &cheapest);
        if (column < 0) {
            failed = OUTSIDE;
            break;
        }
        potential[row] += cheapest;
        for (int i = 0; i < rows; i++)
            if (seen[i] && i != row)
                potential[i] += cheapest - shortest[column_of[i]];
        for (int i = 0; i < columns; i++)
            if (seen[rows + i])
                of_column[i] -= cheapest - shortest[i];
        for (int at = -1; at != row;) {
            at = before[column];
            const int64_t taken = column_of[at];
            row_of[column] = at;
            column_of[at] = column;
            column = (int)taken;
        }
    }
done:
    free(potential);
    free(row_of);
    free(before);
    free(seen);
    return failed;
}
