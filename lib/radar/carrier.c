#include "radar/carrier.h"

#include <math.h>

#define LIGHT_MPS 299792458.0

/* A rounded product and its rounding error; their sum is the exact product. */
struct product {
    double rounded, error;
};

/* The leading 26 bits of x (Veltkamp). */
static double leading(double x)
{
    double shifted = 0x8000001p0 * x;
    return shifted - (shifted - x);
}

/* The exact product by Dekker's algorithm. */
static struct product multiply(double a, double b)
{
    double a_high = leading(a), b_high = leading(b);
    double a_low = a - a_high, b_low = b - b_high;
    double rounded = a * b;
    double error = a_high * b_high - rounded + a_high * b_low + a_low * b_high + a_low * b_low;
    return (struct product){rounded, error};
}

double carrier_phase_turns(double range_m, double carrier_hz)
{
    struct product path = multiply(2 * range_m, carrier_hz);
    struct product whole = multiply(round(path.rounded / LIGHT_MPS), LIGHT_MPS);
    double rest = path.rounded - whole.rounded - whole.error + path.error;
    double turns = rest / LIGHT_MPS;
    return turns - round(turns);
}
