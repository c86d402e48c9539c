#include "sensor/cell_margins.h"

#include <complex.h>

#include "base/elementary.h"
#include "radar/interferer.h"
#include "radar/resolution.h"

/* By how many half cells the other echo is beyond the edge of the leader's cell; negative inside.
 */
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
    bool *leads;             /* of each echo */
    struct margins *margins; /* of each cell */
};

/* Notes a pair in the cells of both. The echo must have been left when the leader opened its cell.
 */
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

/* May an echo this far away in the row change the margins of a cell? Within two half cells it may
 * compete for the lead, and farther only be nearer than all others so far. */
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

static struct resolution_row row_of(const struct sensor *sensor, const struct clustered_echoes *all,
                                    struct arena *arena)
{
    struct resolution_echo *places = arena_room(arena, all->count * sizeof *places);
    for (size_t i = 0; i < all->count; i++)
        places[i] = resolution_cell_place(&all->echoes[i]);
    return resolution_row_of(places, all->count, sensor->half_range_m, sensor->half_range_rate_mps,
                             arena);
}

struct margins *cell_margins_of(const struct sensor *sensor, const struct clustered_echoes *all,
                                size_t cells, struct arena *arena)
{
    struct neighbourhood near = {
        .sensor = sensor,
        .all = all,
        .row = row_of(sensor, all, arena),
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
        if (near.leads[i])
            note_neighbours(&near, i);
    return near.margins;
}

void cell_margins_add(const struct sensor *sensor, struct cell *cell)
{
    margins_note(&cell->margins, MARGIN_THRESHOLD,
                 margins_between_db(cell->amplitude,
                                    interferer_threshold(sensor->threshold, cell->interference)));
    margins_note_sign(&cell->margins, sensor->angle_estimator, frame_cell_pointers(cell));
}
