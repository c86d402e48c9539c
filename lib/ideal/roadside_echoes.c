#include "ideal/roadside_echoes.h"

#include "base/elementary.h"
#include "base/units.h"
#include "ideal/line_of_sight.h"
#include "radar/level.h"

/* The least amplitude of an echo over the threshold. */
#define FAINTEST 0.1

/* A strip, as one sensor sees it. */
struct roadside {
    size_t number; /* in the frame's list */
    struct roadside_grid grid;
    struct random_address scene; /* address of what is drawn */
    struct echo echo;            /* what all its echoes have in common */
    double level;                /* standard deviation of the logarithm of a level's factor */
    double height_m;             /* of its scatterers' middle; the sensor's if it is not known */
    int64_t cells;               /* of this and all other strips */
    int64_t first_cell;          /* number of its first cell among them */
};

static int64_t cell_count(const struct roadside_strip *strip)
{
    struct roadside_grid grid = roadside_grid_of(strip);
    return grid.along_count * grid.across_count;
}

/* The echo of a scatterer that the sensor sees from this range, azimuth and range rate. */
static struct echo *add_echo(struct look *look, const struct roadside *side,
                             const struct kinematics *read)
{
    struct echo *echo = list_add(&look->frame->echoes, look->frame->arena);
    look->echoes++;
    *echo = side->echo;
    echo->range_m = read->range_m;
    echo->azimuth_rad = read->azimuth_rad;
    echo->range_rate_mps = read->range_rate_mps;
    return echo;
}

/* Distance of an echo from the borders of range, view and the bodies beside its sight line. */
static struct margins margins_of(const struct look *look, double reach_m,
                                 const struct obstruction_line *line)
{
    if (!frame_carries(look->frame, CARRY_MARGINS))
        return (struct margins){0};
    return look_sight_margins(
        look, elementary_min(reach_m, line_of_sight_margin_m(look, NULL, 0, line, false, false)));
}

/* The factor on amplitude of a scatterer's level, which changes with its range. */
static double level_of(const struct roadside *side, const struct echo *echo)
{
    struct random_address line = side->scene;
    line.item = (uint64_t)echo->id.number;
    return elementary_exp(side->level * level_on_line(&line, RANDOM_ROADSIDE_LEVEL, echo->range_m));
}

/* Adds the scatterer's echo if it is in range, in view and not hidden. */
static void add_scatterer(struct look *look, const struct roadside *side,
                          const struct roadside_scatterer *one, int64_t cell)
{
    struct vec2 still = {0, 0};
    uint64_t effects = side->echo.effects;
    double gain;
    struct kinematics plane = look_kinematics(look, one->place_m, still);
    struct kinematics read = look_slant(look, side->height_m, plane, &gain, &effects);
    double within_m = look_within_range_m(look, read.range_m);
    double inside_rad = look_within_view_rad(look, read.azimuth_rad);
    if (!(read.range_m > 0 && within_m >= 0 && inside_rad > 0))
        return;
    const struct obstruction_line line = {look->pose.position_m, one->place_m, look->height_m,
                                          side->height_m};
    struct line_of_sight sight = line_of_sight_along(look, &line, NULL, 0);
    if (sight.by != NULL)
        return;
    struct echo *echo = add_echo(look, side, &read);
    echo->id.number = 1 + side->first_cell + cell + one->rank * side->cells;
    echo->ercs = sight.factor * gain * one->ercs * level_of(side, echo);
    echo->effects = effects | sight.effects;
    echo->margins = margins_of(look, elementary_min(within_m, read.range_m * inside_rad), &line);
}

/* The least ERCS of a scatterer that is not left out at this range. */
static double least_ercs(const struct look *look, double range_m)
{
    const struct sensor *sensor = look->sensor;
    return FAINTEST * sensor->threshold /
           radar_reference_amplitude(&sensor->amplitude_law, range_m);
}

/* Adds what stands in a cell, unless it is surely out of reach. */
static void add_cell(struct look *look, const struct roadside *side, int64_t along, int64_t across)
{
    const struct roadside_grid *grid = &side->grid;
    struct vec2 middle = roadside_cell_middle(grid, along, across);
    struct vec2 to_sensor = vec2_sub(look->pose.position_m, middle);
    struct vec2 half_m = {0.5 * grid->along_m, 0.5 * grid->across_m};
    struct silhouette silhouette =
        silhouette_of(half_m, grid->heading, vec2_turn_back(to_sensor, grid->heading));
    if (!effects_forced(look->selection, EFFECT_ROADSIDE) &&
        look_out_of_reach(look, side->height_m, &silhouette))
        return;
    effects_note(look->selection, EFFECT_ROADSIDE, true);
    struct roadside_series series =
        roadside_series_of(grid, side->scene, side->number, along, across);
    struct roadside_scatterer one;
    double least = least_ercs(look, vec2_length(to_sensor));
    while (roadside_next(&series, least, &one))
        add_scatterer(look, side, &one, along * grid->across_count + across);
}

/* Adds the cells that are not farther along the strip than the sensor's range. */
static void add_strip(struct look *look, const struct roadside *side)
{
    const struct roadside_grid *grid = &side->grid;
    double range_m = look->sensor->range_max_m, count = (double)grid->along_count;
    double foot_m = vec2_dot(vec2_sub(look->pose.position_m, grid->from_m), grid->heading);
    double first = floor((foot_m - range_m) / grid->along_m);
    double end = ceil((foot_m + range_m) / grid->along_m);
    first = elementary_min(elementary_max(first, 0), count);
    end = elementary_min(elementary_max(end, 0), count);
    for (int64_t along = (int64_t)first; along < (int64_t)end; along++)
        for (int64_t across = 0; across < grid->across_count; across++)
            add_cell(look, side, along, across);
}

static struct roadside roadside_of(const struct look *look, size_t number)
{
    const struct roadside_strip *strip = &look->frame->roadside.items[number];
    struct roadside side = {.number = number,
                            .grid = roadside_grid_of(strip),
                            .scene = frame_draw_address_of_scene(look->frame),
                            .level = units_amplitude_logarithm(strip->level_db)};
    double top_m = side.grid.height_m;
    bool latency = look->ego_moved;
    bool mirroring = look->frame->conditions.road != ROAD_UNKNOWN && look->height_m > 0;
    side.height_m = top_m > 0 ? 0.5 * top_m : look->height_m;
    side.echo = (struct echo){
        .sensor = look->sensor->name,
        .id.object = "roadside",
        .id.reflector = roadside_kinds[strip->kind],
        .id.path = PATH_CLUTTER,
        .height_m = mirroring && top_m > 0 ? side.height_m : 0,
        .extent_m = mirroring ? top_m : 0,
        .time_s = look->time_s,
        .effects = EFFECT_BIT(EFFECT_ROADSIDE) | (latency ? EFFECT_BIT(EFFECT_LATENCY) : 0),
    };
    return side;
}

void roadside_echoes_add(struct look *look)
{
    struct frame *frame = look->frame;
    int64_t before = look->echoes, cells = 0, first_cell = 0;
    effects_note(look->selection, EFFECT_ROADSIDE, false);
    if (frame->roadside.count == 0 || !effects_enabled(look->selection, EFFECT_ROADSIDE))
        return;
    line_of_sight_note(look, look->indexed_count > 0);
    for (size_t i = 0; i < frame->roadside.count; i++)
        cells += cell_count(&frame->roadside.items[i]);
    for (size_t i = 0; i < frame->roadside.count; i++) {
        struct roadside side = roadside_of(look, i);
        side.cells = cells;
        side.first_cell = first_cell;
        add_strip(look, &side);
        first_cell += side.grid.along_count * side.grid.across_count;
    }
    frame_count_echoes(frame, look->sensor->name, PATH_CLUTTER, look->echoes - before);
}
