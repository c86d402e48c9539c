/* The sensor before noise: amplitude of every echo (MODEL 4), resolution cells (6), threshold on
 * the summed amplitude, superposed sum and delta pointers of each cell (7, 8). */
#include "carrier.h"
#include "cell_margins.h"
#include "random.h"
#include "resolution.h"
#include "sort.h"
#include "stage.h"
#include "units.h"

/* The relative phase of an echo: 0 in the paper's model, drawn in each frame, or that of its path
 * and of its reflector, which is drawn once for all frames. */
static double phase_of(const struct frame *frame, const struct sensor *sensor,
                       const struct echo *echo)
{
    struct contributor subject = frame_contributor(echo);
    struct random_address address = runner_address(frame, sensor->name, &subject);
    double uniform[4];
    if (sensor->cell_phase == CELL_RANDOM_PHASE) {
        random_uniform(&address, RANDOM_PHASE, 0, uniform);
        return 2 * PI * uniform[0];
    }
    address.frame = 0;
    random_uniform(&address, RANDOM_REFLECTOR_PHASE, 0, uniform);
    return 2 * PI * (uniform[0] - carrier_phase_turns(echo->range_m, sensor->carrier_hz));
}

/* The echoes that have an amplitude, strongest first. */
static size_t receive(struct frame *frame, const struct sensor *sensor,
                      const struct selection *selection, struct echo_span echoes, struct ray *rays)
{
    bool coherent = sensor->cell_phase != CELL_IN_PHASE && effects_may(selection, EFFECT_COHERENCE);
    size_t count = 0;
    for (size_t i = 0; i < echoes.count; i++) {
        const struct echo *echo = &echoes.items[i];
        double phase_rad = coherent ? phase_of(frame, sensor, echo) : 0;
        rays[count] = superposition_ray(sensor, echo, phase_rad);
        if (rays[count].amplitude > 0)
            count++;
        else
            frame_lose_echo(frame, "sensor", echo, LOSS_NO_AMPLITUDE);
    }
    sort_items(rays, count, sizeof *rays, superposition_compare, frame->arena);
    effects_note(selection, EFFECT_COHERENCE, coherent);
    return count;
}

/* The number of every ray's cell, and how many cells there are. */
static size_t resolve(struct frame *frame, const struct sensor *sensor,
                      const struct selection *selection, const struct ray *rays, size_t count,
                      size_t *cell)
{
    double half_range_m = sensor->half_range_m, half_rate_mps = sensor->half_range_rate_mps;
    int64_t begin = effects_begin(selection);
    struct resolution_echo *echoes = arena_get(frame->arena, 2 * (count + 1) * sizeof *echoes);
    for (size_t i = 0; i < count; i++)
        echoes[i] = (struct resolution_echo){rays[i].echo.range_m, rays[i].echo.range_rate_mps,
                                             rays[i].amplitude};
    bool merge = effects_must(selection, EFFECT_MERGING) ||
                 (effects_may(selection, EFFECT_MERGING) &&
                  resolution_close(echoes, count, half_range_m, half_rate_mps, echoes + count,
                                   frame->arena));
    size_t cells = count;
    if (merge)
        cells = resolution_cluster(echoes, count, half_range_m, half_rate_mps, cell);
    for (size_t i = 0; i < count && !merge; i++)
        cell[i] = i;
    effects_note(selection, EFFECT_MERGING, merge);
    effects_end(selection, EFFECT_MERGING, begin);
    return cells;
}

static void report(struct frame *frame, const struct sensor *sensor,
                   const struct selection *selection, const struct ray *members, size_t count,
                   struct margins margins)
{
    struct cell cell;
    bool superpose = effects_must(selection, EFFECT_SUPERPOSITION) ||
                     (effects_may(selection, EFFECT_SUPERPOSITION) && count > 1);
    int64_t begin = effects_begin(selection);
    bool has_angle = superposition_cell(sensor, members, count, superpose, frame->arena, &cell);
    effects_note(selection, EFFECT_SUPERPOSITION, superpose);
    effects_end(selection, EFFECT_SUPERPOSITION, begin);
    cell.margins = margins;
    if (frame->margins)
        cell_margins_add(sensor, &cell);
    effects_note(selection, EFFECT_THRESHOLD, true);
    if (effects_may(selection, EFFECT_THRESHOLD) && cell.amplitude < sensor->threshold)
        frame_lose_cell(frame, "sensor", &cell, LOSS_BELOW_THRESHOLD,
                        units_shortfall_db(sensor->threshold, cell.amplitude), &cell.margins);
    else if (!has_angle)
        frame_lose_cell(frame, "sensor", &cell, LOSS_NO_ANGLE, 0, &cell.margins);
    else
        *list_add(&frame->cells, frame->arena) = cell;
}

static void sense(struct frame *frame, const struct sensor *sensor,
                  const struct selection *selection)
{
    struct echo_span echoes = frame_echoes_of(frame, sensor->name);
    struct ray *rays = arena_get(frame->arena, 2 * (echoes.count + 1) * sizeof *rays);
    size_t count = receive(frame, sensor, selection, echoes, rays);
    struct ray *members = rays + count;
    size_t *cell = arena_get(frame->arena, (count + 1) * sizeof *cell);
    size_t cells = resolve(frame, sensor, selection, rays, count, cell);
    struct clustered_rays all = {rays, cell, count};
    for (size_t number = 0; number < cells; number++) {
        size_t member_count = 0;
        for (size_t i = 0; i < count; i++)
            if (cell[i] == number)
                members[member_count++] = rays[i];
        struct margins margins = {0};
        if (frame->margins)
            margins = cell_margins_of(sensor, &all, number);
        report(frame, sensor, selection, members, member_count, margins);
    }
}

static int sensor_step(void *state, struct frame *frame, struct runner *runner)
{
    (void)state;
    return runner_visit_sensors(runner, frame, sense);
}

const struct stage stage_sensor = {
    .name = "sensor",
    .summary = "Merge echoes into resolution cells and superpose their antenna pointers.",
    .details = "Gives every echo its amplitude, lets echoes that the radar cannot resolve share a\n"
               "cell, drops cells whose summed amplitude is below the detection threshold, and\n"
               "writes what the sum and delta channels would show of the rest without noise.",
    .options = &suite_choice_record,
    .reads = SECTION_SENSORS | SECTION_ECHOES,
    .writes = SECTION_CELLS | SECTION_LOST,
    .step = sensor_step,
};
