#include "propagation/roadside.h"

#include <assert.h>

#include "base/hash.h"
#include "base/units.h"
#include "radar/level.h"
#include "radar/radar_equation.h"

/* Length of a cell of a strip without a spacing, and the greatest width of any cell. */
#define CELL_M 4.0

/* A length that exceeds a whole number of cells by less than this share of a cell, as rounding may,
 * has no further cell. */
#define CELL_SLACK 1e-9

/* More scatterers than a cell may have. With the greatest mean, 160, a Poisson count reaches it
 * with a probability below 1e-300. */
#define CELL_RANKS 1024

/* Value of a member that the strip leaves to its kind. */
#define OF_KIND (-1e3)

const char *const roadside_kinds[] = {
    [ROADSIDE_OTHER] = "other",           [ROADSIDE_RAIL] = "rail",
    [ROADSIDE_POLES] = "poles",           [ROADSIDE_KERB] = "kerb",
    [ROADSIDE_VEGETATION] = "vegetation", NULL};

static const struct field strip_fields[] = {
    {OPTIONAL_NAME(struct roadside_strip, id,
                   "unique in the scene; absent: kind and number in the list, as in rail_2")},
    {FIELD_CHOICE_OF(struct roadside_strip, kind, roadside_kinds,
                     "has the numbers that are absent here")},
    {FIELD_REAL_IN(struct roadside_strip, from_x_m, -1e7, 1e7, "where the strip begins")},
    {FIELD_REAL_IN(struct roadside_strip, from_y_m, -1e7, 1e7, "where the strip begins")},
    {FIELD_REAL_IN(struct roadside_strip, to_x_m, -1e7, 1e7, "where the strip ends")},
    {FIELD_REAL_IN(struct roadside_strip, to_y_m, -1e7, 1e7, "where the strip ends")},
    {OPTIONAL_REAL(struct roadside_strip, width_m, 0, 100, "half of it to each side")},
    {OPTIONAL_REAL(struct roadside_strip, spacing_m, 0.1, 1e4,
                   "one scatterer in each such length, at a random place in it")},
    {OPTIONAL_REAL(struct roadside_strip, per_m2, 0, 10,
                   "mean number of scatterers; without spacing_m")},
    {OPTIONAL_REAL(struct roadside_strip, rcs_dbsm, -100, 100, "median cross section"),
     .absent = OF_KIND},
    {OPTIONAL_REAL(struct roadside_strip, spread_db, 0, 30,
                   "standard deviation of the cross sections"),
     .absent = OF_KIND},
    {OPTIONAL_REAL(struct roadside_strip, level_db, 0, 20,
                   "standard deviation of a scatterer's level over range; absent: 2 dB"),
     .absent = 2},
    {OPTIONAL_REAL(struct roadside_strip, height_m, 0, 100, "top over the road; 0: not known"),
     .absent = OF_KIND},
    {0},
};

const struct record roadside_strip_record = {
    FIELD_TABLE(struct roadside_strip, strip_fields, "strip",
                "A straight strip beside the road, and how much on it echoes.")};

/* Where these numbers come from: MODEL 14.23. */
static const struct roadside_strip kinds[] = {
    [ROADSIDE_OTHER] = {.rcs_dbsm = -20},
    [ROADSIDE_RAIL] = {.spacing_m = 4, .rcs_dbsm = -9.5, .spread_db = 9, .height_m = 0.75},
    [ROADSIDE_POLES] = {.spacing_m = 50, .rcs_dbsm = 0, .spread_db = 6, .height_m = 5},
    [ROADSIDE_KERB] = {.spacing_m = 2, .rcs_dbsm = -20, .spread_db = 6, .height_m = 0.12},
    [ROADSIDE_VEGETATION] = {.per_m2 = 0.05, .rcs_dbsm = -20, .spread_db = 9, .height_m = 1},
};

void roadside_shift(struct roadside_strip *strip, struct vec2 by_m)
{
    strip->from_x_m += by_m.x;
    strip->from_y_m += by_m.y;
    strip->to_x_m += by_m.x;
    strip->to_y_m += by_m.y;
}

const char *roadside_name(const struct roadside_strip *strip, size_t number, struct arena *arena)
{
    assert(number >= 1);
    if (strip->id != NULL)
        return strip->id;
    return arena_format(arena, "%s_%zu", roadside_kinds[strip->kind], number);
}

static bool is_called(const void *names, uint32_t index, const void *name)
{
    const char *const *list = names;
    return strcmp(list[index], name) == 0;
}

const char *roadside_name_twice(const struct roadside_strip *strips, size_t count,
                                struct arena *arena)
{
    const char **names = arena_room(arena, count * sizeof *names);
    struct hash_table numbers = hash_table_begin(count, arena);
    for (uint32_t i = 0; i < count; i++) {
        names[i] = roadside_name(&strips[i], i + 1, arena);
        uint64_t hash = hash_table_hash(0, names[i], strlen(names[i]));
        uint32_t *slot = hash_table_slot(&numbers, hash, is_called, names, names[i]);
        if (*slot != 0)
            return names[i];
        *slot = i + 1;
    }
    return NULL;
}

static int64_t cells_in(double length_m, double cell_m)
{
    return (int64_t)ceil(length_m / cell_m - CELL_SLACK);
}

static double said(double member, double of_kind)
{
    return member == OF_KIND ? of_kind : member;
}

/* Sets the cells: those of a strip without a spacing are thinned out in no place by its length. */
static void divide(struct roadside_grid *grid, double width_m, double spacing_m, double per_m2)
{
    grid->spaced = spacing_m > 0;
    grid->along_m = grid->spaced ? spacing_m : CELL_M;
    grid->along_count = cells_in(grid->length_m, grid->along_m);
    grid->across_count = grid->spaced || width_m <= CELL_M ? 1 : cells_in(width_m, CELL_M);
    grid->across_m = width_m / (double)grid->across_count;
    grid->mean = grid->spaced ? 1 : per_m2 * grid->along_m * grid->across_m;
}

struct roadside_grid roadside_grid_of(const struct roadside_strip *strip)
{
    const struct roadside_strip *kind = &kinds[strip->kind];
    const struct roadside_strip *number = strip->spacing_m > 0 || strip->per_m2 > 0 ? strip : kind;
    struct vec2 from = {strip->from_x_m, strip->from_y_m}, to = {strip->to_x_m, strip->to_y_m};
    struct vec2 run = vec2_sub(to, from);
    double median_dbsm = said(strip->rcs_dbsm, kind->rcs_dbsm);
    struct roadside_grid grid = {
        .from_m = from,
        .length_m = vec2_length(run),
        .median_ercs = radar_ercs(radar_cross_section_from_dbsm_m2(median_dbsm)),
        .spread = units_amplitude_logarithm(said(strip->spread_db, kind->spread_db)),
        .height_m = said(strip->height_m, kind->height_m),
    };
    divide(&grid, strip->width_m, number->spacing_m, number->per_m2);
    if (grid.length_m > 0)
        grid.heading = vec2_scale(1 / grid.length_m, run);
    return grid;
}

/* The place at distances in cells from the beginning and from the right border. */
static struct vec2 place_at(const struct roadside_grid *grid, double along, double across)
{
    double left_m = (across - 0.5 * (double)grid->across_count) * grid->across_m;
    struct vec2 ahead = vec2_scale(along * grid->along_m, grid->heading);
    return vec2_add(vec2_add(grid->from_m, ahead), vec2_scale(left_m, vec2_left(grid->heading)));
}

struct vec2 roadside_cell_middle(const struct roadside_grid *grid, int64_t along, int64_t across)
{
    return place_at(grid, (double)along + 0.5, (double)across + 0.5);
}

struct random_address roadside_address(struct random_address scene,
                                       const struct roadside_strip *strip, size_t number)
{
    scene.frame = strip->id != NULL ? hash_text(HASH_START, strip->id) : number - 1;
    return scene;
}

struct roadside_series roadside_series_of(const struct roadside_grid *grid,
                                          struct random_address strip, int64_t along,
                                          int64_t across)
{
    strip.sensor = (uint64_t)along;
    strip.item = (uint64_t)across;
    return (struct roadside_series){
        .grid = grid, .address = strip, .along = along, .across = across};
}

static int64_t number_of(const struct roadside_series *series, int64_t rank)
{
    const struct roadside_grid *grid = series->grid;
    int64_t cell = series->along * grid->across_count + series->across;
    return grid->spaced ? 1 + cell : 1 + cell * CELL_RANKS + rank;
}

bool roadside_next(struct roadside_series *series, double least_ercs,
                   struct roadside_scatterer *found)
{
    const struct roadside_grid *grid = series->grid;
    const uint32_t ranks = grid->spaced ? 1 : CELL_RANKS;
    double uniform[4], along;
    do {
        if (series->taken == ranks)
            return false;
        random_uniform(&series->address, RANDOM_ROADSIDE, series->taken, uniform);
        double stronger = uniform[0];
        if (!grid->spaced) {
            series->waited -= elementary_log(uniform[0]);
            stronger = series->waited / grid->mean;
        }
        if (!(stronger < 1))
            return false;
        found->number = number_of(series, series->taken++);
        found->ercs =
            grid->median_ercs * elementary_exp(grid->spread * random_gaussian_exceeded(stronger));
        if (found->ercs < least_ercs)
            return false;
        along = (double)series->along + uniform[1];
    } while (along * grid->along_m > grid->length_m);
    found->place_m = place_at(grid, along, (double)series->across + uniform[2]);
    return true;
}

double roadside_level(struct random_address strip, int64_t number, double range_m)
{
    strip.sensor = strip.frame; /* level_on_line has its own use for the frame */
    strip.item = (uint64_t)number;
    return level_on_line(&strip, RANDOM_ROADSIDE_LEVEL, range_m);
}
