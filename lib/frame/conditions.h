/* Road and weather of a scene, and other vehicles' radars.
 *
 * The scene's document or the source's options set them. An absent condition does not exist: no
 * road that mirrors, no rain, no other radar. */
#pragma once

#include "text/field.h"

enum road { ROAD_UNSAID = -1, ROAD_UNKNOWN, ROAD_ASPHALT, ROAD_CONCRETE };

/* A radar of another vehicle, which disturbs the sensors. It is silent in frames without its
 * object, and if that object is the ego. A scenario must have the object. */
struct interferer {
    const char *object;
    double eirp_dbm;
    double slope_hzps; /* of its chirps */
    double hit_share;  /* the share of the sensor's chirps that one of its chirps crosses */
};

/* Each member has its row in conditions.def. */
struct conditions {
    enum road road;
    double rain_mmph;
    double fog_gpm3;                     /* liquid water */
    double snow_mmph;                    /* melted */
    double clutter_per_m2, clutter_ercs; /* points on the ground; none if either is 0 */
    double clutter_overdispersion;       /* of their number; at most 1: a Poisson count */
    LIST_OF(struct interferer) interferers;
};

extern const struct record conditions_record;

/* Changes of conditions in the same struct: -1 is no change. Other radars do not change. */
extern const struct record conditions_changes_record;

/* How a random scene draws a number, a choice, or the length of the list: evenly from low to high,
 * or evenly in its logarithm. */
enum condition_law { CONDITION_EVENLY, CONDITION_BY_LOGARITHM };

struct condition_draw {
    enum field_kind kind; /* FIELD_REAL, FIELD_CHOICE or FIELD_LIST */
    size_t offset;        /* in struct conditions */
    double share;         /* of scenes that have it; 0: those that have the condition before it */
    enum condition_law law;
    double low, high;
};

/* In the order in which they are drawn. */
extern const struct condition_draw conditions_draws[];
extern const size_t conditions_draw_count;

/* Changes the conditions; a change may be to 0. */
void conditions_change(struct conditions *conditions, const struct conditions *changes);
