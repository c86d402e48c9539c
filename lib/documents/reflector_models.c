#include "documents/reflector_models.h"

#include <assert.h>

#include "base/elementary.h"
#include "base/hash.h"
#include "base/units.h"
#include "radar/level.h"
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

#define STATED(member, least, most, help)                                                          \
    OPTIONAL_REAL(struct surface, member, least, most, help), .absent = -1

static const struct field surface_fields[] = {
    {STATED(spacing_m, 0.02, 100,
            "distance from one scatterer to the next, at most; absent: the class's, or 0.1 m")},
    {STATED(facing_sigma_rad, 0, PI,
            "standard deviation of a scatterer's facing around the face's normal; absent: the "
            "class's, or 0")},
    {STATED(full_rad, 0, PI,
            "a scatterer is fully seen up to this angle off its facing; absent: the class's, or "
            "that of its cross sections")},
    {STATED(zero_rad, 0.01, PI, "and not seen from this angle on; given together with full_rad")},
    {STATED(
        level_sigma_db, 0, 6,
        "standard deviation of a scatterer's power around its mean; absent: the class's, or 0")},
    {0},
};

const struct record surface_record = {
    FIELD_TABLE(struct surface, surface_fields, "surface",
                "How the scatterers of a contour are spaced and seen, and how they differ.")};

const struct surface reflector_models_usual_surface = {
    .spacing_m = 0.1, .full_rad = -1, .zero_rad = -1};

static bool states_anything(const struct surface *surface)
{
    for (const struct field *field = surface_fields; field->name != NULL; field++)
        if (field_number(field, surface) >= 0)
            return true;
    return false;
}

int reflector_models_check_surface(const struct surface *surface, const struct contour *contour,
                                   struct diag *diag)
{
    if (contour->given == 0 && states_anything(surface))
        return diag_fail(diag, DIAG_CONFIG, "surface: expected a contour, too");
    bool full = surface->full_rad >= 0, zero = surface->zero_rad >= 0;
    if (full != zero)
        return diag_fail(diag, DIAG_CONFIG,
                         "surface.%s: missing; expected full_rad and zero_rad, or none",
                         full ? "zero_rad" : "full_rad");
    if (surface->zero_rad < surface->full_rad)
        return diag_fail(diag, DIAG_CONFIG, "surface.zero_rad: %g is less than full_rad, %g rad",
                         surface->zero_rad, surface->full_rad);
    return 0;
}

struct surface reflector_models_surface(const struct surface *surface, const struct surface *over)
{
    struct surface result = *surface;
    for (const struct field *field = surface_fields; field->name != NULL; field++) {
        double stated = field_number(field, over);
        if (stated >= 0)
            FIELD_STORE(double, field, &result, stated);
    }
    return result;
}

bool reflector_models_differs(const struct surface *surface)
{
    return surface->facing_sigma_rad > 0 || surface->level_sigma_db > 0;
}

/* One face from corner to corner, in half lengths and half widths. */
struct face {
    const char *name;
    double from_x, from_y, to_x, to_y;
    double facing_rad;
    bool across; /* is it as long as the object is wide? */
    double dbsm;
};

enum { FACES = 4 };

static void faces_of(const struct contour *contour, struct face faces[FACES])
{
    faces[0] = (struct face){"front", 0.5, -0.5, 0.5, 0.5, 0, true, contour->front_dbsm};
    faces[1] = (struct face){"left", 0.5, 0.5, -0.5, 0.5, PI / 2, false, contour->side_dbsm};
    faces[2] = (struct face){"rear", -0.5, 0.5, -0.5, -0.5, PI, true, contour->rear_dbsm};
    faces[3] = (struct face){"right", -0.5, -0.5, 0.5, -0.5, -PI / 2, false, contour->side_dbsm};
}

static double length_of(const struct face *face, struct vec2 size_m)
{
    return face->across ? size_m.y : size_m.x;
}

/* A face that exceeds a whole number of pieces by less than this share of one, as rounding may, has
 * no further piece. */
#define PIECE_SLACK 1e-9

static double pieces_of(double length_m, double spacing_m)
{
    return elementary_max(1, ceil(length_m / spacing_m - PIECE_SLACK));
}

/* The power of a raised cosine, averaged over all aspects. */
static double mean_power(struct contour_view view)
{
    return (view.full_rad + 3.0 / 8 * (view.zero_rad - view.full_rad)) / PI;
}

/* A scatterer of the face that has this share of its power. Whatever its view, it has the mean
 * power over all aspects that the view of the cross sections gives. */
static struct point_reflector scatterer_of(const struct contour *contour,
                                           const struct surface *surface, const struct face *face,
                                           double share)
{
    struct contour_view view = reflector_models_contour_view(face->dbsm, contour->oblique_dbsm);
    double factor = 1;
    if (surface->full_rad >= 0) {
        struct contour_view own = {surface->full_rad, surface->zero_rad};
        factor = sqrt(mean_power(view) / mean_power(own));
        view = own;
    }
    return (struct point_reflector){
        .name = face->name,
        .z = 0.5,
        .extent = 1,
        .facing_rad = face->facing_rad,
        .full_rad = view.full_rad,
        .zero_rad = view.zero_rad,
        .ercs = factor * radar_ercs(radar_cross_section_from_dbsm_m2(face->dbsm) * share),
    };
}

static struct post_row row_of(const struct contour *contour, const struct surface *surface,
                              const struct face *face, struct vec2 size_m)
{
    double length_m = length_of(face, size_m);
    double pieces = pieces_of(length_m, surface->spacing_m);
    double half_piece = 0.5 / pieces;
    double along_x = face->to_x - face->from_x, along_y = face->to_y - face->from_y;
    struct point_reflector post = scatterer_of(contour, surface, face, 1 / pieces);
    return (struct post_row){
        .name = face->name,
        .from_x = face->from_x + half_piece * along_x,
        .from_y = face->from_y + half_piece * along_y,
        .to_x = face->to_x - half_piece * along_x,
        .to_y = face->to_y - half_piece * along_y,
        .z = post.z,
        .extent = post.extent,
        .spacing_m = length_m / pieces,
        .facing_rad = post.facing_rad,
        .full_rad = post.full_rad,
        .zero_rad = post.zero_rad,
        .ercs = post.ercs,
    };
}

static void clear(struct reflector_set *set)
{
    set->points.items = NULL;
    set->points.count = set->points.room = 0;
    set->rows.items = NULL;
    set->rows.count = set->rows.room = 0;
    set->planes.count = 0;
}

void reflector_models_of_contour(const struct contour *contour, const struct surface *surface,
                                 struct vec2 size_m, struct reflector_set *set, struct arena *arena)
{
    assert(size_m.x >= 0.01 && size_m.y >= 0.01 && surface->spacing_m >= 0.02);
    struct face faces[FACES];
    faces_of(contour, faces);
    clear(set);
    for (size_t i = 0; i < FACES; i++)
        *list_add(&set->rows, arena) = row_of(contour, surface, &faces[i], size_m);
}

/* A scatterer is as high as the spacing, or as the body if that is lower. With the least extent
 * here its z is at least 0.001, as in documents. */
static double extent_of(double spacing_m, double height_m)
{
    return elementary_max(0.002, elementary_min(spacing_m / height_m, 1));
}

/* The face's scatterer with this number, placed and drawn. It lies between the road and the body's
 * top. The height is the third draw of a block, as a pair of Gaussians takes the first two. */
static struct point_reflector piece_of(const struct face *face, struct point_reflector scatterer,
                                       const struct surface *surface, double place,
                                       const struct random_address *address, uint32_t number)
{
    double gaussian[2], uniform[4];
    random_gaussian_pair(address, RANDOM_SURFACE, number, gaussian);
    random_uniform(address, RANDOM_SURFACE, number, uniform);
    double level_db = level_mean_db(surface->level_sigma_db);
    scatterer.x = face->from_x + place * (face->to_x - face->from_x);
    scatterer.y = face->from_y + place * (face->to_y - face->from_y);
    scatterer.z = scatterer.extent / 2 + (1 - scatterer.extent) * uniform[2];
    scatterer.facing_rad =
        remainder(scatterer.facing_rad + surface->facing_sigma_rad * gaussian[0], 2 * PI);
    scatterer.ercs *= units_amplitude_from_db(level_db + surface->level_sigma_db * gaussian[1]);
    return scatterer;
}

static void add_pieces(const struct face *face, struct point_reflector scatterer,
                       const struct surface *surface, double pieces,
                       const struct random_address *body, struct reflector_set *set,
                       struct arena *arena)
{
    struct random_address address = *body;
    address.item = hash_text(body->item, face->name);
    for (uint32_t i = 0; i < (uint32_t)pieces; i++) {
        struct point_reflector *point = list_add(&set->points, arena);
        *point = piece_of(face, scatterer, surface, (i + 0.5) / pieces, &address, i);
        point->name = reflectors_post_name(face->name, i, arena);
    }
}

void reflector_models_of_surface(const struct contour *contour, const struct surface *surface,
                                 struct vec2 usual_m, struct vec2 size_m, double height_m,
                                 const struct random_address *body, struct reflector_set *set,
                                 struct arena *arena)
{
    assert(size_m.x > 0 && size_m.y > 0 && height_m > 0 && surface->spacing_m >= 0.02);
    struct face faces[FACES];
    faces_of(contour, faces);
    clear(set);
    for (size_t i = 0; i < FACES; i++) {
        double length_m = length_of(&faces[i], size_m);
        double pieces = pieces_of(length_m, surface->spacing_m);
        double share = length_m / length_of(&faces[i], usual_m) / pieces;
        struct point_reflector scatterer = scatterer_of(contour, surface, &faces[i], share);
        scatterer.extent = extent_of(surface->spacing_m, height_m);
        add_pieces(&faces[i], scatterer, surface, pieces, body, set, arena);
    }
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
