/* Traffic on roads: arrivals, car following, and where everybody is.
 *
 * Every lane is a queue of its own. Arrival number n of a lane is drawn by the address of the lane
 * and n: class, size, driver, and the time since arrival n - 1. A vehicle waits outside until it
 * can enter without more than comfortable braking, and all later ones wait behind it. On the lane
 * all follow the Intelligent Driver Model. A red light acts as a leader that stands on every
 * vehicle that can stop with at most twice the comfortable deceleration. Speeds change linearly
 * within steps of 1/16 s, and frames take places and speeds at their own time in a step, so their
 * rate does not change the traffic. */
#pragma once

#include "base/random.h"
#include "traffic/car_following.h"
#include "traffic/lane_path.h"

#define ROAD_TRAFFIC_STEP_S 0.0625

struct frame;

struct road_vehicle {
    const char *id;
    const struct road_arrivals *arrivals;
    double size, length_m; /* size: over that of the class */
    struct car_following driver;
    double front_m; /* along the lane */
    double speed_mps, acceleration_mps2;
};

struct road_queue {
    const struct roadway *road;
    const struct road_lane *lane;
    size_t number; /* of the lane on its road */
    struct lane_path path;
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
