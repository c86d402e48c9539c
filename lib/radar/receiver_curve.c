#include "radar/receiver_curve.h"

#include "base/search.h"
#include "base/units.h"

double receiver_curve_level_db(const struct receiver_curve *curve, double angle_rad)
{
    const struct receiver_curve_row *rows = curve->rows;
    size_t last = curve->count - 1;
    if (angle_rad <= rows[0].at)
        return rows[0].level_db;
    if (angle_rad >= rows[last].at)
        return rows[last].level_db;
    const struct receiver_curve_row *low =
        &rows[search_row(&rows[0].at, sizeof *rows, last, angle_rad)];
    const struct receiver_curve_row *high = low + 1;
    /* Neither weight is formed from the other, so that mirrored tables are rounded alike. */
    double width = high->at - low->at;
    return low->level_db * ((high->at - angle_rad) / width) +
           high->level_db * ((angle_rad - low->at) / width);
}

double receiver_curve_gain(const struct receiver_curve *curve, double angle_rad)
{
    return units_amplitude_from_db(receiver_curve_level_db(curve, angle_rad) - curve->ahead_db);
}
