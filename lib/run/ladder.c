#include "run/ladder.h"

#include <time.h>

#include "base/sort.h"
#include "frame/frame_text.h"
#include "run/fused.h"
#include "run/suite_choice.h"
#include "run/tool.h"
#include "score/ensemble.h"
#include "score/target_score.h"
#include "text/list_cache.h"

enum { SEEDS = LADDER_SEEDS, ALL = 2 * SEEDS };

/* One run of a chain over the sample. */
struct pass {
    struct ladder *ladder;
    LIST_OF(struct runner *) stages;
    uint64_t seed; /* number k of the seed */
    struct frame frame;
    struct arena arena; /* the frame's */
    struct list_cache cache;
    struct text written;
    int64_t spent_ns;
    struct ladder_lists *lists;
    struct arena *kept; /* of the lists */
};

static int64_t cpu_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

/* One frame as `glint` runs it, from its line to a line. */
static int run_frame(struct pass *pass, const struct sampled_frame *sampled)
{
    struct runner *runner = pass->ladder->runner;
    struct frame *frame = &pass->frame;
    struct diag *diag = runner_diag(runner);
    int64_t begin_ns = cpu_ns();
    if (frame_sample_read(sampled, frame, diag) != 0)
        return -1;
    frame->seed = sampled->seed + (pass->seed << 32);
    for (size_t i = (frame->present & SECTION_REFLECTORS) != 0; i < pass->stages.count; i++)
        if (runner_try(runner, pass->stages.items[i], frame) != 0)
            return diag_prefix(diag, "scene \"%s\", frame %lld: ", frame->scene,
                               (long long)frame->frame);
    pass->written.length = 0;
    if (frame_text_write(frame, &pass->written, diag) != 0)
        return -1;
    pass->spent_ns += cpu_ns() - begin_ns;
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
            return diag_fail(runner_diag(pass->ladder->runner), DIAG_DATA,
                             "sensor \"%s\" has cells of %g m by %g m/s in a view of %g rad; "
                             "distances in cells need more than 0",
                             view->name, view->cell_range_m, view->cell_range_rate_mps,
                             view->field_of_view_rad);
        if (pass->seed == 1)
            *list_add(&pass->ladder->scans, pass->kept) =
                (struct ladder_scan){.scene = sampled->scene, .block = sampled->block};
        *list_add(&pass->lists->scans, pass->kept) = ensemble_embed(frame, view, pass->kept);
    }
    return 0;
}

static void show_progress(struct ladder *ladder)
{
    size_t frames = ladder->expected * SEEDS * ladder->sample->list.count;
    if (progress_step(&ladder->progress))
        progress_show(&ladder->progress, (double)ladder->progress.count / (double)frames);
}

static int run_pass(struct pass *pass)
{
    const struct frame_sample *sample = pass->ladder->sample;
    pass->frame.arena = &pass->arena;
    pass->frame.list_cache = &pass->cache;
    int result = 0;
    for (size_t i = 0; result == 0 && i < sample->list.count; i++) {
        if (run_frame(pass, &sample->list.items[i]) != 0 ||
            keep_lists(pass, &sample->list.items[i]) != 0)
            result = -1;
        show_progress(pass->ladder);
    }
    progress_end(&pass->ladder->progress);
    text_free(&pass->written);
    arena_free(&pass->arena);
    list_cache_free(&pass->cache);
    return result;
}

static double mean_targets(const struct ladder_lists *lists)
{
    double targets = 0, scans = 0;
    for (size_t i = 0; i < SEEDS; i++, scans += (double)lists->scans.count)
        for (size_t k = 0; k < lists[i].scans.count; k++)
            targets += (double)lists[i].scans.items[k].targets.count;
    return targets / scans;
}

/* A pass with stages of its own. */
static struct pass begin_pass(struct ladder *ladder, const struct ladder_chain *chain)
{
    struct runner *runner = ladder->runner;
    struct arena *arena = runner_arena(runner);
    const struct suite_choice choice = {ladder->sensors, chain->effects};
    struct pass pass = {.ladder = ladder};
    *list_add(&pass.stages, arena) = runner_trial(runner, fused_stage("extract"), NULL, NULL);
    *list_add(&pass.stages, arena) = runner_trial(runner, fused_stage("ideal"), &choice, NULL);
    for (size_t i = 0; i < chain->programs.count; i++)
        *list_add(&pass.stages, arena) =
            runner_trial(runner, fused_stage(fused_name(chain->programs.items[i])), NULL, NULL);
    return pass;
}

/* Runs the chain with the seeds first, first + 2, ... */
static int run_chain(struct ladder *ladder, struct ladder_chain *chain, uint64_t first,
                     struct ladder_lists *lists, struct arena *kept)
{
    struct pass begun = begin_pass(ladder, chain);
    double us[SEEDS];
    for (size_t i = 0; i < SEEDS; i++) {
        struct pass pass = begun;
        pass.seed = first + 2 * i;
        pass.lists = &lists[i];
        pass.kept = kept;
        if (run_pass(&pass) != 0)
            return -1;
        us[i] = 1e-3 * (double)pass.spent_ns / (double)ladder->sample->list.count;
    }
    sort_numbers(us, SEEDS, runner_arena(ladder->runner));
    chain->us_per_frame = (us[(SEEDS - 1) / 2] + us[SEEDS / 2]) / 2;
    chain->targets_per_scan = mean_targets(lists);
    return 0;
}

/* Counts the scans of scenes and blocks, numbers the blocks that have any, and weighs them. */
static void weigh_blocks(struct ladder *ladder)
{
    const struct frame_sample *sample = ladder->sample;
    struct arena *arena = runner_arena(ladder->runner);
    size_t scenes = 0, names = sample->names.list.count, count = ladder->scans.count;
    double *of_scene = arena_get(arena, names * sizeof *of_scene);
    double *of_block = arena_get(arena, sample->blocks * sizeof *of_block);
    size_t *number = arena_get(arena, sample->blocks * sizeof *number);
    for (size_t i = 0; i < count; i++) {
        struct ladder_scan *scan = &ladder->scans.items[i];
        scenes += of_scene[scan->scene]++ == 0;
        if (of_block[scan->block]++ == 0)
            number[scan->block] = ladder->blocks++;
    }
    ladder->block_weight = arena_get(arena, ladder->blocks * sizeof(double));
    for (size_t i = 0; i < count; i++) {
        struct ladder_scan *scan = &ladder->scans.items[i];
        scan->share = 1 / of_block[scan->block];
        scan->block = number[scan->block];
        ladder->block_weight[scan->block] += 1 / (of_scene[scan->scene] * (double)scenes);
    }
}

int ladder_begin(struct ladder *ladder, struct ladder_chain *reference)
{
    progress_begin(&ladder->progress, "frames");
    if (run_chain(ladder, reference, 1, ladder->reference, runner_arena(ladder->runner)) != 0)
        return -1;
    if (ladder->scans.count == 0)
        return diag_fail(runner_diag(ladder->runner), DIAG_DATA,
                         "no sensor of the suite measures in these frames");
    weigh_blocks(ladder);
    return 0;
}

/* The distances of all lists from each other, by block. */
static void compare(const struct ladder *ladder, const struct ladder_lists *lists,
                    struct energy_blocks *blocks)
{
    size_t size = ladder->blocks * ALL * ALL * sizeof(double);
    double *distance = arena_get(runner_arena(ladder->runner), size);
    for (size_t at = 0; at < ladder->scans.count; at++) {
        const struct ladder_scan *scan = &ladder->scans.items[at];
        const struct embedded_list *list[ALL];
        for (size_t i = 0; i < SEEDS; i++) {
            list[i] = &ladder->reference[i].scans.items[at];
            list[SEEDS + i] = &lists[i].scans.items[at];
        }
        list_embedding_add_distances(list, ALL, scan->share, distance + scan->block * ALL * ALL);
    }
    *blocks = (struct energy_blocks){distance, ladder->block_weight, ladder->blocks, SEEDS, SEEDS};
}

int ladder_climb(struct ladder *ladder, struct ladder_chain *chain)
{
    struct ladder_lists lists[SEEDS] = {0};
    struct arena kept = {0};
    int result = run_chain(ladder, chain, 2, lists, &kept);
    if (result == 0)
        compare(ladder, lists, &chain->blocks);
    arena_free(&kept);
    return result;
}
