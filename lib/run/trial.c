#include "run/trial.h"

#include <time.h>

#include "base/sort.h"
#include "documents/vehicle_set.h"
#include "effects/effect.h"
#include "frame/frame_order.h"
#include "frame/frame_text.h"
#include "run/extraction.h"
#include "run/frame_stream.h"
#include "run/tool.h"
#include "run/trial_options.h"

/* CPU time of this thread, in nanoseconds. */
static int64_t cpu_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* The names of the effects behind a first word, with these letters before each name. */
static const char *list_names(const char *first, const char *before, uint64_t effects,
                              struct arena *arena)
{
    for (int i = 0; i < EFFECT_COUNT; i++)
        if ((effects & EFFECT_BIT(i)) != 0)
            first = arena_format(arena, "%s%s%s", first, *first != '\0' ? before : "",
                                 effects_names[i]);
    return first;
}

const char *trial_request(uint64_t allowed, struct arena *arena)
{
    bool none = (allowed & (EFFECT_BIT(EFFECT_COUNT) - 1)) == 0;
    return none ? "none" : list_names("auto", ",-", ~allowed, arena);
}

const char *trial_names(uint64_t effects, struct arena *arena)
{
    return list_names("", ",", effects, arena);
}

/* The trial's stage at a position; NULL: it has none. */
static struct runner *stage_at(const struct trial_bench *bench, const struct trial *trial, int at,
                               struct effect_log *log)
{
    const struct suite_choice choice = {bench->suite->given, trial->effects};
    const char *program = at == TRIAL_IDEAL ? "glint-ideal" : trial->programs[at - 1];
    if (program == NULL)
        return NULL;
    return runner_trial(bench->runner, stage_by_name(stage_name_in_path(program)),
                        at == TRIAL_IDEAL ? &choice : NULL, sizeof choice, log);
}

void trial_prepare(struct trial_bench *bench, struct trial *trial)
{
    for (int at = (int)trial->first; at < TRIAL_POSITIONS; at++)
        trial->stages[at] = stage_at(bench, trial, at, NULL);
}

/* A trial of the whole chain's stages from the one on where the effect is at home. Stages after
 * ideal take the effects from the frame. */
static void prepare_without(struct trial_bench *bench, enum effect_id effect)
{
    struct trial *trial = &bench->without[effect];
    *trial = bench->whole[effect_table[effect]->home];
    trial->effect = effect;
    trial->effects =
        trial_request(bench->allowed & ~EFFECT_BIT(effect), runner_arena(bench->runner));
    if (trial->first == TRIAL_IDEAL)
        trial->stages[TRIAL_IDEAL] = stage_at(bench, trial, TRIAL_IDEAL, NULL);
}

static void prepare_all(struct trial_bench *bench, const char *effects)
{
    const struct extraction extraction = {.vehicles = bench->vehicles};
    bench->extract =
        runner_trial(bench->runner, stage_by_name("extract"), &extraction, sizeof extraction, NULL);
    for (int at = 0; at < TRIAL_POSITIONS; at++) {
        struct trial *whole = &bench->whole[at];
        *whole = (struct trial){.effects = effects,
                                .effect = EFFECT_NONE,
                                .programs = {"glint-sensor", "glint-noise"},
                                .first = (enum trial_position)at};
        trial_prepare(bench, whole);
        bench->logged[at] = stage_at(bench, whole, at, &bench->log[at]);
    }
    for (enum effect_id i = 0; i < EFFECT_COUNT; i++)
        if ((bench->allowed & EFFECT_BIT(i)) != 0)
            prepare_without(bench, i);
}

/* Refuses a set that is not there, whether it is asked for or the suite's. */
static int choose_vehicles(struct trial_bench *bench, const char *asked, const struct suite *suite)
{
    const char *folder, *named_by = "--vehicles";
    struct arena *arena = runner_arena(bench->runner);
    bench->vehicles = asked;
    bench->asks_vehicles = asked != NULL;
    if (asked == NULL) {
        bench->vehicles = suite->vehicles;
        named_by = arena_format(arena, "%s: vehicles", suite->given);
    }
    return vehicle_set_folder(named_by, bench->vehicles, &folder, arena,
                              runner_diag(bench->runner));
}

int trial_begin(struct trial_bench *bench, const struct trial_options *options,
                struct runner *runner)
{
    const struct suite_choice *choice = &options->choice;
    struct sensors request;
    struct selection selection;
    struct diag *diag = runner_diag(runner);
    const struct suite *suite = suite_choice_load(runner, choice->sensors);
    if (suite == NULL || suite_choice_request(choice, suite, &request, diag) != 0 ||
        effects_read(request.effects, &selection, diag) != 0)
        return -1;
    suite_choice_doubt(runner, suite);
    const char *effects = trial_request(selection.allowed, runner_arena(runner));
    *bench = (struct trial_bench){
        .runner = runner,
        .suite = suite,
        .asked = strcmp(effects, "auto") == 0 ? "auto" : request.effects,
        .allowed = selection.allowed,
    };
    if (choose_vehicles(bench, options->vehicles, suite) != 0)
        return -1;
    prepare_all(bench, effects);
    return 0;
}

void trial_add(struct trial_bench *bench, struct trial *trial)
{
    memset(trial->spent_ns, 0, sizeof trial->spent_ns);
    *list_add(&bench->trials, runner_arena(bench->runner)) = trial;
}

void trial_begin_pass(struct trial_bench *bench, unsigned pass)
{
    bench->pass = pass;
    bench->trials.count = 0;
    memset(bench->frames, 0, sizeof bench->frames);
    memset(bench->head_ns, 0, sizeof bench->head_ns);
    for (int at = 0; at < TRIAL_POSITIONS; at++)
        if ((pass & TRIAL_TIMED) != 0 && ((pass & TRIAL_ALONE) == 0 || at == TRIAL_IDEAL))
            trial_add(bench, &bench->whole[at]);
    for (int i = 0; i < EFFECT_COUNT; i++)
        if ((pass & TRIAL_EFFECTS) != 0 && (bench->allowed & EFFECT_BIT(i)) != 0)
            trial_add(bench, &bench->without[i]);
}

void trial_end(struct trial_bench *bench)
{
    text_free(&bench->line);
    arena_free(&bench->arena);
    arena_free(&bench->made_arena);
    arena_free(&bench->cache.arena);
}

/* Runs the whole chain, and keeps what each stage reads. */
static int run_whole(struct trial_bench *bench)
{
    struct frame *frame = &bench->frame;
    bool compared = (bench->pass & TRIAL_COMPARED) != 0;
    for (int at = 0; at < TRIAL_POSITIONS; at++) {
        bench->kept[at] = *frame;
        if (compared)
            frame->sections |= CARRY_ACCOUNT;
        if (runner_try(bench->runner, bench->logged[at], frame) != 0)
            return -1;
    }
    if (!compared)
        return 0;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        bench->lists += frame->sensors.list.items[i].measured;
    bench->targets += (int64_t)frame->targets.count;
    return 0;
}

static int open_frame(struct trial_bench *bench, const struct sampled_frame *sampled, uint64_t seed)
{
    struct frame *frame = &bench->frame;
    frame->arena = &bench->arena;
    frame->list_cache = &bench->cache;
    int64_t begin_ns = cpu_ns();
    if (frame_stream_parse(sampled->line, sampled->length, frame, runner_diag(bench->runner)) != 0)
        return -1;
    frame->seed = seed;
    bool extracts = (frame->present & PART_REFLECTORS) == 0;
    if (!extracts && bench->asks_vehicles)
        return diag_fail(runner_diag(bench->runner), DIAG_USAGE,
                         "--vehicles: the frames have reflectors; give it to glint-extract");
    if (extracts && runner_try(bench->runner, bench->extract, frame) != 0)
        return -1;
    bench->extracts = bench->extracts || extracts;
    bench->head_ns[bench->round] += cpu_ns() - begin_ns;
    bench->frames[bench->round]++;
    if (!bench->doubts_cells)
        bench->doubts_cells = suite_choice_doubt_cells(bench->runner, bench->suite, frame);
    bench->kept[TRIAL_IDEAL] = *frame;
    return (bench->pass & TRIAL_ALONE) != 0 ? 0 : run_whole(bench);
}

/* The frame as it was kept for the trial's first stage. Stages add to counts in place, so the trial
 * has its own. */
static void resume(struct trial_bench *bench, const struct trial *trial)
{
    struct frame *made = &bench->made;
    arena_clear(&bench->made_arena);
    *made = bench->kept[trial->first];
    made->arena = &bench->made_arena;
    made->sections = CARRY_BY_DEFAULT;
    made->sensors.effects = trial->effects;
    frame_drop(made, PART_LOST | PART_VISIBILITY);
    struct count *counts = arena_get(made->arena, made->counts.count * sizeof *counts);
    for (size_t i = 0; i < made->counts.count; i++) {
        counts[i] = made->counts.items[i];
        counts[i].paths.count = counts[i].paths.room = 0;
        for (size_t k = 0; k < made->counts.items[i].paths.count; k++)
            *list_add(&counts[i].paths, made->arena) = made->counts.items[i].paths.items[k];
    }
    made->counts.items = counts;
    made->counts.room = made->counts.count;
}

static int run_stages(struct trial_bench *bench, struct trial *trial)
{
    resume(bench, trial);
    int64_t begin_ns = cpu_ns();
    for (int at = (int)trial->first; at < TRIAL_POSITIONS; at++)
        if (trial->stages[at] != NULL &&
            runner_try(bench->runner, trial->stages[at], &bench->made) != 0)
            return -1;
    bench->line.length = 0;
    if (frame_text_write(&bench->made, &bench->line, runner_diag(bench->runner)) != 0)
        return -1;
    trial->latest_ns = cpu_ns() - begin_ns;
    return 0;
}

/* Appends the words of an effect's cause with these names in them; false if one is missing. */
static bool fill_in(const char *words, const char *object, const char *other, struct text *text)
{
    for (const char *open; (open = strchr(words, '{')) != NULL;) {
        size_t length = strcspn(open + 1, "}");
        const char *name = text_is(open + 1, length, "object") ? object : other;
        if (name == NULL)
            return false;
        text_format(text, "%.*s%s", (int)(open - words), words, name);
        words = open + length + 2;
    }
    text_add_word(text, words);
    return true;
}

/* Counts the list that changed last for the cause with these names, once. */
static void count_cause(struct trial_bench *bench, struct trial *trial, const char *object,
                        const char *other)
{
    struct text text = {0};
    struct arena *arena = runner_arena(bench->runner);
    if (fill_in(effect_table[trial->effect]->scene, object, other, &text)) {
        size_t number = intern_number(&trial->causes, text.bytes, text.length, arena);
        if (number == trial->counts.count)
            *list_add(&trial->counts, arena) = (struct trial_count){0};
        struct trial_count *count = &trial->counts.items[number];
        count->lists += count->latest != trial->changed;
        count->latest = trial->changed;
    }
    text_free(&text);
}

/* May the effect have made or changed this part of a target that it marked? */
static bool may_be_marked(const struct effect *effect, const struct echo_id *part)
{
    return effect->is_own != NULL ? effect->is_own(part) : frame_has_object(part->path);
}

/* The echo among those that the whole chain lost by the effect; NULL: it is not. */
static const struct lost_echo *find_lost(const struct frame *frame, enum effect_id effect,
                                         const char *sensor, const struct echo_id *id)
{
    for (size_t i = 0; i < frame->lost.count; i++) {
        const struct lost_group *group = &frame->lost.items[i];
        if (group->effect != effect || !frame_same_name(group->sensor, sensor))
            continue;
        for (size_t k = 0; k < group->echoes.count; k++)
            if (frame_order_echo_ids(&group->echoes.items[k], id) == 0)
                return &group->echoes.items[k];
    }
    return NULL;
}

/* Notes what calls for the trial's effect in a list that changed: the strongest echo that the
 * effect marked in this target of the whole chain. */
static void note_marked(struct trial_bench *bench, struct trial *trial, const struct target *target)
{
    const struct contributor *strongest = NULL;
    for (size_t i = 0; i < target->contributors.count; i++) {
        const struct contributor *part = &target->contributors.items[i];
        if (may_be_marked(effect_table[trial->effect], &part->id) &&
            (strongest == NULL || part->weight > strongest->weight))
            strongest = part;
    }
    if (strongest != NULL && (target->effects & EFFECT_BIT(trial->effect)) != 0)
        count_cause(bench, trial, strongest->id.object, strongest->id.mirror);
}

/* The same by the echoes in this target of the trial that the whole chain lost by the effect. */
static void note_lost(struct trial_bench *bench, struct trial *trial, const struct target *target)
{
    for (size_t i = 0; i < target->contributors.count; i++) {
        const struct echo_id *id = &target->contributors.items[i].id;
        const struct lost_echo *lost = find_lost(&bench->frame, trial->effect, target->sensor, id);
        if (lost != NULL)
            count_cause(bench, trial, id->object, lost->by);
    }
}

/* Where the targets of a sensor end, of which this is the first. */
static size_t end_of_list(const struct frame *frame, size_t at, const char *sensor)
{
    const struct target *targets = frame->targets.items;
    while (at < frame->targets.count && frame_same_name(targets[at].sensor, sensor))
        at++;
    return at;
}

static bool same_targets(const struct target *targets, const struct target *others, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (!field_same(&target_record, &targets[i], &others[i]))
            return false;
    return true;
}

/* Counts a list that changed: these targets of the whole chain, and those of the trial. */
static void count_changed(struct trial_bench *bench, struct trial *trial,
                          const struct target *targets, size_t count, const struct target *made,
                          size_t made_count)
{
    trial->changed++;
    if (trial->effect == EFFECT_NONE || effect_table[trial->effect]->scene == NULL)
        return;
    for (size_t i = 0; i < count; i++)
        note_marked(bench, trial, &targets[i]);
    for (size_t i = 0; i < made_count; i++)
        note_lost(bench, trial, &made[i]);
}

/* Returns how many lists of the frame changed. */
static int64_t compare(struct trial_bench *bench, struct trial *trial)
{
    const struct frame *whole = &bench->frame, *made = &bench->made;
    int64_t before = trial->changed;
    size_t at = 0, made_at = 0;
    for (size_t i = 0; i < whole->sensors.list.count; i++) {
        const char *sensor = whole->sensors.list.items[i].name;
        const struct target *targets = &whole->targets.items[at];
        const struct target *others = &made->targets.items[made_at];
        size_t count = end_of_list(whole, at, sensor) - at;
        size_t made_count = end_of_list(made, made_at, sensor) - made_at;
        at += count;
        made_at += made_count;
        if (count != made_count || !same_targets(targets, others, count))
            count_changed(bench, trial, targets, count, others, made_count);
    }
    return trial->changed - before;
}

static bool is_due(const struct trial_bench *bench, const struct trial *trial)
{
    return trial->effect == EFFECT_NONE || trial_simulated(bench, trial->effect);
}

static int run_trial(struct trial_bench *bench, struct trial *trial)
{
    if (run_stages(bench, trial) != 0)
        return -1;
    bool same = (bench->pass & TRIAL_COMPARED) != 0 && compare(bench, trial) == 0;
    if (bench->collect == NULL || (same && trial->effect != EFFECT_NONE))
        return 0;
    return bench->collect(bench->with, trial, &bench->made);
}

/* The trials take turns, so that none always finds the CPU's cache as the same one left it. */
static struct trial *in_turn(const struct trial_bench *bench, size_t at, size_t turn)
{
    size_t count = bench->trials.count, place = (at + turn) % count;
    return bench->trials.items[turn % 2 == 0 ? place : count - 1 - place];
}

int trial_run(struct trial_bench *bench, const struct sampled_frame *sampled, uint64_t seed)
{
    if (open_frame(bench, sampled, seed) != 0)
        return -1;
    for (size_t i = 0; i < bench->trials.count; i++) {
        struct trial *trial = in_turn(bench, i, (size_t)sampled->place + (size_t)bench->round);
        if (is_due(bench, trial) && run_trial(bench, trial) != 0)
            return -1;
    }
    for (size_t i = 0; i < bench->trials.count; i++) {
        struct trial *trial = bench->trials.items[i];
        trial->spent_ns[bench->round] +=
            (is_due(bench, trial) ? trial : &bench->whole[trial->first])->latest_ns;
    }
    return 0;
}

bool trial_simulated(const struct trial_bench *bench, enum effect_id effect)
{
    for (int at = 0; at < TRIAL_POSITIONS; at++)
        if (bench->log[at].scans_simulated[effect] > 0)
            return true;
    return false;
}

const char *trial_cause(const struct trial *trial, int64_t *lists)
{
    const char *cause = effect_table[trial->effect]->cause;
    *lists = 0;
    for (size_t i = 0; i < trial->counts.count; i++)
        if (trial->counts.items[i].lists > *lists) {
            *lists = trial->counts.items[i].lists;
            cause = intern_text(&trial->causes, (uint32_t)i);
        }
    return cause;
}

/* The time between two times of each round. */
static struct trial_time time_between(const struct trial_bench *bench, const int64_t *less_ns,
                                      const int64_t *ns)
{
    double us[TRIAL_ROUNDS];
    for (int i = 0; i < TRIAL_ROUNDS; i++)
        us[i] = 1e-3 * (double)(ns[i] - less_ns[i]) / (double)bench->frames[i];
    sort_numbers(us, TRIAL_ROUNDS, runner_arena(bench->runner));
    return (struct trial_time){(us[(TRIAL_ROUNDS - 1) / 2] + us[TRIAL_ROUNDS / 2]) / 2, us[0],
                               us[TRIAL_ROUNDS - 1]};
}

struct trial_time trial_time_of(const struct trial_bench *bench, const struct trial *trial)
{
    int64_t before_ns[TRIAL_ROUNDS];
    for (int i = 0; i < TRIAL_ROUNDS; i++)
        before_ns[i] = -bench->head_ns[i];
    return time_between(bench, before_ns, trial->spent_ns);
}

struct trial_time trial_saved(const struct trial_bench *bench, const struct trial *trial)
{
    return time_between(bench, trial->spent_ns, bench->whole[trial->first].spent_ns);
}
