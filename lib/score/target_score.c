#include "score/target_score.h"

#include <assert.h>

#include "base/sort.h"
#include "base/units.h"
#include "score/gospa.h"

enum { COMPONENTS = SCORE_AMPLITUDE + 1 };

/* A target of either list. */
struct entry {
    const struct target *target;
    const struct target *partner;
    double strip;        /* number of its strip of ranges, each as wide as the cut-off */
    struct entry *group; /* an entry before it in the same group; itself: it is the first */
    LIST_OF(struct entry *) truths, listed; /* all of the group, in the first of it */
};

struct target_cell target_score_cell(const struct sensor_view *view, double azimuth_rad)
{
    if (azimuth_rad == 0)
        azimuth_rad =
            view->azimuth_cell_rad > 0 ? view->azimuth_cell_rad : view->field_of_view_rad / 20;
    return (struct target_cell){
        .range_m = view->cell_range_m,
        .azimuth_rad = azimuth_rad,
        .range_rate_mps = view->cell_range_rate_mps,
    };
}

bool target_score_has_cells(const struct sensor_view *view)
{
    struct target_cell cell = target_score_cell(view, 0);
    return cell.range_m > 0 && cell.range_rate_mps > 0 && cell.azimuth_rad > 0 &&
           view->field_of_view_rad > 0;
}

double target_score_distance(const struct target *a, const struct target *b,
                             const struct target_cell *cell)
{
    assert(cell->range_m > 0 && cell->azimuth_rad > 0 && cell->range_rate_mps > 0);
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
    const struct target *a = ((const struct entry *)left)->target;
    const struct target *b = ((const struct entry *)right)->target;
    if (a->range_m != b->range_m)
        return a->range_m < b->range_m ? -1 : 1;
    if (a->range_rate_mps != b->range_rate_mps)
        return a->range_rate_mps < b->range_rate_mps ? -1 : 1;
    if (a->azimuth_rad != b->azimuth_rad)
        return a->azimuth_rad < b->azimuth_rad ? -1 : 1;
    return (a->amplitude_db > b->amplitude_db) - (a->amplitude_db < b->amplitude_db);
}

/* Writes the targets of a sensor to entries, each a group by itself; returns how many. */
static size_t enter_targets(struct entry *entries, const struct frame *frame, const char *sensor,
                            const struct target_cell *cell, struct arena *arena)
{
    double strip_m = TARGET_SCORE_CUTOFF * cell->range_m * (1 + 1e-9);
    size_t count = 0;
    for (size_t i = 0; i < frame->targets.count; i++)
        if (strcmp(frame->targets.items[i].sensor, sensor) == 0)
            entries[count++].target = &frame->targets.items[i];
    sort_items(entries, count, sizeof *entries, compare, arena);
    for (size_t i = 0; i < count; i++) {
        entries[i].strip = floor(entries[i].target->range_m / strip_m);
        entries[i].group = &entries[i];
    }
    return count;
}

static double component(const struct target *target, int which)
{
    const double values[COMPONENTS] = {[SCORE_RANGE] = target->range_m,
                                       [SCORE_AZIMUTH] = target->azimuth_rad,
                                       [SCORE_RANGE_RATE] = target->range_rate_mps,
                                       [SCORE_AMPLITUDE] = target->amplitude_db};
    return values[which];
}

static void add_values(struct score_values *values, const struct target *target,
                       struct arena *arena)
{
    if (target == NULL)
        return;
    for (int which = 0; which < COMPONENTS; which++)
        *list_add(&values[which].list, arena) = component(target, which);
}

static void add_errors(struct score_values *values, const struct target_pair *pair,
                       struct arena *arena)
{
    for (int which = 0; which < COMPONENTS; which++) {
        double error = component(pair->listed, which) - component(pair->truth, which);
        if (which == SCORE_AZIMUTH)
            error = units_wrap_rad(error);
        *list_add(&values[which].list, arena) = error;
    }
}

static struct entry *first_of(struct entry *entry)
{
    while (entry->group != entry)
        entry = entry->group = entry->group->group;
    return entry;
}

static void join(struct entry *one, struct entry *other)
{
    one = first_of(one);
    other = first_of(other);
    if (one < other)
        other->group = one;
    else
        one->group = other;
}

static int compare_places(const void *left, const void *right)
{
    const struct entry *a = *(struct entry *const *)left, *b = *(struct entry *const *)right;
    double a_mps = a->target->range_rate_mps, b_mps = b->target->range_rate_mps;
    return a->strip != b->strip ? (a->strip > b->strip) - (a->strip < b->strip)
                                : (a_mps > b_mps) - (a_mps < b_mps);
}

static struct entry **by_place(struct entry *entries, size_t count, struct arena *arena)
{
    struct entry **sorted = arena_room(arena, count * sizeof(*sorted));
    for (size_t i = 0; i < count; i++)
        sorted[i] = &entries[i];
    sort_items(sorted, count, sizeof(*sorted), compare_places, arena);
    return sorted;
}

/* Joins the groups of each true and listed target nearer than the cut-off. Candidates are in the
 * same or a neighbouring strip and within the cut-off in range rate. */
static void join_near(struct entry *entries, size_t rows, size_t columns,
                      const struct target_cell *cell, struct arena *arena)
{
    struct entry **truths = by_place(entries, rows, arena);
    struct entry **listed = by_place(entries + rows, columns, arena);
    double reach_mps = TARGET_SCORE_CUTOFF * cell->range_rate_mps * (1 + 1e-9);
    for (int beside = -1; beside <= 1; beside++)
        for (size_t i = 0, low = 0; i < rows; i++) {
            double strip = truths[i]->strip + beside, rate_mps = truths[i]->target->range_rate_mps;
            while (low < columns && (listed[low]->strip < strip ||
                                     (listed[low]->strip == strip &&
                                      listed[low]->target->range_rate_mps < rate_mps - reach_mps)))
                low++;
            for (size_t j = low; j < columns && listed[j]->strip == strip &&
                                 listed[j]->target->range_rate_mps <= rate_mps + reach_mps;
                 j++)
                if (target_score_distance(truths[i]->target, listed[j]->target, cell) <
                    TARGET_SCORE_CUTOFF)
                    join(truths[i], listed[j]);
        }
}

static void pair_group(const struct entry *first, const struct target_cell *cell,
                       struct arena *arena)
{
    size_t rows = first->truths.count, columns = first->listed.count;
    double *distance = arena_room(arena, rows * columns * sizeof *distance);
    size_t *item_of = arena_room(arena, rows * sizeof *item_of);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++)
            distance[i * columns + j] = target_score_distance(first->truths.items[i]->target,
                                                              first->listed.items[j]->target, cell);
    gospa_pair(distance, rows, columns, TARGET_SCORE_CUTOFF, item_of, arena);
    for (size_t i = 0; i < rows; i++)
        if (item_of[i] < columns) { /* GOSPA_NONE is above all columns */
            first->truths.items[i]->partner = first->listed.items[item_of[i]]->target;
            first->listed.items[item_of[i]]->partner = first->truths.items[i]->target;
        }
}

/* Targets of two groups are farther apart than the cut-off and never pair, so groups are paired one
 * by one. */
struct target_pairs target_score_pairs(const char *sensor, const struct frame *truth,
                                       const struct frame *listed, const struct target_cell *cell,
                                       struct arena *arena)
{
    size_t most = truth->targets.count + listed->targets.count;
    struct entry *entries = arena_get(arena, most * sizeof *entries);
    size_t rows = enter_targets(entries, truth, sensor, cell, arena);
    size_t columns = enter_targets(entries + rows, listed, sensor, cell, arena);
    struct target_pairs pairs = {0};
    join_near(entries, rows, columns, cell, arena);
    for (size_t i = 0; i < rows + columns; i++) {
        struct entry *first = first_of(&entries[i]);
        *list_add(i < rows ? &first->truths : &first->listed, arena) = &entries[i];
    }
    for (size_t i = 0; i < rows; i++)
        if (entries[i].group == &entries[i])
            pair_group(&entries[i], cell, arena);
    for (size_t i = 0; i < rows; i++)
        *list_add(&pairs.list, arena) = (struct target_pair){entries[i].target, entries[i].partner};
    for (size_t i = rows; i < rows + columns; i++)
        if (entries[i].partner == NULL)
            list_add(&pairs.list, arena)->listed = entries[i].target;
    return pairs;
}

bool target_score_is_compared(const char *sensor, const struct frame *truth,
                              const struct frame *listed)
{
    return frame_view(truth, sensor)->measured && frame_view(listed, sensor)->measured;
}

void target_score_scan(struct score_tally *tally, const struct frame *truth,
                       const struct frame *listed, const struct target_cell *cell,
                       struct arena *arena)
{
    if (!target_score_is_compared(tally->sensor, truth, listed)) {
        tally->true_scans += frame_view(truth, tally->sensor)->measured;
        tally->listed_scans += frame_view(listed, tally->sensor)->measured;
        return;
    }
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
    score_add_scan(tally, squares, pairs, truths, items, TARGET_SCORE_CUTOFF);
}
