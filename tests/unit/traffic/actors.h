/* Actors of tests, and where they are. */
#pragma once

#include "check.h"

#include "base/units.h"
#include "traffic/actor.h"

static const struct waypoint WINDING[] = {{0.5, 0, 0}, {2, 12, 3},  {2.6, 18, 1},
                                          {5, 25, 22}, {6, 20, 30}, {8.5, -3, 18}};

static inline struct actor driver(struct segment *segments, size_t count)
{
    struct actor actor = {.id = "a", .class = "car"};
    actor.segments.items = segments;
    actor.segments.count = count;
    return actor;
}

static inline struct actor follower(struct waypoint *waypoints, size_t count)
{
    struct actor actor = {.id = "a", .class = "car"};
    actor.waypoints.items = waypoints;
    actor.waypoints.count = count;
    return actor;
}

static inline struct motion motion_at(const struct actor *actor, double time_s)
{
    struct actor prepared = *actor;
    double travelled_m;
    actor_prepare(&prepared, check_arena());
    return actor_motion(&prepared, time_s, &travelled_m);
}

static inline double travelled_at(const struct actor *actor, double time_s)
{
    struct actor prepared = *actor;
    double travelled_m;
    actor_prepare(&prepared, check_arena());
    actor_motion(&prepared, time_s, &travelled_m);
    return travelled_m;
}

static inline void check_place(struct vec2 place, double x_m, double y_m, double tolerance_m)
{
    assert_close(place.x, x_m, tolerance_m);
    assert_close(place.y, y_m, tolerance_m);
}
