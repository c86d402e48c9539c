#include "sensor/smear.h"

#include <complex.h>

#include "base/elementary.h"
#include "base/units.h"
#include "radar/point_response.h"

/* Samples in a bin, the widest response in units of that of an echo at rest, and the largest number
 * of samples that an echo reaches along one axis. */
enum {
    SAMPLES_PER_BIN = 2,
    MOST_WIDTH = 8,
    MOST_TAPS = 2 * SAMPLES_PER_BIN * (1 + 2 * MOST_WIDTH) + 1
};

/* The sample nearest to a value, and the value's distance beyond it in bins, in [-1/4, 1/4]. */
struct place {
    int64_t sample;
    double offset;
};

static struct place place_of(double value, double bin_width)
{
    double samples = SAMPLES_PER_BIN * (value / bin_width), whole = round(samples);
    return (struct place){(int64_t)whole, (samples - whole) / SAMPLES_PER_BIN};
}

static inline bool is_sample(const void *samples, uint32_t number, const void *wanted)
{
    const struct smear_sample *a = (const struct smear_sample *)samples + number, *b = wanted;
    return a->range == b->range && a->rate == b->rate;
}

static uint32_t *slot_of(const struct smear *smear, int64_t range, int64_t rate)
{
    const struct smear_sample wanted = {.range = range, .rate = rate};
    uint64_t hash = hash_table_mix(hash_table_mix(0, (uint64_t)range), (uint64_t)rate);
    return hash_table_slot(&smear->numbers, hash, is_sample, smear->samples, &wanted);
}

static const struct smear_sample *find(const struct smear *smear, int64_t range, int64_t rate)
{
    uint32_t number = *slot_of(smear, range, rate);
    return number != 0 ? &smear->samples[number - 1] : NULL;
}

static struct smear_sample *find_or_add(struct smear *smear, int64_t range, int64_t rate)
{
    uint32_t *slot = slot_of(smear, range, rate);
    if (*slot == 0) {
        smear->samples[smear->sample_count] = (struct smear_sample){.range = range, .rate = rate};
        *slot = (uint32_t)++smear->sample_count;
    }
    return &smear->samples[*slot - 1];
}

static double _Complex phasor_of(double phase_rad)
{
    struct elementary_sincos phase = elementary_sincos(phase_rad);
    return phase.cos + phase.sin * (double _Complex)I;
}

static double width_of(const struct received_echo *received)
{
    return elementary_min(1 + received->widening, MOST_WIDTH);
}

/* How many samples an echo reaches to either side of its own. */
static int reach_of(double width)
{
    return (int)ceil(SAMPLES_PER_BIN * (1 + 2 * width));
}

/* The samples that an echo reaches along one axis, and its response there. */
struct taps {
    int64_t first;
    int count;
    double weight[MOST_TAPS];
};

static void set_taps(struct taps *taps, struct place place, double width)
{
    int reach = reach_of(width);
    taps->first = place.sample - reach;
    taps->count = 2 * reach + 1;
    for (int i = 0; i < taps->count; i++)
        taps->weight[i] =
            point_response_hann(((double)(i - reach) / SAMPLES_PER_BIN - place.offset) / width);
}

static void add_echo(struct smear *smear, const struct received_echo *received)
{
    const struct sensor *sensor = smear->sensor;
    struct taps range, rate;
    set_taps(&range, place_of(received->range_m, sensor->cell_range_m), width_of(received));
    set_taps(&rate, place_of(received->range_rate_mps, sensor->cell_range_rate_mps),
             width_of(received));
    struct antenna_pointers pointers =
        antenna_pointers(&sensor->antenna, received->echo.azimuth_rad);
    double _Complex strength = received->strength * phasor_of(received->phase_rad);
    bool out_of_phase = received->phase_rad != smear->echoes[0].phase_rad;
    uint64_t effects = received->effects | (out_of_phase ? EFFECT_BIT(EFFECT_COHERENCE) : 0);
    pointers.sum *= strength;
    pointers.delta *= strength;
    for (int i = 0; i < range.count; i++)
        for (int j = 0; j < rate.count; j++) {
            double weight = range.weight[i] * rate.weight[j];
            if (weight == 0)
                continue;
            struct smear_sample *sample = find_or_add(smear, range.first + i, rate.first + j);
            sample->pointers.sum += weight * pointers.sum;
            sample->pointers.delta += weight * pointers.delta;
            sample->echoes++;
            sample->effects |= effects;
        }
}

/* Amplitude of the sum channel; 0 where no echo reaches. */
static double magnitude(const struct smear_sample *sample)
{
    return sample != NULL
               ? elementary_hypot(creal(sample->pointers.sum), cimag(sample->pointers.sum))
               : 0;
}

/* The strongest of a sample and its neighbours; of equal ones the first by range, then by rate. */
static const struct smear_sample *strongest_around(const struct smear *smear,
                                                   const struct smear_sample *from)
{
    const struct smear_sample *best = from;
    double strongest = -1;
    for (int64_t range = from->range - 1; range <= from->range + 1; range++)
        for (int64_t rate = from->rate - 1; rate <= from->rate + 1; rate++) {
            const struct smear_sample *sample = find(smear, range, rate);
            double here = magnitude(sample);
            if (sample != NULL && here > strongest) {
                best = sample;
                strongest = here;
            }
        }
    return best;
}

static size_t peak_of(const struct smear *smear, const struct received_echo *received)
{
    const struct smear_sample *at =
        find(smear, place_of(received->range_m, smear->sensor->cell_range_m).sample,
             place_of(received->range_rate_mps, smear->sensor->cell_range_rate_mps).sample);
    for (const struct smear_sample *next = strongest_around(smear, at); next != at;
         next = strongest_around(smear, at))
        at = next;
    return (size_t)(at - smear->samples);
}

/* The number of samples if no two echoes reach the same sample. */
static size_t most_samples(const struct received_echo *echoes, size_t count)
{
    size_t most = 0;
    for (size_t i = 0; i < count; i++) {
        size_t taps = 2 * (size_t)reach_of(width_of(&echoes[i])) + 1;
        most += taps * taps;
    }
    return most;
}

struct smear smear_make(const struct sensor *sensor, const struct received_echo *echoes,
                        size_t count, struct arena *arena)
{
    struct smear smear = {.sensor = sensor, .echoes = echoes, .count = count};
    size_t most = most_samples(echoes, count);
    smear.samples = arena_room(arena, most * sizeof *smear.samples);
    smear.numbers = hash_table_begin(most, arena);
    smear.cell = arena_get(arena, 2 * (count + 1) * sizeof *smear.cell);
    smear.peak = smear.cell + count + 1;
    for (size_t i = 0; i < count; i++)
        add_echo(&smear, &echoes[i]);
    for (size_t i = 0; i < count; i++) {
        size_t peak = peak_of(&smear, &echoes[i]), number = 0;
        while (number < smear.cells && smear.peak[number] != peak)
            number++;
        smear.cell[i] = number;
        if (number == smear.cells)
            smear.peak[smear.cells++] = peak;
    }
    return smear;
}

/* Distance in bins of the interpolated peak beyond its sample, along range or along rate; at most
 * half way to the next sample. width is that of the peak's response. */
static double offset_of(const struct smear *smear, const struct smear_sample *peak, double width,
                        bool along_range)
{
    int64_t range = along_range ? SAMPLES_PER_BIN : 0, rate = along_range ? 0 : SAMPLES_PER_BIN;
    double least = -0.5 / SAMPLES_PER_BIN, most = 0.5 / SAMPLES_PER_BIN;
    double here = magnitude(peak);
    if (!(here > 0))
        return 0;
    double before = magnitude(find(smear, peak->range - range, peak->rate - rate));
    double after = magnitude(find(smear, peak->range + range, peak->rate + rate));
    double offset = width > 1 ? point_response_vertex(before, here, after)
                              : point_response_hann_offset(before, here, after);
    return elementary_max(elementary_min(offset, most), least);
}

/* The effects at a peak. A single echo is not merged and has no phase relative to others. */
static uint64_t effects_of(const struct smear_sample *peak)
{
    uint64_t merged = EFFECT_BIT(EFFECT_MERGING) | EFFECT_BIT(EFFECT_SUPERPOSITION);
    return peak->echoes > 1 ? peak->effects | merged
                            : peak->effects & ~EFFECT_BIT(EFFECT_COHERENCE);
}

/* The echoes of a cell, the strongest first; sets count. */
static struct received_echo *members_of(const struct smear *smear, size_t number, size_t *count,
                                        struct arena *arena)
{
    struct received_echo *members = arena_get(arena, smear->count * sizeof *members);
    *count = 0;
    for (size_t i = 0; i < smear->count; i++)
        if (smear->cell[i] == number)
            members[(*count)++] = smear->echoes[i];
    return members;
}

/* Reads the beams of an array from the cell's echoes, each with the amplitude that its response has
 * at the place of the cell. Every other side lobe of a response has the opposite phase. */
static bool see(const struct smear *smear, size_t number, struct arena *arena, struct cell *cell)
{
    const struct sensor *sensor = smear->sensor;
    size_t count;
    struct received_echo *members = members_of(smear, number, &count, arena);
    for (size_t i = 0; i < count; i++) {
        struct received_echo *member = &members[i];
        double width = width_of(member);
        double range = (member->range_m - cell->range_m) / sensor->cell_range_m / width;
        double rate =
            (member->range_rate_mps - cell->range_rate_mps) / sensor->cell_range_rate_mps / width;
        double response = point_response_hann(range) * point_response_hann(rate);
        member->amplitude *= fabs(response);
        if (response < 0)
            member->phase_rad += PI;
    }
    bool seen = resolution_cell_see(sensor, members, count, arena, cell);
    cell->amplitude = cell->sum_re;
    return seen;
}

static void add_members(const struct smear *smear, size_t number, struct arena *arena,
                        struct cell *cell)
{
    double total = 0;
    for (size_t i = 0; i < smear->count; i++)
        if (smear->cell[i] == number)
            total += smear->echoes[i].amplitude;
    for (size_t i = 0; i < smear->count; i++)
        if (smear->cell[i] == number) {
            struct contributor *member = list_add(&cell->members, arena);
            *member = smear->echoes[i].echo;
            member->weight = smear->echoes[i].amplitude / total;
        }
}

static void set_elevation(const struct smear *smear, size_t number, struct arena *arena,
                          struct cell *cell)
{
    size_t count;
    const struct received_echo *members = members_of(smear, number, &count, arena);
    resolution_cell_set_elevation(smear->sensor, members, count, arena, cell);
}

bool smear_cell(const struct smear *smear, size_t number, struct arena *arena, struct cell *cell)
{
    const struct sensor *sensor = smear->sensor;
    const struct smear_sample *peak = &smear->samples[smear->peak[number]];
    const struct received_echo *leader = smear->echoes;
    while (smear->cell[leader - smear->echoes] != number)
        leader++;
    double width = width_of(leader);
    double range = offset_of(smear, peak, width, true);
    double rate = offset_of(smear, peak, width, false);
    double _Complex gain = conj(phasor_of(leader->phase_rad)) /
                           (point_response_hann(range / width) * point_response_hann(rate / width));
    struct antenna_pointers pointers = {gain * peak->pointers.sum, gain * peak->pointers.delta};
    *cell = (struct cell){
        .sensor = sensor->name,
        .range_m = elementary_max(
            ((double)peak->range / SAMPLES_PER_BIN + range) * sensor->cell_range_m, 0),
        .range_rate_mps =
            ((double)peak->rate / SAMPLES_PER_BIN + rate) * sensor->cell_range_rate_mps,
        .amplitude = elementary_hypot(creal(pointers.sum), cimag(pointers.sum)),
        .effects = effects_of(peak),
    };
    add_members(smear, number, arena, cell);
    if (sensor->elevation_view_rad > 0)
        set_elevation(smear, number, arena, cell);
    return sensor->beams.count > 0 ? see(smear, number, arena, cell)
                                   : resolution_cell_measure(sensor, pointers, cell);
}
