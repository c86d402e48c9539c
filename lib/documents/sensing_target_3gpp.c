#include "documents/sensing_target_3gpp.h"

#include "base/units.h"
#include "radar/radar_equation.h"

#define DEGREE (PI / 180)

const char *const sensing_target_3gpp_names[] = {[SENSING_TARGET_3GPP_NONE] = "none",
                                                 [SENSING_TARGET_3GPP_VEHICLE] = "vehicle",
                                                 [SENSING_TARGET_3GPP_HUMAN] = "human",
                                                 NULL};

/* One row of the report's tables for several scattering points; angles in degrees. */
struct scattering_point {
    const char *name;
    double x, y, z; /* the middle of its face */
    double azimuth, azimuth_width, zenith, zenith_width;
    double most_dbsm, depth_db;
};

static const struct scattering_point vehicle[] = {
    {"front", 0.5, 0, 0.5, 0, 40.54, 71.75, 29.13, 14.99, 14.91},
    {"left", 0, 0.5, 0.5, 90, 26.90, 79.70, 44.42, 20.60, 20.52},
    {"back", -0.5, 0, 0.5, 180, 36.32, 79.65, 36.73, 13.90, 13.82},
    {"right", 0, -0.5, 0.5, -90, 26.90, 79.70, 44.42, 20.60, 20.52},
    {"roof", 0, 0, 1, 0, 0, 0, 18.13, 21.12, 21.05},
};

/* The report's adult is 1.75 m high, its point at 1.5 m; no lobe. */
static const struct scattering_point human = {"body", 0, 0, 1.5 / 1.75, 0, 0, 0, 0, -1.37, 0};

static struct point_reflector point_of(const struct scattering_point *point)
{
    return (struct point_reflector){
        .name = point->name,
        .x = point->x,
        .y = point->y,
        .z = point->z,
        .facing_rad = point->azimuth * DEGREE,
        .full_rad = PI,
        .zero_rad = PI,
        .shape = VISIBILITY_HARD,
        .ercs = radar_ercs(radar_cross_section_from_dbsm_m2(point->most_dbsm)),
        .lobe = {.width_rad = point->azimuth_width * DEGREE,
                 .zenith_rad = point->zenith * DEGREE,
                 .zenith_width_rad = point->zenith_width * DEGREE,
                 .depth_db = point->depth_db},
    };
}

void sensing_target_3gpp_describe(enum sensing_target_3gpp target, struct reflector_set *set,
                                  struct arena *arena)
{
    bool is_human = target == SENSING_TARGET_3GPP_HUMAN;
    const struct scattering_point *points = is_human ? &human : vehicle;
    size_t count = is_human ? 1 : sizeof vehicle / sizeof *vehicle;
    struct reflector_set described = *set;
    described.points.items = NULL;
    described.points.count = described.points.room = 0;
    described.planes.count = described.rows.count = 0;
    for (size_t i = 0; i < count; i++)
        *list_add(&described.points, arena) = point_of(&points[i]);
    if (is_human)
        described.points.items[0].moving_part = MOVING_LIMBS;
    *set = described;
}
