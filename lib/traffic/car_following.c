#include "traffic/car_following.h"

#include "base/elementary.h"

double car_following_acceleration_mps2(const struct car_following *driver, double speed_mps,
                                       double gap_m, double leader_mps)
{
    double braking_mps2 = sqrt(driver->acceleration_mps2 * driver->deceleration_mps2);
    double wanted_m =
        speed_mps * driver->headway_s + speed_mps * (speed_mps - leader_mps) / (2 * braking_mps2);
    double closeness = (driver->gap_m + elementary_max(0, wanted_m)) / gap_m;
    double share = speed_mps / driver->speed_mps;
    return driver->acceleration_mps2 * (1 - share * share * share * share - closeness * closeness);
}

void car_following_move(double *place_m, double *speed_mps, double acceleration_mps2,
                        double duration_s)
{
    double end_mps = *speed_mps + acceleration_mps2 * duration_s;
    if (end_mps >= 0)
        *place_m += (*speed_mps + end_mps) / 2 * duration_s;
    else
        *place_m += *speed_mps * *speed_mps / (-2 * acceleration_mps2);
    *speed_mps = elementary_max(0, end_mps);
}
