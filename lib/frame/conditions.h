/* Road and weather of a scene, and other vehicles' radars.
 *
 * They are those of the scene's document or of the source's options. What is absent there does not
 * exist: no road that mirrors, no rain, no other radar. */
#pragma once

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

/* Each member has its row in conditions.def. */
struct conditions {
    enum road road;
    double rain_mmph;
    double fog_gpm3;                     /* liquid water */
    double snow_mmph;                    /* melted */
    double clutter_per_m2, clutter_ercs; /* points on the ground; there are none without both */
    double clutter_overdispersion;       /* of their number (random_poisson); up to 1: Poisson */
    LIST_OF(struct interferer) interferers;
};

extern const struct record conditions_record;

/* The same struct for changes: what is not said is -1. They leave other radars as they are. */
extern const struct record conditions_changes_record;

/* How a random scene draws a value: evenly from low to high, or evenly in its logarithm. Of a
 * choice it draws one from low to high, and of the list how many. */
enum condition_law { CONDITION_EVENLY, CONDITION_BY_LOGARITHM };

struct condition_draw {
    enum field_kind kind; /* FIELD_REAL, FIELD_CHOICE or FIELD_LIST */
    size_t offset;        /* in struct conditions */
    double share;         /* of scenes that have it; 0: those that have the one drawn before it */
    enum condition_law law;
    double low, high;
};

/* In the order in which they are drawn. */
extern const struct condition_draw conditions_draws[];
extern const size_t conditions_draw_count;

/* Puts what is said in changes, 0 too, in place of what conditions say. */
void conditions_change(struct conditions *conditions, const struct conditions *changes);
