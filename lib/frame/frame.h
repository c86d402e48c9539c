/* The frame: the one record that every stage reads and writes.
 *
 * Conventions, said once. SI units and radians, the unit is in the name, no suffix means
 * dimensionless. ISO 8855: x forward, y left, counter-clockwise positive; azimuth is left-positive
 * from boresight; range rate is positive when receding. Positions are centres of bounding boxes,
 * relative to the frame's origin; mounts are relative to the centre of the ego's box. Amplitudes
 * are linear in echoes and cells, and so are all decisions; decibels stand only in targets and
 * lost.
 *
 * One frame is one line and stands alone. Sections fill up along the chain: objects (traffic),
 * reflectors (extract), sensors and echoes (ideal), cells (sensor), targets (noise), and lost and
 * counts, which tell what became of the rest. All memory of a frame is in its arena. */
#ifndef FRAME_H
#define FRAME_H

#include <string.h>

#include "frame/conditions.h"
#include "frame/effects.h"
#include "frame/margins.h"
#include "frame/reflectors.h"
#include "radar/antenna.h"
#include "text/field.h"

enum { FRAME_VERSION = 0 };

enum section {
    SECTION_OBJECTS = 1 << 0,
    SECTION_REFLECTORS = 1 << 1,
    SECTION_SENSORS = 1 << 2,
    SECTION_ECHOES = 1 << 3,
    SECTION_CELLS = 1 << 4,
    SECTION_TARGETS = 1 << 5,
    SECTION_LOST = 1 << 6,
    SECTION_COUNTS = 1 << 7,
};

/* These are used up by the stage that reads them, unless it is told to --keep them. */
enum { SECTIONS_CONSUMED = SECTION_REFLECTORS | SECTION_ECHOES | SECTION_CELLS };

/* What one stage wrote into a frame: these sections, and of lost only what it lost itself. */
struct frame_part {
    unsigned sections;
    const char *stage; /* NULL: all of lost */
};

/* Truth. A length, width or height of 0 stands for the default of the class (glint-extract fills
 * it in). Velocity is that of the box centre and need not point along the yaw. */
struct object {
    const char *id;
    const char *class;
    double x_m, y_m, yaw_rad;
    double vx_mps, vy_mps, yaw_rate_radps;
    double length_m, width_m, height_m;
    double travelled_m;
    const char *extra;
};

/* One sensor of the suite, as far as a reader of targets needs it. */
struct sensor_view {
    const char *name;
    double mount_x_m, mount_y_m, mount_yaw_rad;
    double field_of_view_rad;
    double range_max_m;
    double cell_range_m, cell_range_rate_mps;
    double cycle_s;
    bool measured; /* did it deliver a scan in this frame? */
};

struct sensors {
    const char *suite;   /* the document's name, as it was given to glint-ideal */
    const char *digest;  /* of the suite and every table it names, 16 hexadecimal digits */
    const char *effects; /* as requested (effects.h); NULL stands for auto */
    LIST_OF(struct sensor_view) list;
};

/* The way an echo took, and what sent it back. A ghost's last leg is where the radar sees it. Draws
 * are addressed by these numbers: new paths go to the end. */
enum path {
    PATH_DIRECT,           /* sensor, object, sensor */
    PATH_WALL_OBJECT,      /* sensor, wall, object, sensor */
    PATH_OBJECT_WALL,      /* sensor, object, wall, sensor */
    PATH_WALL_OBJECT_WALL, /* sensor, wall, object, wall, sensor */
    PATH_WHEEL,            /* a point on a turning wheel */
    PATH_LIMB,             /* an arm or a leg */
    PATH_CLUTTER,          /* the ground and what stands on it */
    PATH_FALSE_ALARM,      /* nothing: noise */
};

/* What an echo is of, in one sensor's view. */
struct echo_id {
    const char *object;
    const char *reflector;
    enum path path;
    const char *mirror; /* the wall's object on ghost paths, else NULL */
    int64_t number;     /* of several of this kind, from 1; else 0 */
};

/* One sensor's view of one reflector along one path. */
struct echo {
    const char *sensor;
    struct echo_id id;
    double range_m, azimuth_rad, range_rate_mps;
    double ercs;
    double departure_rad; /* azimuth in which its wave left, less the one in which it came back */
    double height_m, extent_m; /* over the road, and upright; 0: not known, a point */
    enum moving_part moving_part;
    double ground_rate_mps; /* the part of its range rate that its own motion over ground makes */
    double heading_rad;     /* of its object, from boresight */
    double time_s;          /* of the measurement */
    uint64_t effects;       /* that changed one of these values */
    struct margins margins;
    const char *extra;
};

/* An echo in a cell or in a target's label: the ideal values, and its weight in the cell. */
struct contributor {
    struct echo_id id;
    double range_m, azimuth_rad, range_rate_mps;
    double ercs;
    double time_s;
    double weight; /* share of the cell's amplitude, equation (5); they sum to 1 */
};

/* One resolution cell without noise. The first member is the leader, which opened the cell. */
struct cell {
    const char *sensor;
    double range_m, azimuth_rad, range_rate_mps;
    double amplitude; /* sum over the members: the upper bound A_cell^u */
    double sum_re, sum_im, delta_re, delta_im;
    bool sign_undecided;
    double interference; /* of other radars, over the sensor's own noise, in power */
    uint64_t effects;    /* that changed a value of the cell or of a member */
    LIST_OF(struct contributor) members;
    struct margins margins;
    const char *extra;
};

/* One line of the target list with its exact label: the cell it came from. */
struct target {
    const char *sensor;
    double range_m, azimuth_rad, range_rate_mps;
    double amplitude_db;
    bool sign_undecided;
    double cell_range_m, cell_azimuth_rad, cell_range_rate_mps;
    double cell_amplitude;
    uint64_t effects; /* that changed a value of the target or of a contributor: input and output
                         differed there */
    LIST_OF(struct contributor) contributors;
    struct margins margins;
    const char *extra;
};

enum loss {
    LOSS_FACING_AWAY,     /* outside the point's visibility range */
    LOSS_NO_SPECULAR,     /* the plane mirrors past the sensor */
    LOSS_OUT_OF_RANGE,    /* nearer or farther than the sensor measures */
    LOSS_OUT_OF_VIEW,     /* outside the field of view */
    LOSS_BLOCKED,         /* another object stands in the way */
    LOSS_NO_AMPLITUDE,    /* nothing comes back: the antenna has a null there */
    LOSS_BELOW_THRESHOLD, /* even the cell's summed amplitude is too weak */
    LOSS_BELOW_FINAL,     /* the amplitude after superposition and noise is too weak */
    LOSS_NO_ANGLE,        /* both channels are exactly zero */
    LOSS_LIST_LIMIT,      /* the sensor reports no more targets than this */
    LOSS_SWITCHED_OFF,    /* the effect that would have made it is not selected */
    LOSS_MASKED,          /* beside stronger ones it is no peak of the signal's spectrum */
};

struct lost_echo {
    struct echo_id id;
    const char *by;      /* blocked by this object */
    double shortfall_db; /* below the threshold by this much */
    struct margins margins;
};

struct lost_group {
    const char *sensor;
    const char *stage;
    enum loss reason;
    enum effect_id effect; /* that lost them, or EFFECT_NONE */
    LIST_OF(struct lost_echo) echoes;
};

struct path_count {
    enum path path;
    int64_t echoes;
};

/* What there was to account for: every (reflector, sensor) pair, and every echo made. */
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
    bool last;
    uint64_t seed;
    const char *ego;
    double origin_x_m, origin_y_m;
    bool account;
    bool margins; /* do entries carry them? Without, no stage works any out. */
    struct conditions conditions;
    LIST_OF(struct object) objects;
    LIST_OF(struct reflector_set) reflectors;
    struct sensors sensors;
    LIST_OF(struct echo) echoes;
    LIST_OF(struct cell) cells;
    LIST_OF(struct target) targets;
    LIST_OF(struct lost_group) lost;
    LIST_OF(struct count) counts;
    const char *extra;
    unsigned present; /* enum section */
    struct arena *arena;
    struct list_cache *list_cache;  /* lists that frames repeat; NULL: no list is kept */
    LIST_OF(struct object *) by_id; /* sorted by frame_order_objects; empty: not yet */
};

extern const struct record frame_record;
extern const struct record object_record;
extern const struct record sensor_view_record;
extern const struct record lost_group_record;

/* Is this the same name? Names are mostly one pointer each, documents' and objects', or differ at
 * once. */
static inline bool frame_same_name(const char *a, const char *b)
{
    return a == b || (*a == *b && strcmp(a, b) == 0);
}

/* Back to an empty frame that keeps its arena's room and its cache of lists. */
void frame_clear(struct frame *frame);

/* The name of a section, for messages. */
const char *frame_section_name(enum section section);

/* NULL behind the last one. */
const char *frame_path_name(enum path path);
const char *frame_loss_name(enum loss loss);

/* Empties sections: they are then absent, as if they had never been there. */
void frame_drop(struct frame *frame, unsigned sections);

/* The object of that id, or NULL. */
struct object *frame_object(const struct frame *frame, const char *id);

/* Where the object was age_s before the frame's time, at constant speed and turn rate (MODEL 2.4).
 */
struct motion frame_motion(const struct object *object, double age_s);

/* The sensor of that name as the frame knows it, or NULL. */
const struct sensor_view *frame_view(const struct frame *frame, const char *sensor);

/* The echoes, or cells, of one sensor: sections are grouped by sensor. */
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

/* The contributor that an echo is, with weight 0. */
struct contributor frame_contributor(const struct echo *echo);

/* Writes the loss of one echo, grouped by sensor, stage and reason, with the effect that the reason
 * belongs to. Does nothing unless the frame keeps account. Text must live as long as the frame. */
void frame_lose(struct frame *frame, const char *stage, const char *sensor, enum loss reason,
                const struct lost_echo *echo);

/* Writes the loss of every member of a cell, each with the margins that the cell had in the end.
 * shortfall_db is 0 where the reason has none. */
void frame_lose_cell(struct frame *frame, const char *stage, const struct cell *cell,
                     enum loss reason, double shortfall_db, const struct margins *margins);

/* Counts echoes that were made, by path, and pairs of the sensor and a reflector. */
void frame_count_echoes(struct frame *frame, const char *sensor, enum path path, int64_t echoes);
void frame_count_pairs(struct frame *frame, const char *sensor, int64_t pairs);

/* Appends a target with the cell's label and the cell's noise-free values and margins as its own.
 */
struct target *frame_add_target(struct frame *frame, const struct cell *cell, double amplitude_db);

#endif
