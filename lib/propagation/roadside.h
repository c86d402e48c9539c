/* Scatterers that stand beside the road, each at its address.
 *
 * A strip runs straight from one place to another and is divided into cells. What stands in a cell
 * is drawn from the seed, the scene, the strip's id or number and the cell, never from the frame,
 * the sensor or another strip, so it stays where it is (MODEL 14.23). A strip with a spacing has
 * one scatterer in each cell of that length, at a uniform place. Any other has a Poisson process in
 * cells of 4 m, whose scatterers come strongest first (LePage's series): their ranks are the sums
 * of exponential gaps. So a caller may stop at any strength without missing a stronger one. */
#pragma once

#include "base/arena.h"
#include "base/random.h"
#include "base/vec2.h"
#include "text/field.h"

enum roadside_kind {
    ROADSIDE_OTHER,
    ROADSIDE_RAIL,
    ROADSIDE_POLES,
    ROADSIDE_KERB,
    ROADSIDE_VEGETATION,
};

extern const char *const roadside_kinds[]; /* names; the last is NULL */

/* Places are in the frame's coordinates, on the middle line of the strip. */
struct roadside_strip {
    const char *id; /* unique in the scene; NULL: none */
    enum roadside_kind kind;
    double from_x_m, from_y_m, to_x_m, to_y_m;
    double width_m;   /* 0: a line */
    double spacing_m; /* one scatterer in each such length; 0: per_m2 holds */
    double per_m2;    /* mean number; both 0: those of the kind */
    double rcs_dbsm;  /* median cross section */
    double spread_db; /* standard deviation of the cross sections in dB, which are normal */
    double level_db;  /* standard deviation of a level over range, with knots of 1 m */
    double height_m;  /* of the top over the road; 0: not known */
};

extern const struct record roadside_strip_record;

void roadside_shift(struct roadside_strip *strip, struct vec2 by_m);

/* The name of a strip: its id, or else its kind and its number in the scene's list, from 1:
 * "rail_2". It is the reflector of its echoes. */
const char *roadside_name(const struct roadside_strip *strip, size_t number, struct arena *arena);

/* A name that two strips of a scene share, or NULL. */
const char *roadside_name_twice(const struct roadside_strip *strips, size_t count,
                                struct arena *arena);

/* The cells of a strip, and the values that all of them share. */
struct roadside_grid {
    struct vec2 from_m, heading;        /* heading: unit vector along the strip */
    double length_m, along_m, across_m; /* of the strip; of a cell */
    int64_t along_count, across_count;  /* numbers of cells; none of a strip without length */
    bool spaced;                        /* one scatterer in each cell */
    double mean;                        /* number of scatterers in a cell */
    double median_ercs, spread;         /* ln(ERCS) is normal, with this standard deviation */
    double height_m;
};

/* Members that the strip does not set have the values of its kind. */
struct roadside_grid roadside_grid_of(const struct roadside_strip *strip);

/* The middle of a cell; along counts from the beginning, across from the right border. */
struct vec2 roadside_cell_middle(const struct roadside_grid *grid, int64_t along, int64_t across);

struct roadside_scatterer {
    struct vec2 place_m;
    double ercs;
    int64_t number; /* in the strip, from 1: by its cell and its rank there */
};

/* The address of what is drawn for a strip: by its id, or else by its number in the scene's list,
 * from 1. scene is the address of the scene: its seed and name alone. */
struct random_address roadside_address(struct random_address scene,
                                       const struct roadside_strip *strip, size_t number);

/* The scatterers of one cell, the strongest first. */
struct roadside_series {
    const struct roadside_grid *grid;
    struct random_address address;
    int64_t along, across;
    double waited; /* sum of the gaps so far */
    uint32_t taken;
};

struct roadside_series roadside_series_of(const struct roadside_grid *grid,
                                          struct random_address strip, int64_t along,
                                          int64_t across);

/* The next scatterer; false if no other one of the cell has at least this ERCS. */
bool roadside_next(struct roadside_series *series, double least_ercs,
                   struct roadside_scatterer *found);

/* The level of a scatterer at a range, a standard normal number that changes with the range. */
double roadside_level(struct random_address strip, int64_t number, double range_m);
