#include "geometry/directivity.h"

#include "base/elementary.h"
#include "base/units.h"

/* Slack on cosines: a million times their rounding. */
#define SLACK 1e-9

/* Vectors shorter than this have squares that underflow. */
#define SHORTEST 1e-100

double directivity_angle_rad(struct vec2 a, struct vec2 b)
{
    /* + 0.0 turns -0 into 0, so that a vector of length zero is at angle 0, never at pi. */
    return elementary_atan2(fabs(vec2_cross(a, b)), vec2_dot(a, b) + 0.0);
}

double directivity_visibility(enum visibility_shape shape, double full_rad, double zero_rad,
                              double delta_rad)
{
    if (shape == VISIBILITY_HARD)
        return delta_rad <= zero_rad;
    double start_rad = shape == VISIBILITY_COSINE ? 0 : full_rad;
    if (delta_rad <= start_rad)
        return 1;
    if (delta_rad >= zero_rad)
        return 0;
    /* Counted from the dark end, so that no shape can round to a negative value there. */
    double rise = (zero_rad - delta_rad) / (zero_rad - start_rad);
    if (shape == VISIBILITY_LINEAR)
        return rise;
    double cosine = elementary_sin(PI / 2 * rise);
    return shape == VISIBILITY_COSINE ? cosine : cosine * cosine;
}

/* The power series of the cosine, cut after a negative term, bounds it from below. */
double directivity_dark_cosine(double zero_rad)
{
    double square = zero_rad * zero_rad;
    return 1 + square * (-1.0 / 2 + square * (1.0 / 24 - square / 720)) - SLACK;
}

double directivity_visibility_along(enum visibility_shape shape, double full_rad, double zero_rad,
                                    struct vec2 facing, struct vec2 to_viewer)
{
    double length = vec2_length(to_viewer);
    if (length > SHORTEST &&
        vec2_dot(facing, to_viewer) < directivity_dark_cosine(zero_rad) * length)
        return 0;
    return directivity_visibility(shape, full_rad, zero_rad,
                                  directivity_angle_rad(facing, to_viewer));
}

static double drop_db(double off_rad, double width_rad, double depth_db)
{
    double widths = width_rad > 0 ? off_rad / width_rad : 0;
    return elementary_min(12 * widths * widths, depth_db);
}

double directivity_lobe_factor(const struct lobe *lobe, double off_rad, double zenith_rad)
{
    double across_db = drop_db(off_rad, lobe->width_rad, lobe->depth_db);
    double upright_db =
        drop_db(zenith_rad - lobe->zenith_rad, lobe->zenith_width_rad, lobe->depth_db);
    return units_amplitude_from_db(-elementary_min(across_db + upright_db, lobe->depth_db));
}
