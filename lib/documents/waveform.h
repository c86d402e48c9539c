/* How a radar makes its signal, for glint-sensor-signal: the member `waveform` of a sensor's
 * document. Its resolution is that of the document's cells: chirps of bandwidth c/(2 cell_range_m),
 * or pulses that are cell_range_m wide at half their amplitude, over a time of wavelength/(2
 * cell_range_rate_mps). */
#ifndef WAVEFORM_H
#define WAVEFORM_H

#include "radar/cfar.h"
#include "radar/point_response.h"
#include "text/field.h"

enum waveform_kind { WAVEFORM_CHIRP, WAVEFORM_PULSE };

struct waveform {
    enum waveform_kind kind;
    int64_t samples;     /* 0: no waveform is described */
    int64_t repetitions; /* of the chirp, or of the pulse */
    int64_t elements;    /* 0: the sum and delta channels of the antenna */
    double spacing;
    enum point_response window;
    enum cfar_kind cfar;
    int64_t cfar_cells, cfar_guard, cfar_rank;
    double cfar_false_alarm;
};

extern const struct record waveform_record;

/* How far apart its range bins are. */
double waveform_range_step_m(const struct waveform *waveform, double cell_range_m);

/* Refuses what is fine alone and wrong together. No waveform is fine. */
int waveform_check(const struct waveform *waveform, double cell_range_m, double range_max_m,
                   struct diag *diag);

struct cfar waveform_cfar(const struct waveform *waveform);

#endif
