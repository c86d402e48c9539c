/* Is it sound to choose effects from the scene? Random scenes are seen with every effect and with
 * those that a planner chose, in this process and without text. A planner is a way to choose
 * effects: auto, or auto without one of them. What judges keeps an account of every echo and a log
 * of every effect, which switch shortcuts off; both words are compared with it again as users run
 * them, without account and log.
 *
 * Frame number n is that of glint-traffic-random (or, of the tests' own, glint-traffic-adversarial)
 * --draw-conditions --first n --frames 1 with the same options; --first n --frames 1 --print writes
 * it, for the chain to read. The output is one JSON line: per planner the violations, the first of
 * them, how often each effect was simulated and left out, and the time. Exit status 1 if there is a
 * violation. */
#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "compare.h"
#include "effects/effect.h"
#include "frame/frame_text.h"
#include "planted.h"
#include "run/options.h"
#include "run/progress.h"
#include "run/runner.h"
#include "run/stage.h"
#include "traffic/random_traffic.h"

enum { STEPS = 3, SHOWN = 5 };
static const char *const steps[STEPS] = {"ideal", "sensor", "noise"};

struct finding {
    int64_t frame;
    char what[160];
};

/* One way to choose effects, with the stages that work by it and what it has found. */
struct planner {
    const char *effects;
    bool plain; /* keeps neither account nor log */
    struct runner runners[STEPS];
    struct effect_log logs[STEPS];
    struct arena arena;
    struct frame frame;
    int64_t frames, violations, spent_ns;
    struct finding findings[SHOWN];
};

enum planners { PLANNERS_AUTO, PLANNERS_DROPS };
static const char *const planner_choices[] = {"auto", "drops", NULL};

struct soundness {
    int density;
    const char *sensors;
    int64_t first, frames;
    enum planners planners;
    const char *without, *only;
    bool margins, until_caught, print;
};

struct bench {
    const struct soundness *wanted;
    struct runner source, extract;
    struct arena arena, documents;
    struct frame scene;
    /* The first simulates all effects; its frames judge the others. */
    struct planner planners[EFFECT_COUNT + 1];
    size_t count;
};

enum { ADVERSARIAL = TRAFFIC_DENSITIES };
static const char *const densities[] = {"sparse", "medium", "dense", "adversarial", NULL};

static const struct field soundness_options[] = {
    {FIELD_CHOICE_OF(struct soundness, density, densities, "of the scenes"), FIELD_OPTIONAL},
    {FIELD_NAME_OF(struct soundness, sensors, "the suite")},
    {FIELD_INTEGER_IN(struct soundness, first, 0, 1e9, "number of the first scene"),
     FIELD_OPTIONAL},
    {FIELD_INTEGER_IN(struct soundness, frames, 0, 1e9, "how many scenes; absent: 1000"),
     FIELD_OPTIONAL, .absent = 1000},
    {FIELD_CHOICE_OF(struct soundness, planners, planner_choices,
                     "auto, or for every effect one that always drops it"),
     FIELD_OPTIONAL},
    {FIELD_NAME_OF(struct soundness, without,
                   "effects that nobody simulates, such as -occlusion,-rows"),
     FIELD_OPTIONAL, .word = "LIST"},
    {FIELD_NAME_OF(struct soundness, only,
                   "only scenes in which every object is of one of these classes: car,van"),
     FIELD_OPTIONAL, .word = "LIST"},
    {FIELD_FLAG_OF(struct soundness, margins, "targets and lost tell margins too"), FIELD_OPTIONAL},
    {FIELD_FLAG_OF(struct soundness, until_caught,
                   "a planner with a violation needs no more scenes"),
     FIELD_OPTIONAL},
    {FIELD_FLAG_OF(struct soundness, print, "write the scenes, and compare nothing"),
     FIELD_OPTIONAL},
    {0},
};

static const struct record soundness_record = {
    .name = "soundness", .size = sizeof(struct soundness), .fields = soundness_options};

static int no_frames(void *state, struct frame *frame, struct runner *runner)
{
    (void)state, (void)frame, (void)runner;
    return 0;
}

static const struct stage soundness = {
    .name = "soundness",
    .summary = "Compare what planners leave out with what simulating every effect says.",
    .options = &soundness_record,
    .next = no_frames,
};

static int64_t now_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

static int refuse(struct runner *runner)
{
    diag_print(runner->stage->name, &runner->diag);
    return -1;
}

static int start_stage(struct runner *runner, const char *name, const char *const *words)
{
    const struct stage *const *stage = stages;
    size_t count = 0;
    while (strcmp((*stage)->name, name) != 0)
        stage++;
    while (words[count] != NULL)
        count++;
    return runner_prepare(runner, *stage, count, words) == 0 && runner_start(runner) == 0
               ? 0
               : refuse(runner);
}

static int start_scenes(struct bench *bench)
{
    const struct soundness *wanted = bench->wanted;
    char first[24], frames[24];
    snprintf(first, sizeof first, "%" PRId64, wanted->first);
    snprintf(frames, sizeof frames, "%" PRId64, wanted->frames);
    bool adversarial = wanted->density == ADVERSARIAL;
    const char *around = adversarial ? wanted->sensors : densities[wanted->density];
    bench->scene.arena = &bench->arena;
    return start_stage(&bench->source, adversarial ? "traffic-adversarial" : "traffic-random",
                       (const char *const[]){adversarial ? "--sensors" : "--density", around,
                                             "--rate-hz", "10", /* a scan in every frame */
                                             "--first", first, "--frames", frames,
                                             "--draw-conditions", NULL}) == 0
               ? start_stage(&bench->extract, "extract", (const char *const[]){NULL})
               : -1;
}

/* Starts glint-ideal with its options. The stages after it read theirs off the frame, but for the
 * place of the suite. */
static int start_step(struct planner *planner, int step, const struct soundness *wanted)
{
    const char *sections = wanted->margins ? "account,margins" : "account";
    if (planner->plain)
        sections = wanted->margins ? "margins" : NULL;
    const char *const of_ideal[] = {"--sensors",
                                    wanted->sensors,
                                    "--effects",
                                    planner->effects,
                                    sections != NULL ? "--sections" : NULL,
                                    sections,
                                    NULL};
    const char *const of_others[] = {"--sensors", wanted->sensors, NULL};
    return start_stage(&planner->runners[step], steps[step], step == 0 ? of_ideal : of_others);
}

static int start_planner(struct planner *planner, const struct bench *bench, const char *effects,
                         bool plain)
{
    *planner = (struct planner){.effects = effects, .plain = plain};
    for (int i = 0; i < STEPS; i++) {
        if (start_step(planner, i, bench->wanted) != 0)
            return -1;
        planner->runners[i].log = plain ? NULL : &planner->logs[i];
    }
    return 0;
}

/* Adds the next planner: the word (auto or all) without the effects that nobody simulates and
 * without one more. */
static int add_planner(struct bench *bench, const char *word, const char *but, bool plain)
{
    const char *without = bench->wanted->without;
    size_t size = FIELD_NAME_SIZE;
    char *effects = arena_get(&bench->documents, size);
    snprintf(effects, size, "%s%s%s%s%s", word, without != NULL ? "," : "",
             without != NULL ? without : "", but != NULL ? ",-" : "", but != NULL ? but : "");
    return start_planner(&bench->planners[bench->count++], bench, effects, plain);
}

static int start(struct bench *bench)
{
    enum planners planners = bench->wanted->planners;
    if (start_scenes(bench) != 0 || add_planner(bench, "all", NULL, false) != 0)
        return -1;
    if (planners == PLANNERS_AUTO)
        return add_planner(bench, "auto", NULL, false) == 0 &&
                       add_planner(bench, "all", NULL, true) == 0
                   ? add_planner(bench, "auto", NULL, true)
                   : -1;
    for (int i = 0; i < EFFECT_COUNT; i++)
        if (add_planner(bench, "auto", effects_names[i], false) != 0)
            return -1;
    return 0;
}

/* Runs the chain over a planner's own copy of the scene's frame; the scene itself is shared. */
static int run(struct planner *planner, const struct frame *scene)
{
    struct frame *frame = &planner->frame;
    planted_begin();
    arena_clear(&planner->arena);
    *frame = *scene;
    frame->arena = &planner->arena;
    int64_t begin_ns = now_ns();
    for (int i = 0; i < STEPS; i++)
        if (runner_step(&planner->runners[i], frame) != 0)
            return refuse(&planner->runners[i]);
    planner->spent_ns += now_ns() - begin_ns;
    planner->frames++;
    return 0;
}

static void judge(const struct frame *all, int64_t number, struct planner *planner)
{
    struct diag diag = {0};
    if (compare_bits(all, &planner->frame, !planner->plain, &diag) == 0)
        return;
    if (planner->violations < SHOWN) {
        struct finding *finding = &planner->findings[planner->violations];
        finding->frame = number;
        snprintf(finding->what, sizeof finding->what, "%.*s", (int)sizeof finding->what - 1,
                 diag.text);
    }
    planner->violations++;
}

static bool lists(const char *names, const char *name)
{
    size_t length = strlen(name);
    for (;; names++) {
        size_t word = strcspn(names, ",");
        if (word == length && memcmp(names, name, length) == 0)
            return true;
        names += word;
        if (*names == '\0')
            return false;
    }
}

/* True if every object is of a class that is asked for; the class of the ego does not count. */
static bool wants(const struct soundness *wanted, const struct frame *scene)
{
    for (size_t i = 1; i < scene->objects.count && wanted->only != NULL; i++)
        if (!lists(wanted->only, scene->objects.items[i].class))
            return false;
    return true;
}

static int print(struct bench *bench)
{
    struct text text = {0};
    int result = frame_text_write(&bench->scene, &text, &bench->source.diag);
    fwrite(text.bytes, 1, text.length, stdout);
    text_free(&text);
    return result == 0 ? 1 : refuse(&bench->source);
}

/* Puts two strips at random places around the ego of one scene in ten. */
static void add_roadside(struct frame *scene)
{
    struct random_sequence sequence =
        random_sequence_at(frame_draw_address_of_scene(scene), RANDOM_OWN);
    const struct object *ego = frame_object(scene, scene->ego);
    if (ego == NULL || !random_sequence_chance(&sequence, 0.1))
        return;
    for (int i = 0; i < 2; i++) {
        struct roadside_strip *strip = list_add(&scene->roadside, scene->arena);
        field_clear(&roadside_strip_record, strip);
        strip->kind = (enum roadside_kind)random_sequence_whole(&sequence, ROADSIDE_RAIL,
                                                                ROADSIDE_VEGETATION);
        strip->from_x_m = ego->x_m + random_sequence_between(&sequence, -60, 60);
        strip->from_y_m = ego->y_m + random_sequence_between(&sequence, -60, 60);
        strip->to_x_m = ego->x_m + random_sequence_between(&sequence, -60, 60);
        strip->to_y_m = ego->y_m + random_sequence_between(&sequence, -60, 60);
        if (strip->kind == ROADSIDE_VEGETATION)
            strip->width_m = random_sequence_between(&sequence, 0, 10);
    }
}

/* Compares one scene. Returns 1 after a scene, 0 if no planner needs another one. */
static int visit(struct bench *bench, int64_t number)
{
    int needed = 0;
    struct planner *all = &bench->planners[0];
    if (runner_next(&bench->source, &bench->scene) != 1)
        return refuse(&bench->source);
    if (!wants(bench->wanted, &bench->scene))
        return 1;
    add_roadside(&bench->scene);
    if (bench->wanted->print)
        return print(bench);
    if (runner_step(&bench->extract, &bench->scene) != 0)
        return refuse(&bench->extract);
    if (run(all, &bench->scene) != 0)
        return -1;
    for (size_t i = 1; i < bench->count; i++) {
        struct planner *planner = &bench->planners[i];
        if (bench->wanted->until_caught && planner->violations > 0)
            continue;
        if (run(planner, &bench->scene) != 0)
            return -1;
        judge(&all->frame, number, planner);
        needed = 1;
    }
    return needed;
}

static void tell_effects(struct text *text, const struct planner *planner)
{
    const char *comma = "";
    text_add_word(text, ",\"effects\":{");
    for (int i = 0; i < EFFECT_COUNT; i++)
        for (int j = 0; j < STEPS; j++) {
            const struct effect_log *log = &planner->logs[j];
            if (strcmp(effect_homes[effect_table[i]->home], steps[j]) != 0)
                continue;
            text_format(text,
                        "%s\"%s\":{\"scans\":%" PRId64 ",\"simulated\":%" PRId64
                        ",\"left_out\":%" PRId64 "}",
                        comma, effects_names[i], log->scans, log->scans_simulated[i],
                        log->scans_left_out[i]);
            comma = ",";
        }
    text_add_word(text, "}");
}

static void tell_planner(struct text *text, const struct planner *planner)
{
    text_format(text,
                "{\"planned\":\"%s\",\"plain\":%s,\"frames\":%" PRId64 ",\"ns\":%" PRId64
                ",\"violations\":%" PRId64 ",\"first_violations\":[",
                planner->effects, planner->plain ? "true" : "false", planner->frames,
                planner->spent_ns, planner->violations);
    for (int64_t i = 0; i < planner->violations && i < SHOWN; i++) {
        const struct finding *finding = &planner->findings[i];
        text_format(text, "%s{\"frame\":%" PRId64 ",\"what\":", i > 0 ? "," : "", finding->frame);
        text_add_json(text, finding->what, strlen(finding->what));
        text_add_word(text, "}");
    }
    text_add_word(text, "]");
    tell_effects(text, planner);
    text_add_word(text, "}");
}

static void tell(const struct bench *bench)
{
    const struct soundness *wanted = bench->wanted;
    struct text text = {0};
    text_format(&text, "{\"density\":\"%s\",\"sensors\":", densities[wanted->density]);
    text_add_json(&text, wanted->sensors, strlen(wanted->sensors));
    text_format(&text, ",\"first\":%" PRId64 ",\"frames\":%" PRId64 ",\"planners\":[",
                wanted->first, bench->planners[0].frames);
    for (size_t i = 0; i < bench->count; i++) {
        text_add_word(&text, i > 0 ? "," : "");
        tell_planner(&text, &bench->planners[i]);
    }
    text_add_word(&text, "]}\n");
    fwrite(text.bytes, 1, text.length, stdout);
    text_free(&text);
}

static void free_planner(struct planner *planner)
{
    for (int i = 0; i < STEPS; i++)
        runner_free(&planner->runners[i]);
    arena_free(&planner->arena);
}

static void free_bench(struct bench *bench)
{
    for (size_t i = 0; i < bench->count; i++)
        free_planner(&bench->planners[i]);
    runner_free(&bench->source);
    runner_free(&bench->extract);
    arena_free(&bench->arena);
    arena_free(&bench->documents);
}

/* Compares the scenes and prints the result; returns the exit status. */
static int prove(struct bench *bench)
{
    struct progress progress;
    int64_t frames = bench->wanted->frames, violations = 0;
    int more = start(bench) == 0 ? 1 : -1;
    progress_begin(&progress, "scenes");
    for (int64_t i = 0; i < frames && more == 1; i++) {
        more = visit(bench, bench->wanted->first + i);
        if (progress_step(&progress))
            progress_show(&progress, (double)progress.count / (double)frames);
    }
    progress_end(&progress);
    if (more < 0)
        return DIAG_INTERNAL;
    if (!bench->wanted->print)
        tell(bench);
    for (size_t i = 1; i < bench->count; i++)
        violations += bench->planners[i].violations;
    return violations > 0;
}

static int help(void)
{
    struct text text = {0};
    options_help(&soundness, &text);
    fwrite(text.bytes, 1, text.length, stdout);
    text_free(&text);
    return 0;
}

static int refuse_words(struct runner *own)
{
    refuse(own);
    return DIAG_USAGE;
}

int main(int count, char **words)
{
    static struct bench bench;
    struct soundness wanted;
    struct runner own = {.stage = &soundness};
    bench.wanted = &wanted;
    int result = options_read(&soundness, (size_t)count - 1, (const char *const *)words + 1,
                              &wanted, &own.common, &own.arena, &own.diag);
    int status = result != 0 ? refuse_words(&own) : own.common.help ? help() : prove(&bench);
    free_bench(&bench);
    runner_free(&own);
    return status;
}
