/* Random snapshots of traffic: an ego and its surroundings.
 *
 * The ego's heading is the direction of the road. Most objects are on lanes 3.5 m wide, oncoming on
 * the left; some cross, and some have any place and yaw. Posts, walls and guardrails stand beside
 * the road. Some objects stand still, some turn, a few crab. Objects never overlap the ego, and
 * rarely each other. Sizes vary around those of the class, or are left to it (0). A snapshot
 * depends on its number alone, and each of its objects on the object's number. */
#pragma once

#include "base/random.h"
#include "frame/frame.h"

/* How many objects there are, and where. */
struct random_traffic_density {
    const char *name;
    int64_t least, most;      /* objects beside the ego */
    double radius_m, ego_mps; /* around the ego; greatest speed of the ego */
    bool centred; /* in every other snapshot the ego stands at the origin, so places can be exact */
};

/* 0 to 3 objects in 120 m, 0 to 8 in 60 m, 4 to 15 in 25 m. */
enum { TRAFFIC_SPARSE, TRAFFIC_MEDIUM, TRAFFIC_DENSE, TRAFFIC_DENSITIES };
extern const struct random_traffic_density random_traffic_densities[TRAFFIC_DENSITIES];

/* The classes of objects: all of data/vehicles/. */
enum random_traffic_class {
    TRAFFIC_CAR,
    TRAFFIC_VAN,
    TRAFFIC_TRUCK,
    TRAFFIC_ARTICULATED_TRUCK,
    TRAFFIC_BUS,
    TRAFFIC_MOTORCYCLE,
    TRAFFIC_BICYCLE,
    TRAFFIC_PEDESTRIAN,
    TRAFFIC_POST,
    TRAFFIC_WALL,
    TRAFFIC_GUARDRAIL,
    TRAFFIC_CLASSES
};

const char *random_traffic_class_name(enum random_traffic_class class);

/* Size and reflectors of a class, from its vehicle document. */
struct random_traffic_model {
    double length_m, width_m;
    const struct reflector_set *reflectors;
};

struct random_traffic {
    const struct random_traffic_density *density;
    struct random_traffic_model models[TRAFFIC_CLASSES];
};

/* The address of the draws for one snapshot; each density has other draws. */
struct random_address random_traffic_address(const struct random_traffic *traffic, uint64_t seed,
                                             int64_t number);

/* Fills ego and objects of the frame, whose seed is set, with snapshot number >= 0. The ego's id is
 * "ego", the others' "o1", "o2" and so on. */
void random_traffic_fill(const struct random_traffic *traffic, int64_t number, struct frame *frame);

/* Draws what stands beside the road, at the address of a snapshot: on each
 * side, independently, a rail or a kerb 5 to 12 m from the ego with probability 0.5, poles farther
 * out with 0.3 and vegetation farther out with 0.5. The strips go from 300 m behind the ego to 300
 * m ahead. */
void random_traffic_roadside(struct random_address address, struct frame *frame);

/* Draws road, weather and the objects with a radar (interferers) at the address of a snapshot or a
 * moving scene, by the laws of the effects that read them
 * (effects/effect.h). There are at most as many interferers as
 * objects beside the ego; each has 0 to 40 dBm and chirps of 1 to 50 MHz/us up or down, and hits up
 * to 30 % of the chirps. */
void random_traffic_conditions(struct random_address address, struct frame *frame);
