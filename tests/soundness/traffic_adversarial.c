/* Random traffic around decisions of a suite: independent snapshots, as glint-traffic-random makes
 * them, with the cases of adversarial_traffic.h. It is a stage of the tests: build/tests/glint has
 * it beside all others. */
#include <inttypes.h>
#include <stdio.h>

#include "adversarial_traffic.h"
#include "documents/vehicle.h"
#include "frame/frame_check.h"
#include "run/suite_choice.h"

struct traffic_adversarial {
    int64_t frames, first;
    double rate_hz;
    bool draw_conditions;
    const char *sensors;
    const struct suite *suite;
    struct random_traffic scene;
    int64_t made;
};

static int traffic_adversarial_start(void *state, struct runner *runner)
{
    struct traffic_adversarial *traffic = state;
    traffic->scene.density = &adversarial_traffic_density;
    for (enum random_traffic_class class = 0; class < TRAFFIC_CLASSES; class ++) {
        const struct vehicle *vehicle =
            runner_vehicle(runner, NULL, random_traffic_class_name(class), NULL);
        if (vehicle == NULL)
            return -1;
        traffic->scene.models[class] = (struct random_traffic_model){
            vehicle->length_m, vehicle->width_m, &vehicle->reflectors};
    }
    runner_expect(runner, traffic->frames);
    traffic->suite = suite_choice_load(runner, traffic->sensors);
    return traffic->suite != NULL ? 0 : -1;
}

static const char *name_of(const struct frame *frame, int64_t number)
{
    enum { SIZE = 80 };
    char *name = arena_get(frame->arena, SIZE);
    snprintf(name, SIZE, "random-adversarial/%" PRIu64 "/%" PRId64, frame->seed, number);
    return name;
}

static int traffic_adversarial_next(void *state, struct frame *frame, struct runner *runner)
{
    (void)runner;
    struct traffic_adversarial *traffic = state;
    if (traffic->made == traffic->frames)
        return 0;
    int64_t number = traffic->first + traffic->made++;
    frame->scene = name_of(frame, number);
    frame->time_s = (double)number / traffic->rate_hz;
    frame->interval_s = 1 / traffic->rate_hz;
    frame->last = true;
    random_traffic_fill(&traffic->scene, number, frame);
    adversarial_traffic_add(&traffic->scene, traffic->suite, number, frame);
    if (traffic->draw_conditions)
        random_traffic_conditions(random_traffic_address(&traffic->scene, frame->seed, number),
                                  frame);
    return 1;
}

/* The suite's figures may ask for what no frame may hold. */
static int traffic_adversarial_locate_fault(void *state, const struct frame *frame,
                                            struct runner *runner)
{
    const struct traffic_adversarial *traffic = state;
    struct diag *diag = runner_diag(runner);
    if (frame_check_extremes(frame, diag) == 0)
        return 0;
    diag->code = DIAG_CONFIG;
    return diag_prefix(diag, "%s: no adversarial scene of its figures; scene \"%s\", ",
                       traffic->sensors, frame->scene);
}

static const struct field traffic_adversarial_options[] = {
    {FIELD_NAME_OF(struct traffic_adversarial, sensors, "the suite for which scenes are made")},
    {FIELD_INTEGER_IN(struct traffic_adversarial, frames, 0, 1e9, "how many frames; absent: 100"),
     FIELD_OPTIONAL, .absent = 100},
    {FIELD_INTEGER_IN(struct traffic_adversarial, first, 0, 1e9, "number of the first frame"),
     FIELD_OPTIONAL},
    {FIELD_REAL_IN(
         struct traffic_adversarial, rate_hz, 1, 1e4,
         "frame number n is at time n / rate; absent: 10, so that frames last longer than a "
         "radar's cycle and every scan is at the time of its frame"),
     FIELD_OPTIONAL, .absent = 10},
    {FIELD_FLAG_OF(struct traffic_adversarial, draw_conditions,
                   "draw road, weather and other radars too"),
     FIELD_OPTIONAL},
    {0},
};

extern const struct stage stage_traffic_adversarial;
const struct stage stage_traffic_adversarial = {
    .name = "traffic-adversarial",
    .summary = "Make random traffic in which decisions of the sensors are close.",
    .details =
        "Amplitudes at the threshold, ties, distances of half a cell, sight lines that touch\n"
        "corners, borders of the view. A frame depends on seed, suite and its number alone, so\n"
        "--first and --frames may cut a set anywhere.",
    .options = STAGE_OPTIONS(struct traffic_adversarial, traffic_adversarial_options),
    .writes = PART_OBJECTS,
    .start = traffic_adversarial_start,
    .next = traffic_adversarial_next,
    .locate_fault = traffic_adversarial_locate_fault,
};
