#include "documents/contour.h"

#include "base/elementary.h"
#include "base/units.h"
#include "radar/radar_equation.h"

#define DBSM(bit, member, help)                                                                    \
    FIELD_REAL_IN(struct contour, member, -60, 80, help), .section = (bit)

static const struct field contour_fields[] = {
    {DBSM(1 << 0, front_dbsm, "cross section seen from ahead")},
    {DBSM(1 << 1, rear_dbsm, "cross section seen from behind")},
    {DBSM(1 << 2, side_dbsm, "cross section seen from the left or the right")},
    {DBSM(1 << 3, oblique_dbsm,
          "cross section seen at 45 degrees to these, at most 3 dB above any of them")},
    {0},
};

const struct record contour_record = {
    FIELD_TABLE(struct contour, contour_fields, "contour",
                "Cross section by aspect, in decibels over 1 m^2."),
    .present_offset = offsetof(struct contour, given)};

int contour_check(const struct contour *contour, struct diag *diag)
{
    if (contour->given == 0)
        return 0;
    for (const struct field *field = contour_fields; field->name != NULL; field++)
        if ((contour->given & field->section) == 0)
            return diag_fail(
                diag, DIAG_CONFIG,
                "%s: missing; expected front_dbsm, rear_dbsm, side_dbsm and oblique_dbsm",
                field->name);
    double least =
        elementary_min(elementary_min(contour->front_dbsm, contour->rear_dbsm), contour->side_dbsm);
    if (contour->oblique_dbsm > least + CONTOUR_OBLIQUE_DB)
        return diag_fail(diag, DIAG_CONFIG,
                         "oblique_dbsm: %g is more than %g dB above %g, the least of the others",
                         contour->oblique_dbsm, CONTOUR_OBLIQUE_DB, least);
    return 0;
}

struct contour_view contour_view(double face_dbsm, double oblique_dbsm)
{
    /* Visibility at 45 degrees: its square is half of the oblique cross section over the face's. */
    double diagonal =
        elementary_min(units_amplitude_from_db(oblique_dbsm - face_dbsm) / sqrt(2), 1);
    double cosine = 2 * diagonal - 1;
    double turns = elementary_atan2(sqrt((1 - cosine) * (1 + cosine)), cosine) / PI;
    if (turns >= 0.5)
        return (struct contour_view){0, PI / 4 / turns};
    return (struct contour_view){PI / 4 * (1 - 2 * turns) / (1 - turns), PI / 2};
}

/* One face from corner to corner, in half lengths and half widths. */
struct face {
    const char *name;
    double from_x, from_y, to_x, to_y;
    double facing_rad;
    double length_m;
    double dbsm;
};

static struct post_row row_of(const struct face *face, double oblique_dbsm, double spacing_m)
{
    double pieces = ceil(face->length_m / spacing_m), half_piece = 0.5 / pieces;
    double along_x = face->to_x - face->from_x, along_y = face->to_y - face->from_y;
    struct contour_view view = contour_view(face->dbsm, oblique_dbsm);
    return (struct post_row){
        .name = face->name,
        .from_x = face->from_x + half_piece * along_x,
        .from_y = face->from_y + half_piece * along_y,
        .to_x = face->to_x - half_piece * along_x,
        .to_y = face->to_y - half_piece * along_y,
        .z = 0.5,
        .extent = 1,
        .spacing_m = face->length_m / pieces,
        .facing_rad = face->facing_rad,
        .full_rad = view.full_rad,
        .zero_rad = view.zero_rad,
        .ercs = radar_ercs(radar_cross_section_from_dbsm_m2(face->dbsm) / pieces),
    };
}

void contour_describe(const struct contour *contour, double length_m, double width_m,
                      double spacing_m, struct reflector_set *set, struct arena *arena)
{
    const struct face faces[] = {
        {"front", 0.5, -0.5, 0.5, 0.5, 0, width_m, contour->front_dbsm},
        {"left", 0.5, 0.5, -0.5, 0.5, PI / 2, length_m, contour->side_dbsm},
        {"rear", -0.5, 0.5, -0.5, -0.5, PI, width_m, contour->rear_dbsm},
        {"right", -0.5, -0.5, 0.5, -0.5, -PI / 2, length_m, contour->side_dbsm},
    };
    set->points.count = set->planes.count = 0;
    set->rows.items = NULL;
    set->rows.count = set->rows.room = 0;
    for (size_t i = 0; i < sizeof faces / sizeof *faces; i++)
        *list_add(&set->rows, arena) = row_of(&faces[i], contour->oblique_dbsm, spacing_m);
}
