/* The ideal target list: exact range, azimuth, range rate and cross section of every reflector that
 * a sensor sees (MODEL 2.2 to 2.5, 5). */
#include "ideal/direct_echoes.h"
#include "ideal/ghost_echoes.h"
#include "ideal/look.h"
#include "ideal/roadside_echoes.h"
#include "radar/scan_timing.h"
#include "run/suite_choice.h"

struct ideal {
    struct suite_choice choice; /* first: its options are ideal's */
    const struct suite *suite;
    struct sensors request; /* what every frame says of suite and effects */
    bool doubts_cells;      /* has it been said that reflectors are made for finer cells? */
};

static int ideal_start(void *state, struct runner *runner)
{
    struct ideal *ideal = state;
    ideal->suite = suite_choice_load(runner, ideal->choice.sensors);
    if (ideal->suite == NULL)
        return -1;
    suite_choice_doubt(runner, ideal->suite);
    return suite_choice_request(&ideal->choice, ideal->suite, &ideal->request, runner_diag(runner));
}

static struct sensor_view view_of(const struct sensor *sensor, bool measured)
{
    return (struct sensor_view){
        .name = sensor->name,
        .mount_x_m = sensor->mount_x_m,
        .mount_y_m = sensor->mount_y_m,
        .mount_z_m = sensor->mount_z_m,
        .mount_yaw_rad = sensor->mount_yaw_rad,
        .field_of_view_rad = sensor->field_of_view_rad,
        .range_max_m = sensor->range_max_m,
        .cell_range_m = sensor->bin_range_m,
        .cell_range_rate_mps = sensor->bin_range_rate_mps,
        .resolution_range_m = sensor->half_range_m,
        .resolution_range_rate_mps = sensor->half_range_rate_mps,
        .azimuth_cell_rad = sensor->azimuth_cell_rad,
        .carrier_hz = sensor->carrier_hz,
        .cycle_s = sensor->cycle_s,
        .measured = measured,
    };
}

/* How long before the instant of measurement the scene is looked at (MODEL 14.6). */
static double latency_s(const struct sensor *sensor, const struct selection *selection)
{
    bool late = sensor->latency_s > 0 && effects_enabled(selection, EFFECT_LATENCY);
    effects_note(selection, EFFECT_LATENCY, late);
    return late ? sensor->latency_s : 0;
}

/* Tells at which rate of frames all sensors measure in their cycles, as this one is too low for a
 * sensor; the fastest one is told. */
static void note_long_frame(const struct suite *suite, const struct sensor *fastest,
                            const struct frame *frame, struct diag *diag)
{
    for (size_t i = 0; i < suite->sensors.count; i++) {
        const struct sensor *sensor = &suite->sensors.items[i];
        if (sensor->cycle_s > 0 && sensor->cycle_s < fastest->cycle_s)
            fastest = sensor;
    }
    double rate_hz = ceil(10 / fastest->cycle_s - 1e-6) / 10;
    diag_note(diag,
              "sensor \"%s\" has a cycle of %g s and measures once in a frame of %g s; from %g "
              "frames a second on it measures in its cycle",
              fastest->name, fastest->cycle_s, frame->interval_s, rate_hz);
}

/* Adds the sensor to the frame, and its echoes if it measures in the frame. */
static int add_sensor(struct frame *frame, const struct suite *suite, const struct sensor *sensor,
                      const struct selection *selection, struct diag *diag)
{
    double instant_s = 0;
    enum scan_timing_answer answer =
        scan_timing_instant_s(sensor->cycle_s, frame->time_s, frame->interval_s, &instant_s);
    if (answer == SCAN_TIMING_LONG_FRAME)
        note_long_frame(suite, sensor, frame, diag);
    struct sensor_view *view = list_add(&frame->sensors.list, frame->arena);
    *view = view_of(sensor, answer != SCAN_TIMING_NONE);
    if (answer == SCAN_TIMING_NONE)
        return 0;
    struct look look;
    double seen_s = instant_s - latency_s(sensor, selection);
    view->age_s = round((frame->time_s - seen_s) * 1e9) / 1e9;
    if (look_begin(&look, frame, sensor, selection, seen_s, diag) != 0)
        return -1;
    direct_echoes_add(&look);
    ghost_echoes_add(&look);
    roadside_echoes_add(&look);
    effects_count_scan(selection);
    return 0;
}

static int ideal_step(void *state, struct frame *frame, struct runner *runner)
{
    struct ideal *ideal = state;
    const struct suite *suite = ideal->suite;
    struct selection selection;
    frame->sensors = ideal->request;
    if (!ideal->doubts_cells)
        ideal->doubts_cells = suite_choice_doubt_cells(runner, suite, frame);
    if (suite_choice_effects(&ideal->choice, frame, runner, &selection) != 0)
        return -1;
    for (size_t i = 0; i < suite->sensors.count; i++)
        if (add_sensor(frame, suite, &suite->sensors.items[i], &selection, runner_diag(runner)) !=
            0)
            return -1;
    return 0;
}

static const struct field ideal_options[] = {
    SUITE_CHOICE_OF_IDEAL,
    {0},
};

const struct stage stage_ideal = {
    .name = "ideal",
    .summary = "Write what a perfect radar would see of every reflector.",
    .details =
        "Computes, for each sensor of the suite that measures in the frame, the exact range, "
        "azimuth, range rate and cross section of all reflectors that it can see. A reflector is "
        "seen if it is in range and in the field of view, faces the sensor, and no other object "
        "stands in the way. A sensor whose document describes ghosts also gets the echoes that "
        "walls, guardrails and flat sides mirror.",
    .options = STAGE_OPTIONS(struct ideal, ideal_options),
    .reads = PART_OBJECTS | PART_REFLECTORS,
    .writes = PART_SENSORS | PART_ECHOES | PART_LOST | PART_COUNTS | PART_VISIBILITY,
    .start = ideal_start,
    .step = ideal_step,
    .locate_fault = suite_choice_locate_fault,
};
