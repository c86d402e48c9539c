#include "ideal/roadside_echoes.h"

#include "base/elementary.h"
#include "base/units.h"
#include "ideal/line_of_sight.h"

/* The least amplitude of an echo over the threshold, and the part of it where the road strengthens
 * echoes, by a factor of 4/sqrt(6) at most (14.10). */
#define FAINTEST 0.2
#define MIRRORED 0.6

/* A strip, as one sensor sees it. */
struct roadside {
    struct roadside_grid grid;
    struct random_address address; /* of what is drawn */
    struct echo echo;              /* what all its echoes have in common */
    double level;                  /* standard deviation of the logarithm of a level's factor */
    double faintest;               /* amplitude below which echoes are left out */
    double height_m;               /* of its scatterers' middle; the sensor's if it is not known */
};

/* Distance of an echo from the borders of range, view and the bodies beside its sight line. */
static struct margins margins_of(const struct look *look, double reach_m,
                                 const struct obstruction_line *line)
{
    if (!frame_carries(look->frame, CARRY_MARGINS))
        return (struct margins){0};
    return look_sight_margins(
        look, elementary_min(reach_m, line_of_sight_margin_m(look, NULL, 0, line, false, false)));
}

/* Adds the scatterer's echo if it is in range, in view, not hidden and, as the antenna sees it, not
 * below least_ercs. */
static void add_scatterer(struct look *look, const struct roadside *side,
                          const struct roadside_scatterer *one, double least_ercs)
{
    struct frame *frame = look->frame;
    struct vec2 still = {0, 0};
    struct echo echo = side->echo;
    double gain;
    struct kinematics plane = look_kinematics(look, one->place_m, still);
    struct kinematics read = look_slant(look, side->height_m, plane, &gain, &echo.effects);
    double within_m = look_within_range_m(look, &read);
    double inside_rad = look_within_view_rad(look, read.azimuth_rad);
    if (!(read.range_m > 0 && within_m >= 0 && inside_rad > 0))
        return;
    const struct obstruction_line line = {look->pose.position_m, one->place_m, look->height_m,
                                          side->height_m};
    struct line_of_sight sight = line_of_sight_along(look, &line, NULL, 0);
    if (sight.by != NULL)
        return;
    double level = side->level * roadside_level(side->address, one->number, read.range_m);
    echo.id.number = one->number;
    echo.range_m = read.range_m;
    echo.azimuth_rad = read.azimuth_rad;
    look_set_elevation(look, one->place_m, side->height_m, &echo);
    echo.range_rate_mps = read.range_rate_mps;
    echo.ercs = sight.factor * gain * one->ercs * elementary_exp(level);
    if (echo.ercs * antenna_gain(&look->sensor->antenna, echo.azimuth_rad) < least_ercs)
        return;
    echo.effects |= sight.effects;
    echo.margins = margins_of(look, elementary_min(within_m, read.range_m * inside_rad), &line);
    *list_add(&frame->echoes, frame->arena) = echo;
    look->echoes++;
}

/* Adds what stands in a cell. */
static void add_cell(struct look *look, const struct roadside *side, int64_t along, int64_t across)
{
    const struct roadside_grid *grid = &side->grid;
    struct roadside_series series = roadside_series_of(grid, side->address, along, across);
    struct vec2 middle = roadside_cell_middle(grid, along, across);
    double range_m = vec2_length(vec2_sub(look->pose.position_m, middle));
    double least =
        side->faintest / radar_reference_amplitude(&look->sensor->amplitude_law, range_m);
    struct roadside_scatterer one;
    while (roadside_next(&series, least, &one))
        add_scatterer(look, side, &one, least);
}

/* Adds the cells of a row along the strip, without those that are surely out of reach: always by
 * range, so that strips may be long, and unless the effect is forced by the view, too. */
static void add_row(struct look *look, const struct roadside *side, int64_t across)
{
    const struct roadside_grid *grid = &side->grid;
    double count = (double)grid->along_count, cell_m = grid->along_m;
    struct vec2 middle_m = roadside_cell_middle(grid, 0, across);
    double here_m = vec2_dot(vec2_sub(look->pose.position_m, middle_m), grid->heading);
    double reach_m = look->sensor->range_max_m + grid->across_m;
    struct look_stretch stretch = {here_m - reach_m, here_m + reach_m};
    if (!effects_forced(look->selection, EFFECT_ROADSIDE))
        stretch = look_stretch_in_reach(look, middle_m, grid->heading, 0.5 * grid->across_m,
                                        fabs(side->height_m - look->height_m));
    /* Counted from the middle of the first cell; one cell is left at each end for rounding. */
    double first = elementary_max(floor(stretch.first_m / cell_m) - 1, 0);
    double end = elementary_min(ceil(stretch.end_m / cell_m) + 2, count);
    effects_note(look->selection, EFFECT_ROADSIDE, first < end);
    for (int64_t along = (int64_t)first; (double)along < end; along++)
        add_cell(look, side, along, across);
}

static struct roadside roadside_of(const struct look *look, size_t number)
{
    struct frame *frame = look->frame;
    const struct roadside_strip *strip = &frame->roadside.items[number];
    const char *name = roadside_name(strip, number + 1, frame->arena);
    struct random_address scene = frame_draw_address_of_scene(frame);
    struct roadside side = {.grid = roadside_grid_of(strip),
                            .address = roadside_address(scene, strip, number + 1),
                            .level = units_amplitude_logarithm(strip->level_db)};
    double top_m = side.grid.height_m;
    bool latency = look->ego_moved;
    bool mirroring = frame->conditions.road != ROAD_UNKNOWN && look->height_m > 0;
    side.faintest = FAINTEST * look->sensor->threshold * (mirroring ? MIRRORED : 1);
    side.height_m = top_m > 0 ? 0.5 * top_m : look->height_m;
    side.echo = (struct echo){
        .sensor = look->sensor->name,
        .id.object = "roadside",
        .id.reflector = name,
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
    int64_t before = look->echoes;
    effects_note(look->selection, EFFECT_ROADSIDE, false);
    if (frame->roadside.count == 0 || !effects_enabled(look->selection, EFFECT_ROADSIDE))
        return;
    line_of_sight_note(look, look->indexed_count > 0);
    for (size_t i = 0; i < frame->roadside.count; i++) {
        struct roadside side = roadside_of(look, i);
        for (int64_t across = 0; across < side.grid.across_count; across++)
            add_row(look, &side, across);
    }
    frame_count_echoes(frame, look->sensor->name, PATH_CLUTTER, look->echoes - before);
}
