#include "score/target_score.h"

#include "base/sort.h"
#include "base/units.h"

enum { COMPONENTS = SCORE_AMPLITUDE + 1 };

struct target_list {
    LIST_OF(const struct target *) list;
};

struct target_cell target_score_cell(const struct sensor_view *view, double azimuth_rad,
                                     double cutoff)
{
    if (azimuth_rad == 0)
        azimuth_rad =
            view->azimuth_cell_rad > 0 ? view->azimuth_cell_rad : view->field_of_view_rad / 20;
    return (struct target_cell){
        .range_m = view->cell_range_m,
        .azimuth_rad = azimuth_rad,
        .range_rate_mps = view->cell_range_rate_mps,
        .cutoff = cutoff,
    };
}

bool target_score_has_cells(const struct sensor_view *view)
{
    return view->cell_range_m > 0 && view->cell_range_rate_mps > 0 && view->field_of_view_rad > 0;
}

double target_score_distance(const struct target *a, const struct target *b,
                             const struct target_cell *cell)
{
    double range = (a->range_m - b->range_m) / cell->range_m;
    double rate = (a->range_rate_mps - b->range_rate_mps) / cell->range_rate_mps;
    double azimuth = units_wrap_rad(a->azimuth_rad - b->azimuth_rad) / cell->azimuth_rad;
    return sqrt(range * range + rate * rate + azimuth * azimuth);
}

int target_score_check(const struct frame *truth, const struct frame *listed, struct diag *diag)
{
    size_t sensors = truth->sensors.list.count;
    if (listed->sensors.list.count != sensors)
        return diag_fail(diag, DIAG_DATA, "sensors.list: %zu sensors; the truth has %zu",
                         listed->sensors.list.count, sensors);
    for (size_t i = 0; i < sensors; i++) {
        const struct sensor_view *view = &truth->sensors.list.items[i];
        const char *name = listed->sensors.list.items[i].name;
        if (strcmp(view->name, name) != 0)
            return diag_fail(diag, DIAG_DATA,
                             "sensors.list[%zu].name: \"%s\"; the truth has \"%s\"", i, name,
                             view->name);
        if (!target_score_has_cells(view))
            return diag_fail(
                diag, DIAG_DATA,
                "sensors.list[%zu]: the truth's \"%s\" has cells of %g m by %g m/s in a field of "
                "view of %g rad; expected more than 0 of each",
                i, name, view->cell_range_m, view->cell_range_rate_mps, view->field_of_view_rad);
    }
    return 0;
}

/* Ties between pairs go by this order, not by that of the lists. */
static int compare(const void *left, const void *right)
{
    const struct target *a = *(const struct target *const *)left;
    const struct target *b = *(const struct target *const *)right;
    if (a->range_m != b->range_m)
        return a->range_m < b->range_m ? -1 : 1;
    if (a->range_rate_mps != b->range_rate_mps)
        return a->range_rate_mps < b->range_rate_mps ? -1 : 1;
    if (a->azimuth_rad != b->azimuth_rad)
        return a->azimuth_rad < b->azimuth_rad ? -1 : 1;
    return (a->amplitude_db > b->amplitude_db) - (a->amplitude_db < b->amplitude_db);
}

static struct target_list targets_of(const struct frame *frame, const char *sensor,
                                     struct arena *arena)
{
    struct target_list targets = {0};
    for (size_t i = 0; i < frame->targets.count; i++)
        if (strcmp(frame->targets.items[i].sensor, sensor) == 0)
            *list_add(&targets.list, arena) = &frame->targets.items[i];
    sort_list(&targets.list, compare, arena);
    return targets;
}

static double component(const struct target *target, int which)
{
    switch (which) {
    case SCORE_RANGE:
        return target->range_m;
    case SCORE_AZIMUTH:
        return target->azimuth_rad;
    case SCORE_RANGE_RATE:
        return target->range_rate_mps;
    default:
        return target->amplitude_db;
    }
}

static void add_values(struct score_values *values, const struct target *target,
                       struct arena *arena)
{
    for (int which = 0; which < COMPONENTS && target != NULL; which++)
        score_add_value(&values[which], component(target, which), arena);
}

static void add_errors(struct score_values *values, const struct target_pair *pair,
                       struct arena *arena)
{
    for (int which = 0; which < COMPONENTS; which++) {
        double error = component(pair->listed, which) - component(pair->truth, which);
        if (which == SCORE_AZIMUTH)
            error = units_wrap_rad(error);
        score_add_value(&values[which], error, arena);
    }
}

struct target_pairs target_score_pairs(const char *sensor, const struct frame *truth,
                                       const struct frame *listed, const struct target_cell *cell,
                                       struct arena *arena)
{
    struct target_list truths = targets_of(truth, sensor, arena);
    struct target_list list = targets_of(listed, sensor, arena);
    size_t rows = truths.list.count, columns = list.list.count;
    double *distance = arena_get(arena, rows * columns * sizeof *distance);
    size_t *item_of = arena_get(arena, rows * sizeof *item_of);
    bool *paired = arena_get(arena, columns * sizeof *paired);
    struct target_pairs pairs = {0};
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++)
            distance[i * columns + j] =
                target_score_distance(truths.list.items[i], list.list.items[j], cell);
    gospa_pair(distance, rows, columns, cell->cutoff, item_of, arena);
    for (size_t i = 0; i < rows; i++) {
        struct target_pair *pair = list_add(&pairs.list, arena);
        pair->truth = truths.list.items[i];
        if (item_of[i] >= columns) /* ASSIGNMENT_NONE is above all columns */
            continue;
        pair->listed = list.list.items[item_of[i]];
        paired[item_of[i]] = true;
    }
    for (size_t j = 0; j < columns; j++)
        if (!paired[j])
            list_add(&pairs.list, arena)->listed = list.list.items[j];
    return pairs;
}

void target_score_scan(struct score_tally *tally, const struct frame *truth,
                       const struct frame *listed, const struct target_cell *cell,
                       struct arena *arena)
{
    struct target_pairs found = target_score_pairs(tally->sensor, truth, listed, cell, arena);
    double squares = 0;
    size_t pairs = 0, truths = 0, items = 0;
    for (size_t i = 0; i < found.list.count; i++) {
        const struct target_pair *pair = &found.list.items[i];
        add_values(tally->values[SCORE_TRUTH], pair->truth, arena);
        add_values(tally->values[SCORE_LISTED], pair->listed, arena);
        truths += pair->truth != NULL;
        items += pair->listed != NULL;
        if (pair->truth == NULL || pair->listed == NULL)
            continue;
        double error = target_score_distance(pair->truth, pair->listed, cell);
        squares += error * error;
        pairs++;
        add_errors(tally->values[SCORE_ERROR], pair, arena);
    }
    score_add_scan(tally, squares, pairs, truths, items, cell->cutoff);
}
