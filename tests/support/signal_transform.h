/* Transforms of a signal cube by the sums that define them. */
#pragma once

#include "check.h"

#include "sensor_signal/signal_cube.h"

/* Point k of a transform of twice as many points as there are samples. */
static inline struct phasor signal_transform_sum(const struct phasor *samples, size_t count,
                                                 size_t k)
{
    struct phasor sum = {0, 0};
    for (size_t n = 0; n < count; n++) {
        double angle = acos(-1) * (double)(k * n) / (double)count;
        sum.re += samples[n].re * cos(angle) - samples[n].im * sin(angle);
        sum.im += samples[n].re * sin(angle) + samples[n].im * cos(angle);
    }
    return sum;
}

/* Transforms the rows of one repetition. */
static inline void signal_transform_rows(const struct signal_cube *signal)
{
    struct phasor samples[64];
    size_t count = signal->row_cells / 2;
    assert_in_range(count, 1, COUNT(samples));
    for (size_t channel = 0; channel < signal->channels; channel++) {
        struct phasor *row = signal->rows + channel * signal->row_cells;
        memcpy(samples, row, count * sizeof *row);
        for (size_t k = 0; k < signal->row_cells; k++)
            row[k] = signal_transform_sum(samples, count, k);
    }
}
