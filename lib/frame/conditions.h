/* Road and weather of a scene, as its document or the source's options say. What is not said is not
 * there: no road to mirror, no rain, nobody else's radar. */
#ifndef CONDITIONS_H
#define CONDITIONS_H

#include "text/field.h"

enum road { ROAD_UNSAID = -1, ROAD_UNKNOWN, ROAD_ASPHALT, ROAD_CONCRETE };

/* An object that carries a radar of its own, of another kind or out of step. One that is not in the
 * frame has left and is not heard, nor is the ego; a scenario must know it, though. */
struct interferer {
    const char *object;
    double eirp_dbm;
    double slope_hzps; /* of its chirps */
    double hit_share;  /* the part of our chirps that one of its crosses */
};

struct conditions {
    enum road road;
    double rain_mmph;
    double fog_gpm3;                     /* liquid water */
    double clutter_per_m2, clutter_ercs; /* points on the ground; there are none without both */
    double clutter_overdispersion;       /* of their number (poisson.h); up to 1: Poisson */
    LIST_OF(struct interferer) interferers;
};

extern const struct record conditions_record;

/* The same struct for changes: what is not said is -1. They leave other radars as they are. */
extern const struct record conditions_changes_record;

/* Puts what is said in changes, 0 too, in place of what conditions say. */
void conditions_change(struct conditions *conditions, const struct conditions *changes);

#endif
