#include "frame/reflectors.h"

#include "base/elementary.h"
#include "base/hash.h"
#include "base/number.h"
#include "base/units.h"
#include "text/list_cache.h"

static const char *const shapes[] = {
    [VISIBILITY_RAISED_COSINE] = "raised_cosine",
    [VISIBILITY_HARD] = "hard",
    [VISIBILITY_LINEAR] = "linear",
    [VISIBILITY_COSINE] = "cosine",
    NULL,
};

const char *const reflectors_moving_parts[] = {
    [MOVING_NONE] = "none", [MOVING_WHEEL] = "wheel", [MOVING_LIMBS] = "limbs", NULL};

/* A coordinate as a fraction of the box, which mirrors, bumpers and loads may stand out of. */
#define FRACTION(owner, member, help) FIELD_REAL_IN(owner, member, -1, 1, help)

#define HEIGHT(owner)                                                                              \
    {OPTIONAL_REAL(owner, z, 1e-3, 2,                                                              \
                   "height, as a fraction of the object's; absent: the sensor's")},                \
    {                                                                                              \
        OPTIONAL_REAL(owner, extent, 0, 2,                                                         \
                      "from its lowest to its highest part, as a fraction of the height; absent: " \
                      "a point")                                                                   \
    }

#define SEEN_FROM(owner)                                                                           \
    {FIELD_REAL_IN(owner, facing_rad, -PI, PI, "middle of the visibility range, object frame")},   \
        {FIELD_REAL_IN(owner, full_rad, 0, PI, "fully visible up to this angle off the facing")},  \
        {FIELD_REAL_IN(owner, zero_rad, 0, PI, "invisible from this angle off the facing")},       \
        {OPTIONAL_CHOICE(owner, shape, shapes, "how visibility falls from full to zero")},         \
    {                                                                                              \
        FIELD_REAL_IN(owner, ercs, 0, 1e3, "equivalent radar cross section, a linear amplitude")   \
    }

static const struct field lobe_fields[] = {
    {FIELD_REAL_IN(struct lobe, width_rad, 0, 4 * PI,
                   "in azimuth around the facing, 3 dB down at both ends; absent: all around"),
     FIELD_OPTIONAL},
    {OPTIONAL_REAL(struct lobe, zenith_rad, 0, PI, "its middle, from straight up")},
    {OPTIONAL_REAL(struct lobe, zenith_width_rad, 0, 4 * PI,
                   "the same upright; absent: at every height")},
    {OPTIONAL_REAL(struct lobe, depth_db, 0, 100, "the most that it is below its middle")},
    {0},
};

static const struct record lobe_record = {
    FIELD_TABLE(struct lobe, lobe_fields, "lobe",
                "Where a point returns most: a parabola in decibels, with a floor.")};

static const struct field point_fields[] = {
    {FIELD_NAME_OF(struct point_reflector, name, "unique in its set")},
    {FRACTION(struct point_reflector, x, "place, as a fraction of the length from the centre")},
    {FRACTION(struct point_reflector, y, "place, as a fraction of the width from the centre")},
    HEIGHT(struct point_reflector),
    {OPTIONAL_REAL(struct point_reflector, inset_m, 0, 10, "depth behind the place")},
    SEEN_FROM(struct point_reflector),
    {OPTIONAL_CHOICE(struct point_reflector, moving_part, reflectors_moving_parts,
                     "what turns or swings there, for sensors with micro_motion")},
    {OPTIONAL_REAL(
        struct point_reflector, under_vehicles, 0, 1,
        "part of the cross section that is left when only raised vehicles are in the way")},
    {OPTIONAL_RECORD(struct point_reflector, lobe, &lobe_record, "of ercs; absent: none")},
    {0},
};

static const struct field plane_fields[] = {
    {FIELD_NAME_OF(struct plane_reflector, name, "unique in its set")},
    {FRACTION(struct plane_reflector, from_x,
              "start; the outer face is to the right of from -> to")},
    {FRACTION(struct plane_reflector, from_y, "start")},
    {FRACTION(struct plane_reflector, to_x, "end")},
    {FRACTION(struct plane_reflector, to_y, "end")},
    HEIGHT(struct plane_reflector),
    {OPTIONAL_REAL(struct plane_reflector, margin_m, 0, 10, "not flat this far from both ends")},
    {FIELD_REAL_IN(struct plane_reflector, ercs, 0, 1e3, "equivalent radar cross section")},
    {OPTIONAL_REAL(struct plane_reflector, profile_radius_m, 1e-3, 1e6,
                   "of curvature from below to above; absent: of constant cross section")},
    {OPTIONAL_REAL(struct plane_reflector, radius_m, 1e-3, 1e6,
                   "of curvature along the side; absent: straight")},
    {0},
};

static const struct field mirror_fields[] = {
    {FRACTION(struct mirror_plane, from_x, "start; the outer face is to the right of from -> to")},
    {FRACTION(struct mirror_plane, from_y, "start")},
    {FRACTION(struct mirror_plane, to_x, "end")},
    {FRACTION(struct mirror_plane, to_y, "end")},
    {OPTIONAL_REAL(
        struct mirror_plane, reflection, 1e-6, 1,
        "part of an amplitude that is reflected, at all angles; absent: the material's")},
    {OPTIONAL_CHOICE(struct mirror_plane, material, reflection_material_names,
                     "whose permittivity reflects by angle and polarization; absent: reflection")},
    {OPTIONAL_REAL(struct mirror_plane, profile_radius_m, 1e-3, 1e6,
                   "of curvature from below to above; absent: straight")},
    {OPTIONAL_REAL(struct mirror_plane, radius_m, 1e-3, 1e6,
                   "of curvature along the side; absent: straight")},
    {OPTIONAL_REAL(struct mirror_plane, bottom, 0, 1,
                   "lower edge, as a fraction of the object's height; absent: on the road")},
    {0},
};

static const struct record mirror_record = {
    FIELD_TABLE(struct mirror_plane, mirror_fields, "mirror",
                "A side in which a radar sees other objects a second time.")};

static const struct field row_fields[] = {
    {FIELD_NAME_OF(struct post_row, name, "post n of the row is called name_n")},
    {FRACTION(struct post_row, from_x, "the first post")},
    {FRACTION(struct post_row, from_y, "the first post")},
    {FRACTION(struct post_row, to_x, "where the row ends")},
    {FRACTION(struct post_row, to_y, "where the row ends")},
    HEIGHT(struct post_row),
    {FIELD_REAL_IN(struct post_row, spacing_m, 0.01, 1e4, "from post to post")},
    SEEN_FROM(struct post_row),
    {0},
};

static const struct record point_record = {
    FIELD_TABLE(struct point_reflector, point_fields, "point reflector",
                "A reflection centre, seen from a range of angles.")};

static const struct record plane_record = {
    FIELD_TABLE(struct plane_reflector, plane_fields, "plane reflector",
                "A flat side that mirrors the radar from the foot of the perpendicular.")};

static const struct record row_record = {
    FIELD_TABLE(struct post_row, row_fields, "row of posts", "Equal points along a line.")};

/* A vehicle document has all but the first two: the class and its objects are a frame's. */
static const struct field reflector_set_fields[] = {
    {FIELD_NAME_OF(struct reflector_set, model, "the class that the vehicle document describes")},
    {FIELD_NAMES_OF(struct reflector_set, objects, "ids of the objects that reflect like this")},
    {OPTIONAL_FLAG(struct reflector_set, blocks, "does the outline stop sight lines?")},
    {OPTIONAL_FLAG(struct reflector_set, raised, "can a radar look under it?")},
    {OPTIONAL_REAL(struct reflector_set, clearance_m, 0, 100,
                   "of its underside above the road; absent: nothing passes under it")},
    {OPTIONAL_LIST(struct reflector_set, points, &point_record, "corners, wheel houses, poles"),
     FIELD_STEADY},
    {OPTIONAL_LIST(struct reflector_set, planes, &plane_record, "flat sides"), FIELD_STEADY},
    {OPTIONAL_LIST(struct reflector_set, rows, &row_record, "rows of posts"), FIELD_STEADY},
    {OPTIONAL_LIST(struct reflector_set, mirrors, &mirror_record, "flat sides that show ghosts"),
     FIELD_STEADY},
    {0},
};

const struct record reflector_set_record = {
    FIELD_TABLE(struct reflector_set, reflector_set_fields, "reflector set",
                "The reflection centres of one class and the objects that have them."),
    .document_offset = offsetof(struct reflector_set, document)};

/* The same struct and table without its first two members, which a document does not have. */
const struct record reflector_model_record = {
    .name = "reflector model",
    .help = "The reflection centres of a class.",
    .size = sizeof(struct reflector_set),
    .fields = reflector_set_fields + 2,
};

#define SAME_LIST(one, other) ((one).items == (other).items && (one).count == (other).count)

static bool same_lists(const struct reflector_set *one, const struct reflector_set *other)
{
    return SAME_LIST(one->points, other->points) && SAME_LIST(one->planes, other->planes) &&
           SAME_LIST(one->rows, other->rows) && SAME_LIST(one->mirrors, other->mirrors);
}

bool reflectors_unchanged(const struct reflector_set *set)
{
    return set->document != NULL && same_lists(set, set->document);
}

/* The first list of the set with items, from this field on; the field without a name if none has.
 */
static const struct field *next_list(const struct reflector_set *set, const struct field *field)
{
    while (field->name != NULL && (!field->steady || field_list(field, set).count == 0))
        field++;
    return field;
}

/* What the cache has of the set's first list, or NULL. */
static struct list_cache_entry *first_kept(const struct reflector_set *set,
                                           struct list_cache *cache)
{
    const struct record *record = &reflector_set_record;
    const struct field *first = next_list(set, record->fields);
    return first->name == NULL ? NULL : list_cache_of(cache, record, first, set);
}

static bool all_kept(const struct reflector_set *set, struct list_cache *cache)
{
    const struct record *record = &reflector_set_record;
    const struct field *list = next_list(set, record->fields);
    while (list->name != NULL && list_cache_of(cache, record, list, set) != NULL)
        list = next_list(set, list + 1);
    return list->name == NULL;
}

void reflectors_keep(const struct reflector_set *set, struct list_cache *cache)
{
    struct list_cache_entry *first = first_kept(set, cache);
    if (first == NULL || first->document != NULL || !all_kept(set, cache))
        return;
    struct reflector_set *document = arena_get(&cache->arena, sizeof *document);
    *document = (struct reflector_set){
        .points = set->points, .planes = set->planes, .rows = set->rows, .mirrors = set->mirrors};
    document->shape = reflectors_shape(document, &cache->arena);
    first->document = document;
}

bool reflectors_recall(struct reflector_set *set, struct list_cache *cache)
{
    const struct list_cache_entry *first = first_kept(set, cache);
    const struct reflector_set *kept = first == NULL ? NULL : first->document;
    if (kept == NULL || !same_lists(set, kept))
        return false;
    set->document = kept;
    set->shape = kept->shape;
    return true;
}

/* The name of a reflector by its number: points come first, then planes, then rows. */
static const char *name_at(const struct reflector_set *set, size_t index)
{
    size_t planes = set->points.count, rows = planes + set->planes.count;
    if (index < planes)
        return set->points.items[index].name;
    return index < rows ? set->planes.items[index - planes].name
                        : set->rows.items[index - rows].name;
}

/* True if the name is one that a post of the row may have. */
static bool names_post(const char *name, const char *row)
{
    size_t length = strlen(row), digits = 0;
    if (strncmp(name, row, length) == 0 && name[length] == '_')
        digits = strspn(name + length + 1, "0123456789");
    return digits > 0 && name[length + 1 + digits] == '\0';
}

/* The name of a point or plane that is also that of a post, or NULL. */
static const char *name_of_post(const struct reflector_set *set)
{
    for (size_t i = 0; i < set->points.count + set->planes.count; i++)
        for (size_t j = 0; j < set->rows.count; j++)
            if (names_post(name_at(set, i), set->rows.items[j].name))
                return name_at(set, i);
    return NULL;
}

static bool is_called(const void *set, uint32_t index, const void *name)
{
    return strcmp(name_at(set, index), name) == 0;
}

const char *reflectors_name_twice(const struct reflector_set *set, struct arena *arena)
{
    size_t count = set->points.count + set->planes.count + set->rows.count;
    struct hash_table names = hash_table_begin(count, arena);
    for (uint32_t i = 0; i < count; i++) {
        const char *name = name_at(set, i);
        uint64_t hash = hash_table_hash(0, name, strlen(name));
        uint32_t *slot = hash_table_slot(&names, hash, is_called, set, name);
        if (*slot != 0)
            return name;
        *slot = i + 1;
    }
    return name_of_post(set);
}

/* Raises the share of the box to one that also holds the place (x, y), and the range of heights to
 * one that also holds z; 0 is no height. */
static void include(struct reflectors_shape *shape, double x, double y, double z)
{
    shape->share = elementary_max(shape->share, 2 * elementary_max(fabs(x), fabs(y)));
    if (z > 0 && (shape->lowest_z == 0 || z < shape->lowest_z))
        shape->lowest_z = z;
    shape->highest_z = elementary_max(shape->highest_z, z);
}

#define INCLUDE_ENDS(shape, list, z)                                                               \
    for (size_t i = 0; i < (list)->count; i++) {                                                   \
        include((shape), (list)->items[i].from_x, (list)->items[i].from_y, (z));                   \
        include((shape), (list)->items[i].to_x, (list)->items[i].to_y, (z));                       \
    }

size_t reflectors_unclear_mirror(const struct reflector_set *set)
{
    for (size_t i = 0; i < set->mirrors.count; i++) {
        const struct mirror_plane *mirror = &set->mirrors.items[i];
        if ((mirror->material != MATERIAL_NONE) == (mirror->reflection > 0))
            return i;
    }
    return set->mirrors.count;
}

const struct reflectors_shape *reflectors_shape(const struct reflector_set *set,
                                                struct arena *arena)
{
    if (set->shape != NULL && reflectors_unchanged(set))
        return set->shape;
    struct reflectors_shape *shape = arena_get(arena, sizeof *shape);
    shape->faces = arena_get(arena, set->points.count * sizeof *shape->faces);
    shape->share = 1;
    for (size_t i = 0; i < set->points.count; i++) {
        const struct point_reflector *point = &set->points.items[i];
        shape->faces[i] = (struct reflectors_face){vec2_heading(point->facing_rad),
                                                   directivity_dark_cosine(point->zero_rad)};
        include(shape, point->x, point->y, point->z);
        shape->inset_m = elementary_max(shape->inset_m, point->inset_m);
        shape->under |= point->under_vehicles > 0;
    }
    INCLUDE_ENDS(shape, &set->planes, set->planes.items[i].z)
    INCLUDE_ENDS(shape, &set->rows, set->rows.items[i].z)
    INCLUDE_ENDS(shape, &set->mirrors, 0)
    return shape;
}

struct vec2 reflectors_point_place(const struct box *box, const struct point_reflector *point)
{
    struct vec2 surface = motion_box_place(box, point->x, point->y);
    if (point->inset_m == 0)
        return surface;
    struct vec2 facing = vec2_turn(vec2_heading(point->facing_rad), box->heading);
    return vec2_sub(surface, vec2_scale(point->inset_m, facing));
}

double reflectors_visibility(const struct box *box, const struct point_reflector *point,
                             struct vec2 facing, struct vec2 place, struct vec2 sensor)
{
    return directivity_visibility_along(point->shape, point->full_rad, point->zero_rad,
                                        vec2_turn(facing, box->heading), vec2_sub(sensor, place));
}

bool reflectors_surely_no_foot(const struct box *box, const struct plane_reflector *plane,
                               struct vec2 sensor)
{
    struct vec2 from = {plane->from_x * box->length_m, plane->from_y * box->width_m};
    struct vec2 to = {plane->to_x * box->length_m, plane->to_y * box->width_m};
    struct vec2 side = vec2_sub(to, from), sight = vec2_sub(sensor, from);
    double square = vec2_dot(side, side), along = vec2_dot(side, sight);
    double length = sqrt(square);
    double margin = (plane->margin_m - REFLECTORS_SLACK_M) * length;
    return vec2_cross(side, sight) > REFLECTORS_SLACK_M * length || along < margin ||
           along > square - margin;
}

double reflectors_lobe(const struct box *box, const struct point_reflector *point,
                       struct vec2 place, struct vec2 sensor, double zenith_rad)
{
    struct vec2 facing = vec2_turn(vec2_heading(point->facing_rad), box->heading);
    double off_rad = directivity_angle_rad(facing, vec2_sub(sensor, place));
    return directivity_lobe_factor(&point->lobe, off_rad, zenith_rad);
}

/* From the first post to the end of the row, in the world. */
static struct vec2 row_vector(const struct box *box, const struct post_row *row)
{
    return vec2_sub(motion_box_place(box, row->to_x, row->to_y),
                    motion_box_place(box, row->from_x, row->from_y));
}

/* The number of a post, within 0 and their count. */
static int64_t post_number(double number, int64_t posts)
{
    if (!(number > 0))
        return 0;
    return number < (double)posts ? (int64_t)number : posts;
}

void reflectors_posts_within(const struct box *box, const struct post_row *row, struct vec2 sensor,
                             double range_m, int64_t *first, int64_t *end)
{
    struct vec2 along = row_vector(box, row);
    double length = vec2_length(along);
    int64_t posts = 1 + (int64_t)floor(length / row->spacing_m + 1e-9);
    *first = 0;
    *end = posts;
    if (length == 0)
        return;
    struct vec2 unit = vec2_scale(1 / length, along);
    struct vec2 to_sensor = vec2_sub(sensor, motion_box_place(box, row->from_x, row->from_y));
    double foot = vec2_dot(to_sensor, unit), aside = vec2_cross(unit, to_sensor);
    if (fabs(aside) > range_m) {
        *end = 0;
        return;
    }
    double half_chord = sqrt((range_m - aside) * (range_m + aside));
    *first = post_number(floor((foot - half_chord) / row->spacing_m), posts);
    *end = post_number(ceil((foot + half_chord) / row->spacing_m) + 1, posts);
}

void reflectors_cut_posts(const struct post_row *row, double first_m, double end_m, int64_t *first,
                          int64_t *end)
{
    double low = ceil(first_m / row->spacing_m) - 1;
    double high = floor(end_m / row->spacing_m) + 2;
    if (low > (double)*first)
        *first = low < (double)*end ? (int64_t)low : *end;
    if (high < (double)*end)
        *end = high > (double)*first ? (int64_t)high : *first;
}

const char *reflectors_post_name(const char *row, int64_t post, struct arena *arena)
{
    size_t length = strlen(row);
    char *name = arena_get(arena, length + 1 + NUMBER_SIZE + 1);
    memcpy(name, row, length);
    name[length++] = '_';
    length += number_write_whole((uint64_t)post, name + length);
    name[length] = '\0';
    return name;
}

struct vec2 reflectors_post_place(const struct box *box, const struct post_row *row, int64_t post)
{
    struct vec2 along = row_vector(box, row);
    double length = vec2_length(along);
    struct vec2 start = motion_box_place(box, row->from_x, row->from_y);
    if (length == 0)
        return start;
    return vec2_add(start, vec2_scale((double)post * row->spacing_m / length, along));
}
