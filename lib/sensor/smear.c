#include "sensor/smear.h"

#include <complex.h>
#include <math.h>

#include "base/elementary.h"
#include "radar/point_response.h"

/* Samples in a bin, samples to either side of a received echo's own, and in a row. */
enum { BIN = 2, REACH = 3 * BIN, TAPS = 2 * REACH + 1 };

/* The sample next to a value, and how many bins behind it the value lies, in [-1/4, 1/4]. */
struct place {
    int64_t sample;
    double offset;
};

static struct place place_of(double value, double bin_width)
{
    double samples = BIN * (value / bin_width), whole = round(samples);
    return (struct place){(int64_t)whole, (samples - whole) / BIN};
}

/* The slot of that sample, or the empty one where it belongs. */
static uint32_t *slot_of(const struct smear *smear, int64_t range, int64_t rate)
{
    uint64_t mixed = (uint64_t)range * UINT64_C(0x9e3779b97f4a7c15) + (uint64_t)rate;
    mixed *= UINT64_C(0xc2b2ae3d27d4eb4f);
    for (size_t at = (size_t)(mixed >> 32);; at++) {
        uint32_t *slot = &smear->slot[at & (smear->slots - 1)];
        if (*slot == 0)
            return slot;
        const struct smear_sample *sample = &smear->samples[*slot - 1];
        if (sample->range == range && sample->rate == rate)
            return slot;
    }
}

static const struct smear_sample *find(const struct smear *smear, int64_t range, int64_t rate)
{
    uint32_t number = *slot_of(smear, range, rate);
    return number != 0 ? &smear->samples[number - 1] : NULL;
}

static struct smear_sample *touch(struct smear *smear, int64_t range, int64_t rate)
{
    uint32_t *slot = slot_of(smear, range, rate);
    if (*slot == 0) {
        smear->samples[smear->sample_count].range = range;
        smear->samples[smear->sample_count].rate = rate;
        *slot = (uint32_t)++smear->sample_count;
    }
    return &smear->samples[*slot - 1];
}

static struct place range_place(const struct smear *smear, const struct received_echo *received)
{
    return place_of(received->range_m, smear->sensor->cell_range_m);
}

static struct place rate_place(const struct smear *smear, const struct received_echo *received)
{
    return place_of(received->range_rate_mps, smear->sensor->cell_range_rate_mps);
}

static double _Complex turn_of(double phase_rad)
{
    struct elementary_sincos phase = elementary_sincos(phase_rad);
    return phase.cos + phase.sin * (double _Complex)I;
}

static void spread(struct smear *smear, const struct received_echo *received)
{
    struct place range = range_place(smear, received), rate = rate_place(smear, received);
    struct antenna_pointers one =
        antenna_pointers(&smear->sensor->antenna, received->echo.azimuth_rad);
    double _Complex strength = received->strength * turn_of(received->phase_rad);
    bool turned = received->phase_rad != smear->received_echoes[0].phase_rad;
    uint64_t effects = received->effects | (turned ? EFFECT_BIT(EFFECT_COHERENCE) : 0);
    double across[TAPS];
    for (int j = 0; j < TAPS; j++)
        across[j] = point_response_hann((double)(j - REACH) / BIN - rate.offset);
    one.sum *= strength;
    one.delta *= strength;
    for (int i = 0; i < TAPS; i++) {
        double along = point_response_hann((double)(i - REACH) / BIN - range.offset);
        for (int j = 0; j < TAPS; j++) {
            double weight = along * across[j];
            if (weight == 0)
                continue;
            struct smear_sample *sample =
                touch(smear, range.sample + i - REACH, rate.sample + j - REACH);
            sample->pointers.sum += weight * one.sum;
            sample->pointers.delta += weight * one.delta;
            sample->received_echoes++;
            sample->effects |= effects;
        }
    }
}

/* Of the sum channel; 0 where no received echo reaches. */
static double magnitude(const struct smear_sample *sample)
{
    return sample != NULL
               ? elementary_hypot(creal(sample->pointers.sum), cimag(sample->pointers.sum))
               : 0;
}

/* The strongest of a sample and its neighbours; of equal ones the first by range, then by rate. */
static const struct smear_sample *step(const struct smear *smear, const struct smear_sample *from)
{
    const struct smear_sample *best = from;
    double most = -1;
    for (int64_t range = from->range - 1; range <= from->range + 1; range++)
        for (int64_t rate = from->rate - 1; rate <= from->rate + 1; rate++) {
            const struct smear_sample *sample = find(smear, range, rate);
            double here = magnitude(sample);
            if (sample != NULL && here > most) {
                best = sample;
                most = here;
            }
        }
    return best;
}

static size_t peak_of(const struct smear *smear, const struct received_echo *received)
{
    const struct smear_sample *at =
        find(smear, range_place(smear, received).sample, rate_place(smear, received).sample);
    for (const struct smear_sample *next = step(smear, at); next != at; next = step(smear, at))
        at = next;
    return (size_t)(at - smear->samples);
}

struct smear smear_make(const struct sensor *sensor, const struct received_echo *received_echoes,
                        size_t count, struct arena *arena)
{
    struct smear smear = {
        .sensor = sensor, .received_echoes = received_echoes, .count = count, .slots = 2};
    size_t most = count * TAPS * TAPS;
    while (smear.slots < 2 * most)
        smear.slots *= 2;
    smear.samples = arena_get(arena, most * sizeof *smear.samples);
    smear.slot = arena_get(arena, smear.slots * sizeof *smear.slot);
    smear.cell = arena_get(arena, 2 * (count + 1) * sizeof *smear.cell);
    smear.peak = smear.cell + count + 1;
    for (size_t i = 0; i < count; i++)
        spread(&smear, &received_echoes[i]);
    for (size_t i = 0; i < count; i++) {
        size_t peak = peak_of(&smear, &received_echoes[i]), number = 0;
        while (number < smear.cells && smear.peak[number] != peak)
            number++;
        smear.cell[i] = number;
        if (number == smear.cells)
            smear.peak[smear.cells++] = peak;
    }
    return smear;
}

/* How many bins behind the peak its echo lies, along range or along rate; no farther than half way
 * to the next sample. */
static double offset_of(const struct smear *smear, const struct smear_sample *peak,
                        bool along_range)
{
    int64_t range = along_range ? BIN : 0, rate = along_range ? 0 : BIN;
    double least = -0.5 / BIN, most = 0.5 / BIN, here = magnitude(peak);
    if (!(here > 0))
        return 0;
    double before = magnitude(find(smear, peak->range - range, peak->rate - rate));
    double after = magnitude(find(smear, peak->range + range, peak->rate + rate));
    return elementary_max(elementary_min(point_response_hann_offset(before, here, after), most),
                          least);
}

/* Where there is one received echo alone, nothing merges. */
static uint64_t effects_of(const struct smear_sample *peak)
{
    uint64_t together = EFFECT_BIT(EFFECT_MERGING) | EFFECT_BIT(EFFECT_SUPERPOSITION);
    return peak->received_echoes > 1 ? peak->effects | together
                                     : peak->effects & ~EFFECT_BIT(EFFECT_COHERENCE);
}

static void add_members(const struct smear *smear, size_t number, struct arena *arena,
                        struct cell *cell)
{
    double total = 0;
    for (size_t i = 0; i < smear->count; i++)
        if (smear->cell[i] == number)
            total += smear->received_echoes[i].amplitude;
    for (size_t i = 0; i < smear->count; i++)
        if (smear->cell[i] == number) {
            struct contributor *member = list_add(&cell->members, arena);
            *member = smear->received_echoes[i].echo;
            member->weight = smear->received_echoes[i].amplitude / total;
        }
}

bool smear_cell(const struct smear *smear, size_t number, struct arena *arena, struct cell *cell)
{
    const struct sensor *sensor = smear->sensor;
    const struct smear_sample *peak = &smear->samples[smear->peak[number]];
    double range = offset_of(smear, peak, true), rate = offset_of(smear, peak, false);
    const struct received_echo *leader = smear->received_echoes;
    while (smear->cell[leader - smear->received_echoes] != number)
        leader++;
    double _Complex gain =
        conj(turn_of(leader->phase_rad)) / (point_response_hann(range) * point_response_hann(rate));
    struct antenna_pointers pointers = {gain * peak->pointers.sum, gain * peak->pointers.delta};
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, pointers);
    *cell = (struct cell){
        .sensor = sensor->name,
        .range_m = elementary_max(((double)peak->range / BIN + range) * sensor->cell_range_m, 0),
        .azimuth_rad = angle.azimuth_rad,
        .range_rate_mps = ((double)peak->rate / BIN + rate) * sensor->cell_range_rate_mps,
        .amplitude = elementary_hypot(creal(pointers.sum), cimag(pointers.sum)),
        .sum_re = creal(pointers.sum),
        .sum_im = cimag(pointers.sum),
        .delta_re = creal(pointers.delta),
        .delta_im = cimag(pointers.delta),
        .sign_undecided = angle.sign_undecided,
        .effects = effects_of(peak),
    };
    add_members(smear, number, arena, cell);
    return angle.valid;
}
