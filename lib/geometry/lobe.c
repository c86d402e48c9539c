#include "geometry/lobe.h"

#include "base/elementary.h"
#include "base/units.h"

static double drop_db(double off_rad, double width_rad, double depth_db)
{
    double widths = width_rad > 0 ? off_rad / width_rad : 0;
    return elementary_min(12 * widths * widths, depth_db);
}

double lobe_amplitude_factor(const struct lobe *lobe, double off_rad, double zenith_rad)
{
    double across_db = drop_db(off_rad, lobe->width_rad, lobe->depth_db);
    double upright_db =
        drop_db(zenith_rad - lobe->zenith_rad, lobe->zenith_width_rad, lobe->depth_db);
    return units_amplitude_from_db(-elementary_min(across_db + upright_db, lobe->depth_db));
}
