/* Waveform and CFAR search of a radar, for glint-sensor-signal. The record is the member `waveform`
 * of a sensor's document. The resolution is that of the document's cells: chirps have the bandwidth
 * c/(2 cell_range_m), pulses are cell_range_m wide at half their amplitude, and a train of
 * repetitions lasts wavelength/(2 cell_range_rate_mps). */
#pragma once

#include "radar/cfar.h"
#include "radar/point_response.h"
#include "text/field.h"

enum waveform_kind { WAVEFORM_CHIRP, WAVEFORM_PULSE };

struct waveform {
    enum waveform_kind kind;
    int64_t samples;     /* 0: the document describes no waveform */
    int64_t repetitions; /* chirps or pulses of a train */
    int64_t stagger;     /* range rates are known within so many folds; 0: they fold */
    int64_t elements;    /* 0: the sum and delta channels of the antenna */
    double spacing;      /* of the elements, in wavelengths */
    enum point_response window;
    enum cfar_kind cfar;
    int64_t cfar_cells, cfar_guard, cfar_rank;
    double cfar_false_alarm;
};

extern const struct record waveform_record;

/* The distance between range bins. */
double waveform_range_step_m(const struct waveform *waveform, double cell_range_m);

/* Refuses combinations of members that contradict each other. No waveform at all is accepted. */
int waveform_check(const struct waveform *waveform, double cell_range_m, double range_max_m,
                   struct diag *diag);

/* The search in a spectrum of `padding` cells to a bin. Its windows take neighbours whose noise is
 * independent. Each beam has its share of the probability of a false alarm. */
struct cfar waveform_cfar(const struct waveform *waveform, size_t padding, size_t beams);
