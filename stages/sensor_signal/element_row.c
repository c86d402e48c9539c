#include "element_row.h"

#include <stdbool.h>

#include "base/elementary.h"
#include "base/units.h"

/* Side lobes have 0.22 of their peak; noise and other echoes may double that. */
#define LEAST_OF_STRONGEST 0.5
/* Beams are searched in steps of a quarter of a beam's width. */
#define SEARCH 4

/* B^2 as a cosine series over the phase from element to element: r_k is the sum of x_{a+k} times
 * the conjugate of x_a. */
struct series {
    size_t elements;
    struct phasor r[ELEMENT_ROW_MOST_ELEMENTS];
};

struct phasor element_row_response(const struct element_row *array, double sine, size_t element)
{
    double place = (double)element - (double)(array->elements - 1) / 2;
    struct elementary_sincos phase = elementary_sincos_turns(array->spacing * place * sine);
    return (struct phasor){phase.cos, phase.sin};
}

double element_row_factor(const struct element_row *array, double distance)
{
    double x = PI * array->spacing * distance, n = (double)array->elements;
    double below = n * elementary_sin(x);
    return below == 0 ? 1 : fabs(elementary_sin(n * x) / below);
}

static struct series series_of(const struct phasor *samples, size_t elements, size_t stride)
{
    struct series series = {.elements = elements};
    for (size_t k = 0; k < elements; k++)
        for (size_t a = 0; a + k < elements; a++) {
            struct phasor here = samples[a * stride], there = samples[(a + k) * stride];
            series.r[k].re += there.re * here.re + there.im * here.im;
            series.r[k].im += there.im * here.re - there.re * here.im;
        }
    return series;
}

static double power_at(const struct series *series, double turns)
{
    double sum = series->r[0].re, n = (double)series->elements;
    for (size_t k = 1; k < series->elements; k++) {
        struct elementary_sincos phase = elementary_sincos_turns((double)k * turns);
        sum += 2 * (series->r[k].re * phase.cos + series->r[k].im * phase.sin);
    }
    return elementary_max(sum, 0) / (n * n);
}

static double slope_at(const struct series *series, double turns)
{
    double sum = 0;
    for (size_t k = 1; k < series->elements; k++) {
        struct elementary_sincos phase = elementary_sincos_turns((double)k * turns);
        sum += (double)k * (series->r[k].im * phase.cos - series->r[k].re * phase.sin);
    }
    return sum;
}

/* The zero of a slope that is positive at low and not at high. */
static double peak_between(const struct series *series, double low, double high)
{
    for (double middle = low + (high - low) / 2; middle > low && middle < high;
         middle = low + (high - low) / 2)
        *(slope_at(series, middle) > 0 ? &low : &high) = middle;
    return low;
}

static void insert(struct element_row_peak *peaks, size_t *count, struct element_row_peak peak)
{
    size_t place = *count < ELEMENT_ROW_MOST_PEAKS ? (*count)++ : ELEMENT_ROW_MOST_PEAKS - 1;
    for (; place > 0 && peaks[place - 1].amplitude < peak.amplitude; place--)
        peaks[place] = peaks[place - 1];
    peaks[place] = peak;
}

size_t element_row_peaks(const struct element_row *array, const struct phasor *samples,
                         size_t stride, double limit, double least, struct element_row_peak *peaks)
{
    struct series series = series_of(samples, array->elements, stride);
    double reach = array->spacing * limit;
    double step = 1 / (SEARCH * (double)array->elements);
    size_t steps = (size_t)ceil(2 * reach / step), count = 0, kept = 0;
    bool rises = false;
    for (size_t i = 0; i <= steps; i++) {
        double turns = elementary_min((double)i * step, 2 * reach) - reach;
        bool rose = rises;
        rises = slope_at(&series, turns) > 0;
        if (!rose || rises)
            continue;
        double top =
            peak_between(&series, elementary_max((double)(i - 1) * step - reach, -reach), turns);
        insert(peaks, &count,
               (struct element_row_peak){top / array->spacing, sqrt(power_at(&series, top))});
    }
    while (kept < count && peaks[kept].amplitude >= least &&
           peaks[kept].amplitude >= LEAST_OF_STRONGEST * peaks[0].amplitude)
        kept++;
    return kept;
}
