/* Lists of targets of the same scene, described in two ways: chains that run both, and where each
 * echo ends up in either, with its margins (MODEL 11.1). */
#pragma once

#include "hard.h"
#include "support/traffic_models.h"

#include "base/hash.h"
#include "base/sort.h"
#include "documents/suite_file.h"
#include "frame/frame_order.h"
#include "ideal/direct_echoes.h"
#include "ideal/ghost_echoes.h"
#include "ideal/roadside_echoes.h"
#include "run/runner.h"
#include "run/stage.h"
#include "soundness/adversarial_traffic.h"

enum { SENSORS = 4 };

static const struct selection everything = {.allowed = EFFECT_BIT(EFFECT_COUNT) - 1};

/* The largest relative step of one unit in the last place. */
#define ULP 0x1p-52

/* How far the last digits of the inputs may carry a decision, by the kind of its margin.
 * Coordinates are up to 620 m and lever arms 150 m, so places move by up to 2e-12 m (error_of).
 * From 1 m on that is an angle of 2e-12 rad; amplitudes follow it up to tenfold, and the range to
 * the exponent, both by less than 3e-11 or 3e-10 dB. Rates turn with it by speeds of up to 80 m/s,
 * and half a cell is 0.014 m/s: 2e-8 half cells. */
static const struct {
    enum margin kind;
    size_t offset;
    double bound;
} overrun[] = {
    {MARGIN_SIGHT, offsetof(struct margins, sight_m), 2e-12},
    {MARGIN_THRESHOLD, offsetof(struct margins, threshold_db), 3e-10},
    {MARGIN_LEADER, offsetof(struct margins, leader_db), 3e-10},
    {MARGIN_CELL_EDGE, offsetof(struct margins, cell_edge), 2e-8},
    {MARGIN_LIMIT_DB, offsetof(struct margins, limit_db), 3e-10},
};
enum { KINDS = sizeof overrun / sizeof *overrun };

/* Outcome of one echo: the cell or target that it is in, or 0 if it is lost. */
struct fate {
    uint64_t echo, outcome;
    size_t sensor;
    const struct margins *margins;
    const void *entry; /* the struct cell or struct target that this echo leads, or NULL */
};

struct fates {
    LIST_OF(struct fate) list;
};

/* One run of the chain. */
struct chain {
    struct runner extract, sensor, noise;
    struct arena arena;
    struct frame frame;
    struct fates cells, targets;
};

static inline void prepare(struct runner *runner, const char *stage)
{
    static const char *const words[] = {"--sections", "reflectors,echoes,cells"};
    assert_int_equal(runner_prepare(runner, stage_by_name(stage), 2, words), 0);
}

static inline void prepare_chain(struct chain *chain)
{
    prepare(&chain->extract, "extract");
    prepare(&chain->sensor, "sensor");
    prepare(&chain->noise, "noise");
    chain->frame.arena = &chain->arena;
}

static inline void free_chain(struct chain *chain)
{
    runner_free(&chain->extract);
    runner_free(&chain->sensor);
    runner_free(&chain->noise);
    arena_free(&chain->arena);
}

static inline const struct suite *load_suite(const char *name, struct arena *arena)
{
    struct diag diag = {0};
    const struct suite *suite = suite_file_load(name, arena, &diag);
    if (suite == NULL)
        fail_msg("%s", diag.text);
    assert_in_range(suite->sensors.count, 1, SENSORS);
    return suite;
}

/* Two runs of the chain on one scene. */
struct runs {
    struct arena documents;
    struct random_traffic scene;
    struct chain before, after;
};

/* The state of a group of tests: a struct of that size that begins with a struct runs. */
static inline int make_runs(size_t size, void **state)
{
    struct runs *runs = calloc(1, size);
    assert_non_null(runs);
    load_traffic_models(runs->scene.models, &runs->documents);
    prepare_chain(&runs->before);
    prepare_chain(&runs->after);
    *state = runs;
    return 0;
}

static inline int remove_runs(void **state)
{
    struct runs *runs = *state;
    free_chain(&runs->before);
    free_chain(&runs->after);
    arena_free(&runs->documents);
    free(runs);
    return 0;
}

/* A value's neighbour within the field's bounds, on either side; for zero an ulp of 1 on either
 * side, as a value that is zero by rounding may have. Sizes of zero stay: they stand for those of
 * the class. */
static inline double neighbour(const struct field *field, double value, uint64_t *coin)
{
    double side = sample_bits(coin) % 2 == 0 ? 1 : -1;
    if (value == 0)
        return field->low < 0 ? side * ULP : 0;
    double moved = nextafter(value, side * (double)INFINITY);
    bool outside = moved < field->low || moved > field->high;
    return outside ? nextafter(value, -side * (double)INFINITY) : moved;
}

static inline void move_all(const struct record *record, void *base, uint64_t *coin)
{
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        double value;
        if (field->kind != FIELD_REAL)
            continue;
        memcpy(&value, (char *)base + field->offset, sizeof value);
        if (value == field->absent && field->optional)
            continue;
        value = neighbour(field, value, coin);
        memcpy((char *)base + field->offset, &value, sizeof value);
    }
}

static inline void begin(struct chain *chain, int64_t number)
{
    frame_clear(&chain->frame);
    chain->frame.scene = "perturbation";
    chain->frame.frame = number;
    chain->frame.seed = 1;
    chain->frame.interval_s = 1;
    chain->frame.sections |= CARRY_ACCOUNT;
    chain->frame.present = PART_OBJECTS;
}

static inline void step(struct runner *runner, struct frame *frame)
{
    if (runner_step(runner, frame) != 0)
        fail_msg("%s: %s", runner->stage->name, runner->diag.text);
}

/* Looks at the scene as glint-ideal does for sensors that measure in every frame. */
static inline void see(struct frame *frame, const struct suite *suite, bool ghosts)
{
    frame->sensors.suite = suite->name;
    frame->sensors.digest = suite->digest;
    for (size_t i = 0; i < suite->sensors.count; i++) {
        const struct sensor *sensor = &suite->sensors.items[i];
        *list_add(&frame->sensors.list, frame->arena) =
            (struct sensor_view){.name = sensor->name, .measured = true};
        struct look look;
        double seen_s = frame->time_s - sensor->latency_s;
        assert_done(look_begin, &look, frame, sensor, &everything, seen_s);
        direct_echoes_add(&look);
        if (ghosts)
            ghost_echoes_add(&look);
        roadside_echoes_add(&look);
    }
    frame->present |= PART_SENSORS | PART_ECHOES | PART_LOST | PART_COUNTS;
    frame_order(frame);
}

static inline void use_suite(struct runner *runner, const struct suite *suite)
{
    runner->suites.count = 0;
    *list_add(&runner->suites, &runner->arena) = suite;
}

static inline void run_chain(struct chain *chain, const struct suite *suite)
{
    use_suite(&chain->sensor, suite);
    use_suite(&chain->noise, suite);
    step(&chain->extract, &chain->frame);
    see(&chain->frame, suite, false);
    step(&chain->sensor, &chain->frame);
    step(&chain->noise, &chain->frame);
}

static inline uint64_t hash_echo(uint64_t hash, const struct echo_id *id)
{
    uint64_t place = hash_text(hash_text(hash, id->object), id->reflector);
    return hash_bytes(hash_bytes(place, &id->path, sizeof id->path), &id->number,
                      sizeof id->number);
}

static inline void add_members(const struct suite *suite, const char *sensor,
                               const struct contributor *members, size_t count,
                               const struct margins *margins, const void *entry,
                               struct fates *fates, struct arena *arena)
{
    uint64_t begin = hash_text(HASH_START, sensor), outcome = begin;
    for (size_t i = 0; i < count; i++)
        outcome = hash_echo(outcome, &members[i].id);
    for (size_t i = 0; i < count; i++)
        *list_add(&fates->list, arena) = (struct fate){
            .echo = hash_echo(begin, &members[i].id),
            .outcome = outcome,
            .sensor = (size_t)(suite_sensor(suite, sensor) - suite->sensors.items),
            .margins = margins,
            .entry = i == 0 ? entry : NULL,
        };
}

static inline void add_lost(const struct suite *suite, const struct frame *frame, const char *but,
                            struct fates *fates)
{
    for (size_t i = 0; i < frame->lost.count; i++) {
        const struct lost_group *group = &frame->lost.items[i];
        uint64_t begin = hash_text(HASH_START, group->sensor);
        if (strcmp(group->stage, but) == 0)
            continue;
        for (size_t j = 0; j < group->echoes.count; j++) {
            const struct lost_echo *echo = &group->echoes.items[j];
            *list_add(&fates->list, frame->arena) = (struct fate){
                .echo = hash_echo(begin, &echo->id),
                .sensor = (size_t)(suite_sensor(suite, group->sensor) - suite->sensors.items),
                .margins = &echo->margins,
            };
        }
    }
}

static inline int compare_fates(const void *left, const void *right)
{
    const struct fate *a = left, *b = right;
    return (a->echo > b->echo) - (a->echo < b->echo);
}

static inline void collect(struct chain *chain, const struct suite *suite)
{
    const struct frame *frame = &chain->frame;
    chain->cells = chain->targets = (struct fates){0};
    for (size_t i = 0; i < frame->cells.count; i++) {
        const struct cell *cell = &frame->cells.items[i];
        add_members(suite, cell->sensor, cell->members.items, cell->members.count, &cell->margins,
                    cell, &chain->cells, frame->arena);
    }
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        add_members(suite, target->sensor, target->contributors.items, target->contributors.count,
                    &target->margins, target, &chain->targets, frame->arena);
    }
    add_lost(suite, frame, "noise", &chain->cells);
    add_lost(suite, frame, "", &chain->targets);
    sort_list(&chain->cells.list, compare_fates, frame->arena);
    sort_list(&chain->targets.list, compare_fates, frame->arena);
}

/* How much farther than by one unit in the last place a decision may be carried: a factor on the
 * bounds above, and one more on that of thresholds, which phases of paths carry farther. */
struct carry {
    double all, threshold;
};

/* The least margin of an entry, in units of what may be overrun. */
static inline double nearness(const struct margins *margins, struct carry carry)
{
    double least = (double)INFINITY;
    for (int i = 0; i < KINDS; i++) {
        double margin, bound = overrun[i].bound * carry.all;
        memcpy(&margin, (const char *)margins + overrun[i].offset, sizeof margin);
        if (overrun[i].kind == MARGIN_THRESHOLD)
            bound *= carry.threshold;
        if ((margins->present & overrun[i].kind) != 0)
            least = fmin(least, margin / bound);
    }
    return least;
}

/* What two runs made of one echo. NULL: the run has no such echo. */
struct fate_pair {
    const struct fate *before, *after;
};

/* Takes the next echo of either run, in the order of the echoes' numbers; false after the last. */
static inline bool next_pair(const struct fates *before, const struct fates *after, size_t at[2],
                             struct fate_pair *pair)
{
    const struct fate *a = at[0] < before->list.count ? &before->list.items[at[0]] : NULL;
    const struct fate *b = at[1] < after->list.count ? &after->list.items[at[1]] : NULL;
    if (a != NULL && b != NULL && a->echo != b->echo)
        *(a->echo < b->echo ? &b : &a) = NULL;
    at[0] += a != NULL;
    at[1] += b != NULL;
    *pair = (struct fate_pair){a, b};
    return a != NULL || b != NULL;
}

/* Did the echo come into another cell or target? An echo that one run lacks is lost there. */
static inline bool differs(struct fate_pair pair)
{
    uint64_t was = pair.before != NULL ? pair.before->outcome : 0;
    uint64_t is = pair.after != NULL ? pair.after->outcome : 0;
    return was != is;
}
