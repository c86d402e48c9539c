/* Waveform and CFAR search of a radar, for glint-sensor-signal.
 *
 * The member `waveform` of a sensor's document. The document's cells give the resolution: chirps
 * have the bandwidth c/(2 cell_range_m), pulses are cell_range_m wide at half their amplitude, and
 * a train of repetitions lasts wavelength/(2 cell_range_rate_mps). */
#pragma once

#include "radar/cfar.h"
#include "radar/point_response.h"
#include "text/field.h"

enum waveform_kind { WAVEFORM_CHIRP, WAVEFORM_PULSE };

struct waveform {
    enum waveform_kind kind;
    int64_t samples;     /* 0: the document describes no waveform */
    int64_t repetitions; /* chirps or pulses of a train */
    int64_t stagger;     /* folds of range rate that a second train resolves; 0: there is none */
    enum point_response window;
    enum cfar_kind cfar;
    int64_t cfar_cells, cfar_guard, cfar_rank;
    double cfar_false_alarm;
};

extern const struct record waveform_record;

/* The distance between range bins. */
double waveform_range_step_m(const struct waveform *waveform, double cell_range_m);

/* The point response along range; that along range rate is the member window. */
enum point_response waveform_range_response(const struct waveform *waveform);

/* Refuses members that contradict each other (DIAG_CONFIG); accepts 0 samples, no waveform. */
int waveform_check(const struct waveform *waveform, double cell_range_m, double range_max_m,
                   struct diag *diag);

/* The search in a spectrum with `padding` cells to a bin. Its windows take only cells of
 * independent noise. The probability of a false alarm is divided by the number of beams. */
struct cfar waveform_cfar(const struct waveform *waveform, size_t padding, size_t beams);
