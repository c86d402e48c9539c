#include "propagation/carrier.h"

#include "base/units.h"
#include "base/vec2.h"

/* The products are exact: each is a rounded one and its rest. */
double carrier_phase_turns(double range_m, double carrier_hz)
{
    const double light_mps = SPEED_OF_LIGHT_MPS;
    double path = 2 * range_m * carrier_hz, whole = round(path / light_mps);
    double path_rest = vec2_product_rest(2 * range_m, carrier_hz, path);
    double whole_rest = vec2_product_rest(whole, light_mps, whole * light_mps);
    double turns = (path - whole * light_mps - whole_rest + path_rest) / light_mps;
    return turns - round(turns);
}
