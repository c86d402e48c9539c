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

struct conditions {
#define NUMBER(member, ...) double member;
#define CHOICE(type, member, ...) type member;
#define LIST(type, member, ...) LIST_OF(type) member;
#include "frame/conditions.def"
};

extern const struct record conditions_record;

/* Changes of conditions in the same struct: -1 is no change. Other radars do not change. */
extern const struct record conditions_changes_record;

/* Changes the conditions; a change may be to 0. */
void conditions_change(struct conditions *conditions, const struct conditions *changes);
