#include "noise/beam_cells.h"

#include "base/elementary.h"
#include "radar/beam_owner.h"
#include "radar/interferer.h"

struct beam_list {
    LIST_OF(struct cell) cells;
};

/* One cell on its way into beams. */
struct parting {
    const struct sensor *sensor;
    const struct cell *cell;
    struct array_maximum clean[ARRAY_MOST_ELEMENTS], noisy[ARRAY_MOST_ELEMENTS];
    size_t clean_count, count;
};

/* The part of a member's amplitude that a beam receives. */
static double part_of(const void *of, size_t member, size_t beam)
{
    const struct parting *parting = of;
    double azimuth_rad = parting->cell->members.items[member].azimuth_rad;
    return array_response(&parting->sensor->beams,
                          elementary_sin(azimuth_rad) - parting->noisy[beam].sine);
}

static double amplitude_of(const void *of, size_t member)
{
    const struct parting *parting = of;
    return parting->cell->members.items[member].weight;
}

/* Adds complex Gaussian noise to the samples, whose RMS in a beam is noise. */
static void add_noise(const struct array *array, const struct random_address *address, double noise,
                      struct phasor *samples)
{
    double sigma = sqrt(0.5) * noise / array->noise, draw[4];
    for (size_t n = 0; n < array->count; n++) {
        if (n % 2 == 0)
            random_gaussian(address, RANDOM_ELEMENTS, (uint32_t)(n / 2), draw);
        samples[n].re += sigma * draw[n % 2 * 2];
        samples[n].im += sigma * draw[n % 2 * 2 + 1];
    }
}

static void find_beams(const struct effect_scan *scan, struct parting *parting)
{
    const struct sensor *sensor = parting->sensor;
    const struct cell *cell = parting->cell;
    const struct array *array = &sensor->beams;
    struct phasor samples[ARRAY_MOST_ELEMENTS];
    double noise = sensor->pointer_sigma * interferer_noise_factor(cell->interference);
    double threshold = interferer_threshold(sensor->threshold, cell->interference);
    memcpy(samples, cell->elements.items, array->count * sizeof *samples);
    parting->clean_count = array_maxima(array, samples, parting->clean);
    if (scan != NULL && effect_simulates(scan, EFFECT_ANGLE_NOISE)) {
        struct random_address address =
            frame_draw_address_in(scan->address, cell->members.items[0].id);
        add_noise(array, &address, noise, samples);
    }
    parting->count = array_maxima(array, samples, parting->noisy);
    parting->count = array_keep(array, threshold, noise, parting->noisy, parting->count);
}

/* The echoes of a beam, each with its share of the beam's amplitude; returns the part of the whole
 * cell's that this is. The signal has other weights: there the echoes of a beam are a cell, and
 * share the amplitude as they do in cells (MODEL 11.3). */
static double add_members(const struct parting *parting, const struct beam_owner *owners,
                          size_t beam, struct arena *arena, struct cell *cell)
{
    size_t *shown = arena_get(arena, owners->echoes * sizeof *shown);
    size_t count = beam_owner_shown(owners, beam, 0, shown, &cell->repeats);
    double sum = 0;
    for (size_t i = 0; i < count; i++) {
        struct contributor *member = list_add(&cell->members, arena);
        *member = parting->cell->members.items[shown[i]];
        member->weight *= elementary_max(part_of(parting, shown[i], beam), 1e-300);
        sum += member->weight;
    }
    for (size_t i = 0; i < count; i++)
        cell->members.items[i].weight /= sum;
    return sum;
}

/* How far a value lies from that of the cell's leader; values an interval apart fold alike. */
static double away(double value, double leader, double interval)
{
    return interval > 0 ? remainder(value - leader, interval) : value - leader;
}

/* Moves range and range rate from the means over the old members to those over the new. */
static void add_means(const struct sensor *sensor, const struct contributor *leader,
                      const struct cell *of, double sign, struct cell *cell)
{
    for (size_t i = 0; i < of->members.count; i++) {
        const struct contributor *member = &of->members.items[i];
        cell->range_m += sign * member->weight *
                         away(member->range_m, leader->range_m, sensor->unambiguous_range_m);
        cell->range_rate_mps +=
            sign * member->weight *
            away(member->range_rate_mps, leader->range_rate_mps, 2 * sensor->unambiguous_rate_mps);
    }
}

/* The mean elevation of a cell's members by their powers. */
static double mean_elevation_rad(const struct cell *cell)
{
    double sum = 0, power = 0;
    for (size_t i = 0; i < cell->members.count; i++) {
        double weight = cell->members.items[i].weight;
        sum += weight * weight * cell->members.items[i].elevation_rad;
        power += weight * weight;
    }
    return sum / power;
}

static const struct array_maximum *nearest_clean(const struct parting *parting, size_t beam)
{
    const struct array_maximum *nearest = parting->clean;
    double sine = parting->noisy[beam].sine;
    for (size_t i = 1; i < parting->clean_count; i++)
        if (fabs(parting->clean[i].sine - sine) < fabs(nearest->sine - sine))
            nearest = &parting->clean[i];
    return nearest;
}

static struct cell cell_of(const struct parting *parting, const struct beam_owner *owners,
                           size_t beam, struct arena *arena)
{
    const struct cell *whole = parting->cell;
    const struct array_maximum *clean = nearest_clean(parting, beam);
    struct array_maximum *noisy = arena_get(arena, sizeof *noisy);
    struct cell cell = *whole;
    memset(&cell.elements, 0, sizeof cell.elements);
    memset(&cell.members, 0, sizeof cell.members);
    *noisy = parting->noisy[beam];
    cell.beam = noisy;
    cell.amplitude *= add_members(parting, owners, beam, arena, &cell);
    add_means(parting->sensor, &whole->members.items[0], whole, -1, &cell);
    add_means(parting->sensor, &whole->members.items[0], &cell, 1, &cell);
    if (parting->sensor->elevation_view_rad > 0)
        cell.elevation_rad += mean_elevation_rad(&cell) - mean_elevation_rad(whole);
    cell.range_m = elementary_max(cell.range_m, 0);
    cell.azimuth_rad = elementary_asin(clean->sine);
    cell.sum_re = clean->amplitude;
    return cell;
}

/* Parts one cell; adds its beams to the list. */
static void part(struct frame *frame, const char *stage, const struct parting *parting,
                 struct beam_list *beams)
{
    const struct cell *cell = parting->cell;
    const struct beam_owner owners = {
        .beams = parting->count,
        .echoes = cell->members.count,
        .part = part_of,
        .amplitude = amplitude_of,
        .of = parting,
        .owner = arena_get(frame->arena, cell->members.count * sizeof *owners.owner),
    };
    beam_owner_find(&owners);
    for (size_t beam = 0; beam < parting->count; beam++)
        *list_add(&beams->cells, frame->arena) = cell_of(parting, &owners, beam, frame->arena);
    for (size_t i = 0; i < cell->members.count; i++) {
        struct lost_echo lost = frame_lost_echo(&cell->members.items[i], &cell->margins);
        if (owners.owner[i] == BEAM_OWNER_NONE)
            frame_lose(frame, stage, parting->sensor->name, LOSS_MASKED, &lost);
    }
}

struct cell_span beam_cells_of(struct frame *frame, const char *stage, const struct sensor *sensor,
                               const struct effect_scan *scan, struct cell_span cells)
{
    struct beam_list beams = {{0}};
    if (sensor->beams.count == 0)
        return cells;
    for (size_t i = 0; i < cells.count; i++) {
        const struct cell *cell = &cells.items[i];
        struct parting parting = {.sensor = sensor, .cell = cell};
        if (cell->elements.count == sensor->beams.count)
            find_beams(scan, &parting);
        if (parting.count > 0 && parting.clean_count > 0)
            part(frame, stage, &parting, &beams);
        else
            *list_add(&beams.cells, frame->arena) = *cell;
    }
    return (struct cell_span){beams.cells.items, beams.cells.count};
}
