#include "frame/conditions.h"

static const char *const roads[] = {
    [ROAD_UNKNOWN] = "unknown", [ROAD_ASPHALT] = "asphalt", [ROAD_CONCRETE] = "concrete", NULL};

static const struct field interferer_fields[] = {
    {FIELD_NAME_OF(struct interferer, object, "id of the object that carries it")},
    {FIELD_REAL_IN(struct interferer, eirp_dbm, -100, 100, "what it radiates towards us")},
    {FIELD_REAL_IN(struct interferer, slope_hzps, -1e15, 1e15, "of its chirps, falling negative")},
    {FIELD_REAL_IN(struct interferer, hit_share, 0, 1, "part of our chirps that it crosses")},
    {0},
};

static const struct record interferer_record = {
    .name = "interferer",
    .help = "An object with a radar of its own.",
    .size = sizeof(struct interferer),
    .fields = interferer_fields,
};

#define ROAD(absent_)                                                                              \
    {                                                                                              \
        FIELD_CHOICE_OF(struct conditions, road, roads, "what the road is made of: it mirrors"),   \
            FIELD_OPTIONAL, .absent = (absent_)                                                    \
    }
#define RAIN(absent_)                                                                              \
    {                                                                                              \
        FIELD_REAL_IN(struct conditions, rain_mmph, 0, 500, "rain"), FIELD_OPTIONAL,               \
            .absent = (absent_)                                                                    \
    }
#define FOG(absent_)                                                                               \
    {                                                                                              \
        FIELD_REAL_IN(struct conditions, fog_gpm3, 0, 10, "fog, liquid water; dense fog has 0.5"), \
            FIELD_OPTIONAL, .absent = (absent_)                                                    \
    }

#define CLUTTER(absent_)                                                                           \
    {FIELD_REAL_IN(struct conditions, clutter_per_m2, 0, 10,                                       \
                   "points of the ground that echo, at most 1000 of them in a scan"),              \
     FIELD_OPTIONAL, .absent = (absent_)},                                                         \
        {FIELD_REAL_IN(struct conditions, clutter_ercs, 0, 1e3,                                    \
                       "of these, on average over power"),                                         \
         FIELD_OPTIONAL, .absent = (absent_)},                                                     \
    {                                                                                              \
        FIELD_REAL_IN(struct conditions, clutter_overdispersion, 0, 1e3,                           \
                      "variance of their number in a scan over its mean; absent: 1"),              \
            FIELD_OPTIONAL, .absent = (absent_)                                                    \
    }

static const struct field condition_fields[] = {
    ROAD(ROAD_UNKNOWN),
    RAIN(0),
    FOG(0),
    CLUTTER(0),
    {FIELD_LIST_OF(struct conditions, interferers, &interferer_record, "other radars"),
     FIELD_OPTIONAL},
    {0},
};

static const struct field change_fields[] = {
    ROAD(ROAD_UNSAID), RAIN(-1), FOG(-1), CLUTTER(-1), {0}};

const struct record conditions_record = {
    .name = "conditions",
    .help = "Road and weather; what is not said is not there.",
    .size = sizeof(struct conditions),
    .fields = condition_fields,
};

const struct record conditions_changes_record = {
    .name = "changes of conditions",
    .help = "Road and weather; what is not said stays.",
    .size = sizeof(struct conditions),
    .fields = change_fields,
};

void conditions_change(struct conditions *conditions, const struct conditions *changes)
{
    if (changes->road != ROAD_UNSAID)
        conditions->road = changes->road;
    if (changes->rain_mmph >= 0)
        conditions->rain_mmph = changes->rain_mmph;
    if (changes->fog_gpm3 >= 0)
        conditions->fog_gpm3 = changes->fog_gpm3;
    if (changes->clutter_per_m2 >= 0)
        conditions->clutter_per_m2 = changes->clutter_per_m2;
    if (changes->clutter_ercs >= 0)
        conditions->clutter_ercs = changes->clutter_ercs;
    if (changes->clutter_overdispersion >= 0)
        conditions->clutter_overdispersion = changes->clutter_overdispersion;
}
