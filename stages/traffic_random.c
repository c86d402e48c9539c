/* Random traffic: independent snapshots, each a scene of one frame that its number determines. */
#include <inttypes.h>
#include <stdio.h>

#include "documents/vehicle.h"
#include "frame/frame_check.h"
#include "run/stage.h"
#include "traffic/adversarial_traffic.h"
#include "traffic/random_traffic.h"

struct traffic_random {
    enum random_traffic_density density;
    int64_t frames, first;
    double rate_hz;
    bool conditions;
    const char *sensors;
    const struct suite *suite;
    struct random_traffic scene;
    int64_t made;
};

static int traffic_random_start(void *state, struct runner *runner)
{
    struct traffic_random *traffic = state;
    struct random_traffic *scene = &traffic->scene;
    if ((traffic->density == TRAFFIC_ADVERSARIAL) != (traffic->sensors != NULL))
        return diag_fail(runner_diag(runner), DIAG_USAGE,
                         "--density adversarial and --sensors SUITE need each other");
    scene->density = traffic->density;
    for (enum random_traffic_class class = 0; class < TRAFFIC_CLASSES; class ++) {
        const struct vehicle *vehicle =
            runner_vehicle(runner, NULL, random_traffic_class_name(class));
        if (vehicle == NULL)
            return -1;
        scene->models[class] = (struct random_traffic_model){vehicle->length_m, vehicle->width_m,
                                                             &vehicle->reflectors};
    }
    runner_expect(runner, traffic->frames);
    if (traffic->sensors != NULL)
        traffic->suite = runner_suite(runner, traffic->sensors);
    return traffic->sensors == NULL || traffic->suite != NULL ? 0 : -1;
}

static const char *name_of(const struct traffic_random *traffic, const struct frame *frame,
                           int64_t number)
{
    enum { SIZE = 80 };
    char *name = arena_get(frame->arena, SIZE);
    snprintf(name, SIZE, "random-%s/%" PRIu64 "/%" PRId64,
             random_traffic_densities[traffic->density], frame->seed, number);
    return name;
}

static int traffic_random_next(void *state, struct frame *frame, struct runner *runner)
{
    (void)runner;
    struct traffic_random *traffic = state;
    if (traffic->made == traffic->frames)
        return 0;
    int64_t number = traffic->first + traffic->made++;
    frame->scene = name_of(traffic, frame, number);
    frame->time_s = (double)number / traffic->rate_hz;
    frame->interval_s = 1 / traffic->rate_hz;
    frame->last = true;
    random_traffic_fill(&traffic->scene, number, frame);
    if (traffic->suite != NULL)
        adversarial_traffic_add(&traffic->scene, traffic->suite, number, frame);
    if (traffic->conditions)
        random_traffic_conditions(&traffic->scene, number, frame);
    return 1;
}

/* Ordinary scenes have ordinary values. Those that are made for a suite depend on its figures. */
static int traffic_random_locate_fault(void *state, const struct frame *frame,
                                       struct runner *runner)
{
    const struct traffic_random *traffic = state;
    struct diag *diag = runner_diag(runner);
    if (traffic->suite == NULL || frame_check_extremes(frame, diag) == 0)
        return 0;
    diag->code = DIAG_CONFIG;
    return diag_prefix(diag, "%s: no adversarial scene of its figures; scene \"%s\", ",
                       traffic->sensors, frame->scene);
}

static const struct field traffic_random_options[] = {
    {FIELD_CHOICE_OF(struct traffic_random, density, random_traffic_densities,
                     "how many objects, and how near"),
     FIELD_OPTIONAL, .absent = TRAFFIC_MEDIUM},
    {FIELD_INTEGER_IN(struct traffic_random, frames, 0, 1e9, "how many frames; absent: 100"),
     FIELD_OPTIONAL, .absent = 100},
    {FIELD_INTEGER_IN(struct traffic_random, first, 0, 1e9, "number of the first frame"),
     FIELD_OPTIONAL},
    {FIELD_REAL_IN(struct traffic_random, rate_hz, 1, 1e4,
                   "frame number n is at time n / rate; absent: 20"),
     FIELD_OPTIONAL, .absent = 20},
    {FIELD_FLAG_OF(struct traffic_random, conditions, "draw road, weather and other radars too"),
     FIELD_OPTIONAL},
    {FIELD_NAME_OF(struct traffic_random, sensors,
                   "the suite for which adversarial scenes are made"),
     FIELD_OPTIONAL},
    {0},
};

static const struct record traffic_random_record = {
    .name = "traffic-random",
    .size = sizeof(struct traffic_random),
    .fields = traffic_random_options,
};

const struct stage stage_traffic_random = {
    .name = "traffic-random",
    .summary = "Make random traffic: independent snapshots, each a scene of its own.",
    .details =
        "Objects of all classes around an ego: 0 to 3 within 120 m (sparse), 0 to 8 within\n"
        "60 m (medium, the default), 4 to 15 within 25 m (dense). Adversarial scenes are made so\n"
        "that decisions of the sensors are close: amplitudes at the threshold, ties, distances\n"
        "of half a cell, sight lines that touch corners, borders of the view. A frame depends on\n"
        "seed, density (and suite) and its number alone, so --first and --frames may cut a set\n"
        "anywhere.",
    .options = &traffic_random_record,
    .writes = SECTION_OBJECTS,
    .start = traffic_random_start,
    .next = traffic_random_next,
    .locate_fault = traffic_random_locate_fault,
};
