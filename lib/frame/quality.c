#include "frame/quality.h"

#include "base/units.h"

#define MEMBER(bit) FIELD_OPTIONAL, .section = (bit)
#define REAL(member, bit, low, high, help)                                                         \
    FIELD_REAL_IN(struct quality, member, low, high, help), MEMBER(bit)
#define PLACE(member, bit, help) REAL(member, bit, -1e8, 1e8, help)

static const struct field quality_fields[] = {
    {REAL(snr_db, QUALITY_SNR, -1e4, 1e4, "power over that of the noise")},
    {REAL(rcs_dbsm, QUALITY_RCS, -1e5, 1e5, "cross section by amplitude, range and azimuth")},
    {REAL(range_sd_m, QUALITY_RANGE, 0, 1e6, "standard deviation")},
    {REAL(range_rate_sd_mps, QUALITY_RANGE_RATE, 0, 1e6, "standard deviation")},
    {REAL(azimuth_sd_rad, QUALITY_AZIMUTH, 0, PI, "standard deviation")},
    {REAL(existence, QUALITY_EXISTENCE, 0, 1, "probability of an echo, not noise alone")},
    {REAL(range_rate_interval_mps, QUALITY_INTERVAL, 0, 1e6,
          "range rates this far apart read alike; absent: none do")},
    {FIELD_INTEGER_IN(struct quality, ambiguity_number, -1e6, 1e6,
                      "true range rate less the reported one, in such intervals"),
     MEMBER(QUALITY_AMBIGUITY)},
    {FIELD_FLAG_OF(struct quality, merged_objects, "are contributors of several objects?"),
     MEMBER(QUALITY_OBJECTS)},
    {FIELD_FLAG_OF(struct quality, merged_reflectors, "are contributors of several reflectors?"),
     MEMBER(QUALITY_REFLECTORS)},
    {REAL(range_rate_over_ground_mps, QUALITY_OVER_GROUND, -1e6, 1e6,
          "without the sensor's own motion: 0 for what stands")},
    {PLACE(x_sensor_m, QUALITY_X_SENSOR, "from the sensor, along its boresight")},
    {PLACE(y_sensor_m, QUALITY_Y_SENSOR, "from the sensor, to the left of its boresight")},
    {PLACE(x_centre_m, QUALITY_X_CENTRE, "from the centre of the ego's box, forward")},
    {PLACE(y_centre_m, QUALITY_Y_CENTRE, "from the centre of the ego's box, to the left")},
    {PLACE(x_rear_axle_m, QUALITY_X_REAR_AXLE, "from the middle of the rear axle, forward")},
    {PLACE(y_rear_axle_m, QUALITY_Y_REAR_AXLE, "from the middle of the rear axle, to the left")},
    {PLACE(x_world_m, QUALITY_X_WORLD, "from the frame's origin, as objects")},
    {PLACE(y_world_m, QUALITY_Y_WORLD, "from the frame's origin, as objects")},
    {0},
};

const struct record quality_record = {
    FIELD_TABLE(struct quality, quality_fields, "quality",
                "What the sensor tells of a detection's quality; labels are exact."),
    .present_offset = offsetof(struct quality, present)};
