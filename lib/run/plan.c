#include "run/plan.h"

#include <inttypes.h>

#include "effects/effect.h"
#include "frame/frame_text.h"
#include "run/tool.h"
#include "text/document.h"

static const struct plan_position chain[PLAN_POSITIONS] = {
    [PLAN_IDEAL] = {.program = "glint-ideal", .section = SECTION_ECHOES},
    [PLAN_SENSOR] = {.program = "glint-sensor",
                     .stand_in = "glint-sensor-perfect",
                     .section = SECTION_CELLS},
    [PLAN_NOISE] = {.program = "glint-noise",
                    .stand_in = "glint-noise-none",
                    .section = SECTION_TARGETS},
};

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

const char *plan_request(uint64_t allowed, struct arena *arena)
{
    return list_names("auto", ",-", ~allowed, arena);
}

const char *plan_names(uint64_t effects, struct arena *arena)
{
    return effects == 0 ? "none" : list_names("", ",", effects, arena);
}

static struct runner *trial(const char *program, const struct suite_choice *choice,
                            struct effect_log *log, struct runner *runner)
{
    return runner_trial(runner, stage_by_name(stage_name_in_path(program)), choice, log);
}

int plan_begin(struct plan *plan, const struct suite_choice *choice, struct runner *runner)
{
    struct sensors request;
    struct selection selection;
    struct diag *diag = runner_diag(runner);
    const struct suite *suite = suite_choice_load(runner, choice->sensors);
    if (suite == NULL || suite_choice_request(choice, suite, &request, diag) != 0 ||
        effects_read(request.effects, &selection, diag) != 0)
        return -1;
    suite_choice_doubt(runner, suite);
    struct suite_choice planned = {choice->sensors,
                                   plan_request(selection.allowed, runner_arena(runner))};
    *plan = (struct plan){
        .sensors = choice->sensors,
        .request = strcmp(planned.effects, "auto") == 0 ? "auto" : request.effects,
        .allowed = selection.allowed,
        .runner = runner,
        .extract = trial("glint-extract", NULL, NULL, runner),
    };
    for (int i = 0; i < PLAN_POSITIONS; i++) {
        struct plan_position *position = &plan->positions[i];
        *position = chain[i];
        position->tried =
            trial(position->program, i == PLAN_IDEAL ? &planned : NULL, &position->log, runner);
        if (position->stand_in != NULL)
            position->simpler = trial(position->stand_in, NULL, NULL, runner);
    }
    return 0;
}

static bool same_bytes(const struct frame *a, const struct frame *b, unsigned section)
{
    struct frame one = *a, other = *b;
    struct text one_text = {0}, other_text = {0};
    struct diag unused = {0};
    frame_drop(&one, ~section);
    frame_drop(&other, ~section);
    bool same = frame_text_write(&one, &one_text, &unused) == 0 &&
                frame_text_write(&other, &other_text, &unused) == 0 &&
                one_text.length == other_text.length &&
                memcmp(one_text.bytes, other_text.bytes, one_text.length) == 0;
    text_free(&one_text);
    text_free(&other_text);
    return same;
}

void plan_compare(struct plan_position *position, const struct frame *made,
                  const struct frame *stand_in_made, struct arena *arena)
{
    if (same_bytes(made, stand_in_made, position->section))
        return;
    position->differs = true;
    position->scene = arena_text(arena, made->scene, strlen(made->scene));
    position->frame = made->frame;
}

static int try_position(struct plan *plan, struct plan_position *position, struct frame *frame)
{
    struct frame copy = *frame;
    frame_drop(&copy, SECTION_LOST | SECTION_COUNTS);
    if (runner_try(plan->runner, position->tried, frame) != 0)
        return -1;
    if (position->stand_in == NULL || position->differs)
        return 0;
    if (runner_try(plan->runner, position->simpler, &copy) != 0)
        return -1;
    plan_compare(position, frame, &copy, runner_arena(plan->runner));
    return 0;
}

int plan_try(struct plan *plan, struct frame *frame)
{
    plan->frames++;
    frame_drop(frame, SECTION_SENSORS | SECTION_ECHOES | SECTION_CELLS | SECTION_TARGETS |
                          SECTION_LOST | SECTION_COUNTS | SECTION_VISIBILITY);
    frame->sections = CARRY_BY_DEFAULT;
    if ((frame->present & SECTION_REFLECTORS) == 0 &&
        runner_try(plan->runner, plan->extract, frame) != 0)
        return -1;
    for (int i = 0; i < PLAN_POSITIONS; i++)
        if (try_position(plan, &plan->positions[i], frame) != 0)
            return -1;
    return 0;
}

/* Whether the stand-in may take the stage's place: it wrote the same bytes in all frames. */
static bool stands_in(const struct plan_position *position)
{
    return position->stand_in != NULL && !position->differs;
}

uint64_t plan_effects(const struct plan *plan)
{
    uint64_t effects = 0;
    for (int at = 0; at < PLAN_POSITIONS; at++) {
        const struct plan_position *position = &plan->positions[at];
        for (int i = 0; i < EFFECT_COUNT && !stands_in(position); i++)
            if (position->log.scans_simulated[i] > 0)
                effects |= EFFECT_BIT(i);
    }
    return effects;
}

/* The log of the stage where the effect is at home: the others do not note it. */
static const struct effect_log *log_of(const struct plan *plan, int effect)
{
    static const int position[] = {[EFFECT_HOME_IDEAL] = PLAN_IDEAL,
                                   [EFFECT_HOME_SENSOR] = PLAN_SENSOR,
                                   [EFFECT_HOME_NOISE] = PLAN_NOISE};
    return &plan->positions[position[effect_table[effect]->home]].log;
}

static void write_effect(const struct plan *plan, int effect, bool all, struct text *text)
{
    const struct effect *entry = effect_table[effect];
    const struct effect_log *log = log_of(plan, effect);
    const char *left_out = log->scans_left_out[effect] > 0 ? entry->left_out_when : NULL;
    text_format(text, "# %-17s ", effects_names[effect]);
    if ((plan->allowed & EFFECT_BIT(effect)) == 0)
        text_add_word(text, "off: not asked for\n");
    else if (log->scans_simulated[effect] > 0)
        text_format(text, "on in %" PRId64 " of %" PRId64 " scans: %s%s%s\n",
                    log->scans_simulated[effect], log->scans, entry->cause,
                    all && left_out != NULL ? "; in the others " : "",
                    all && left_out != NULL ? left_out : "");
    else if (left_out != NULL)
        text_format(text, "off: %s\n", left_out);
    else
        text_format(text, "off: nothing describes it (%s)\n", entry->cause);
}

static void write_stage(const struct plan_position *position, struct text *text)
{
    text_format(text, "# %s ", position->program);
    if (position->stand_in == NULL) {
        text_add_word(text, "stays: no simpler stage stands in for it\n");
        return;
    }
    bool replaced = stands_in(position);
    text_format(text, "%s: %s writes ", replaced ? "goes" : "stays", position->stand_in);
    if (position->differs) {
        text_format(text, "other %s, first in frame %" PRId64 " of scene ",
                    frame_section_name(position->section), position->frame);
        text_add_json(text, position->scene, strlen(position->scene));
    } else {
        text_format(text, "the same %s", frame_section_name(position->section));
    }
    text_add_word(text, "\n");
}

/* Writes the word so that bash and glint read it back as it is, in quotes if need be. */
static void write_word(const char *word, struct text *text)
{
    static const char plain[] =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./-";
    if (word[strspn(word, plain)] == '\0') {
        text_add_word(text, word);
        return;
    }
    text_add_word(text, "'");
    for (; *word != '\0'; word++)
        text_add(text, *word == '\'' ? "'\\''" : word, *word == '\'' ? 4 : 1);
    text_add_word(text, "'");
}

void plan_write_pipeline(const char *sensors, const char *effects, const char *const *programs,
                         size_t count, struct text *text)
{
    text_add_word(text, "set -o pipefail\nglint-extract \\\n  | glint-ideal --sensors ");
    write_word(sensors, text);
    text_format(text, " --effects %s", effects);
    for (size_t i = 0; i < count; i++) {
        text_format(text, " \\\n  | %s", programs[i]);
        if (!document_is_plain(sensors)) {
            text_add_word(text, " --sensors ");
            write_word(sensors, text);
        }
    }
    text_add_word(text, "\n");
}

static void write_effects(const struct plan *plan, bool all, struct text *text)
{
    int off = 0;
    for (int i = 0; i < EFFECT_COUNT; i++) {
        bool on = log_of(plan, i)->scans_simulated[i] > 0;
        off += !on;
        if (on || all)
            write_effect(plan, i, all, text);
    }
    if (off > 0 && !all)
        text_format(text, "# %d others are off; --all says why\n", off);
}

void plan_write(const struct plan *plan, bool all, struct arena *arena, struct text *text)
{
    if (plan->frames == 0)
        return;
    text_format(text, "# What these %" PRId64 " frames need, and why.\n", plan->frames);
    write_effects(plan, all, text);
    text_add_word(text, "# glint-extract stays: no simpler stage stands in for it\n");
    for (int i = 0; i < PLAN_POSITIONS; i++)
        write_stage(&plan->positions[i], text);
    const char *programs[PLAN_POSITIONS];
    for (int i = 0; i < PLAN_POSITIONS; i++) {
        const struct plan_position *position = &plan->positions[i];
        programs[i] = stands_in(position) ? position->stand_in : position->program;
    }
    plan_write_pipeline(plan->sensors, plan_names(plan_effects(plan), arena),
                        programs + PLAN_SENSOR, PLAN_POSITIONS - PLAN_SENSOR, text);
}
