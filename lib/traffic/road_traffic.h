/* Traffic on roads: arrivals, car following, places of vehicles.
 *
 * Every lane is a queue of its own. Arrival number n of a lane is drawn by the address of the lane
 * and n: class, size, driver, and the time since arrival n - 1. A vehicle waits outside until it
 * can enter without more than comfortable braking, and all later ones wait behind it. On the lane
 * all follow the Intelligent Driver Model (IDM). A red light acts as a leader that stands on every
 * vehicle that can stop with at most twice the comfortable deceleration. Speeds change linearly
 * within steps of 1/16 s, and frames take places and speeds at their own time in a step, so their
 * rate does not change the traffic.
 *
 * IDM: Treiber, Hennecke and Helbing, "Congested traffic states in empirical observations and
 * microscopic simulations" (2000), with exponent 4 and s1 = 0: behind a leader at v_l, s ahead,
 *
 *     dv/dt = a (1 - (v/v0)^4 - (s* / s)^2),  s* = s0 + max(0, v T + v (v - v_l) / (2 sqrt(a b))),
 *
 * so that at the leader's speed the gap is (s0 + v T) / sqrt(1 - (v/v0)^4). */
#pragma once

#include "base/random.h"
#include "traffic/road.h"

#define ROAD_TRAFFIC_STEP_S 0.0625

struct frame;

/* All positive; the headway may be 0. */
struct road_driver {
    double speed_mps;         /* v0, wanted on a free road */
    double headway_s;         /* T */
    double gap_m;             /* s0, when standing */
    double acceleration_mps2; /* a */
    double deceleration_mps2; /* b, comfortable */
};

struct road_vehicle {
    const char *id;
    const struct road_arrivals *arrivals;
    double size, length_m; /* size: over that of the class */
    struct road_driver driver;
    double front_m; /* along the lane */
    double speed_mps, acceleration_mps2;
};

struct road_queue {
    const struct roadway *road;
    const struct road_lane *lane;
    size_t number; /* of the lane on its road */
    struct road_path path;
    double flow_per_h;
    LIST_OF(struct road_vehicle) vehicles; /* the foremost first */
    struct road_vehicle next;              /* who comes next */
    int64_t next_number;
    double next_s; /* when; INFINITY: nobody */
};

struct road_traffic {
    LIST_OF(struct road_queue) queues;
    struct random_address address;
    int64_t step, begin; /* the present step, from the warm-up on, and that of time 0 */
    double within_s;     /* since the step began */
    const char *awaited; /* id for the ego, until it comes; or NULL */
    struct arena *arena; /* of the scene */
};

/* Fills the roads from time -warmup_s on, and further until the ego comes by its ego_m, if any
 * arrivals have one: that is time 0, and the ego takes this id. The address has the seed and, for
 * scene, the scene's number. All lies in the arena. Refuses a class without a document, lanes too
 * near for their vehicles, and an ego that does not come within six hours. */
int road_traffic_begin(struct road_traffic *traffic, const struct roadway *roads, size_t count,
                       double warmup_s, const char *ego, struct random_address address,
                       struct arena *arena, struct diag *diag);

/* Goes on to a time that is not before the last one. */
void road_traffic_advance(struct road_traffic *traffic, double time_s);

/* Is the vehicle of this id on a road? */
bool road_traffic_has(const struct road_traffic *traffic, const char *id);

/* Appends everybody to the frame's objects, lane by lane from the front. */
void road_traffic_fill(const struct road_traffic *traffic, struct frame *frame);

/* The driver's acceleration. gap_m: from bumper to bumper, INFINITY on a free road; negative
 * infinity at a gap of 0. */
double road_traffic_acceleration_mps2(const struct road_driver *driver, double speed_mps,
                                      double gap_m, double leader_mps);

/* Moves on for duration_s at a constant acceleration. Who comes to a stop on the way stands from
 * there, exactly where the parabola has its vertex: the speed is never negative. */
void road_traffic_move(double *place_m, double *speed_mps, double acceleration_mps2,
                       double duration_s);
