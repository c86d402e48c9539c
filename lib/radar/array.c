#include "radar/array.h"

#include <assert.h>

#include "base/elementary.h"
#include "base/root.h"
#include "base/units.h"

static double middle_of(const struct array *array, size_t n)
{
    return (double)n - (double)(array->count - 1) / 2;
}

/* Taylor's coefficients for side lobes of -30 dB (Taylor 1955). */
static double taylor_coefficient(int order)
{
    const int nbar = 4;
    double level = units_amplitude_from_db(30);
    double a = elementary_log(level + sqrt(level * level - 1)) / PI;
    double dilation = nbar * nbar / (a * a + (nbar - 0.5) * (nbar - 0.5));
    double square = order * order;
    double over = 1, under = 2;
    for (int i = 1; i < nbar; i++) {
        over *= 1 - square / dilation / (a * a + (i - 0.5) * (i - 0.5));
        if (i != order)
            under *= 1 - square / (i * i);
    }
    return (order % 2 == 1 ? 1 : -1) * over / under;
}

static double taylor_weight(double turns)
{
    double weight = 1;
    for (int order = 1; order < 4; order++)
        weight += 2 * taylor_coefficient(order) * elementary_sincos_turns(order * turns).cos;
    return weight;
}

/* Chebyshev's polynomial of this degree. */
static double chebyshev(size_t degree, double x)
{
    double before = 1, here = x;
    for (size_t i = 1; i < degree; i++) {
        double next = 2 * x * here - before;
        before = here;
        here = next;
    }
    return degree == 0 ? 1 : here;
}

/* The weight whose pattern is Chebyshev's polynomial (Dolph 1946). turns = m/N. */
static double chebyshev_weight(size_t count, double turns)
{
    double level = units_amplitude_from_db(30), weight = 0;
    double root =
        elementary_exp(elementary_log(level + sqrt(level * level - 1)) / (double)(count - 1));
    double stretch = (root + 1 / root) / 2;
    for (size_t k = 0; k < count; k++) {
        double x = stretch * elementary_sincos_turns((double)k / (double)(2 * count)).cos;
        weight += chebyshev(count - 1, x) * elementary_sincos_turns((double)k * turns).cos;
    }
    return weight;
}

static double taper_weight(enum array_taper taper, size_t count, double middle)
{
    double turns = middle / (double)count;
    if (taper == TAPER_HANN)
        return (1 + elementary_sincos_turns(turns).cos) / 2;
    if (taper == TAPER_TAYLOR)
        return taylor_weight(turns);
    if (taper == TAPER_CHEBYSHEV && count > 1)
        return chebyshev_weight(count, turns);
    return 1;
}

/* S and its derivatives by turns from element to element. */
struct beam {
    struct phasor value, slope, bend;
};

static struct beam beam_at(const struct array *array, const struct phasor *samples, double turns)
{
    struct beam beam = {{0, 0}, {0, 0}, {0, 0}};
    for (size_t n = 0; n < array->count; n++) {
        double middle = middle_of(array, n), rate = -2 * PI * middle;
        struct elementary_sincos turn = elementary_sincos_turns(-middle * turns);
        double re = array->weight[n] * (samples[n].re * turn.cos - samples[n].im * turn.sin);
        double im = array->weight[n] * (samples[n].re * turn.sin + samples[n].im * turn.cos);
        beam.value.re += re;
        beam.value.im += im;
        beam.slope.re -= rate * im;
        beam.slope.im += rate * re;
        beam.bend.re -= rate * rate * re;
        beam.bend.im -= rate * rate * im;
    }
    return beam;
}

static double product(struct phasor a, struct phasor b)
{
    return a.re * b.re + a.im * b.im;
}

double array_response(const struct array *array, double distance)
{
    double sum = 0;
    for (size_t n = 0; n < array->count; n++)
        sum += array->weight[n] *
               elementary_sincos_turns(array->spacing * middle_of(array, n) * distance).cos;
    return fabs(sum);
}

/* The largest side lobe at each distance or beyond, up to half a period; within the main lobe,
 * which ends at the first minimum, the largest of all. */
static void set_envelope(struct array *array)
{
    enum { FINE = 4 };
    size_t steps = ARRAY_PADDING * array->count / 2;
    double step = 1 / (array->spacing * ARRAY_PADDING * FINE * (double)array->count);
    size_t lobe = 1;
    while (lobe < FINE * steps && array_response(array, (double)(lobe + 1) * step) <
                                      array_response(array, (double)lobe * step))
        lobe++;
    double most = 0;
    for (size_t i = FINE * steps + 1; i-- > 0;) {
        if (i >= lobe)
            most = elementary_max(most, array_response(array, (double)i * step));
        if (i % FINE == 0)
            array->envelope[i / FINE] = most;
    }
}

static void set_weights(struct array *array, enum array_taper taper)
{
    double sum = 0, squares = 0;
    for (size_t n = 0; n < array->count; n++) {
        array->weight[n] = taper_weight(taper, array->count, middle_of(array, n));
        sum += array->weight[n];
    }
    for (size_t n = 0; n < array->count; n++) {
        double phase = 2 * PI * middle_of(array, n), weight = array->weight[n] / sum;
        array->weight[n] = weight;
        array->signal_moment += weight * phase * phase;
        array->noise_moment += weight * weight * phase * phase;
        squares += weight * weight;
    }
    array->noise = sqrt(squares);
    array->noise_moment /= squares;
}

/* Puts the virtual elements in their order from the right. */
static void set_places(struct array *array, const struct array_layout *layout)
{
    double places[ARRAY_MOST_ELEMENTS] = {0};
    for (size_t t = 0; t < layout->transmit.count; t++)
        for (size_t r = 0; r < layout->receive.count; r++) {
            double place = layout->transmit.items[t].place + layout->receive.items[r].place;
            size_t n = array->count++;
            while (n > 0 && places[n - 1] > place) {
                places[n] = places[n - 1];
                array->turn[n] = array->turn[n - 1];
                n--;
            }
            places[n] = place;
            array->turn[n] = t;
        }
    size_t last = array->count - 1;
    array->least_step = last > 0 ? (double)INFINITY : 0;
    for (size_t n = 0; n < last; n++) {
        array->least_step = elementary_min(array->least_step, places[n + 1] - places[n]);
        array->most_step = elementary_max(array->most_step, places[n + 1] - places[n]);
    }
    array->spacing = last > 0 ? (places[last] - places[0]) / (double)last : 0;
}

struct array array_of(const struct array_layout *layout)
{
    assert(layout->transmit.count >= 1 && layout->receive.count >= 1);
    assert(layout->transmit.count * layout->receive.count <= ARRAY_MOST_ELEMENTS);
    struct array array = {.count = 0};
    set_places(&array, layout);
    set_weights(&array, layout->taper);
    size_t length = ARRAY_PADDING * array.count;
    for (size_t k = 0; k < length; k++) {
        struct elementary_sincos turn = elementary_sincos_turns(-(double)k / (double)length);
        array.root[k] = (struct phasor){turn.cos, turn.sin};
    }
    if (array.least_step > 0)
        set_envelope(&array);
    return array;
}

struct phasor array_phasor(const struct array *array, double sine, size_t n)
{
    struct elementary_sincos turn =
        elementary_sincos_turns(array->spacing * middle_of(array, n) * sine);
    return (struct phasor){turn.cos, turn.sin};
}

void array_receive(const struct array *array, double sine, struct phasor echo,
                   struct phasor *samples)
{
    for (size_t n = 0; n < array->count; n++) {
        struct phasor one = array_phasor(array, sine, n);
        samples[n].re += echo.re * one.re - echo.im * one.im;
        samples[n].im += echo.re * one.im + echo.im * one.re;
    }
}

/* |S|^2 at point k of the transform. */
static double power_at(const struct array *array, const struct phasor *samples, size_t k)
{
    size_t length = ARRAY_PADDING * array->count, at = 0;
    struct phasor sum = {0, 0};
    for (size_t n = 0; n < array->count; n++) {
        struct phasor root = array->root[at];
        sum.re += array->weight[n] * (samples[n].re * root.re - samples[n].im * root.im);
        sum.im += array->weight[n] * (samples[n].re * root.im + samples[n].im * root.re);
        at += k;
        if (at >= length)
            at -= length;
    }
    return product(sum, sum);
}

/* The second derivative of |S|^2 by turns. */
static double bend_of(const struct beam *beam)
{
    return 2 * (product(beam->slope, beam->slope) + product(beam->value, beam->bend));
}

/* The mean power of the samples, weighted by the taper: the power of their mean S plus the mean
 * power of their deviations from it. */
static double power_of_samples(const struct array *array, const struct phasor *samples)
{
    double power = 0;
    for (size_t n = 0; n < array->count; n++)
        power += array->weight[n] * product(samples[n], samples[n]);
    return power;
}

/* The maximum of |S| near this place; a Newton step that would lead down is not taken. */
static struct array_maximum refined(const struct array *array, const struct phasor *samples,
                                    double turns)
{
    struct beam beam = beam_at(array, samples, turns);
    for (int i = 0; i < 2 && bend_of(&beam) < 0; i++) {
        double next = turns - 2 * product(beam.value, beam.slope) / bend_of(&beam);
        struct beam there = beam_at(array, samples, next);
        if (product(there.value, there.value) < product(beam.value, beam.value))
            break;
        beam = there;
        turns = next;
    }
    double power = product(beam.value, beam.value);
    double noise = product(beam.slope, beam.slope) + power * array->noise_moment;
    return (struct array_maximum){
        .sine = turns / array->spacing,
        .amplitude = sqrt(power),
        .sigma = sqrt(2 * noise) / (fabs(bend_of(&beam)) * array->spacing),
        .others = elementary_max(0, power_of_samples(array, samples) - power),
    };
}

/* Puts a maximum in its place among the count stronger and weaker ones. */
static void insert(struct array_maximum *maxima, size_t count, const struct array_maximum *found)
{
    size_t place = count;
    while (place > 0 && maxima[place - 1].amplitude < found->amplitude) {
        maxima[place] = maxima[place - 1];
        place--;
    }
    maxima[place] = *found;
}

size_t array_maxima(const struct array *array, const struct phasor *samples,
                    struct array_maximum *maxima)
{
    double power[ARRAY_PADDING * ARRAY_MOST_ELEMENTS];
    size_t length = ARRAY_PADDING * array->count, count = 0;
    double step = 1 / (double)length;
    for (size_t k = 0; k < length; k++)
        power[k] = power_at(array, samples, k);
    for (size_t k = 0; k < length; k++) {
        double before = power[(k + length - 1) % length], after = power[(k + 1) % length];
        if (!(power[k] > before && power[k] >= after))
            continue;
        double turn = k > length / 2 ? (double)k - (double)length : (double)k;
        double vertex = point_response_vertex(before, power[k], after) * step;
        struct array_maximum found = refined(array, samples, turn * step + vertex);
        if (fabs(found.sine) <= 1 && count < array->count)
            insert(maxima, count++, &found);
    }
    return count;
}

/* The envelope of side lobes at a distance of sines, which repeat after 1/spacing. */
static double side_lobe(const struct array *array, double distance)
{
    double turns = fabs(remainder(array->spacing * distance, 1));
    return array->envelope[(size_t)(turns * (double)(ARRAY_PADDING * array->count))];
}

size_t array_keep(const struct array *array, double threshold, double noise,
                  struct array_maximum *maxima, size_t count)
{
    size_t kept = count > 0;
    for (size_t i = 1; i < count; i++) {
        double lobes = 0, amplitude = maxima[i].amplitude;
        for (size_t j = 0; j < kept; j++)
            lobes += side_lobe(array, maxima[i].sine - maxima[j].sine) * maxima[j].amplitude;
        if (amplitude > threshold && amplitude > 1.06 * lobes + 3 * noise)
            maxima[kept++] = maxima[i];
    }
    return kept;
}

struct array_others array_noise_beside(const struct array *array, double noise)
{
    double squares = array->noise * array->noise, element = noise * noise / squares;
    return (struct array_others){(1 - squares) * element, array->noise * element};
}

double array_sigma(const struct array *array, double snr)
{
    return sqrt(array->noise_moment / (2 * snr)) / (array->signal_moment * array->spacing);
}

static bool is_within_beam(const void *of, double distance)
{
    return array_response(of, distance) > sqrt(0.5);
}

double array_beam(const struct array *array)
{
    double beyond = 1 / (array->spacing * (double)array->count);
    while (is_within_beam(array, beyond) && beyond < 2)
        beyond *= 1.5;
    return 2 * root_between(0, beyond, 0, is_within_beam, array).low;
}
