#include "radar/level.h"

#include "base/elementary.h"
#include "base/units.h"

/* The value of the knot in this column and row. */
static double knot(const struct random_address *plane, enum random_purpose purpose, int64_t column,
                   int64_t row)
{
    struct random_address address = *plane;
    double gaussian[2];
    address.frame = (uint64_t)column;
    random_gaussian_pair(&address, purpose, (uint32_t)row, gaussian);
    return gaussian[0];
}

/* The weights of the knots below and above a place, whose squares sum to 1. */
static struct elementary_sincos weights(double place, int64_t *below)
{
    double whole = floor(place);
    *below = (int64_t)whole;
    return elementary_sincos_turns((place - whole) / 4);
}

double level_on_line(const struct random_address *line, enum random_purpose purpose, double x)
{
    int64_t below;
    struct elementary_sincos weight = weights(x, &below);
    return weight.cos * knot(line, purpose, below, 0) +
           weight.sin * knot(line, purpose, below + 1, 0);
}

double level_on_turn(const struct random_address *plane, enum random_purpose purpose, double x,
                     double y, int64_t turn)
{
    int64_t column, row;
    struct elementary_sincos along = weights(x, &column), across = weights(y, &row);
    double value[2];
    for (int i = 0; i < 2; i++)
        value[i] = across.cos * knot(plane, purpose, (column + i) % turn, row) +
                   across.sin * knot(plane, purpose, (column + i) % turn, row + 1);
    return along.cos * value[0] + along.sin * value[1];
}

double level_mean_db(double sigma_db)
{
    return -units_amplitude_logarithm(sigma_db) * sigma_db;
}

double level_centre_db(enum level_keeps keeps, double sigma_db)
{
    return keeps == LEVEL_KEEPS_MEAN ? level_mean_db(sigma_db) : 0;
}
