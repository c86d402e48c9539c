#include "radar/antenna.h"

#include "base/elementary.h"
#include "base/search.h"
#include "base/units.h"

/* The real factors of both pointers: H_sum = sum · e, H_delta = -j delta · e. */
struct antenna_pair {
    double sum, delta;
};

/* The phase u = (pi/2) sin|azimuth| of a dipole against the array's centre. */
struct dipole_phase {
    double u, cos_azimuth, cos_u;
    double sin_u; /* with the sign of the azimuth */
};

/* Near pi/2 cos u comes from its cofunction (hard case 4). The sign of sin u is set last, so that
 * mirrored azimuths are rounded alike. */
static struct dipole_phase dipole_phase_at(double azimuth_rad)
{
    struct elementary_sincos azimuth = elementary_sincos(fabs(azimuth_rad));
    double u = PI / 2 * azimuth.sin;
    struct elementary_sincos phase = elementary_sincos(u);
    if (azimuth.sin >= 0.5)
        phase.cos = elementary_sin(PI / 2 * (azimuth.cos * azimuth.cos / (1 + azimuth.sin)));
    return (struct dipole_phase){u, azimuth.cos, phase.cos, copysign(phase.sin, azimuth_rad)};
}

static struct antenna_pair dipole_pair(double azimuth_rad)
{
    struct dipole_phase phase = dipole_phase_at(azimuth_rad);
    double element = units_si(phase.u) * phase.cos_azimuth;
    return (struct antenna_pair){element * phase.cos_u, element * phase.sin_u};
}

/* The mean of two values under weights that sum to 1. Neither weight is formed from the other, so
 * that a mirrored table gives exactly mirrored results. */
static double interpolated(double from, double from_weight, double to, double to_weight)
{
    return from * from_weight + to * to_weight;
}

static struct antenna_pair table_pair(const struct antenna *antenna, double azimuth_rad)
{
    const struct antenna_row *first = antenna->rows, *last = first + antenna->row_count - 1;
    if (azimuth_rad < first->azimuth_rad || azimuth_rad > last->azimuth_rad)
        return (struct antenna_pair){0, 0};
    const struct antenna_row *low =
        first + search_row(&first->azimuth_rad, sizeof *first, antenna->row_count - 1, azimuth_rad);
    const struct antenna_row *high = low + 1;
    double width = high->azimuth_rad - low->azimuth_rad;
    double to = (azimuth_rad - low->azimuth_rad) / width;
    double from = (high->azimuth_rad - azimuth_rad) / width;
    return (struct antenna_pair){interpolated(low->sum, from, high->sum, to),
                                 interpolated(low->delta, from, high->delta, to)};
}

static struct antenna_pair pattern_pair(const struct antenna *antenna, double azimuth_rad)
{
    if (antenna->pattern == ANTENNA_TABLE)
        return table_pair(antenna, azimuth_rad);
    if (antenna->pattern == ANTENNA_ARRAY)
        return (struct antenna_pair){1, 0};
    return dipole_pair(azimuth_rad);
}

static struct antenna_pair pair_at(const struct antenna *antenna, double azimuth_rad)
{
    struct antenna_pair pair = pattern_pair(antenna, azimuth_rad);
    if (antenna->curve.rows == NULL || pair.sum == 0)
        return pair;
    double gain = receiver_curve_gain(&antenna->curve, azimuth_rad);
    return (struct antenna_pair){gain, gain * (pair.delta / pair.sum)};
}

/* Positive if delta/sum of the pair is above that of the row. */
static double row_cross(struct antenna_pair pair, const struct antenna_row *row)
{
    return pair.delta * row->sum - pair.sum * row->delta;
}

/* Where a ratio of delta to sum lies in a table. */
struct ratio_search {
    const struct antenna_row *rows;
    struct antenna_pair pair;
};

/* True if delta/sum of the pair is above that of the row. If both sums are zero, the cross product
 * cannot tell minus from plus infinity, and the sign of the pair's delta decides. */
static bool is_above(const void *of, size_t row)
{
    const struct ratio_search *search = of;
    double cross = row_cross(search->pair, &search->rows[row]);
    return cross > 0 || (cross == 0 && search->pair.delta > 0);
}

static double table_azimuth(const struct antenna *antenna, struct antenna_pair pair)
{
    const struct ratio_search search = {antenna->rows, pair};
    size_t last = antenna->row_count - 1;
    if (!is_above(&search, 0))
        return antenna->rows[0].azimuth_rad;
    if (is_above(&search, last))
        return antenna->rows[last].azimuth_rad;
    const struct antenna_row *low = &antenna->rows[search_last(0, last, is_above, &search)];
    const struct antenna_row *high = low + 1;
    double above = row_cross(pair, low);
    double below = -row_cross(pair, high);
    double azimuth_rad = interpolated(low->azimuth_rad, below / (above + below), high->azimuth_rad,
                                      above / (above + below));
    return elementary_min(elementary_max(azimuth_rad, low->azimuth_rad), high->azimuth_rad);
}

/* Uses arcsin only where it is well conditioned, up to half of its range (hard case 7). */
static double dipole_azimuth(struct antenna_pair pair)
{
    double size = fabs(pair.delta);
    double azimuth_rad;
    if (size <= pair.sum) {
        azimuth_rad = elementary_asin(elementary_atan2(size, pair.sum) / (PI / 2));
    } else {
        double from_side = elementary_atan2(pair.sum, size) / (PI / 2);
        azimuth_rad = elementary_atan2(1 - from_side, sqrt(from_side * (2 - from_side)));
    }
    return pair.delta < 0 ? -azimuth_rad : azimuth_rad;
}

static double _Complex pointer(double real, double imag)
{
    return real + imag * (double _Complex)I;
}

struct antenna_pointers antenna_pointers(const struct antenna *antenna, double azimuth_rad)
{
    struct antenna_pair pair = pair_at(antenna, azimuth_rad);
    if (antenna->phase == PHASE_CENTRE)
        return (struct antenna_pointers){pointer(pair.sum, 0), pointer(0, -pair.delta)};
    struct dipole_phase phase = dipole_phase_at(azimuth_rad);
    return (struct antenna_pointers){pointer(pair.sum * phase.cos_u, pair.sum * phase.sin_u),
                                     pointer(pair.delta * phase.sin_u, -pair.delta * phase.cos_u)};
}

double antenna_gain(const struct antenna *antenna, double azimuth_rad)
{
    return pair_at(antenna, azimuth_rad).sum;
}

/* By steps and not by base/root.h, as a pattern may cross its edge more than once. */
double antenna_beam_rad(const struct antenna *antenna)
{
    const double fine_rad = PI / 2 / 65536;
    double edge = sqrt(0.5) * antenna_gain(antenna, 0), above_rad = 0;
    for (int steps = 16; steps > 0; steps /= 16)
        while (above_rad < PI / 2 && antenna_gain(antenna, above_rad + steps * fine_rad) > edge)
            above_rad += steps * fine_rad;
    return elementary_min(2 * (above_rad + fine_rad), PI);
}

double antenna_border_rad(double field_of_view_rad)
{
    return field_of_view_rad / 2 - 1e-9;
}

double antenna_azimuth_rad(const struct antenna *antenna, double delta, double sum)
{
    /* Scaling by a power of two changes neither the ratio nor any rounding. */
    int exponent;
    frexp(elementary_max(fabs(delta), sum), &exponent);
    struct antenna_pair pair = {elementary_scaled(sum, -exponent),
                                elementary_scaled(delta, -exponent)};
    return antenna->pattern == ANTENNA_TABLE ? table_azimuth(antenna, pair) : dipole_azimuth(pair);
}

const char *antenna_table_fault(const struct antenna_row *rows, size_t count, size_t *row)
{
    *row = count;
    if (count < 2)
        return "a pattern needs two rows or more";
    for (size_t i = 0; i < count; i++) {
        *row = i;
        if (!(rows[i].sum >= 0))
            return "the sum must not be negative";
        if (rows[i].sum == 0 && rows[i].delta == 0)
            return "sum and delta must not both be zero";
        if (i == 0)
            continue;
        if (!(rows[i].azimuth_rad > rows[i - 1].azimuth_rad))
            return "azimuth must ascend from row to row";
        struct antenna_pair pair = {rows[i].sum, rows[i].delta};
        if (!(row_cross(pair, &rows[i - 1]) > 0))
            return "the ratio of delta to sum must ascend from row to row";
    }
    return NULL;
}

double antenna_reported_rad(const struct boresight_error *error, double azimuth_rad)
{
    double reported_rad = azimuth_rad + error->yaw_error_rad;
    if (error->bias_rad != 0) {
        double turns = azimuth_rad / error->bias_period_rad;
        double angle_rad = 2 * PI * turns + error->bias_phase_rad;
        reported_rad += error->bias_rad * elementary_sin(angle_rad);
    }
    return units_wrap_rad(reported_rad);
}
