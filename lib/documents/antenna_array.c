#include "documents/antenna_array.h"

#include "base/elementary.h"
#include "base/units.h"

static const char *const tapers[] = {[TAPER_RECTANGULAR] = "rectangular",
                                     [TAPER_HANN] = "hann",
                                     [TAPER_TAYLOR] = "taylor",
                                     [TAPER_CHEBYSHEV] = "chebyshev",
                                     NULL};
static const struct field element_fields[] = {
    {FIELD_REAL_IN(struct array_element, place, -1e4, 1e4, "in wavelengths, positive to the left")},
    {0},
};

static const struct record element_record = {
    FIELD_TABLE(struct array_element, element_fields, "array_element", "An antenna element.")};

static const struct field array_fields[] = {
    {OPTIONAL_LIST(struct array_layout, transmit, &element_record, "in the order of their turns")},
    {OPTIONAL_LIST(struct array_layout, receive, &element_record,
                   "sums of a place of transmit and one of receive are evenly spaced")},
    {OPTIONAL_CHOICE(struct array_layout, taper, tapers,
                     "weights of the elements; taylor and chebyshev: side lobes of -30 dB; absent: "
                     "rectangular")},
    {0},
};

const struct record antenna_array_record = {
    FIELD_TABLE(struct array_layout, array_fields, "array",
                "Transmitters and receivers, which act like one line of elements.")};

int antenna_array_check(const struct array_layout *layout, double field_of_view_rad,
                        struct diag *diag)
{
    size_t elements = layout->transmit.count * layout->receive.count;
    if (elements < 2 || elements > ARRAY_MOST_ELEMENTS)
        return diag_fail(diag, DIAG_CONFIG,
                         "array: %zu transmitters times %zu receivers; expected 2 to %d virtual "
                         "elements",
                         layout->transmit.count, layout->receive.count, ARRAY_MOST_ELEMENTS);
    struct array beams = array_of(layout);
    double sine = elementary_sin(field_of_view_rad / 2), most = 0.5 / sine;
    if (field_of_view_rad > PI - 1e-9)
        most = 0.5;
    if (beams.most_step - beams.least_step > 1e-6 * beams.spacing)
        return diag_fail(diag, DIAG_CONFIG,
                         "array: virtual elements are %g to %g wavelengths apart; expected even "
                         "steps of transmit plus receive",
                         beams.least_step, beams.most_step);
    if (beams.spacing > most * (1 + 1e-9))
        return diag_fail(diag, DIAG_CONFIG,
                         "array: virtual elements are %g wavelengths apart; expected at most %g, "
                         "as two directions in a field_of_view_rad of %g look alike otherwise",
                         beams.spacing, most, field_of_view_rad);
    return 0;
}
