/* Whether a stream is what it claims to be. */
#include <inttypes.h>

#include "frame/frame_order.h"
#include "frame/frame_sequence.h"
#include "run/fused.h"
#include "run/suite_choice.h"
#include "run/tool.h"
#include "text/output.h"

/* By so much, relative to its size, may a value differ from what is recomputed. */
static const double tolerance = 1e-9;

struct check {
    const char *sensors, *extract;
    bool partial;
    struct runner *runner;
    struct runner *extraction, *ideal; /* that make the echoes again; NULL: not begun */
    const char *key;                   /* of ideal's suite and effects */
    struct diag unknown;               /* why echoes of a frame could not be made again */
    struct frame_sequence sequence;
    int64_t frames, targets, contributors, recomputed;
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
    own->ideal =
        suite == NULL ? NULL : runner_trial(own->runner, fused_stage("ideal"), &choice, NULL);
}

/* Makes the echoes of the frame's objects again. False without the documents that made them. */
static bool remake(struct check *own, const struct frame *frame, struct frame *again)
{
    struct diag *diag = runner_diag(own->runner);
    *again = *frame;
    frame_drop(again, ~(unsigned)(SECTION_OBJECTS | SECTION_REFLECTORS | SECTION_VEHICLES));
    again->sections = CARRY_BY_DEFAULT | (frame->sections & (CARRY_ACCOUNT | CARRY_VISIBILITY));
    begin_ideal(own, frame);
    bool made = own->ideal != NULL &&
                ((frame->present & SECTION_REFLECTORS) != 0 ||
                 runner_try(own->runner, own->extraction, again) == 0) &&
                runner_try(own->runner, own->ideal, again) == 0;
    if (own->unknown.code == DIAG_OK)
        own->unknown = *diag;
    *diag = (struct diag){0};
    return made;
}

static int check_value(const char *member, double told, double truth, struct diag *diag)
{
    if (fabs(told - truth) <= tolerance * fabs(truth))
        return 0;
    return diag_fail(diag, DIAG_DATA, "%s: %.17g; recomputed, it is %.17g", member, told, truth);
}

/* All numbers of a struct must be those that are made again. */
static int check_numbers(const struct record *record, const void *told, const void *truth,
                         struct diag *diag)
{
    int result = 0;
    for (const struct field *field = record->fields; field->name != NULL && result == 0; field++)
        result =
            check_value(field->name, field_number(field, told), field_number(field, truth), diag);
    return result;
}

/* Sensors must be those of the suite. */
static int check_views(const struct frame *frame, const struct frame *again, struct diag *diag)
{
    for (size_t i = 0; i < frame->sensors.list.count && i < again->sensors.list.count; i++)
        if (check_numbers(&sensor_view_record, &frame->sensors.list.items[i],
                          &again->sensors.list.items[i], diag) != 0)
            return diag_prefix(diag, "sensors.list[%zu].", i);
    return 0;
}

static int check_count(const struct count *told, const struct count *truth, struct diag *diag)
{
    for (enum path path = PATH_DIRECT; path < PATH_WHEEL; path++)
        if (check_value("echoes", (double)frame_counted_echoes(told, path),
                        (double)frame_counted_echoes(truth, path), diag) != 0)
            return diag_prefix(diag, "paths: %s ", frame_paths[path]);
    return check_value("pairs", (double)told->pairs, (double)truth->pairs, diag);
}

/* What ideal counts: direct echoes, ghosts and reflectors in view. frame_check_account knows what
 * later stages count. */
static int check_counts(const struct frame *frame, struct frame *again, struct diag *diag)
{
    for (size_t i = 0; i < frame->counts.count && i < again->counts.count; i++)
        if (check_count(&frame->counts.items[i], &again->counts.items[i], diag) != 0)
            return diag_prefix(diag, "counts[%zu].", i);
    again->targets = frame->targets;
    sightings_count_targets(again);
    for (size_t i = 0; i < frame->visibility.count && i < again->visibility.count; i++)
        if (check_numbers(&sighting_record, &frame->visibility.items[i],
                          &again->visibility.items[i], diag) != 0)
            return diag_prefix(diag, "visibility[%zu].", i);
    return 0;
}

static int check_contributor(const struct contributor *told, const char *sensor,
                             const struct frame *again, struct check *own, struct diag *diag)
{
    struct echo_span echoes = frame_echoes_of(again, sensor);
    for (size_t i = 0; i < echoes.count; i++)
        if (frame_order_echo_ids(echoes.items[i].id, told->id) == 0) {
            struct contributor truth = frame_contributor(&echoes.items[i]);
            truth.weight = told->weight;
            own->recomputed++;
            return check_numbers(&contributor_record, told, &truth, diag);
        }
    bool made_later = told->id.path >= PATH_WHEEL; /* than by ideal: of a body, or of none */
    if (made_later &&
        (frame_object(again, told->id.object) != NULL) == frame_shows_object(told->id.path))
        return 0;
    return diag_fail(diag, DIAG_DATA, "reflector: the objects make no echo of \"%s\", \"%s\", %s",
                     told->id.object, told->id.reflector, frame_paths[told->id.path]);
}

static int check_target(const struct target *target, const struct frame *again, struct check *own,
                        struct diag *diag)
{
    double weights = 0;
    own->contributors += (int64_t)target->contributors.count;
    for (size_t i = 0; i < target->contributors.count; i++) {
        const struct contributor *told = &target->contributors.items[i];
        weights += told->weight;
        if (again != NULL && check_contributor(told, target->sensor, again, own, diag) != 0)
            return diag_prefix(diag, "contributors[%zu].", i);
    }
    if (fabs(weights - 1) <= tolerance)
        return 0;
    return diag_fail(diag, DIAG_DATA, "contributors: weights sum to %.17g; expected 1", weights);
}

static int check_group(const struct lost_group *told, const struct lost_group *due,
                       struct diag *diag)
{
    bool same = due != NULL && frame_order_lost_groups(told, due) == 0 &&
                told->echoes.count == due->echoes.count;
    for (size_t i = 0; same && i < told->echoes.count; i++) {
        const struct lost_echo *one = &told->echoes.items[i], *truth = &due->echoes.items[i];
        same = frame_order_echo_ids(one->id, truth->id) == 0;
        if (same && check_numbers(&lost_echo_record, one, truth, diag) != 0)
            return diag_prefix(diag, "echoes[%zu].", i);
    }
    return same ? 0 : diag_fail(diag, DIAG_DATA, "echoes: of these objects, ideal loses others");
}

/* What never became an echo is known from the objects: `again` has the losses of ideal alone. */
static int check_losses(const struct frame *frame, const struct frame *again, struct diag *diag)
{
    size_t known = 0;
    for (size_t i = 0; i < frame->lost.count; i++) {
        const struct lost_group *due = known < again->lost.count ? &again->lost.items[known] : NULL;
        bool of_ideal = strcmp(frame->lost.items[i].stage, "ideal") == 0;
        if (of_ideal && check_group(&frame->lost.items[i], due, diag) != 0)
            return diag_prefix(diag, "lost[%zu].", i);
        known += of_ideal;
    }
    return known == again->lost.count ? 0 : diag_fail(diag, DIAG_DATA, "lost: ideal loses more");
}

static int check_labels(struct check *own, const struct frame *frame, struct diag *diag)
{
    struct frame again;
    bool known = frame->objects.count > 0 && remake(own, frame, &again);
    if (known && (check_views(frame, &again, diag) != 0 || check_losses(frame, &again, diag) != 0))
        return -1;
    for (size_t i = 0; i < frame->targets.count; i++)
        if (check_target(&frame->targets.items[i], known ? &again : NULL, own, diag) != 0)
            return diag_prefix(diag, "targets[%zu].", i);
    return known ? check_counts(frame, &again, diag) : 0;
}

static int check_all(struct check *own, struct diag *diag)
{
    struct frame *frame;
    int more;
    while ((more = runner_frame(own->runner, &frame)) > 0) {
        own->frames++;
        own->targets += (int64_t)frame->targets.count;
        if ((own->partial ? frame_sequence_once
                          : frame_sequence_follow)(&own->sequence, frame, runner_place(own->runner),
                                                   runner_arena(own->runner), diag) != 0 ||
            check_labels(own, frame, diag) != 0)
            return -1;
    }
    return more == 0 && !own->partial ? frame_sequence_end(&own->sequence, diag) : more;
}

static int print(const struct check *own, struct output *output)
{
    struct text *text = output_text(output);
    text_format(text,
                "%" PRId64 " frames, %" PRId64 " targets; %" PRId64 " of %" PRId64
                " contributors recomputed\n",
                own->frames, own->targets, own->recomputed, own->contributors);
    if (own->unknown.code != DIAG_OK)
        text_format(text, "not all could be recomputed: %s\n", own->unknown.text);
    return output_send(output, runner_diag(own->runner));
}

static int check_run(void *state, struct runner *runner)
{
    struct check *own = state;
    own->runner = runner;
    const struct stage *extract = fused_stage(own->extract != NULL ? own->extract : "extract");
    if (extract == NULL)
        return diag_fail(
            runner_diag(runner), DIAG_USAGE,
            "--extract: there is no stage \"%s\"; expected extract-contour or the like",
            own->extract);
    if (own->sensors != NULL && suite_choice_load(runner, own->sensors) == NULL)
        return -1;
    own->extraction = runner_trial(runner, extract, NULL, NULL);
    struct output *output = runner_output(runner);
    int result = output != NULL ? check_all(own, runner_diag(runner)) : -1;
    return result == 0 ? print(own, output) : result;
}

static const struct field check_options[] = {
    {OPTIONAL_FLAG(struct check, partial, "scenes may lack frames and come in any order")},
    {OPTIONAL_NAME(struct check, sensors, "path of the suite, if it is not found by its name")},
    {OPTIONAL_NAME(struct check, extract,
                   "stage that wrote the reflectors, as extract-3gpp; absent: extract")},
    {0},
};

const struct tool tool_check = {
    .name = "check",
    .summary = "Check that a stream is whole and its labels agree with its truth.",
    .details =
        "Checks every line against the schema and its bounds, every scene for all its frames from "
        "0 to the last, and every account for its sums. Then computes the echoes again from the "
        "objects and compares with them, to a relative 1e-9, the labels, the lost echoes with "
        "their reasons and places, the counts and the visibility. The first fault ends the check "
        "with status 65. scripts/check-set checks tables and sets.",
    .options = STAGE_OPTIONS(struct check, check_options),
    .reads = SECTION_SENSORS | SECTION_TARGETS,
    .run = check_run,
};
