#include "run/suite_choice.h"

#include "documents/consistency.h"
#include "documents/suite_file.h"
#include "documents/usual_figures.h"
#include "effects/effect.h"
#include "frame/frame_check.h"
#include "propagation/ground_return.h"
#include "run/runner.h"
#include "text/path.h"

static const struct field suite_choice_fields[] = {SUITE_CHOICE_AFTER_IDEAL, {0}};

const struct record suite_choice_record = {
    .name = "stage", .size = sizeof(struct suite_choice), .fields = suite_choice_fields};

static const struct suite *load_suite(struct runner *runner, const char *name, struct diag *diag)
{
    const struct suite *suite = suite_file_load(name, &runner->arena, diag);
    if (suite != NULL)
        *list_add(&runner->suites, &runner->arena) = suite;
    return suite;
}

const struct suite *suite_choice_load(struct runner *runner, const char *name)
{
    const struct runner *at = runner;
    do {
        for (size_t i = 0; i < at->suites.count; i++)
            if (strcmp(at->suites.items[i]->given, name) == 0)
                return at->suites.items[i];
        at = at->before;
    } while (at != NULL);
    return load_suite(runner, name, &runner->diag);
}

/* Has a sensor before this one the same value of the member? */
static bool is_told(const struct suite *suite, size_t sensor, const struct usual_figure *figure)
{
    for (size_t i = 0; i < sensor; i++) {
        struct usual_figure before[USUAL_FIGURES_MOST];
        size_t count = usual_figures_list(&suite->sensors.items[i], before);
        for (size_t k = 0; k < count; k++)
            if (strcmp(before[k].member, figure->member) == 0 && before[k].value == figure->value)
                return true;
    }
    return false;
}

void suite_choice_doubt(struct runner *runner, const struct suite *suite)
{
    struct usual_figure unusual[USUAL_FIGURES_MOST];
    for (size_t i = 0; i < suite->sensors.count; i++) {
        size_t count = usual_figures_list(&suite->sensors.items[i], unusual);
        for (size_t k = 0; k < count; k++) {
            const struct usual_figure *one = &unusual[k];
            if (!is_told(suite, i, one))
                runner_notice(runner, arena_format(&runner->arena,
                                                   "%s: sensors[%zu].%s: doubt: %.*g%s; automotive "
                                                   "radars have %g to %g%s" DOUBT_ADVICE,
                                                   suite->given, i, one->member, CONSISTENCY_DIGITS,
                                                   one->value, one->unit, one->least, one->most,
                                                   one->unit));
        }
    }
}

static bool reflects(const struct frame *frame, const char *class)
{
    for (size_t i = 0; i < frame->reflectors.count; i++)
        if (frame_same_name(frame->reflectors.items[i].model, class))
            return true;
    return false;
}

/* A class of the frame's reflectors that is made for finer range cells, or NULL. */
static const struct class_document *too_fine(const struct frame *frame, double cell_m)
{
    for (size_t i = 0; i < frame->vehicles.count; i++) {
        const struct class_document *document = &frame->vehicles.items[i];
        if (document->cell_max_m > 0 && cell_m > (1 + CONSISTENCY_SLACK) * document->cell_max_m &&
            reflects(frame, document->class))
            return document;
    }
    return NULL;
}

bool suite_choice_doubt_cells(struct runner *runner, const struct suite *suite,
                              const struct frame *frame)
{
    for (size_t i = 0; i < suite->sensors.count; i++) {
        double cell_m = suite->sensors.items[i].bin_range_m;
        const struct class_document *document = too_fine(frame, cell_m);
        if (document == NULL)
            continue;
        runner_notice(runner,
                      arena_format(&runner->arena,
                                   "%s: sensors[%zu].cell_range_m: doubt: cells of %.7g m; the "
                                   "reflectors of the class \"%s\" are made for cells of at "
                                   "most %.7g m; for larger ones take --vehicles "
                                   "detailed",
                                   suite->given, i, cell_m, document->class, document->cell_max_m));
        return true;
    }
    return false;
}

static bool is_suite_of(const struct suite *suite, const struct frame *frame)
{
    return suite != NULL && strcmp(suite->name, frame->sensors.suite) == 0 &&
           strcmp(suite->digest, frame->sensors.digest) == 0;
}

static const struct suite *loaded_suite_of(const struct runner *runner, const struct frame *frame)
{
    for (; runner != NULL; runner = runner->before)
        for (size_t i = 0; i < runner->suites.count; i++)
            if (is_suite_of(runner->suites.items[i], frame))
                return runner->suites.items[i];
    return NULL;
}

/* The document of the frame's suite at that place, or NULL; with a message only where the document
 * could not be opened for want of a descriptor. */
static const struct suite *suite_at(struct runner *runner, const char *place,
                                    const struct frame *frame)
{
    struct diag fault = {0};
    const struct suite *suite = path_is_special(place) ? NULL : load_suite(runner, place, &fault);
    if (fault.code == DIAG_MEMORY)
        runner->diag = fault;
    return is_suite_of(suite, frame) ? suite : NULL;
}

const struct suite *suite_choice_of_frame(struct runner *runner, const struct frame *frame)
{
    const char *name = frame->sensors.suite;
    const struct suite *suite = loaded_suite_of(runner, frame);
    if (suite == NULL)
        suite = suite_at(runner, name, frame);
    if (suite == NULL)
        suite = suite_at(runner, arena_format(&runner->arena, "./%s.json", name), frame);
    if (suite == NULL)
        diag_fail(
            &runner->diag, DIAG_CONFIG,
            "sensors.suite: no \"%s\" among the documents or in the working folder is the one "
            "that the frame was seen with, %s; give its path (--sensors PATH), or set "
            "GLINT_DATA to a folder that has it as sensors/%s.json",
            name, frame->sensors.digest, name);
    return suite;
}

int suite_choice_request(const struct suite_choice *choice, const struct suite *suite,
                         struct sensors *request, struct diag *diag)
{
    *request = (struct sensors){
        .suite = suite->name,
        .digest = suite->digest,
        .effects = choice->effects != NULL ? choice->effects : suite->effects,
    };
    if (request->effects == NULL)
        request->effects = "auto";
    struct selection selection;
    if (effects_read(request->effects, &selection, diag) == 0)
        return 0;
    if (choice->effects == NULL)
        return -1;
    diag->code = DIAG_USAGE;
    return diag_prefix(diag, "--");
}

/* A sensor that only the frame knows would lose its echoes without a word. */
static int check_sensors(const struct suite *suite, const struct frame *frame, struct diag *diag)
{
    size_t known = 0;
    while (known < suite->sensors.count &&
           frame_view(frame, suite->sensors.items[known].name) != NULL)
        known++;
    if (known == suite->sensors.count && known == frame->sensors.list.count)
        return 0;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (suite_sensor(suite, frame->sensors.list.items[i].name) == NULL)
            return diag_fail(diag, DIAG_DATA,
                             "sensors.list[%zu].name: \"%s\" is not in the suite \"%s\"", i,
                             frame->sensors.list.items[i].name, suite->name);
    if (frame->sensors.list.count != suite->sensors.count)
        return diag_fail(diag, DIAG_DATA, "sensors.list: %zu sensors; the suite \"%s\" has %zu",
                         frame->sensors.list.count, suite->name, suite->sensors.count);
    return 0;
}

/* A suite that the command line gives must be the frame's. */
static const struct suite *given_suite(const char *given, const struct frame *frame,
                                       struct runner *runner)
{
    const struct suite *suite = suite_choice_load(runner, given);
    if (suite == NULL || strcmp(suite->digest, frame->sensors.digest) == 0)
        return suite;
    diag_fail(runner_diag(runner), DIAG_CONFIG,
              "sensors.digest: the frame was seen with %s, \"%s\" is now %s; run the whole chain "
              "with one suite",
              frame->sensors.digest, given, suite->digest);
    return NULL;
}

const struct suite *suite_choice_suite(const struct suite_choice *choice, const struct frame *frame,
                                       struct runner *runner)
{
    const struct suite *suite = choice->sensors != NULL
                                    ? given_suite(choice->sensors, frame, runner)
                                    : suite_choice_of_frame(runner, frame);
    return suite != NULL && check_sensors(suite, frame, runner_diag(runner)) == 0 ? suite : NULL;
}

int suite_choice_effects(const struct suite_choice *choice, const struct frame *frame,
                         struct runner *runner, struct selection *selection)
{
    struct diag *diag = runner_diag(runner);
    const char *asked = frame->sensors.effects != NULL ? frame->sensors.effects : "auto";
    if (choice->effects != NULL && strcmp(choice->effects, asked) != 0)
        return diag_fail(diag, DIAG_CONFIG,
                         "sensors.effects: the frame was seen with \"%s\", not with \"%s\"; give "
                         "the effects to glint-ideal",
                         asked, choice->effects);
    if (strcmp(asked, runner->effects) != 0) {
        runner->effects[0] = '\0';
        if (effects_read(asked, &runner->selection, diag) != 0)
            return diag_prefix(diag, "sensors.");
        memcpy(runner->effects, asked, strlen(asked) + 1);
    }
    *selection = runner->selection;
    selection->log = runner_log(runner);
    return 0;
}

/* Clutter of more points than this is refused: every point may become a target. */
#define MOST_CLUTTER 1e5

static int check_clutter(const struct frame *frame, const struct sensor *sensor,
                         const struct selection *selection, struct diag *diag)
{
    double per_m2 = frame->conditions.clutter_per_m2;
    double area_m2 =
        ground_return_area_m2(sensor->range_min_m, sensor->range_max_m, sensor->field_of_view_rad);
    if (!effects_enabled(selection, EFFECT_CLUTTER) || per_m2 * area_m2 <= MOST_CLUTTER ||
        frame->conditions.clutter_ercs == 0)
        return 0;
    return diag_fail(
        diag, DIAG_DATA,
        "conditions.clutter_per_m2: %g make %.0f points in the %.0f m2 that the sensor "
        "\"%s\" sees; at most %.0f are simulated",
        per_m2, per_m2 * area_m2, area_m2, sensor->name, MOST_CLUTTER);
}

int suite_choice_read(struct frame *frame, const struct suite *suite,
                      const struct selection *selection, struct runner *runner)
{
    if (frame->line.unread == 0)
        return 0;
    const struct stage *stage = runner_stage(runner);
    bool simulates_effects = (stage->reads & PART_ECHOES) != 0;
    bool adds_quality = (stage->writes & PART_TARGETS) != 0 && frame_carries(frame, CARRY_QUALITY);
    unsigned parts = adds_quality ? PART_OBJECTS : 0;
    for (size_t i = 0; simulates_effects && i < suite->sensors.count; i++)
        parts |= effect_reads(frame, &suite->sensors.items[i], selection, EFFECT_HOME_SENSOR);
    return frame_stream_read_left(frame, parts, runner_diag(runner));
}

int suite_choice_step(void *state, struct frame *frame, struct runner *runner)
{
    const struct suite_choice *choice = state;
    struct selection selection = {0};
    const struct suite *suite = suite_choice_suite(choice, frame, runner);
    if (suite == NULL || suite_choice_effects(choice, frame, runner, &selection) != 0)
        return -1;
    if (suite_choice_read(frame, suite, &selection, runner) != 0)
        return -1;
    for (size_t i = 0; i < suite->sensors.count; i++) {
        const struct sensor *sensor = &suite->sensors.items[i];
        if (check_clutter(frame, sensor, &selection, runner_diag(runner)) != 0)
            return -1;
        selection.log = frame_view(frame, sensor->name)->measured ? runner_log(runner) : NULL;
        runner_stage(runner)->visit(frame, sensor, &selection);
        effects_count_scan(&selection);
    }
    return 0;
}

int suite_choice_locate_fault(void *state, const struct frame *frame, struct runner *runner)
{
    (void)state;
    return frame_check_extremes(frame, runner_diag(runner));
}
