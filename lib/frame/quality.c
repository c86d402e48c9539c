#include "frame/quality.h"

#include "base/units.h"

#define QUALITY_GROUP(group) FIELD_OPTIONAL, .section = QUALITY_##group
#define QUALITY_REAL(member, group, low, high, help)                                               \
    FIELD_REAL_IN(struct quality, member, low, high, help), QUALITY_GROUP(group)
#define QUALITY_PLACE(member, group, help) QUALITY_REAL(member, group, -1e8, 1e8, help)
#define QUALITY_FLAG(member, help)                                                                 \
    FIELD_FLAG_OF(struct quality, member, help), QUALITY_GROUP(MERGED)

static const struct field quality_fields[] = {
    {QUALITY_REAL(snr_db, NOISE, -1e4, 1e4, "power over that of the noise")},
    {QUALITY_REAL(rcs_dbsm, RCS, -1e5, 1e5, "cross section by amplitude, range and azimuth")},
    {QUALITY_REAL(range_sd_m, ERRORS, 0, 1e6, "standard deviation")},
    {QUALITY_REAL(range_rate_sd_mps, ERRORS, 0, 1e6, "standard deviation")},
    {QUALITY_REAL(azimuth_sd_rad, ERRORS, 0, PI, "standard deviation")},
    {QUALITY_REAL(existence, NOISE, 0, 1, "probability of an echo, not noise alone")},
    {QUALITY_REAL(range_rate_interval_mps, FOLDS, 0, 1e6, "range rates this far apart read alike")},
    {FIELD_INTEGER_IN(struct quality, ambiguity_number, -1e6, 1e6,
                      "true range rate less the reported one, in such intervals"),
     QUALITY_GROUP(FOLDS)},
    {QUALITY_FLAG(merged_objects, "are contributors of several objects?")},
    {QUALITY_FLAG(merged_reflectors, "are contributors of several reflectors?")},
    {QUALITY_REAL(range_rate_over_ground_mps, EGO, -1e6, 1e6, "0 for what stands")},
    {QUALITY_PLACE(x_sensor_m, MOUNT, "from the sensor, along its boresight")},
    {QUALITY_PLACE(y_sensor_m, MOUNT, "from the sensor, to the left of its boresight")},
    {QUALITY_PLACE(x_centre_m, MOUNT, "from the centre of the ego's box, forward")},
    {QUALITY_PLACE(y_centre_m, MOUNT, "from the centre of the ego's box, to the left")},
    {QUALITY_PLACE(x_rear_axle_m, EGO, "from the middle of the rear axle, forward")},
    {QUALITY_PLACE(y_rear_axle_m, EGO, "from the middle of the rear axle, to the left")},
    {QUALITY_PLACE(x_world_m, EGO, "from the frame's origin, as objects")},
    {QUALITY_PLACE(y_world_m, EGO, "from the frame's origin, as objects")},
    {0},
};

const struct record quality_record = {
    FIELD_TABLE(struct quality, quality_fields, "quality",
                "What the sensor tells of a detection's quality; labels are exact."),
    .present_offset = offsetof(struct quality, present)};
