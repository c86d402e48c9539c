/* The one record that every stage reads and writes.
 *
 * A frame is one scene in one interval of time. In a stream it is one line, complete by itself.
 * Each stage fills parts: traffic objects, extract reflectors, ideal sensors and echoes, sensor
 * cells, noise targets. The parts lost and counts account for all other echoes. All memory of a
 * frame is in its arena.
 *
 * Conventions in all modules: SI units and radians, with the unit in the name; a name without a
 * unit is dimensionless. Axes are those of ISO 8855: x forward, y left, angles counter-clockwise.
 * Azimuths count from boresight, positive to the left; range rates are positive when receding.
 * Positions of objects are the centres of their boxes, from the frame's origin; mounts count from
 * the centre of the ego's box. Amplitudes are linear, except members that end in _db. */
#pragma once

#include "base/random.h"
#include "frame/conditions.h"
#include "frame/effects.h"
#include "frame/margins.h"
#include "frame/reflectors.h"
#include "frame/sections.h"
#include "frame/sightings.h"
#include "propagation/roadside.h"
#include "radar/antenna.h"
#include "radar/array.h"
#include "text/field.h"

enum { FRAME_VERSION = 1, FRAME_OLDEST_VERSION = 0 }; /* written; the oldest one that is read */

enum frame_part {
    PART_OBJECTS = 1 << 0,
    PART_REFLECTORS = 1 << 1,
    PART_SENSORS = 1 << 2,
    PART_ECHOES = 1 << 3,
    PART_CELLS = 1 << 4,
    PART_TARGETS = 1 << 5,
    PART_LOST = 1 << 6,
    PART_COUNTS = 1 << 7,
    PART_VEHICLES = 1 << 8,
    PART_VISIBILITY = 1 << 9,
};

_Static_assert(PART_VISIBILITY < 1U << 31, "a set of parts is an unsigned");

/* The members that are in no part, in a set of parts. */
#define PART_HEADER FIELD_UNGROUPED

/* Parts of a frame, as one stage may have written them. */
struct frame_parts {
    unsigned parts;    /* set of enum frame_part, and PART_HEADER */
    const char *stage; /* of PART_LOST only the groups of this stage; NULL: all groups */
};

/* A road user or thing: truth. A length, width or height of 0 means the size of the class, which
 * glint-extract fills in. The velocity of the box's centre need not point along the yaw. */
struct object {
    const char *id;
    const char *class;
    double x_m, y_m, yaw_rad;
    double vx_mps, vy_mps, yaw_rate_radps;
    double length_m, width_m, height_m;
    double travelled_m; /* since the scene began */
    const char *extra;  /* the user's own member, here and below, passed on byte for byte */
};

/* Standard deviations of the levels of a class's bodies (MODEL 14.22). Below 0: the sensor's. */
struct class_level {
    double constant_db, slow_db, fast_db;
};

/* The document that described a class to the stage which wrote the reflectors. */
struct class_document {
    const char *class;
    const char *digest;   /* 16 hexadecimal digits */
    double rear_axle_x_m; /* from the centre of the box; 0: the document does not say */
    struct class_level level;
    double cell_max_m; /* coarsest range cell that the reflectors are made for; 0: any */
};

/* The properties of a sensor that readers of targets need. */
struct sensor_view {
    const char *name;
    double mount_x_m, mount_y_m, mount_yaw_rad;
    double mount_z_m; /* 0: not known */
    double field_of_view_rad;
    double range_max_m;
    double cell_range_m, cell_range_rate_mps;
    double resolution_range_m, resolution_range_rate_mps; /* 0: not known */
    double azimuth_cell_rad;                              /* 0: a twentieth of the field of view */
    double carrier_hz;                                    /* 0: not known */
    double cycle_s;                                       /* 0: a scan in every frame */
    bool measured; /* does the frame have a scan of this sensor? */
    double age_s;  /* the frame's time less the time that the scan shows */
};

struct sensors {
    const char *suite;   /* plain name of the suite's document, without folder and ending */
    const char *digest;  /* of the values of that document and its tables, 16 hex digits */
    const char *effects; /* the selection as it was given to glint-ideal; NULL: auto */
    LIST_OF(struct sensor_view) list;
};

/* The path of an echo's wave. A ghost appears in the direction of its last leg. Addresses of random
 * numbers contain these values: a new path goes to the end. */
enum path {
    PATH_DIRECT,           /* sensor, object, sensor */
    PATH_WALL_OBJECT,      /* sensor, wall, object, sensor */
    PATH_OBJECT_WALL,      /* sensor, object, wall, sensor */
    PATH_WALL_OBJECT_WALL, /* sensor, wall, object, wall, sensor */
    PATH_WHEEL,            /* direct, from a point on a rolling wheel */
    PATH_LIMB,             /* direct, from an arm or a leg */
    PATH_CLUTTER,          /* direct, from the ground or the roadside */
    PATH_FALSE_ALARM,      /* no echo but noise */
    PATH_COUNT,
};

/* The identity of an echo in a sensor's scan. */
struct echo_id {
    const char *object;
    const char *reflector;
    enum path path;
    const char *mirror; /* id of the object that mirrors, on paths by a wall; else NULL */
    int64_t number;     /* from 1 where several may be alike in all members above; else 0 */
};

/* Groups of members of echoes, contributors, cells, targets: a record has all of one or none. */
enum value_group {
    VALUE_ELEVATION = 1 << 0, /* of a sensor that measures elevation */
};
_Static_assert(VALUE_ELEVATION < 1U << 31, "a set of groups is an unsigned");

/* The exact measurement of a reflector by a sensor along one path. */
struct echo {
    const char *sensor;
    struct echo_id id;
    double range_m, azimuth_rad, elevation_rad, range_rate_mps;
    double ercs;
    double departure_azimuth_rad; /* of the wave, on paths by a wall one way; else 0 */
    double height_m;              /* of the reflector's middle over the road; 0: not known */
    double extent_m;              /* from the reflector's lowest to its highest part; 0: a point */
    enum moving_part moving_part;
    double ground_rate_mps; /* part of range_rate_mps, by the object's motion over ground */
    double heading_rad;     /* of the object, from boresight */
    double time_s;          /* of the measurement */
    uint64_t effects;       /* EFFECT_BITs of the effects that changed one of these values */
    struct margins margins;
    const char *extra;
    unsigned present; /* enum value_group, here and below */
};

/* An echo in a cell or in a target's label: its exact values and its weight in the cell. */
struct contributor {
    struct echo_id id;
    double range_m, azimuth_rad, elevation_rad, range_rate_mps;
    double ercs;
    double time_s;
    double weight; /* share of the cell's amplitude, equation (5); a cell's weights sum to 1 */
    unsigned present;
};

/* A resolution cell before noise. The first member is the leader, which opened the cell. */
struct cell {
    const char *sensor;
    double range_m, azimuth_rad, elevation_rad, range_rate_mps;
    double amplitude; /* sum of the members' amplitudes, A_cell of MODEL 6 */
    double sum_re, sum_im, delta_re, delta_im;
    bool below_threshold; /* only noise can lift it over the threshold (MODEL 8.4) */
    bool sign_undecided;
    double interference; /* power of other radars over that of the sensor's own noise */
    uint64_t effects;    /* EFFECT_BITs of those that changed a value of the cell or a member */
    LIST_OF(struct contributor) members;
    LIST_OF(struct phasor) elements; /* of an array, without noise; empty for a single echo */
    /* The noisy beam of which beam_cells made this cell; NULL elsewhere and on the wire. */
    const struct array_maximum *beam;
    bool repeats; /* is its label that of another cell of the frame as well? Not on the wire */
    struct margins margins;
    const char *extra;
    unsigned present;
};

/* Members of a target's quality that are known together. */
enum quality_group {
    QUALITY_NOISE = 1 << 0, /* snr_db, existence */
    QUALITY_RCS = 1 << 1,
    QUALITY_ERRORS = 1 << 2, /* standard deviations */
    QUALITY_FOLDS = 1 << 3,  /* interval and ambiguity_number */
    QUALITY_MERGED = 1 << 4,
    QUALITY_MOUNT = 1 << 5,    /* places from the sensor and the centre */
    QUALITY_EGO = 1 << 6,      /* places and rate that need to know the ego */
    QUALITY_POINTERS = 1 << 7, /* looks_merged */
    QUALITY_ELEVATION = 1 << 8,
};
_Static_assert(QUALITY_ELEVATION < 1U << 31, "a set of groups is an unsigned");

/* Quality of a detection by its report and the suite (MODEL 14.21), and exact labels. */
struct quality {
    double snr_db, rcs_dbsm;
    double range_sd_m, range_rate_sd_mps, azimuth_sd_rad, elevation_sd_rad; /* deviations */
    double existence;               /* probability of an echo */
    double range_rate_interval_mps; /* rates this far apart read alike */
    int64_t ambiguity_number;       /* label: true rate less reported one, in such intervals */
    bool looks_merged;              /* do pointers or elements show several echoes? */
    bool merged_objects, merged_reflectors; /* labels: are contributors of several? */
    double range_rate_over_ground_mps;      /* without the sensor's own motion */
    double x_sensor_m, y_sensor_m, x_centre_m, y_centre_m;
    double x_rear_axle_m, y_rear_axle_m, x_world_m, y_world_m;
    unsigned present; /* enum quality_group */
};

/* An entry of the target list with its exact label: values and members of its cell. */
struct target {
    const char *sensor;
    double range_m, azimuth_rad, elevation_rad, range_rate_mps;
    double amplitude_db;
    bool sign_undecided;
    double cell_range_m, cell_azimuth_rad, cell_elevation_rad, cell_range_rate_mps;
    double cell_amplitude;
    double cell_sum;  /* amplitude of the cell's sum pointer, without noise; 0: not known */
    uint64_t effects; /* EFFECT_BITs of those that changed a value of the target or a contributor */
    LIST_OF(struct contributor) contributors;
    struct margins margins;
    struct quality quality;
    const char *extra;
    unsigned present;
};

/* Why an echo is part of no target: the reasons of losses.def. */
enum loss {
#define LOSS(id, name, effect) LOSS_##id,
#include "frame/losses.def"
    LOSS_OWN, /* a reason that only its stage knows */
};

/* Range and azimuth of the echo, rounded to 1 mm and 1e-5 rad; without an echo those of the
 * reflector's place in the plane, for a flat side of its middle. */
struct lost_echo {
    struct echo_id id;
    double range_m, azimuth_rad; /* range 0: not known */
    const char *by;              /* id of the object that blocks it, for LOSS_BLOCKED; else NULL */
    double shortfall_db;         /* threshold over amplitude, for losses by a threshold; else 0 */
    struct margins margins;
};

/* The echoes of one sensor that one stage lost for one reason. */
struct lost_group {
    const char *sensor;
    const char *stage;
    const char *reason;    /* the name of an enum loss, or the stage's own, of a to z and _ */
    enum effect_id effect; /* that loses echoes for the reason, or EFFECT_NONE */
    LIST_OF(struct lost_echo) echoes;
};

/* How many echoes along one path were made. */
struct path_count {
    enum path path;
    int64_t echoes;
};

/* Numbers for the account (frame_check.h): pairs of a sensor and a reflector, and echoes made. */
struct count {
    const char *sensor;
    int64_t pairs;
    LIST_OF(struct path_count) paths;
};

struct frame {
    int64_t version;
    const char *scene;
    int64_t frame;
    double time_s;
    double interval_s;
    bool last; /* is it the last frame of its scene? */
    uint64_t seed;
    const char *ego;
    double origin_x_m, origin_y_m;
    uint64_t sections; /* set of enum carried: the choice of what it carries */
    struct conditions conditions;
    LIST_OF(struct roadside_strip) roadside; /* the same in every frame of a scene */
    LIST_OF(struct object) objects;
    LIST_OF(struct class_document) vehicles; /* by class; empty before extraction */
    LIST_OF(struct reflector_set) reflectors;
    struct sensors sensors;
    LIST_OF(struct echo) echoes;
    LIST_OF(struct cell) cells;
    LIST_OF(struct target) targets;
    LIST_OF(struct lost_group) lost;
    LIST_OF(struct count) counts;
    LIST_OF(struct sighting) visibility;
    const char *extra;
    struct field_line line;       /* that the frame was read from */
    const struct frame *document; /* NULL: no frame is copied from a document */
    unsigned present;             /* enum frame_part: the parts that the frame has, even if empty */
    struct arena *arena;
    struct list_cache *list_cache;  /* lists that many lines repeat; NULL: none are kept */
    LIST_OF(struct object *) by_id; /* the cache of frame_order_objects; empty: not sorted yet */
    struct {
        size_t lost, counts;
    } ordered; /* numbers of items in canonical order; later items are new */
};

/* The members of a frame that are in no part, byte for byte. */
struct frame_header {
    char bytes[offsetof(struct frame, objects)];
};

extern const struct record frame_record;
extern const struct record object_record;
extern const struct record class_level_record;
extern const struct record sensor_view_record;
extern const struct record echo_record;
extern const struct record contributor_record;
extern const struct record cell_record;
extern const struct record target_record;
extern const struct record quality_record;
extern const struct record lost_echo_record;
extern const struct record lost_group_record;

/* True if both names are equal: quick for one pointer, and for different first letters. */
static inline bool frame_same_name(const char *a, const char *b)
{
    return a == b || (*a == *b && strcmp(a, b) == 0);
}

/* Empties the frame. Its arena keeps its memory, and the cache of lists stays. */
void frame_clear(struct frame *frame);

/* Does the choice of the frame contain this? */
static inline bool frame_carries(const struct frame *frame, enum carried what)
{
    return (frame->sections & what) != 0;
}

/* Does the frame have objects, and so its ego, even if they are not read yet? */
static inline bool frame_has_objects(const struct frame *frame)
{
    return frame->objects.count > 0 || (frame->line.unread & PART_OBJECTS) != 0;
}

/* The key of a part on the wire. */
const char *frame_part_name(enum frame_part part);

/* Names on the wire; NULL follows the last. */
extern const char *const frame_paths[], *const frame_losses[];

/* The reason of that name; LOSS_OWN for any other. */
static inline enum loss frame_loss_of(const char *reason)
{
    enum loss loss = 0;
    while (frame_losses[loss] != NULL && !frame_same_name(frame_losses[loss], reason))
        loss++;
    return loss;
}

/* The reason of a group, in the arena: "blocked", or "mud: covered" for a reason of the stage mud's
 * own. */
const char *frame_loss_words(const struct lost_group *group, struct arena *arena);

/* Removes parts of the frame. */
void frame_drop(struct frame *frame, unsigned parts);

/* Notes that parts are changed, so that they are not written as in the frame's line. */
static inline void frame_alter(struct frame *frame, unsigned parts)
{
    frame->line.same &= ~parts;
    frame->line.unread &= ~parts;
}

/* The object with this id, or NULL: by bisection once frame_order_objects has sorted them. */
struct object *frame_object(const struct frame *frame, const char *id);

/* True for paths whose echoes come from the place of an object: no ghost, clutter, false alarm. */
bool frame_shows_object(enum path path);

/* True for paths whose echoes are of an object. Clutter and false alarms are of none: the name that
 * stands for their object is only a word, which an object may have as its id. */
bool frame_has_object(enum path path);

/* The object that an echo is of, directly or by a mirror. NULL if it is of none, or if the frame
 * lacks the object. Whoever joins a label to its object asks this function. */
struct object *frame_object_of(const struct frame *frame, const struct echo_id *echo);

/* True if both echoes are of one object, or both of no object and named alike. */
bool frame_same_object(const struct echo_id *a, const struct echo_id *b);

/* The place of a target in the axes of its sensor: x along the boresight, y to the left, in the
 * plane of the road. A measured elevation shortens x, as the azimuth is the angle of a cone. */
struct vec2 frame_target_place(const struct target *target);

/* The contributor of the greatest weight, the first of equals; NULL: the target has no label. */
const struct contributor *frame_strongest(const struct target *target);

/* True if a sensor measured in this frame. */
bool frame_measured(const struct frame *frame);

/* True if an echo of the object with this id is in a target. */
bool frame_detects(const struct frame *frame, const char *object);

/* The object's motion age_s before the frame's time, at constant speed and turn rate (MODEL 2.4).
 */
struct motion frame_motion(const struct object *object, double age_s);

/* The object with the place, heading and velocity of this motion. */
struct object frame_object_in(struct object object, struct motion motion);

/* The sensor with this name in the frame's suite, or NULL. This and the functions below need the
 * parts in canonical order. */
const struct sensor_view *frame_view(const struct frame *frame, const char *sensor);

/* The documents of one class: one, or none before extraction. */
struct document_span {
    const struct class_document *items;
    size_t count;
};
struct document_span frame_documents_of(const struct frame *frame, const char *class);

/* Place of the object's rear axle from the centre of its box: that of its class's document, or else
 * in proportion to a car's of 4.5 m (MODEL 2.1). */
double frame_rear_axle_x_m(const struct frame *frame, const struct object *object);

/* The echoes and the cells of one sensor, which are neighbours in canonical order. */
struct echo_span {
    const struct echo *items;
    size_t count;
};
struct cell_span {
    const struct cell *items;
    size_t count;
};
struct echo_span frame_echoes_of(const struct frame *frame, const char *sensor);
struct cell_span frame_cells_of(const struct frame *frame, const char *sensor);

/* The noise-free sum and delta pointers of a cell. */
struct antenna_pointers frame_cell_pointers(const struct cell *cell);

/* An echo as a contributor, with the weight 0. */
struct contributor frame_contributor(const struct echo *echo);

/* An echo, or a member of a cell, as it is lost. */
struct lost_echo frame_lost_echo(const struct contributor *echo, const struct margins *margins);

/* Adds a lost echo to the group of its sensor, stage and reason, if the frame keeps account. A
 * stage must finish one sensor before the next. All text must live as long as the frame. */
void frame_lose(struct frame *frame, const char *stage, const char *sensor, enum loss reason,
                const struct lost_echo *echo);

/* The same for a reason of the stage's own, of letters a to z and underscores. */
void frame_lose_own(struct frame *frame, const char *stage, const char *sensor, const char *reason,
                    const struct lost_echo *echo);

/* Adds every member of a cell as a lost echo, each with these margins. shortfall_db is 0 for
 * reasons without a threshold. */
void frame_lose_cell(struct frame *frame, const char *stage, const struct cell *cell,
                     enum loss reason, double shortfall_db, const struct margins *margins);

/* Adds to the sensor's counts of echoes made along a path, and of pairs with a reflector. A stage
 * must finish one sensor before the next. */
void frame_count_echoes(struct frame *frame, const char *sensor, enum path path, int64_t echoes);
void frame_count_pairs(struct frame *frame, const char *sensor, int64_t pairs);

/* The echoes that a count has along a path. */
int64_t frame_counted_echoes(const struct count *count, enum path path);

/* Appends a target with the cell's values, without noise, its margins and its members as label. */
struct target *frame_add_target(struct frame *frame, const struct cell *cell, double amplitude_db);

/* Addresses of random numbers (random.h) contain the frame's seed, scene and number, the sensor and
 * the identity of the echo; of a cell, of its leader. The address of a scan contains no echo. */
struct random_address frame_draw_address_of_scan(const struct frame *frame, const char *sensor);

/* The address of the scene, for what is the same in all its frames and for all sensors. */
struct random_address frame_draw_address_of_scene(const struct frame *frame);

/* The address of an echo in that scan. */
struct random_address frame_draw_address_in(struct random_address scan, struct echo_id id);

struct random_address frame_draw_address_of(const struct frame *frame, const char *sensor,
                                            struct echo_id id);
