/* Random snapshots of traffic: an ego and what is around it.
 *
 * The ego's heading is the direction of the road. Most others keep to lanes 3.5 m wide, those on
 * the left oncoming, some cross, and some stand anywhere at any angle; posts, walls and guardrails
 * stand beside the road. Some stand still, some turn, a few crab. Objects never overlap the ego,
 * and each other rarely. Sizes vary around those of the class; some are left to it (0). Every frame
 * is drawn by its number alone, and in it every object by its own. */
#ifndef RANDOM_TRAFFIC_H
#define RANDOM_TRAFFIC_H

#include "base/random_sequence.h"
#include "frame/frame.h"

/* How many objects within what radius of the ego (NUMERICS C4): 0 to 3 in 120 m, 0 to 8 in 60 m,
 * 4 to 15 in 25 m. Around hard cases (adversarial_traffic.h) 0 to 3 in 60 m. */
enum random_density { RANDOM_SPARSE, RANDOM_MEDIUM, RANDOM_DENSE, RANDOM_ADVERSARIAL };

extern const char *const random_traffic_densities[]; /* their names, ending with NULL */

/* Every class of data/vehicles/ and its share of the objects. */
enum random_class {
    RANDOM_CAR,
    RANDOM_VAN,
    RANDOM_TRUCK,
    RANDOM_ARTICULATED_TRUCK,
    RANDOM_BUS,
    RANDOM_MOTORCYCLE,
    RANDOM_BICYCLE,
    RANDOM_PEDESTRIAN,
    RANDOM_POST,
    RANDOM_WALL,
    RANDOM_GUARDRAIL,
    RANDOM_CLASSES
};

const char *random_traffic_class_name(enum random_class class);
double random_traffic_class_share(enum random_class class); /* they sum to 1 */

/* What the vehicle document says about a class. */
struct random_model {
    double length_m, width_m;
    const struct reflector_set *reflectors;
};

struct random_traffic {
    enum random_density density;
    struct random_model models[RANDOM_CLASSES];
};

/* The address of draws for one frame; the density counts, its seed is the frame's. */
struct random_address random_traffic_address(const struct random_traffic *scene, uint64_t seed,
                                             int64_t number);

/* Fills ego and objects of the frame, whose seed is set, with snapshot number >= 0. The ego is
 * "ego", the others "o1", "o2" and so on. In every other adversarial frame the ego stands at the
 * origin along x, so that places can be exact. */
void random_traffic_fill(const struct random_traffic *scene, int64_t number, struct frame *frame);

/* Draws the road and weather of snapshot number, and who in the frame carries a radar, by an
 * address of their own: rain in 40 % of the snapshots (0.05 to 100 mm/h, evenly in the logarithm),
 * fog in 15 % (0.005 to 1 g/m^3, likewise), asphalt or concrete in 50 %, clutter in 20 % (1e-5 to
 * 3e-3 points per m^2 of 0.01 to 1 ERCS, likewise, up to four times overdispersed), one or two
 * interferers in 20 % (fewer where there are not that many objects beside the ego; 0 to 40 dBm, 1
 * to 50 MHz/us up or down, up to 30 % of the chirps hit). */
void random_traffic_conditions(const struct random_traffic *scene, int64_t number,
                               struct frame *frame);

#endif
