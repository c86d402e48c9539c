/* Checks that a stream is whole and that its labels agree with its truth. */
#include <inttypes.h>

#include "frame/frame_remade.h"
#include "frame/frame_sequence.h"
#include "run/suite_choice.h"
#include "run/tool.h"
#include "text/output.h"

struct check {
    const char *sensors, *extract;
    struct runner *runner;
    struct runner *extraction, *ideal; /* that make the echoes again; NULL: not begun */
    const char *key;                   /* of ideal's suite and effects */
    struct diag unknown;               /* why echoes of a frame could not be made again */
    struct frame_sequence sequence;
    struct frame_remade counts; /* numbers of checked labels */
    int64_t frames, targets, every;
};

/* Begins ideal anew where a frame has another suite or other effects than the one before. */
static void begin_ideal(struct check *own, const struct frame *frame)
{
    struct arena *arena = runner_arena(own->runner);
    const struct sensors *now = &frame->sensors;
    const char *effects = now->effects != NULL ? now->effects : "auto";
    const char *key = arena_format(frame->arena, "%s %s", now->digest, effects);
    if (own->key != NULL && strcmp(own->key, key) == 0)
        return;
    const struct suite *suite = suite_choice_of_frame(own->runner, frame);
    struct suite_choice choice = {suite != NULL ? suite->given : NULL,
                                  arena_text(arena, effects, strlen(effects))};
    own->key = arena_text(arena, key, strlen(key));
    own->ideal = suite == NULL ? NULL
                               : runner_trial(own->runner, stage_by_name("ideal"), &choice,
                                              sizeof choice, NULL);
}

/* Makes the echoes of the frame's objects again. False without the documents that made them. */
static bool remake(struct check *own, const struct frame *frame, struct frame *again)
{
    struct diag *diag = runner_diag(own->runner);
    *again = *frame;
    frame_drop(again, ~(unsigned)(PART_OBJECTS | PART_REFLECTORS | PART_VEHICLES));
    again->sections = CARRY_BY_DEFAULT | (frame->sections & (CARRY_ACCOUNT | CARRY_VISIBILITY));
    begin_ideal(own, frame);
    bool made = own->ideal != NULL &&
                ((frame->present & PART_REFLECTORS) != 0 ||
                 runner_try(own->runner, own->extraction, again) == 0) &&
                runner_try(own->runner, own->ideal, again) == 0;
    if (own->unknown.code == DIAG_OK)
        own->unknown = *diag;
    *diag = (struct diag){0};
    return made;
}

static int check_labels(struct check *own, const struct frame *frame, struct diag *diag)
{
    struct frame again;
    bool due = own->every > 0 && (own->frames - 1) % own->every == 0;
    bool known = due && frame->objects.count > 0 && remake(own, frame, &again);
    return frame_remade_check(frame, known ? &again : NULL, &own->counts, diag);
}

static int check_all(struct check *own, struct diag *diag)
{
    struct frame *frame;
    int more;
    while ((more = runner_frame(own->runner, &frame)) > 0) {
        own->frames++;
        own->targets += (int64_t)frame->targets.count;
        if (frame_sequence_follow(&own->sequence, frame, runner_place(own->runner),
                                  runner_arena(own->runner), diag) != 0 ||
            check_labels(own, frame, diag) != 0)
            return -1;
    }
    return more == 0 ? frame_sequence_end(&own->sequence, diag) : more;
}

static int print(const struct check *own, struct output *output)
{
    struct text *text = output_text(output);
    text_format(text,
                "%" PRId64 " frames, %" PRId64 " targets; %" PRId64 " of %" PRId64
                " contributors recomputed\n",
                own->frames, own->targets, own->counts.recomputed, own->counts.contributors);
    if (own->unknown.code != DIAG_OK)
        text_format(text, "not all could be recomputed: %s\n", own->unknown.text);
    return output_send(output, runner_diag(own->runner));
}

static int check_run(void *state, struct runner *runner)
{
    struct check *own = state;
    own->runner = runner;
    const struct stage *extract = stage_by_name(own->extract != NULL ? own->extract : "extract");
    if (extract == NULL)
        return diag_fail(
            runner_diag(runner), DIAG_USAGE,
            "--extract: there is no stage \"%s\"; expected extract-contour or the like",
            own->extract);
    if (own->sensors != NULL && suite_choice_load(runner, own->sensors) == NULL)
        return -1;
    own->extraction = runner_trial(runner, extract, NULL, 0, NULL);
    struct output *output = runner_output(runner);
    int result = output != NULL ? check_all(own, runner_diag(runner)) : -1;
    return result == 0 ? print(own, output) : result;
}

static const struct field check_options[] = {
    {OPTIONAL_NAME(struct check, sensors, "path of the suite, if it is not found by its name")},
    {OPTIONAL_INTEGER(struct check, every, 0, 1e9,
                      "compute the labels of every N-th frame again; 0: of no frame; absent: 1"),
     .word = "N", .absent = 1},
    {OPTIONAL_NAME(struct check, extract,
                   "stage that wrote the reflectors: extract-3gpp, for instance; absent: extract")},
    {0},
};

const struct stage stage_check = {
    .name = "check",
    .summary = "Check that a stream is whole and its labels agree with its truth.",
    .details =
        "Checks every line against the schema and its bounds, that every scene has all its frames "
        "from 0 to the last, and that every account adds up. Then computes the echoes again from "
        "the objects and compares the labels, the lost echoes with their reasons and places, the "
        "counts and the visibility with them, to a relative 1e-9. The first fault ends the check "
        "with status 65. scripts/check-set checks tables and sets.",
    .options = STAGE_OPTIONS(struct check, check_options),
    .reads = PART_SENSORS | PART_TARGETS,
    .run = check_run,
};
