/* Traffic on roads: arrivals, car following, places of vehicles.
 *
 * Every lane is a queue. Arrival number n of a lane is drawn at the address of the lane and n:
 * class, size, driver, and the time since arrival n - 1. A vehicle waits outside until it can enter
 * with comfortable braking, and all later ones wait behind it. On the lane vehicles follow the
 * Intelligent Driver Model (IDM). A red light acts as a standing leader on every vehicle that can
 * stop with at most twice the comfortable deceleration. Speeds change linearly within steps of
 * 1/16 s. Frames take places and speeds at their own time within a step, so the frame rate does not
 * change the traffic.
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
    struct road_vehicle next;              /* the next arrival */
    int64_t next_number;
    double next_s; /* its time; INFINITY: none */
};

struct road_traffic {
    LIST_OF(struct road_queue) queues;
    struct random_address address;
    int64_t step, begin; /* numbers of the present step and of that of time 0 */
    double within_s;     /* time since the step began */
    const char *awaited; /* id of an ego that has not come yet, or NULL */
    struct arena *arena; /* of the scene */
};

/* Fills the roads for warmup_s. Unless ego is NULL, goes on until a vehicle passes the ego_m of its
 * arrivals; that is time 0, and the vehicle gets this id. The address has the seed and the scene.
 * Refuses a class without a document, lanes too near for their vehicles, and an ego that does not
 * come within six hours. */
int road_traffic_begin(struct road_traffic *traffic, const struct roadway *roads, size_t count,
                       double warmup_s, const char *ego, struct random_address address,
                       struct arena *arena, struct diag *diag);

/* Advances to a time that is not before the last one. */
void road_traffic_advance(struct road_traffic *traffic, double time_s);

/* Is the vehicle of this id on a road? */
bool road_traffic_has(const struct road_traffic *traffic, const char *id);

/* Appends all vehicles to the frame's objects, lane by lane from the front. */
void road_traffic_fill(const struct road_traffic *traffic, struct frame *frame);

/* The driver's acceleration. gap_m is from bumper to bumper, INFINITY on a free road; at 0 the
 * acceleration is -INFINITY. */
double road_traffic_acceleration_mps2(const struct road_driver *driver, double speed_mps,
                                      double gap_m, double leader_mps);

/* Moves a vehicle for duration_s at a constant acceleration. If it stops on the way, it stays
 * there: the speed is never negative. */
void road_traffic_move(double *place_m, double *speed_mps, double acceleration_mps2,
                       double duration_s);
