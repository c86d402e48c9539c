#include "sensor/cell_margins.h"

#include <complex.h>
#include <math.h>

#include "base/elementary.h"

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

static void note_pair(const struct sensor *sensor, const struct received_echo *leader,
                      const struct received_echo *other, struct margins *margins)
{
    double beyond = beyond_edge(sensor, leader, other);
    margins_note(margins, MARGIN_CELL_EDGE, fabs(beyond));
    if (beyond <= 1)
        margins_note(margins, MARGIN_LEADER,
                     margins_between_db(leader->amplitude, other->amplitude));
}

struct margins cell_margins_of(const struct sensor *sensor, const struct clustered_echoes *all,
                               size_t number)
{
    struct margins margins = {0};
    size_t opened = 0;
    for (size_t i = 0; i < all->count; i++) {
        size_t own = all->cell[i];
        if (own == number)
            margins_merge(&margins, all->echoes[i].margins);
        bool leads = own == opened;
        opened += leads;
        for (size_t j = i + 1; j < all->count && leads && own <= number; j++)
            if (all->cell[j] == number || (own == number && all->cell[j] > number))
                note_pair(sensor, &all->echoes[i], &all->echoes[j], &margins);
    }
    return margins;
}

void cell_margins_add(const struct sensor *sensor, struct cell *cell)
{
    margins_note(&cell->margins, MARGIN_THRESHOLD,
                 margins_between_db(cell->amplitude, suite_threshold(sensor, cell->interference)));
    margins_note_sign(&cell->margins, sensor->angle_estimator, frame_cell_pointers(cell));
}
