#include "run/chain_trials.h"

#include <inttypes.h>

#include "base/random.h"
#include "base/sort.h"
#include "frame/frame_text.h"
#include "run/chain.h"
#include "run/frame_stream.h"
#include "run/suite_choice.h"
#include "run/tool.h"
#include "score/ensemble.h"
#include "score/target_score.h"
#include "text/list_cache.h"

enum { SEEDS = CHAIN_TRIALS_SEEDS, ALL = 2 * SEEDS };

/* Which of two: drawn for a stretch of this length, at this place among those of its length. */
static int64_t drawn_half(int64_t stretch, int64_t length)
{
    double uniform[4];
    struct random_address address = {.frame = (uint64_t)stretch, .item = (uint64_t)length};
    random_uniform(&address, RANDOM_SAMPLE, 0, uniform);
    return uniform[0] < 0.5 ? 0 : 1;
}

/* True if the frame is the one of its stretch. A stretch keeps what one of its halves keeps, so a
 * frame that is left out stays out when the stretches grow. */
static bool is_kept(int64_t place, int64_t stride)
{
    for (int64_t half = 1; half < stride; half *= 2)
        if (drawn_half(place / half / 2, 2 * half) != place / half % 2)
            return false;
    return true;
}

static void lengthen_stretches(struct frame_sample *sample)
{
    sample->stride *= 2;
    size_t kept = 0;
    for (size_t i = 0; i < sample->list.count; i++)
        if (is_kept(sample->list.items[i].place, sample->stride))
            sample->list.items[kept++] = sample->list.items[i];
    sample->list.count = kept;
}

/* Frames of one name and different seeds are of different scenes. */
static size_t scene_of(struct frame_sample *sample, const struct frame *frame)
{
    struct text key = {0};
    text_format(&key, "%" PRIu64 " %s", frame->seed, frame->scene);
    size_t number = intern_number(&sample->names, key.bytes, key.length, sample->arena);
    text_free(&key);
    return number;
}

int chain_trials_sample(struct frame_sample *sample, const struct frame *frame, struct diag *diag)
{
    if (sample->seen == 0)
        sample->stride = 1;
    int64_t place = sample->seen++;
    if (!is_kept(place, sample->stride))
        return 0;
    struct frame bare = *frame;
    struct text line = {0};
    frame_drop(&bare, ~(unsigned)(SECTION_OBJECTS | SECTION_VEHICLES | SECTION_REFLECTORS));
    bare.sections = CARRY_BY_DEFAULT;
    int result = frame_text_write(&bare, &line, diag);
    if (result == 0)
        *list_add(&sample->list, sample->arena) = (struct sampled_frame){
            .line = arena_text(sample->arena, line.bytes, line.length - 1),
            .length = line.length - 1,
            .seed = frame->seed,
            .place = place,
            .scene = scene_of(sample, frame),
        };
    text_free(&line);
    while ((int64_t)sample->list.count > sample->most)
        lengthen_stretches(sample);
    return result;
}

int chain_trials_read(const struct sampled_frame *sampled, struct frame *frame, struct diag *diag)
{
    return frame_stream_parse(sampled->line, sampled->length, frame, diag);
}

/* One run of a chain over the sample. */
struct pass {
    struct chain_trials *trials;
    LIST_OF(struct runner *) stages;
    uint64_t seed; /* number k of the seed, below 16 */
    struct frame frame;
    struct arena arena; /* the frame's */
    struct list_cache cache;
    struct text written;
    int64_t spent_ns;
    struct trial_lists *lists;
    struct arena *kept; /* of the lists */
};

/* One frame as `glint` runs it, from its line to a line. */
static int run_frame(struct pass *pass, const struct sampled_frame *sampled)
{
    struct runner *runner = pass->trials->runner;
    struct frame *frame = &pass->frame;
    struct diag *diag = runner_diag(runner);
    int64_t begin_ns = chain_cpu_ns();
    if (chain_trials_read(sampled, frame, diag) != 0)
        return -1;
    frame->seed = sampled->seed + ((16 * (uint64_t)frame->frame + pass->seed) << 32);
    for (size_t i = (frame->present & SECTION_REFLECTORS) != 0; i < pass->stages.count; i++)
        if (runner_try(runner, pass->stages.items[i], frame) != 0)
            return diag_prefix(diag, "scene \"%s\", frame %lld: ", frame->scene,
                               (long long)frame->frame);
    pass->written.length = 0;
    if (frame_text_write(frame, &pass->written, diag) != 0)
        return -1;
    pass->spent_ns += chain_cpu_ns() - begin_ns;
    return 0;
}

/* The first pass of all notes which scans there are. */
static int keep_lists(struct pass *pass, const struct sampled_frame *sampled)
{
    const struct frame *frame = &pass->frame;
    for (size_t i = 0; i < frame->sensors.list.count; i++) {
        const struct sensor_view *view = &frame->sensors.list.items[i];
        if (!view->measured)
            continue;
        if (!target_score_has_cells(view))
            return diag_fail(runner_diag(pass->trials->runner), DIAG_DATA,
                             "sensor \"%s\" has cells of %g m by %g m/s in a view of %g rad; "
                             "distances in cells need more than 0",
                             view->name, view->cell_range_m, view->cell_range_rate_mps,
                             view->field_of_view_rad);
        if (pass->seed == 1)
            *list_add(&pass->trials->scans, pass->kept) =
                (struct trial_scan){.scene = sampled->scene};
        *list_add(&pass->lists->scans, pass->kept) = ensemble_embed(frame, view, pass->kept);
    }
    return 0;
}

static void show_progress(struct chain_trials *trials)
{
    size_t frames = trials->expected * SEEDS * trials->sample->list.count;
    if (progress_step(&trials->progress))
        progress_show(&trials->progress, (double)trials->progress.count / (double)frames);
}

static void end_pass(struct pass *pass)
{
    text_free(&pass->written);
    arena_free(&pass->arena);
    arena_free(&pass->cache.arena);
}

/* Each runs first on every other frame, as the second one finds its line in the CPU's cache. */
static int run_pass(struct pass *pass, struct pass *beside)
{
    const struct frame_sample *sample = pass->trials->sample;
    pass->frame.arena = &pass->arena;
    pass->frame.list_cache = &pass->cache;
    beside->frame.arena = &beside->arena;
    beside->frame.list_cache = &beside->cache;
    int result = 0;
    for (size_t i = 0; result == 0 && i < sample->list.count; i++) {
        const struct sampled_frame *sampled = &sample->list.items[i];
        bool both = beside->trials != NULL, first = both && i % 2 == 0;
        if ((first && run_frame(beside, sampled) != 0) || run_frame(pass, sampled) != 0 ||
            (both && !first && run_frame(beside, sampled) != 0) || keep_lists(pass, sampled) != 0)
            result = -1;
        show_progress(pass->trials);
    }
    progress_end(&pass->trials->progress);
    end_pass(pass);
    end_pass(beside);
    return result;
}

static double mean_targets(const struct trial_lists *lists)
{
    double targets = 0, scans = 0;
    for (size_t i = 0; i < SEEDS; i++, scans += (double)lists->scans.count)
        for (size_t k = 0; k < lists[i].scans.count; k++)
            targets += (double)lists[i].scans.items[k].targets.count;
    return targets / scans;
}

static double median(double values[SEEDS], struct arena *arena)
{
    sort_numbers(values, SEEDS, arena);
    return (values[(SEEDS - 1) / 2] + values[SEEDS / 2]) / 2;
}

/* A pass with stages of its own. */
static struct pass begin_pass(struct chain_trials *trials, const struct tried_chain *chain)
{
    struct runner *runner = trials->runner;
    struct arena *arena = runner_arena(runner);
    const struct suite_choice choice = {trials->sensors, chain->effects};
    struct pass pass = {.trials = trials};
    *list_add(&pass.stages, arena) = runner_trial(runner, stage_by_name("extract"), NULL, NULL);
    *list_add(&pass.stages, arena) = runner_trial(runner, stage_by_name("ideal"), &choice, NULL);
    for (size_t i = 0; i < chain->programs.count; i++)
        *list_add(&pass.stages, arena) = runner_trial(
            runner, stage_by_name(stage_name_in_path(chain->programs.items[i])), NULL, NULL);
    return pass;
}

/* Runs the chain with the seeds first, first + 2, ... */
static int run_chain(struct chain_trials *trials, struct tried_chain *chain, uint64_t first,
                     struct trial_lists *lists, struct arena *kept)
{
    struct pass begun = begin_pass(trials, chain), begun_beside = {0};
    if (chain->beside != NULL)
        begun_beside = begin_pass(trials, chain->beside);
    double us[SEEDS], saved[SEEDS], frames = (double)trials->sample->list.count;
    for (size_t i = 0; i < SEEDS; i++) {
        struct pass pass = begun, beside = begun_beside;
        pass.seed = beside.seed = first + 2 * i;
        pass.lists = &lists[i];
        pass.kept = kept;
        if (run_pass(&pass, &beside) != 0)
            return -1;
        us[i] = 1e-3 * (double)pass.spent_ns / frames;
        saved[i] = beside.spent_ns > 0 ? 1 - (double)pass.spent_ns / (double)beside.spent_ns : 0;
    }
    chain->us_per_frame = median(us, runner_arena(trials->runner));
    chain->saved = median(saved, runner_arena(trials->runner));
    chain->saved_least = saved[0];
    chain->targets_per_scan = mean_targets(lists);
    return 0;
}

/* Weighs scans: all scenes alike, and in a scene all its scans. */
static void weigh_scans(struct chain_trials *trials)
{
    struct arena *arena = runner_arena(trials->runner);
    double *of_scene = arena_get(arena, trials->sample->names.list.count * sizeof *of_scene);
    for (size_t i = 0; i < trials->scans.count; i++)
        trials->scenes += of_scene[trials->scans.items[i].scene]++ == 0;
    for (size_t i = 0; i < trials->scans.count; i++) {
        struct trial_scan *scan = &trials->scans.items[i];
        scan->share = 1 / (of_scene[scan->scene] * (double)trials->scenes);
    }
}

int chain_trials_begin(struct chain_trials *trials, struct tried_chain *reference)
{
    progress_begin(&trials->progress, "frames");
    if (run_chain(trials, reference, 1, trials->reference, runner_arena(trials->runner)) != 0)
        return -1;
    if (trials->scans.count == 0)
        return diag_fail(runner_diag(trials->runner), DIAG_DATA,
                         "no sensor of the suite measures in these frames");
    weigh_scans(trials);
    trials->among_reference =
        arena_get(runner_arena(trials->runner), sizeof(double) * SEEDS * SEEDS);
    for (size_t at = 0; at < trials->scans.count; at++) {
        const struct embedded_list *list[SEEDS];
        for (size_t i = 0; i < SEEDS; i++)
            list[i] = &trials->reference[i].scans.items[at];
        energy_distance_add(list, 0, SEEDS, trials->scans.items[at].share, trials->among_reference);
    }
    return 0;
}

/* The distances between all lists, of the reference and of the chain. */
static struct energy_sample compare(const struct chain_trials *trials,
                                    const struct trial_lists *lists)
{
    double *distance = arena_get(runner_arena(trials->runner), sizeof(double) * ALL * ALL);
    for (size_t i = 0; i < SEEDS; i++)
        memcpy(distance + i * ALL, trials->among_reference + i * SEEDS, SEEDS * sizeof *distance);
    for (size_t at = 0; at < trials->scans.count; at++) {
        const struct embedded_list *list[ALL];
        for (size_t i = 0; i < SEEDS; i++) {
            list[i] = &trials->reference[i].scans.items[at];
            list[SEEDS + i] = &lists[i].scans.items[at];
        }
        energy_distance_add(list, SEEDS, ALL, trials->scans.items[at].share, distance);
    }
    return (struct energy_sample){distance, SEEDS, SEEDS};
}

int chain_trials_run(struct chain_trials *trials, struct tried_chain *chain)
{
    struct trial_lists lists[SEEDS] = {0};
    struct arena kept = {0};
    int result = run_chain(trials, chain, 2, lists, &kept);
    if (result == 0)
        chain->lists = compare(trials, lists);
    arena_free(&kept);
    return result;
}

static struct embedded_list spoil(const struct embedded_list *list, double lost, double off_cells,
                                  struct random_sequence *draws, struct arena *arena)
{
    struct embedded_list spoiled = {0};
    for (size_t i = 0; i < list->targets.count; i++) {
        if (random_sequence_chance(draws, lost))
            continue;
        struct embedded_target *target = list_add(&spoiled.targets, arena);
        *target = list->targets.items[i];
        target->axis[0] += off_cells;
    }
    energy_distance_close(&spoiled, arena);
    return spoiled;
}

double chain_trials_spoiled(const struct chain_trials *trials, double lost, double off_cells)
{
    struct random_sequence draws = random_sequence_at((struct random_address){0}, RANDOM_SAMPLE);
    struct trial_lists lists[SEEDS] = {0};
    struct arena kept = {0};
    for (size_t i = 0; i < SEEDS; i++)
        for (size_t at = 0; at < trials->scans.count; at++)
            *list_add(&lists[i].scans, &kept) =
                spoil(&trials->reference[i].scans.items[at], lost, off_cells, &draws, &kept);
    const double *distance = compare(trials, lists).distance;
    double sum = 0;
    for (size_t i = 0; i < SEEDS; i++)
        for (size_t k = 0; k < SEEDS; k++)
            if (i != k)
                sum += 2 * distance[i * ALL + SEEDS + k] - distance[i * ALL + k] -
                       distance[(SEEDS + i) * ALL + SEEDS + k];
    arena_free(&kept);
    return sum / (SEEDS * (SEEDS - 1));
}
