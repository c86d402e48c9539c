/* Random traffic: independent snapshots, each a scene of one frame that its number determines. */
#include <inttypes.h>
#include <stdio.h>

#include "documents/vehicle.h"
#include "run/stage.h"
#include "traffic/random_traffic.h"

struct traffic_random {
    enum random_traffic_density density;
    int64_t frames, first;
    double rate_hz;
    bool conditions;
    struct random_traffic scene;
    int64_t made;
};

/* The tests have one more density, with a stage of its own (tests/soundness). */
static const char *const densities[] = {"sparse", "medium", "dense", NULL};

static int traffic_random_start(void *state, struct runner *runner)
{
    struct traffic_random *traffic = state;
    struct random_traffic *scene = &traffic->scene;
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
    return 0;
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
    if (traffic->conditions)
        random_traffic_conditions(&traffic->scene, number, frame);
    return 1;
}

static const struct field traffic_random_options[] = {
    {FIELD_CHOICE_OF(struct traffic_random, density, densities, "how many objects, and how near"),
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
    {0},
};

const struct stage stage_traffic_random = {
    .name = "traffic-random",
    .summary = "Make random traffic: independent snapshots, each a scene of its own.",
    .details = "Objects of all classes around an ego: 0 to 3 within 120 m (sparse), 0 to 8 within\n"
               "60 m (medium, the default), 4 to 15 within 25 m (dense). A frame depends on seed,\n"
               "density and its number alone, so --first and --frames may cut a set anywhere.",
    .options = STAGE_OPTIONS(struct traffic_random, traffic_random_options),
    .writes = SECTION_OBJECTS,
    .start = traffic_random_start,
    .next = traffic_random_next,
};
