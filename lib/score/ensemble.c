#include "score/ensemble.h"

#include <inttypes.h>

#include "base/random.h"
#include "base/sort.h"
#include "score/reference_stream.h"
#include "score/relative_error.h"
#include "score/target_score.h"
#include "text/text_table.h"

#define LEVEL_DB 3
#define FEWEST_SEEDS 3
#define RESAMPLES 4000

/* A target list as it was read, without targets where the sensor did not measure; the cells are
 * those of its own stream. */
struct ensemble_list {
    int64_t frame;
    double time_s;
    struct sensor_view view;
    LIST_OF(struct embedded_target) targets; /* in m, rad, m/s and dB */
};

struct ensemble_seed {
    uint64_t seed;
    int64_t last; /* the number of its last frame; -1 before the first */
    LIST_OF(struct ensemble_list) lists;
};

struct ensemble_scene {
    const char *name;
    LIST_OF(struct ensemble_seed) seeds;
};

static const struct field scene_fields[] = {
    {FIELD_NAME_OF(struct ensemble_scene_score, scene, "its name; seeds are counted")},
    {FIELD_INTEGER_IN(struct ensemble_scene_score, lists, 0, 0x1p53,
                      "frames times the sensors that measured in them on both sides")},
    {OPTIONAL_INTEGER(struct ensemble_scene_score, true_lists, 0, 0x1p53,
                      "lists of the truth alone, which are not compared; absent: none")},
    {OPTIONAL_INTEGER(struct ensemble_scene_score, listed_lists, 0, 0x1p53,
                      "lists of the stream alone, which are not compared; absent: none")},
    {FIELD_INTEGER_IN(struct ensemble_scene_score, true_seeds, 0, 0x1p53, "of the truth")},
    {FIELD_INTEGER_IN(struct ensemble_scene_score, listed_seeds, 0, 0x1p53, "of the stream")},
    {FIELD_REAL_IN(struct ensemble_scene_score, true_targets, 0, 1e300, "mean number in a list")},
    {FIELD_REAL_IN(struct ensemble_scene_score, listed_targets, 0, 1e300, "mean number in a list")},
    {FIELD_REAL_IN(struct ensemble_scene_score, energy, -1e300, 1e300,
                   "energy distance, mean over the lists; unbiased, so it may be negative")},
    {FIELD_REAL_IN(struct ensemble_scene_score, energy_error, 0, 1e300,
                   "its standard error, by the jackknife over seeds")},
    {0},
};

static const struct record scene_record = {
    FIELD_TABLE(struct ensemble_scene_score, scene_fields, "scene_score",
                "A scene of the truth against the same of the stream.")};

static const struct field score_fields[] = {
    {FIELD_LIST_OF(struct ensemble_score, scenes, &scene_record, "as the truth has them")},
    {FIELD_REAL_IN(struct ensemble_score, energy, -1e300, 1e300, "mean over the scenes")},
    {FIELD_REAL_IN(struct ensemble_score, low, -1e300, 1e300, "of the 95 % interval")},
    {FIELD_REAL_IN(struct ensemble_score, high, -1e300, 1e300, "of the 95 % interval")},
    {0},
};

const struct record ensemble_score_record = {
    FIELD_TABLE(struct ensemble_score, score_fields, "score_ensemble",
                "What glint-score --ensemble writes: energy distances of random target lists.")};

/* The scene of that name; a new one has no seeds. */
static struct ensemble_scene *scene_of(struct ensemble *ensemble, const char *name)
{
    size_t number = intern_word(&ensemble->names, name, ensemble->arena);
    if (number == ensemble->scenes.count)
        *list_add(&ensemble->scenes, ensemble->arena) =
            (struct ensemble_scene){.name = intern_text(&ensemble->names, (uint32_t)number)};
    return &ensemble->scenes.items[number];
}

static struct ensemble_seed *seed_of(struct ensemble_scene *scene, uint64_t seed,
                                     struct arena *arena)
{
    for (size_t i = scene->seeds.count; i-- > 0;)
        if (scene->seeds.items[i].seed == seed)
            return &scene->seeds.items[i];
    struct ensemble_seed *added = list_add(&scene->seeds, arena);
    *added = (struct ensemble_seed){.seed = seed, .last = -1};
    return added;
}

static struct ensemble_list list_of(const struct frame *frame, const struct sensor_view *view,
                                    struct arena *arena)
{
    struct ensemble_list list = {.frame = frame->frame, .time_s = frame->time_s, .view = *view};
    list.view.name = arena_text(arena, view->name, strlen(view->name));
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        if (strcmp(target->sensor, view->name) == 0)
            *list_add(&list.targets, arena) =
                (struct embedded_target){{target->range_m, target->azimuth_rad,
                                          target->range_rate_mps, target->amplitude_db}};
    }
    return list;
}

int ensemble_add(struct ensemble *ensemble, const struct frame *frame, struct diag *diag)
{
    struct ensemble_seed *seed =
        seed_of(scene_of(ensemble, frame->scene), frame->seed, ensemble->arena);
    if (frame->frame <= seed->last)
        return diag_fail(diag, DIAG_DATA,
                         "frame: %" PRId64 " of scene \"%s\" with seed %" PRIu64
                         " comes behind frame %" PRId64 "; expected frames to ascend",
                         frame->frame, frame->scene, frame->seed, seed->last);
    seed->last = frame->frame;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        *list_add(&seed->lists, ensemble->arena) =
            list_of(frame, &frame->sensors.list.items[i], ensemble->arena);
    return 0;
}

/* True if both lists are of the same frame, time and sensor. */
static bool same_scan(const struct ensemble_list *a, const struct ensemble_list *b)
{
    return a->frame == b->frame && reference_stream_same_time(a->time_s, b->time_s) &&
           strcmp(a->view.name, b->view.name) == 0;
}

static bool same_cells(const struct sensor_view *a, const struct sensor_view *b)
{
    return a->cell_range_m == b->cell_range_m && a->cell_range_rate_mps == b->cell_range_rate_mps &&
           a->azimuth_cell_rad == b->azimuth_cell_rad &&
           a->field_of_view_rad == b->field_of_view_rad;
}

/* True if both seeds have the same frames, times and sensors. */
static bool same_lists(const struct ensemble_seed *first, const struct ensemble_seed *seed)
{
    if (seed->lists.count != first->lists.count)
        return false;
    for (size_t i = 0; i < first->lists.count; i++)
        if (!same_scan(&seed->lists.items[i], &first->lists.items[i]))
            return false;
    return true;
}

static bool measured(const struct ensemble_scene *scene, size_t list)
{
    return scene->seeds.items[0].lists.items[list].view.measured;
}

/* The seeds of a stream are samples of the same lists, so the same sensors measured. */
static int check_measured(const struct ensemble_scene *scene, const struct ensemble_seed *seed,
                          const char *stream, struct diag *diag)
{
    for (size_t i = 0; i < seed->lists.count; i++)
        if (seed->lists.items[i].view.measured != measured(scene, i))
            return diag_fail(diag, DIAG_DATA,
                             "scene \"%s\": sensor \"%s\" measured in frame %" PRId64
                             " of %s with one of the seeds %" PRIu64 " and %" PRIu64 ", not both",
                             scene->name, seed->lists.items[i].view.name,
                             seed->lists.items[i].frame, stream, scene->seeds.items[0].seed,
                             seed->seed);
    return 0;
}

static int check_scene(const struct ensemble_scene *scene, const struct ensemble_seed *first,
                       const char *stream, struct diag *diag)
{
    if (scene->seeds.count < FEWEST_SEEDS)
        return diag_fail(diag, DIAG_DATA, "scene \"%s\": seeds in %s: %zu; expected at least %d",
                         scene->name, stream, scene->seeds.count, FEWEST_SEEDS);
    for (size_t i = 0; i < scene->seeds.count; i++) {
        const struct ensemble_seed *seed = &scene->seeds.items[i];
        if (!same_lists(first, seed))
            return diag_fail(
                diag, DIAG_DATA,
                "scene \"%s\": seed %" PRIu64
                " in %s has other frames, times or sensors than the first seed of the truth",
                scene->name, seed->seed, stream);
        if (check_measured(scene, seed, stream, diag) != 0)
            return -1;
    }
    return 0;
}

/* The sensors of the truth have the same cells with a width for all seeds. */
static int check_cells(const struct ensemble_scene *truth, struct diag *diag)
{
    const struct ensemble_seed *first = &truth->seeds.items[0];
    for (size_t k = 0; k < first->lists.count; k++) {
        const struct sensor_view *view = &first->lists.items[k].view;
        if (!target_score_has_cells(view))
            return diag_fail(diag, DIAG_DATA,
                             "scene \"%s\": the truth's sensor \"%s\" has cells of %g m by %g m/s "
                             "in a view of %g rad; distances in cells need more than 0",
                             truth->name, view->name, view->cell_range_m, view->cell_range_rate_mps,
                             view->field_of_view_rad);
        for (size_t i = 1; i < truth->seeds.count; i++)
            if (!same_cells(view, &truth->seeds.items[i].lists.items[k].view))
                return diag_fail(diag, DIAG_DATA,
                                 "scene \"%s\": sensor \"%s\" of the truth has other cells with "
                                 "seed %" PRIu64 " than with seed %" PRIu64,
                                 truth->name, view->name, truth->seeds.items[i].seed, first->seed);
    }
    return 0;
}

/* Samples with the same seed share their draws: they are not independent. */
static int check_independence(const struct ensemble_scene *truth,
                              const struct ensemble_scene *listed, struct diag *diag)
{
    for (size_t i = 0; i < truth->seeds.count; i++)
        for (size_t j = 0; j < listed->seeds.count; j++)
            if (truth->seeds.items[i].seed == listed->seeds.items[j].seed)
                return diag_fail(diag, DIAG_DATA,
                                 "scene \"%s\": seed %" PRIu64
                                 " stands in both streams; expected independent seeds",
                                 truth->name, truth->seeds.items[i].seed);
    return 0;
}

static struct embedded_list embed(const struct ensemble_list *list, const struct target_cell *unit,
                                  struct arena *arena)
{
    const double cell[EMBEDDED_AXES] = {unit->range_m, unit->azimuth_rad, unit->range_rate_mps,
                                        LEVEL_DB};
    struct embedded_list embedded = {0};
    for (size_t i = 0; i < list->targets.count; i++) {
        struct embedded_target *target = list_add(&embedded.targets, arena);
        for (int axis = 0; axis < EMBEDDED_AXES; axis++)
            target->axis[axis] = list->targets.items[i].axis[axis] / cell[axis];
    }
    energy_distance_close(&embedded, arena);
    return embedded;
}

struct embedded_list ensemble_embed(const struct frame *frame, const struct sensor_view *view,
                                    struct arena *arena)
{
    struct ensemble_list list = list_of(frame, view, arena);
    struct target_cell unit = target_score_cell(view, 0);
    return embed(&list, &unit, arena);
}

/* Sums the targets of a list over the seeds. */
static double count_targets(const struct ensemble_scene *scene, size_t list)
{
    double sum = 0;
    for (size_t i = 0; i < scene->seeds.count; i++)
        sum += (double)scene->seeds.items[i].lists.items[list].targets.count;
    return sum;
}

/* Counts the lists of both sides and of one alone, and the targets of the former. */
static struct ensemble_scene_score count_lists(const struct ensemble_scene *truth,
                                               const struct ensemble_scene *listed)
{
    struct ensemble_scene_score score = {
        .scene = truth->name,
        .true_seeds = (int64_t)truth->seeds.count,
        .listed_seeds = (int64_t)listed->seeds.count,
    };
    for (size_t k = 0; k < truth->seeds.items[0].lists.count; k++) {
        score.true_lists += measured(truth, k) && !measured(listed, k);
        score.listed_lists += measured(listed, k) && !measured(truth, k);
        if (!measured(truth, k) || !measured(listed, k))
            continue;
        score.lists++;
        score.true_targets += count_targets(truth, k);
        score.listed_targets += count_targets(listed, k);
    }
    score.true_targets /= (double)(score.lists * score.true_seeds);
    score.listed_targets /= (double)(score.lists * score.listed_seeds);
    return score;
}

static int score_scene(const struct ensemble_scene *truth, const struct ensemble_scene *listed,
                       double azimuth_rad, struct arena *arena, struct ensemble_scene_score *score,
                       struct diag *diag)
{
    size_t ones = truth->seeds.count, all = ones + listed->seeds.count;
    *score = count_lists(truth, listed);
    if (score->lists == 0)
        return diag_fail(diag, DIAG_DATA, "scene \"%s\": no sensor measured in it on both sides",
                         truth->name);
    double *distance = arena_get(arena, all * all * sizeof *distance);
    struct embedded_list *embedded = arena_get(arena, all * sizeof *embedded);
    const struct embedded_list **list = arena_get(arena, all * sizeof *list);
    struct arena scratch = {0};
    for (size_t k = 0; k < truth->seeds.items[0].lists.count; k++) {
        if (!measured(truth, k) || !measured(listed, k))
            continue;
        struct target_cell unit =
            target_score_cell(&truth->seeds.items[0].lists.items[k].view, azimuth_rad);
        for (size_t i = 0; i < all; i++) {
            const struct ensemble_seed *seed =
                i < ones ? &truth->seeds.items[i] : &listed->seeds.items[i - ones];
            embedded[i] = embed(&seed->lists.items[k], &unit, &scratch);
            list[i] = &embedded[i];
        }
        energy_distance_add(list, all, 1 / (double)score->lists, distance);
        arena_clear(&scratch);
    }
    arena_free(&scratch);
    const struct energy_sample sample = {distance, ones, all - ones};
    struct relative_error energy = relative_error_of(&sample, NULL);
    score->energy = energy.value;
    score->energy_error = energy.deviation;
    score->low = energy.low;
    score->high = energy.high;
    return 0;
}

/* The percentile interval over resampled scenes. */
static void bootstrap(struct ensemble_score *score, struct arena *arena)
{
    size_t count = score->scenes.count;
    double *means = arena_get(arena, RESAMPLES * sizeof *means);
    struct random_sequence draws =
        random_sequence_at((struct random_address){.seed = 1}, RANDOM_BOOTSTRAP);
    for (size_t i = 0; i < RESAMPLES; i++)
        for (size_t k = 0; k < count; k++) {
            int64_t drawn = random_sequence_whole(&draws, 0, (int64_t)count - 1);
            means[i] += score->scenes.items[drawn].energy / (double)count;
        }
    sort_numbers(means, RESAMPLES, arena);
    score->low = means[RESAMPLES / 40];
    score->high = means[RESAMPLES - 1 - RESAMPLES / 40];
}

int ensemble_compare(const struct ensemble *truth, struct ensemble *listed, double azimuth_cell_rad,
                     struct arena *arena, struct ensemble_score *score, struct diag *diag)
{
    *score = (struct ensemble_score){0};
    if (truth->scenes.count != listed->scenes.count || truth->scenes.count == 0)
        return diag_fail(
            diag, DIAG_DATA,
            "scenes: %zu in the stream, %zu in the truth; expected the same, at least 1",
            listed->scenes.count, truth->scenes.count);
    for (size_t i = 0; i < truth->scenes.count; i++) {
        const struct ensemble_scene *scene = &truth->scenes.items[i];
        const struct ensemble_scene *other = scene_of(listed, scene->name);
        const struct ensemble_seed *first = &scene->seeds.items[0];
        if (other->seeds.count == 0)
            return diag_fail(diag, DIAG_DATA, "scene \"%s\": in the truth, not in the stream",
                             scene->name);
        if (check_scene(scene, first, "the truth", diag) != 0 ||
            check_scene(other, first, "the stream", diag) != 0 || check_cells(scene, diag) != 0 ||
            check_independence(scene, other, diag) != 0 ||
            score_scene(scene, other, azimuth_cell_rad, arena, list_add(&score->scenes, arena),
                        diag) != 0)
            return -1;
    }
    for (size_t i = 0; i < score->scenes.count; i++)
        score->energy += score->scenes.items[i].energy / (double)score->scenes.count;
    score->low = score->scenes.items[0].low;
    score->high = score->scenes.items[0].high;
    if (score->scenes.count > 1)
        bootstrap(score, arena);
    return 0;
}

void ensemble_table(const struct ensemble_score *score, struct text *text)
{
    int64_t true_lists = 0, listed_lists = 0;
    struct text rows = {0};
    text_add_word(&rows, "scene\tlists\ttargets\tin truth\tD\terror\n");
    for (size_t i = 0; i < score->scenes.count; i++) {
        const struct ensemble_scene_score *scene = &score->scenes.items[i];
        text_format(&rows, "%s\t%" PRId64 "\t%.2f\t%.2f\t%.5f\t%.5f\n", scene->scene, scene->lists,
                    scene->listed_targets, scene->true_targets, scene->energy, scene->energy_error);
        true_lists += scene->true_lists;
        listed_lists += scene->listed_lists;
    }
    text_table_write(&rows, (int[]){-32, 7, 8, 8, 10, 0}, "", text);
    if (true_lists + listed_lists > 0)
        text_format(text,
                    "not compared: %" PRId64 " lists of the truth alone, %" PRId64
                    " of the scored stream alone\n",
                    true_lists, listed_lists);
    text_format(text, "mean %.5f, 95 %% interval %.5f to %.5f\n", score->energy, score->low,
                score->high);
}
