#include "frame/quality.h"

#include "base/units.h"

#define MEMBER(group) FIELD_OPTIONAL, .section = QUALITY_##group
#define REAL(member, group, low, high, help)                                                       \
    FIELD_REAL_IN(struct quality, member, low, high, help), MEMBER(group)
#define PLACE(member, group, help) REAL(member, group, -1e8, 1e8, help)
#define FLAG(member, help) FIELD_FLAG_OF(struct quality, member, help), MEMBER(MERGED)

static const struct field quality_fields[] = {
    {REAL(snr_db, NOISE, -1e4, 1e4, "power over that of the noise")},
    {REAL(rcs_dbsm, RCS, -1e5, 1e5, "cross section by amplitude, range and azimuth")},
    {REAL(range_sd_m, ERRORS, 0, 1e6, "standard deviation")},
    {REAL(range_rate_sd_mps, ERRORS, 0, 1e6, "standard deviation")},
    {REAL(azimuth_sd_rad, ERRORS, 0, PI, "standard deviation")},
    {REAL(existence, NOISE, 0, 1, "probability of an echo, not noise alone")},
    {REAL(range_rate_interval_mps, FOLDS, 0, 1e6, "range rates this far apart read alike")},
    {FIELD_INTEGER_IN(struct quality, ambiguity_number, -1e6, 1e6,
                      "true range rate less the reported one, in such intervals"),
     MEMBER(FOLDS)},
    {FLAG(merged_objects, "are contributors of several objects?")},
    {FLAG(merged_reflectors, "are contributors of several reflectors?")},
    {REAL(range_rate_over_ground_mps, EGO, -1e6, 1e6, "0 for what stands")},
    {PLACE(x_sensor_m, MOUNT, "from the sensor, along its boresight")},
    {PLACE(y_sensor_m, MOUNT, "from the sensor, to the left of its boresight")},
    {PLACE(x_centre_m, MOUNT, "from the centre of the ego's box, forward")},
    {PLACE(y_centre_m, MOUNT, "from the centre of the ego's box, to the left")},
    {PLACE(x_rear_axle_m, EGO, "from the middle of the rear axle, forward")},
    {PLACE(y_rear_axle_m, EGO, "from the middle of the rear axle, to the left")},
    {PLACE(x_world_m, EGO, "from the frame's origin, as objects")},
    {PLACE(y_world_m, EGO, "from the frame's origin, as objects")},
    {0},
};

const struct record quality_record = {
    FIELD_TABLE(struct quality, quality_fields, "quality",
                "What the sensor tells of a detection's quality; labels are exact."),
    .present_offset = offsetof(struct quality, present)};
