#include "sensor/resolution_cell.h"

#include <complex.h>

#include "base/elementary.h"
#include "base/units.h"
#include "frame/frame_order.h"
#include "radar/interferer.h"

int resolution_cell_compare(const void *left, const void *right)
{
    const struct received_echo *a = left, *b = right;
    if (a->amplitude != b->amplitude)
        return a->amplitude > b->amplitude ? -1 : 1;
    return frame_order_tied(&a->echo, &b->echo);
}

struct resolution_echo resolution_cell_place(const struct received_echo *echo)
{
    return (struct resolution_echo){echo->range_m, echo->range_rate_mps, echo->amplitude,
                                    echo->widening, echo->phase_rad};
}

/* A compensated sum (Neumaier 1974; MODEL 17.3): a weak echo survives beside strong echoes that
 * cancel. left_out is the sum of the rounding errors. */
struct compensated {
    double sum, left_out;
};

static void add(struct compensated *total, double term)
{
    double sum = total->sum + term;
    total->left_out +=
        fabs(total->sum) >= fabs(term) ? total->sum - sum + term : term - sum + total->sum;
    total->sum = sum;
}

/* A sum that overflows stays infinite, so that the check of bounds refuses it. */
static double value_of(const struct compensated *terms)
{
    return isfinite(terms->sum) ? terms->sum + terms->left_out : terms->sum;
}

struct channel {
    struct compensated real, imag;
};

static void add_pointer(struct channel *channel, double _Complex pointer)
{
    add(&channel->real, creal(pointer));
    add(&channel->imag, cimag(pointer));
}

static double _Complex pointer_of(const struct channel *channel)
{
    return value_of(&channel->real) + value_of(&channel->imag) * (double _Complex)I;
}

static struct antenna_pointers add_pointers(const struct sensor *sensor,
                                            const struct received_echo *echoes, size_t count)
{
    struct channel sum = {{0, 0}, {0, 0}}, delta = sum;
    for (size_t i = 0; i < count; i++) {
        struct antenna_pointers unit =
            antenna_pointers(&sensor->antenna, echoes[i].echo.azimuth_rad);
        struct elementary_sincos phase =
            elementary_sincos(echoes[i].phase_rad - echoes[0].phase_rad);
        double _Complex phasor = phase.cos + phase.sin * (double _Complex)I;
        bool out_of_phase = echoes[i].phase_rad != echoes[0].phase_rad;
        add_pointer(&sum, echoes[i].strength * (out_of_phase ? phasor * unit.sum : unit.sum));
        add_pointer(&delta, echoes[i].strength * (out_of_phase ? phasor * unit.delta : unit.delta));
    }
    return (struct antenna_pointers){pointer_of(&sum), pointer_of(&delta)};
}

/* One echo of the summed strength at the mean azimuth. */
static struct received_echo merge(const struct received_echo *echoes, size_t count,
                                  const double *weight, double *azimuth)
{
    struct received_echo merged = echoes[0];
    for (size_t i = 0; i < count; i++)
        azimuth[i] = echoes[i].echo.azimuth_rad;
    for (size_t i = 1; i < count; i++) {
        merged.strength += echoes[i].strength;
        merged.amplitude += echoes[i].amplitude;
    }
    merged.echo.azimuth_rad = resolution_mean(azimuth, weight, count);
    return merged;
}

static uint64_t effects_of(const struct received_echo *echoes, size_t count, bool superpose)
{
    uint64_t effects = count > 1 ? EFFECT_BIT(EFFECT_MERGING) : 0;
    if (count > 1 && superpose)
        effects |= EFFECT_BIT(EFFECT_SUPERPOSITION);
    for (size_t i = 0; i < count; i++) {
        effects |= echoes[i].effects;
        if (superpose && echoes[i].phase_rad != echoes[0].phase_rad)
            effects |= EFFECT_BIT(EFFECT_COHERENCE);
    }
    return effects;
}

bool resolution_cell_measure(const struct sensor *sensor, struct antenna_pointers pointers,
                             struct cell *cell)
{
    struct monopulse_angle angle =
        monopulse_angle(&sensor->antenna, sensor->angle_estimator, pointers);
    cell->sum_re = creal(pointers.sum);
    cell->sum_im = cimag(pointers.sum);
    cell->delta_re = creal(pointers.delta);
    cell->delta_im = cimag(pointers.delta);
    cell->azimuth_rad = angle.azimuth_rad;
    cell->sign_undecided = angle.sign_undecided;
    return angle.valid;
}

/* Sees several echoes at the largest maximum of the array's beams. */
static void see_together(const struct array *array, const struct received_echo *echoes,
                         size_t count, struct arena *arena, struct cell *cell)
{
    struct phasor samples[ARRAY_MOST_ELEMENTS] = {{0, 0}};
    struct array_maximum maxima[ARRAY_MOST_ELEMENTS];
    for (size_t i = 0; i < count; i++) {
        struct elementary_sincos phase =
            elementary_sincos(echoes[i].phase_rad - echoes[0].phase_rad);
        struct phasor echo = {echoes[i].amplitude * phase.cos, echoes[i].amplitude * phase.sin};
        array_receive(array, elementary_sin(echoes[i].echo.azimuth_rad), echo, samples);
    }
    for (size_t n = 0; n < array->count; n++)
        *list_add(&cell->elements, arena) = samples[n];
    if (array_maxima(array, samples, maxima) == 0)
        return;
    cell->azimuth_rad = elementary_asin(maxima[0].sine);
    cell->sum_re = maxima[0].amplitude;
}

bool resolution_cell_see(const struct sensor *sensor, const struct received_echo *echoes,
                         size_t count, struct arena *arena, struct cell *cell)
{
    cell->azimuth_rad = echoes[0].echo.azimuth_rad;
    cell->sum_re = echoes[0].amplitude;
    if (count > 1)
        see_together(&sensor->beams, echoes, count, arena, cell);
    return cell->sum_re > 0;
}

void resolution_cell_set_elevation(const struct sensor *sensor, const struct received_echo *echoes,
                                   size_t count, struct arena *arena, struct cell *cell)
{
    if (sensor->elevation_view_rad == 0)
        return;
    double *elevation = arena_get(arena, 2 * count * sizeof *elevation);
    double *power = elevation + count;
    for (size_t i = 0; i < count; i++) {
        double part = echoes[i].amplitude / echoes[0].amplitude;
        elevation[i] = echoes[i].elevation_rad;
        power[i] = part * part;
    }
    cell->elevation_rad = resolution_mean(elevation, power, count);
    cell->present |= VALUE_ELEVATION;
}

bool resolution_cell_of(const struct sensor *sensor, const struct received_echo *echoes,
                        size_t count, bool superpose, struct arena *arena, struct cell *cell)
{
    double *range = arena_room(arena, 4 * count * sizeof *range);
    double *rate = range + count;
    double *weight = rate + count;
    double *azimuth = weight + count;
    *cell = (struct cell){
        .sensor = sensor->name,
        .effects = effects_of(echoes, count, superpose),
    };
    for (size_t i = 0; i < count; i++) {
        range[i] = echoes[i].range_m;
        rate[i] = echoes[i].range_rate_mps;
        weight[i] = echoes[i].amplitude;
        cell->amplitude += echoes[i].amplitude;
    }
    cell->members.items = arena_room(arena, count * sizeof *cell->members.items);
    cell->members.count = cell->members.room = count;
    for (size_t i = 0; i < count; i++) {
        struct contributor *member = &cell->members.items[i];
        *member = echoes[i].echo;
        member->weight = echoes[i].amplitude / cell->amplitude;
    }
    resolution_cell_set_elevation(sensor, echoes, count, arena, cell);
    cell->range_m = resolution_mean(range, weight, count);
    cell->range_rate_mps = resolution_mean(rate, weight, count);
    struct received_echo merged =
        superpose || count == 1 ? echoes[0] : merge(echoes, count, weight, azimuth);
    const struct received_echo *added = superpose ? echoes : &merged;
    size_t added_count = superpose ? count : 1;
    if (sensor->beams.count > 0)
        return resolution_cell_see(sensor, added, added_count, arena, cell);
    return resolution_cell_measure(sensor, add_pointers(sensor, added, added_count), cell);
}

void resolution_cell_list(struct frame *frame, const char *stage, const struct effect_scan *scan,
                          const struct selection *selection, struct cell *cell, bool has_angle)
{
    double threshold = interferer_threshold(scan->sensor->threshold, scan->interference);
    double least = interferer_threshold(scan->sensor->lowered_threshold, scan->interference);
    cell->interference = scan->interference;
    if (cell->interference > 0)
        cell->effects |= EFFECT_BIT(EFFECT_INTERFERENCE);
    if (frame_carries(frame, CARRY_MARGINS))
        resolution_cell_note_margins(scan->sensor, cell);
    bool tested = effects_enabled(selection, EFFECT_THRESHOLD);
    cell->below_threshold = tested && cell->amplitude < threshold;
    if (tested && cell->amplitude < least)
        frame_lose_cell(frame, stage, cell, LOSS_BELOW_THRESHOLD,
                        units_shortfall_db(threshold, cell->amplitude), &cell->margins);
    else if (!has_angle)
        frame_lose_cell(frame, stage, cell, LOSS_NO_ANGLE, 0, &cell->margins);
    else
        *list_add(&frame->cells, frame->arena) = *cell;
}

/* Distance of the other echo from the edge of the leader's cell, in half cells; negative inside. */
static double beyond_edge(const struct sensor *sensor, const struct received_echo *leader,
                          const struct received_echo *other)
{
    double range_m = fabs(other->range_m - leader->range_m);
    double rate_mps = fabs(other->range_rate_mps - leader->range_rate_mps);
    double size = 1 + elementary_max(leader->widening, other->widening);
    double half_range_m = size * sensor->half_range_m;
    double half_rate_mps = size * sensor->half_range_rate_mps;
    return elementary_max((range_m - half_range_m) / half_range_m,
                          (rate_mps - half_rate_mps) / half_rate_mps);
}

struct neighbourhood {
    const struct sensor *sensor;
    const struct clustered_echoes *all;
    struct resolution_row row;
    bool *leads;             /* for each echo: it opened a cell */
    struct margins *margins; /* of each cell */
};

/* Notes a pair in the cells of both, if the other echo had none when the leader opened its own. */
static void note_pair(const struct neighbourhood *near, size_t leader, size_t other)
{
    const struct clustered_echoes *all = near->all;
    if (!near->leads[leader] || other <= leader || all->cell[other] < all->cell[leader])
        return;
    const struct received_echo *a = &all->echoes[leader], *b = &all->echoes[other];
    double beyond = beyond_edge(near->sensor, a, b);
    double stronger_db = beyond <= 1 ? margins_between_db(a->amplitude, b->amplitude) : 0;
    size_t cells[] = {all->cell[leader], all->cell[other]};
    for (size_t i = 0; i < 2; i++) {
        margins_note(&near->margins[cells[i]], MARGIN_CELL_EDGE, fabs(beyond));
        if (beyond <= 1)
            margins_note(&near->margins[cells[i]], MARGIN_LEADER, stronger_db);
    }
}

/* True if an echo this far away in the row may change the margins of a cell: within two half cells
 * it may compete for the lead; beyond, it must be nearer than all others so far. */
static bool may_matter(const struct neighbourhood *near, size_t cell, double gap)
{
    const struct margins *margins = &near->margins[cell];
    bool alone = (margins->present & MARGIN_CELL_EDGE) == 0;
    double beyond = elementary_max(margins->cell_edge, 1) * (1 + 1e-9);
    return alone || gap <= (1 + beyond) * near->row.reach;
}

/* Notes the pairs of a leader and its neighbours in the row, nearest first to either side. */
static void note_neighbours(const struct neighbourhood *near, size_t leader)
{
    const struct resolution_row *row = &near->row;
    size_t own = near->all->cell[leader], at = row->rank[leader];
    double place = row->items[at].place;
    for (size_t i = at + 1; i < row->count && may_matter(near, own, row->items[i].place - place);
         i++) {
        note_pair(near, leader, row->items[i].echo);
        note_pair(near, row->items[i].echo, leader);
    }
    for (size_t i = at; i > 0 && may_matter(near, own, place - row->items[i - 1].place); i--) {
        note_pair(near, leader, row->items[i - 1].echo);
        note_pair(near, row->items[i - 1].echo, leader);
    }
}

static struct resolution_row row_of(const struct clustered_echoes *all, struct arena *arena)
{
    struct resolution_echo *places = arena_room(arena, all->count * sizeof *places);
    for (size_t i = 0; i < all->count; i++)
        places[i] = resolution_cell_place(&all->echoes[i]);
    return resolution_row_of(places, all->count, &all->resolution, arena);
}

struct margins *resolution_cell_margins(const struct sensor *sensor,
                                        const struct clustered_echoes *all, size_t cells,
                                        struct arena *arena)
{
    struct neighbourhood near = {
        .sensor = sensor,
        .all = all,
        .row = row_of(all, arena),
        .leads = arena_get(arena, all->count * sizeof *near.leads),
        .margins = arena_get(arena, cells * sizeof *near.margins),
    };
    size_t opened = 0;
    for (size_t i = 0; i < all->count; i++) {
        margins_merge(&near.margins[all->cell[i]], all->echoes[i].margins);
        near.leads[i] = all->cell[i] == opened;
        opened += near.leads[i];
    }
    for (size_t i = 0; i < all->count; i++)
        if (near.leads[i] && !all->resolution.coherent)
            note_neighbours(&near, i);
    return near.margins;
}

void resolution_cell_note_margins(const struct sensor *sensor, struct cell *cell)
{
    double least = interferer_threshold(sensor->lowered_threshold, cell->interference);
    if (least > 0)
        margins_note(&cell->margins, MARGIN_THRESHOLD, margins_between_db(cell->amplitude, least));
    margins_note_sign(&cell->margins, sensor->angle_estimator, frame_cell_pointers(cell));
}
