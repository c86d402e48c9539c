#include "radar/receiver_curve.h"

#include "base/units.h"

double receiver_curve_level_db(const struct receiver_curve *curve, double angle_rad)
{
    const struct receiver_curve_row *rows = curve->rows;
    size_t low = 0, high = curve->count - 1;
    if (angle_rad <= rows[low].at)
        return rows[low].level_db;
    if (angle_rad >= rows[high].at)
        return rows[high].level_db;
    while (high - low > 1) {
        size_t middle = low + (high - low) / 2;
        if (angle_rad < rows[middle].at)
            high = middle;
        else
            low = middle;
    }
    /* Neither weight is formed from the other, so that mirrored tables are rounded alike. */
    double width = rows[high].at - rows[low].at;
    return rows[low].level_db * ((rows[high].at - angle_rad) / width) +
           rows[high].level_db * ((angle_rad - rows[low].at) / width);
}

double receiver_curve_gain(const struct receiver_curve *curve, double angle_rad)
{
    return units_amplitude_from_db(receiver_curve_level_db(curve, angle_rad) - curve->ahead_db);
}
