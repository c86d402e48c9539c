#include "geometry/kinematics.h"

#include "base/elementary.h"
#include "base/units.h"

struct kinematics kinematics_of(struct vec2 sensor_m, struct vec2 sensor_mps, struct vec2 boresight,
                                struct vec2 point_m, struct vec2 point_mps)
{
    struct vec2 line_m = vec2_sub(point_m, sensor_m);
    double range_m = vec2_length(line_m);
    if (range_m == 0)
        return (struct kinematics){0};
    double azimuth_rad =
        elementary_atan2(vec2_cross(boresight, line_m), vec2_dot(boresight, line_m));
    return (struct kinematics){
        .range_m = range_m,
        .azimuth_rad = azimuth_rad <= -PI ? PI : azimuth_rad,
        .range_rate_mps = vec2_dot_accurate(vec2_sub(point_mps, sensor_mps), line_m) / range_m,
    };
}
