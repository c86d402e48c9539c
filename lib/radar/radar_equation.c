#include "radar/radar_equation.h"

#include "base/elementary.h"
#include "base/search.h"

/* The cross section of a reflector with an ERCS of 1 (MODEL 3). */
#define ERCS_UNIT_M2 10.0

static double table_amplitude(const struct radar_equation *equation, double range_m)
{
    const struct radar_row *rows = equation->rows;
    if (equation->row_count < 2 || range_m <= rows[0].range_m)
        return rows[0].amplitude;
    const struct radar_row *from =
        rows + search_row(&rows[0].range_m, sizeof *rows, equation->row_count - 1, range_m);
    const struct radar_row *to = from + 1;
    double part =
        elementary_log(range_m / from->range_m) / elementary_log(to->range_m / from->range_m);
    return from->amplitude * elementary_pow(to->amplitude / from->amplitude, part);
}

double radar_reference_amplitude(const struct radar_equation *equation, double range_m)
{
    double counted_m = elementary_max(range_m, equation->range_floor_m);
    if (equation->rows != NULL)
        return table_amplitude(equation, counted_m);
    return equation->threshold / equation->calibration_ercs *
           elementary_pow(equation->calibration_range_m / counted_m, equation->exponent);
}

double radar_greatest_amplitude(const struct radar_equation *equation, double from_m, double to_m)
{
    double greatest = elementary_max(radar_reference_amplitude(equation, from_m),
                                     radar_reference_amplitude(equation, to_m));
    if (equation->rows == NULL)
        return greatest;
    for (size_t i = 0; i < equation->row_count; i++)
        if (equation->rows[i].range_m > from_m && equation->rows[i].range_m < to_m)
            greatest = elementary_max(greatest, equation->rows[i].amplitude);
    return greatest;
}

/* The last range at which the table, straight in the logarithms, falls below this amplitude. */
static double table_range_m(const struct radar_equation *equation, double amplitude)
{
    size_t last = equation->row_count - 1;
    if (last == 0 || equation->rows[last].amplitude >= equation->rows[last - 1].amplitude)
        return (double)INFINITY;
    for (size_t i = last; i > 0; i--) {
        const struct radar_row *from = &equation->rows[i - 1], *to = from + 1;
        double part = elementary_log(amplitude / from->amplitude) /
                      elementary_log(to->amplitude / from->amplitude);
        if (to->amplitude < from->amplitude && part >= 0 && (part <= 1 || i == last))
            return from->range_m * elementary_pow(to->range_m / from->range_m, part);
    }
    return 0;
}

double radar_strength(const struct radar_equation *equation, double range_m, double ercs)
{
    return radar_reference_amplitude(equation, range_m) * ercs;
}

double radar_amplitude(const struct radar_equation *equation, const struct antenna *antenna,
                       double range_m, double azimuth_rad, double ercs)
{
    return radar_strength(equation, range_m, ercs) * antenna_gain(antenna, azimuth_rad);
}

double radar_detection_range_m(const struct radar_equation *equation, double gain, double ercs)
{
    if (equation->rows != NULL)
        return table_range_m(equation, equation->threshold / (gain * ercs));
    return equation->calibration_range_m *
           elementary_pow(ercs * gain / equation->calibration_ercs, 1 / equation->exponent);
}

double radar_ercs(double cross_section_m2)
{
    return sqrt(cross_section_m2 / ERCS_UNIT_M2);
}

double radar_cross_section_m2(double ercs)
{
    return ERCS_UNIT_M2 * ercs * ercs;
}

double radar_cross_section_from_dbsm_m2(double dbsm)
{
    return elementary_pow(10, dbsm / 10);
}
