#include "documents/reflector_models.h"

#include <assert.h>

#include "base/elementary.h"
#include "base/units.h"
#include "radar/radar_equation.h"

#define DBSM(bit, member, help) FIELD_REAL_IN(struct contour, member, -60, 80, help), .group = (bit)

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

int reflector_models_check_contour(const struct contour *contour, struct diag *diag)
{
    if (contour->given == 0)
        return 0;
    for (const struct field *field = contour_fields; field->name != NULL; field++)
        if ((contour->given & field->group) == 0)
            return diag_fail(
                diag, DIAG_CONFIG,
                "%s: missing; expected front_dbsm, rear_dbsm, side_dbsm and oblique_dbsm",
                field->name);
    double least =
        elementary_min(elementary_min(contour->front_dbsm, contour->rear_dbsm), contour->side_dbsm);
    if (contour->oblique_dbsm > least + REFLECTOR_MODELS_OBLIQUE_DB)
        return diag_fail(diag, DIAG_CONFIG,
                         "oblique_dbsm: %g is more than %g dB above %g, the least of the others",
                         contour->oblique_dbsm, REFLECTOR_MODELS_OBLIQUE_DB, least);
    return 0;
}

struct contour_view reflector_models_contour_view(double face_dbsm, double oblique_dbsm)
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

/* A face that exceeds a whole number of pieces by less than this share of one, as rounding may, has
 * no further piece. */
#define PIECE_SLACK 1e-9

static struct post_row row_of(const struct face *face, double oblique_dbsm, double spacing_m)
{
    double pieces = elementary_max(1, ceil(face->length_m / spacing_m - PIECE_SLACK));
    double half_piece = 0.5 / pieces;
    double along_x = face->to_x - face->from_x, along_y = face->to_y - face->from_y;
    struct contour_view view = reflector_models_contour_view(face->dbsm, oblique_dbsm);
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

void reflector_models_of_contour(const struct contour *contour, double length_m, double width_m,
                                 double spacing_m, struct reflector_set *set, struct arena *arena)
{
    assert(length_m >= 0.01 && width_m >= 0.01 && spacing_m >= 0.02);
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

#define DEGREE (PI / 180)

const char *const reflector_models_3gpp_names[] = {[SENSING_TARGET_3GPP_NONE] = "none",
                                                   [SENSING_TARGET_3GPP_VEHICLE] = "vehicle",
                                                   [SENSING_TARGET_3GPP_HUMAN] = "human",
                                                   NULL};

/* One row of the report's tables for several scattering points; angles in degrees. */
struct scattering_point {
    const char *name;
    double x, y, z; /* the middle of its face */
    double azimuth, azimuth_width, zenith, zenith_width;
    double most_dbsm, depth_db;
};

static const struct scattering_point vehicle[] = {
    {"front", 0.5, 0, 0.5, 0, 40.54, 71.75, 29.13, 14.99, 14.91},
    {"left", 0, 0.5, 0.5, 90, 26.90, 79.70, 44.42, 20.60, 20.52},
    {"back", -0.5, 0, 0.5, 180, 36.32, 79.65, 36.73, 13.90, 13.82},
    {"right", 0, -0.5, 0.5, -90, 26.90, 79.70, 44.42, 20.60, 20.52},
    {"roof", 0, 0, 1, 0, 0, 0, 18.13, 21.12, 21.05},
};

/* The report's adult is 1.75 m high, its point at 1.5 m; no lobe. */
static const struct scattering_point human = {"body", 0, 0, 1.5 / 1.75, 0, 0, 0, 0, -1.37, 0};

static struct point_reflector point_of(const struct scattering_point *point)
{
    return (struct point_reflector){
        .name = point->name,
        .x = point->x,
        .y = point->y,
        .z = point->z,
        .facing_rad = point->azimuth * DEGREE,
        .full_rad = PI,
        .zero_rad = PI,
        .shape = VISIBILITY_HARD,
        .ercs = radar_ercs(radar_cross_section_from_dbsm_m2(point->most_dbsm)),
        .lobe = {.width_rad = point->azimuth_width * DEGREE,
                 .zenith_rad = point->zenith * DEGREE,
                 .zenith_width_rad = point->zenith_width * DEGREE,
                 .depth_db = point->depth_db},
    };
}

void reflector_models_of_3gpp(enum sensing_target_3gpp target, struct reflector_set *set,
                              struct arena *arena)
{
    bool is_human = target == SENSING_TARGET_3GPP_HUMAN;
    const struct scattering_point *points = is_human ? &human : vehicle;
    size_t count = is_human ? 1 : sizeof vehicle / sizeof *vehicle;
    struct reflector_set described = *set;
    described.points.items = NULL;
    described.points.count = described.points.room = 0;
    described.planes.count = described.rows.count = 0;
    for (size_t i = 0; i < count; i++)
        *list_add(&described.points, arena) = point_of(&points[i]);
    if (is_human)
        described.points.items[0].moving_part = MOVING_LIMBS;
    *set = described;
}
