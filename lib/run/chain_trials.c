#include "run/chain_trials.h"

#include <assert.h>

#include "base/random.h"
#include "score/ensemble.h"
#include "score/target_score.h"

enum { SEEDS = CHAIN_TRIALS_SEEDS, ALL = 2 * SEEDS };

/* Notes with the first seed of the reference which scans there are; they need cells with a width.
 */
static int note_scan(struct chain_trials *trials, const struct sensor_view *view)
{
    if (!target_score_has_cells(view))
        return diag_fail(runner_diag(trials->bench->runner), DIAG_DATA,
                         "sensor \"%s\" has cells of %g m by %g m/s in a view of %g rad; "
                         "distances in cells need more than 0",
                         view->name, view->cell_range_m, view->cell_range_rate_mps,
                         view->field_of_view_rad);
    if (trials->bench->round == 0)
        *list_add(&trials->scans, runner_arena(trials->bench->runner)) =
            (struct trial_scan){.scene = trials->scene};
    return 0;
}

/* Keeps the lists of a trial, those of the reference for good. */
static int keep_lists(void *with, struct trial *trial, const struct frame *frame)
{
    struct chain_trials *trials = with;
    struct tried_chain *chain = trial->own;
    bool of_reference = trials->among_reference == NULL;
    if (chain == NULL)
        return 0;
    struct arena *arena = of_reference ? runner_arena(trials->bench->runner) : &trials->kept;
    struct trial_lists *lists =
        &(of_reference ? trials->reference : chain->latest)[trials->bench->round];
    for (size_t i = 0; i < frame->sensors.list.count; i++) {
        const struct sensor_view *view = &frame->sensors.list.items[i];
        if (!view->measured)
            continue;
        if (of_reference && note_scan(trials, view) != 0)
            return -1;
        *list_add(&lists->scans, arena) = ensemble_embed(frame, view, arena);
    }
    return 0;
}

/* Runs the trials on a frame with all seeds, of which the first is this one. */
static int run_seeds(struct chain_trials *trials, const struct sampled_frame *sampled,
                     uint64_t first)
{
    struct trial_bench *bench = trials->bench;
    trials->scene = sampled->scene;
    for (bench->round = 0; bench->round < SEEDS; bench->round++) {
        uint64_t seed = 16 * (uint64_t)sampled->frame + first + 2 * (uint64_t)bench->round;
        if (trial_run(bench, sampled, sampled->seed + (seed << 32)) != 0)
            return diag_prefix(runner_diag(bench->runner),
                               "scene \"%s\", frame %lld: ", bench->frame.scene,
                               (long long)sampled->frame);
        if (progress_step(&trials->progress))
            progress_show(&trials->progress, (double)trials->progress.count /
                                                 (double)(SEEDS * trials->sample->list.count));
    }
    return 0;
}

/* Begins a pass in which these chains keep lists. */
static void begin_pass(struct chain_trials *trials, struct tried_chain *const *chains, size_t count,
                       unsigned pass)
{
    struct trial_bench *bench = trials->bench;
    bench->collect = keep_lists;
    bench->with = trials;
    trial_begin_pass(bench, pass);
    for (size_t i = 0; i < bench->trials.count; i++)
        bench->trials.items[i]->own = NULL;
    for (size_t i = 0; i < count; i++) {
        chains[i]->trial->own = chains[i];
        if (chains[i]->trial == &chains[i]->own)
            trial_add(bench, chains[i]->trial);
    }
    progress_begin(&trials->progress, "frames");
}

/* Weighs scans: all scenes alike, and in a scene all its scans. */
static void weigh_scans(struct chain_trials *trials)
{
    struct arena *arena = runner_arena(trials->bench->runner);
    double *of_scene = arena_get(arena, trials->sample->names.list.count * sizeof *of_scene);
    for (size_t i = 0; i < trials->scans.count; i++)
        trials->scenes += of_scene[trials->scans.items[i].scene]++ == 0;
    for (size_t i = 0; i < trials->scans.count; i++) {
        struct trial_scan *scan = &trials->scans.items[i];
        scan->share = 1 / (of_scene[scan->scene] * (double)trials->scenes);
    }
}

static int run_frames(struct chain_trials *trials, uint64_t first)
{
    for (size_t i = 0; i < trials->sample->list.count; i++)
        if (run_seeds(trials, &trials->sample->list.items[i], first) != 0)
            return -1;
    progress_end(&trials->progress);
    return 0;
}

int chain_trials_begin(struct chain_trials *trials, struct tried_chain *reference)
{
    begin_pass(trials, &reference, 1, TRIAL_ALONE);
    if (run_frames(trials, 1) != 0)
        return -1;
    if (trials->scans.count == 0)
        return diag_fail(runner_diag(trials->bench->runner), DIAG_DATA,
                         "no sensor of the suite measures in these frames");
    weigh_scans(trials);
    double targets = 0;
    trials->among_reference =
        arena_get(runner_arena(trials->bench->runner), sizeof(double) * SEEDS * SEEDS);
    for (size_t at = 0; at < trials->scans.count; at++) {
        const struct embedded_list *list[SEEDS];
        for (size_t i = 0; i < SEEDS; i++) {
            list[i] = &trials->reference[i].scans.items[at];
            targets += (double)list[i]->targets.count;
        }
        energy_distance_add(list, SEEDS, trials->scans.items[at].share, trials->among_reference);
    }
    reference->row.targets_per_scan = targets / (double)(SEEDS * trials->scans.count);
    return 0;
}

/* Distances of all lists, of which those of the reference from each other are set. */
static double *begin_distances(const struct chain_trials *trials)
{
    double *distance = arena_get(runner_arena(trials->bench->runner), sizeof(double) * ALL * ALL);
    for (size_t i = 0; i < SEEDS; i++)
        memcpy(distance + i * ALL, trials->among_reference + i * SEEDS, SEEDS * sizeof *distance);
    return distance;
}

/* The lists of one scan, of the reference and behind them of a chain, and their distances. */
struct compared_scan {
    const struct embedded_list *list[ALL];
    double distance[ALL * ALL];
};

/* Measures the distances of a chain's lists. Those of lists that another chain has as well are
 * known; NULL: there is no other. */
static void measure_scan(struct compared_scan *scan, const struct compared_scan *other)
{
    for (size_t i = SEEDS; i < ALL; i++)
        for (size_t j = 0; j < i; j++) {
            double *distance = &scan->distance[i * ALL + j];
            if (other != NULL && scan->list[i] == other->list[i] && scan->list[j] == other->list[j])
                *distance = other->distance[i * ALL + j];
            else
                *distance = energy_distance_of_lists(scan->list[i], scan->list[j]);
        }
}

static void add_scan(const struct compared_scan *scan, double share, double *distance)
{
    for (size_t i = SEEDS; i < ALL; i++)
        for (size_t j = 0; j < i; j++) {
            distance[i * ALL + j] += share * scan->distance[i * ALL + j];
            distance[j * ALL + i] += share * scan->distance[i * ALL + j];
        }
}

/* The list of a chain in a scan of the frame at hand: that of the first chain if it is equal, or if
 * the chain gave none. */
static const struct embedded_list *list_of(const struct tried_chains *chains, size_t chain,
                                           size_t seed, size_t scan)
{
    const struct trial_lists *first = &chains->list.items[0]->latest[seed];
    const struct trial_lists *own = &chains->list.items[chain]->latest[seed];
    const struct embedded_list *of_first = &first->scans.items[scan];
    if (own->scans.count <= scan || energy_distance_equal(&own->scans.items[scan], of_first))
        return of_first;
    return &own->scans.items[scan];
}

/* Adds the distances of a scan of the frame at hand to every chain. */
static void compare_scan(const struct chain_trials *trials, const struct tried_chains *chains,
                         double *const *distances, size_t at, size_t scan)
{
    struct compared_scan first, other;
    for (size_t i = 0; i < chains->list.count; i++) {
        struct compared_scan *compared = i == 0 ? &first : &other;
        for (size_t k = 0; k < SEEDS; k++) {
            const struct embedded_list *list = list_of(chains, i, k, scan);
            compared->list[k] = &trials->reference[k].scans.items[at];
            compared->list[SEEDS + k] = list;
            chains->list.items[i]->row.targets_per_scan += (double)list->targets.count;
        }
        measure_scan(compared, i == 0 ? NULL : &first);
        add_scan(compared, trials->scans.items[at].share, distances[i]);
    }
}

int chain_trials_run(struct chain_trials *trials, const struct tried_chains *chains, unsigned pass)
{
    assert((pass & TRIAL_EFFECTS) == 0 ||
           chains->list.items[0]->trial == &trials->bench->whole[TRIAL_IDEAL]);
    size_t count = chains->list.count, first = 0;
    double **distances = arena_get(runner_arena(trials->bench->runner), count * sizeof *distances);
    begin_pass(trials, chains->list.items, count, pass);
    for (size_t i = 0; i < count; i++) {
        distances[i] = begin_distances(trials);
        chains->list.items[i]->row.targets_per_scan = 0;
    }
    for (size_t i = 0; i < trials->sample->list.count; i++) {
        arena_clear(&trials->kept);
        for (size_t k = 0; k < count; k++)
            memset(chains->list.items[k]->latest, 0, sizeof chains->list.items[k]->latest);
        if (run_seeds(trials, &trials->sample->list.items[i], 2) != 0)
            return -1;
        size_t scans = chains->list.items[0]->latest[0].scans.count;
        for (size_t scan = 0; scan < scans; scan++)
            compare_scan(trials, chains, distances, first++, scan);
    }
    progress_end(&trials->progress);
    arena_free(&trials->kept);
    for (size_t i = 0; i < count; i++) {
        chains->list.items[i]->lists = (struct energy_sample){distances[i], SEEDS, SEEDS};
        chains->list.items[i]->row.targets_per_scan /= (double)(SEEDS * trials->scans.count);
    }
    return 0;
}

int chain_trials_time(struct chain_trials *trials, struct tried_chain *chain)
{
    begin_pass(trials, &chain, 1, TRIAL_ALONE | TRIAL_TIMED);
    trials->bench->collect = NULL;
    return run_frames(trials, 2);
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
    assert(lost >= 0 && lost <= 1);
    struct random_sequence draws = random_sequence_at((struct random_address){0}, RANDOM_SAMPLE);
    struct trial_lists lists[SEEDS] = {0};
    struct arena kept = {0};
    for (size_t i = 0; i < SEEDS; i++)
        for (size_t at = 0; at < trials->scans.count; at++)
            *list_add(&lists[i].scans, &kept) =
                spoil(&trials->reference[i].scans.items[at], lost, off_cells, &draws, &kept);
    double *distance = begin_distances(trials), sum = 0;
    for (size_t at = 0; at < trials->scans.count; at++) {
        struct compared_scan scan;
        for (size_t i = 0; i < SEEDS; i++) {
            scan.list[i] = &trials->reference[i].scans.items[at];
            scan.list[SEEDS + i] = &lists[i].scans.items[at];
        }
        measure_scan(&scan, NULL);
        add_scan(&scan, trials->scans.items[at].share, distance);
    }
    for (size_t i = 0; i < SEEDS; i++)
        for (size_t k = 0; k < SEEDS; k++)
            if (i != k)
                sum += 2 * distance[i * ALL + SEEDS + k] - distance[i * ALL + k] -
                       distance[(SEEDS + i) * ALL + SEEDS + k];
    arena_free(&kept);
    return sum / (SEEDS * (SEEDS - 1));
}
