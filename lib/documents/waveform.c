#include "documents/waveform.h"

#include <math.h>

static const char *const kinds[] = {[WAVEFORM_CHIRP] = "chirp", [WAVEFORM_PULSE] = "pulse", NULL};
static const char *const windows[] = {
    [POINT_RESPONSE_HANN] = "hann", [POINT_RESPONSE_RECTANGULAR] = "rectangular", NULL};
static const char *const cfars[] = {[CFAR_ORDERED] = "ordered", [CFAR_MEAN] = "mean", NULL};

static const struct field waveform_fields[] = {
    {FIELD_CHOICE_OF(struct waveform, kind, kinds,
                     "a chirp that is mixed with its echo, or a pulse")},
    {FIELD_INTEGER_IN(struct waveform, samples, 16, 4096,
                      "range bins: one to a range cell for chirps, four for pulses")},
    {FIELD_INTEGER_IN(struct waveform, repetitions, 16, 4096,
                      "chirps or pulses of a train, as many as range rate cells")},
    {OPTIONAL_INTEGER(
        struct waveform, stagger, 2, 64,
        "n: a second train, 1 + 1/n as long, tells n folds of range rate apart; absent: none")},
    {OPTIONAL_CHOICE(struct waveform, window, windows, "window of the Fourier transforms")},
    {OPTIONAL_CHOICE(struct waveform, cfar, cfars,
                     "noise level of a cell: the neighbour of cfar_rank, or the mean of all")},
    {OPTIONAL_INTEGER(
         struct waveform, cfar_cells, 2, CFAR_MOST_CELLS,
         "neighbours in range rate, half of them on each side; every third with Hann's window"),
     .absent = 16},
    {OPTIONAL_INTEGER(struct waveform, cfar_guard, 0, 64,
                      "cells between a cell and its neighbours, on each side"),
     .absent = 2},
    {OPTIONAL_INTEGER(struct waveform, cfar_rank, 1, CFAR_MOST_CELLS,
                      "ordered: rank of the neighbour, from 1 for the weakest"),
     .absent = 12},
    {OPTIONAL_REAL(struct waveform, cfar_false_alarm, 1e-12, 0.5,
                   "probability that noise alone passes the threshold"),
     .absent = 1e-4},
    {0},
};

#define ELEMENTS_NOW                                                                               \
    "the sensor's array has the elements; write beside the waveform \"antenna_pattern\": "         \
    "\"array\", \"angle_estimator\": \"beams\", \"array\": {\"transmit\": [{\"place\": 0}], "      \
    "\"receive\": [{\"place\": 0}, {\"place\": 0.5}]}, with a place in wavelengths for each "      \
    "receiver, and no antenna_table"

static const struct field_gone gone_fields[] = {
    {"elements", ELEMENTS_NOW}, {"spacing", ELEMENTS_NOW}, {0}};

const struct record waveform_record = {
    FIELD_TABLE(struct waveform, waveform_fields, "waveform",
                "How the signal is made and searched."),
    .gone = gone_fields,
};

double waveform_range_step_m(const struct waveform *waveform, double cell_range_m)
{
    return waveform->kind == WAVEFORM_PULSE ? cell_range_m / 4 : cell_range_m;
}

enum point_response waveform_range_response(const struct waveform *waveform)
{
    return waveform->kind == WAVEFORM_PULSE ? POINT_RESPONSE_PULSE : waveform->window;
}

/* The least distance of bins of the transform whose noise is independent. */
static size_t independent_bins(const struct waveform *waveform)
{
    return waveform->window == POINT_RESPONSE_HANN ? 3 : 1;
}

/* Refuses a CFAR window or a stagger that needs more repetitions. */
static int check_rates(const struct waveform *waveform, struct diag *diag)
{
    struct cfar cfar = waveform_cfar(waveform, 1, 1);
    long long apart = (long long)independent_bins(waveform);
    long long guard = waveform->cfar_guard, repetitions = waveform->repetitions;
    if (guard + 1 < apart)
        return diag_fail(diag, DIAG_CONFIG,
                         "cfar_guard: %lld; expected at least %lld, as the window correlates "
                         "nearer cells",
                         guard, apart - 1);
    if ((long long)cfar_extent(&cfar) - 1 + apart > repetitions)
        return diag_fail(diag, DIAG_CONFIG,
                         "cfar_cells: %lld, every %s, behind cfar_guard, %lld, span %zu cells and "
                         "need %lld repetitions; there are %lld",
                         (long long)waveform->cfar_cells, apart == 3 ? "third" : "one", guard,
                         cfar_extent(&cfar), (long long)cfar_extent(&cfar) - 1 + apart,
                         repetitions);
    if (waveform->stagger * apart > repetitions)
        return diag_fail(
            diag, DIAG_CONFIG, "stagger: %lld; expected at most %lld, a %s of repetitions",
            (long long)waveform->stagger, repetitions / apart, apart == 3 ? "third" : "whole");
    return 0;
}

int waveform_check(const struct waveform *waveform, double cell_range_m, double range_max_m,
                   struct diag *diag)
{
    double step_m = waveform_range_step_m(waveform, cell_range_m);
    if (waveform->samples == 0)
        return 0;
    if ((double)waveform->samples * step_m < range_max_m)
        return diag_fail(
            diag, DIAG_CONFIG,
            "samples: %lld of %g m do not reach range_max_m, %g m; expected at least %.0f",
            (long long)waveform->samples, step_m, range_max_m, ceil(range_max_m / step_m));
    if (waveform->cfar_cells % 2 != 0)
        return diag_fail(diag, DIAG_CONFIG, "cfar_cells: %lld; expected an even number",
                         (long long)waveform->cfar_cells);
    if (waveform->cfar == CFAR_ORDERED && waveform->cfar_rank > waveform->cfar_cells)
        return diag_fail(diag, DIAG_CONFIG, "cfar_rank: %lld is above cfar_cells, %lld",
                         (long long)waveform->cfar_rank, (long long)waveform->cfar_cells);
    return check_rates(waveform, diag);
}

struct cfar waveform_cfar(const struct waveform *waveform, size_t padding, size_t beams)
{
    size_t cells = (size_t)waveform->cfar_cells, rank = (size_t)waveform->cfar_rank;
    return (struct cfar){
        .kind = waveform->cfar,
        .cells = cells,
        .nearest = padding * ((size_t)waveform->cfar_guard + 1),
        .spacing = padding * independent_bins(waveform),
        .rank = rank,
        .factor =
            cfar_factor(waveform->cfar, cells, rank, waveform->cfar_false_alarm / (double)beams),
    };
}
