#include "frame/margins.h"

#include "base/elementary.h"
#include "base/units.h"

#define MARGIN(member, bit, high, help)                                                            \
    FIELD_REAL_IN(struct margins, member, 0, high, help), FIELD_OPTIONAL, .group = (bit)

static const struct field margin_fields[] = {
    {MARGIN(sight_m, MARGIN_SIGHT, 1e8,
            "of range, view, visibility and sight lines; angles times range")},
    {MARGIN(threshold_db, MARGIN_THRESHOLD, 1e4, "between the amplitude and the threshold")},
    {MARGIN(leader_db, MARGIN_LEADER, 1e4,
            "between two echoes of which the stronger opened a cell")},
    {MARGIN(cell_edge, MARGIN_CELL_EDGE, 1e13, "from the border of a cell, in half cells")},
    {MARGIN(sign, MARGIN_SIGN, 1, "sine of the phase between sum and delta; 0 is undecided")},
    {MARGIN(limit_db, MARGIN_LIMIT_DB, 1e4, "from the list's limit, in a list by amplitude")},
    {MARGIN(limit_m, MARGIN_LIMIT_M, 1e6, "from the list's limit, in a list by range")},
    {0},
};

const struct record margins_record = {
    FIELD_TABLE(struct margins, margin_fields, "margins",
                "Distances from other decisions; absent: no decision of that kind."),
    .present_offset = offsetof(struct margins, present)};

static double *member(struct margins *margins, enum margin which)
{
    const struct field *field = margin_fields;
    while (field->group != (unsigned)which)
        field++;
    return (double *)(void *)((char *)margins + field->offset);
}

void margins_note(struct margins *margins, enum margin which, double value)
{
    if (!isfinite(value))
        return;
    double *least = member(margins, which);
    if ((margins->present & which) == 0 || value < *least)
        *least = value;
    margins->present |= which;
}

void margins_merge(struct margins *margins, const struct margins *others)
{
    struct margins other = *others;
    for (unsigned which = 1; which <= other.present; which <<= 1)
        if ((other.present & which) != 0)
            margins_note(margins, which, *member(&other, which));
}

double margins_between_db(double a, double b)
{
    return elementary_min(fabs(units_amplitude_db(a) - units_amplitude_db(b)), 1e4);
}

void margins_note_sign(struct margins *margins, enum monopulse_estimator estimator,
                       struct antenna_pointers pointers)
{
    if (estimator == MONOPULSE_MAGNITUDE)
        margins_note(margins, MARGIN_SIGN, monopulse_sign_margin(pointers));
}
