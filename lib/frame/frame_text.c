#include "frame/frame_text.h"

#include "base/units.h"
#include "text/record_read.h"
#include "text/record_write.h"

/* Bounds of members. No scene reaches beyond 1e7 m and no radar beyond 1e6 m. Reported values, with
 * noise and rounding, may be ten times the exact ones. A scan's time may be before its frame's. */
#define PLACE(owner, member, help) FIELD_REAL_IN(owner, member, -1e7, 1e7, help)
#define ANGLE(owner, member, help) FIELD_REAL_IN(owner, member, -1e6, 1e6, help)
#define SPEED(owner, member, help) FIELD_REAL_IN(owner, member, -1e4, 1e4, help)
#define SIZE(owner, member, help) FIELD_REAL_IN(owner, member, 0, 1e6, help)
#define AMPLITUDE(owner, member, help) FIELD_REAL_IN(owner, member, 0, 1e308, help)
#define POINTER(owner, member, help) FIELD_REAL_IN(owner, member, -1e308, 1e308, help)
#define RANGE(owner, member, help) FIELD_REAL_IN(owner, member, 0, 1e6, help)
#define AZIMUTH(owner, member, help) FIELD_REAL_IN(owner, member, -PI, PI, help)
#define ELEVATION(owner, member, help)                                                             \
    FIELD_REAL_IN(owner, member, -PI / 2, PI / 2, help), FIELD_OPTIONAL, .group = VALUE_ELEVATION
#define RATE(owner, member, help) FIELD_REAL_IN(owner, member, -1e5, 1e5, help)
#define NAME(owner, member, help) FIELD_NAME_OF(owner, member, help)
#define UNDECIDED(owner)                                                                           \
    OPTIONAL_FLAG(owner, sign_undecided,                                                           \
                  "the phase between the channels does not tell left from right")
#define EFFECTS(owner, help) FIELD_SET_OF(owner, effects, effects_names, help), FIELD_OPTIONAL
#define MARGINS(owner)                                                                             \
    OPTIONAL_RECORD(owner, margins, &margins_record, "distances from other decisions")
#define EXTRA(owner) FIELD_RAW_OF(owner, extra, "the user's own, passed on byte for byte")
#define ECHO_ID(owner, member, kind_, help_)                                                       \
    FIELD_NAMED(member), .kind = (kind_), .offset = offsetof(owner, id.member), .help = (help_)
#define ECHO_REFLECTOR(owner)                                                                      \
    ECHO_ID(owner, reflector, FIELD_NAME, "name of the reflector in its set")
#define ECHO_PATH(owner)                                                                           \
    ECHO_ID(owner, path, FIELD_CHOICE, "path of the echo's wave"), .choices = frame_paths
#define ECHO_MIRROR(owner)                                                                         \
    {ECHO_ID(owner, mirror, FIELD_NAME, "id of the object that mirrors, on paths by a wall"),      \
     FIELD_OPTIONAL},                                                                              \
    {                                                                                              \
        ECHO_ID(owner, number, FIELD_INTEGER,                                                      \
                "from 1, if there may be several that are else alike"),                            \
            .low = 0, .high = 1e9, FIELD_OPTIONAL                                                  \
    }
#define ECHO_NAMES(owner)                                                                          \
    {ECHO_ID(owner, object, FIELD_NAME, "id of the object")}, {ECHO_REFLECTOR(owner)},             \
        {ECHO_PATH(owner)}, ECHO_MIRROR(owner)
#define IDEAL_VALUES(owner)                                                                        \
    {RANGE(owner, range_m, "from the sensor to the reflector, exact")},                            \
        {AZIMUTH(owner, azimuth_rad, "from boresight, positive to the left, exact")},              \
        {ELEVATION(owner, elevation_rad, "from the horizontal, positive upwards, exact")},         \
        {RATE(owner, range_rate_mps, "positive when receding, exact")},                            \
        {AMPLITUDE(owner, ercs, "equivalent radar cross section in this direction")},              \
    {                                                                                              \
        FIELD_REAL_IN(owner, time_s, -1e11, 1e11, "instant of the measurement")                    \
    }

static const struct field object_fields[] = {
    {NAME(struct object, id, "unique in the frame")},
    {NAME(struct object, class, "name of the vehicle document")},
    {PLACE(struct object, x_m, "centre of the box, from the frame's origin")},
    {PLACE(struct object, y_m, "centre of the box, from the frame's origin")},
    {ANGLE(struct object, yaw_rad, "heading of the box")},
    {SPEED(struct object, vx_mps, "velocity of the centre")},
    {SPEED(struct object, vy_mps, "velocity of the centre")},
    {FIELD_REAL_IN(struct object, yaw_rate_radps, -1e3, 1e3, "turn rate")},
    {SIZE(struct object, length_m, "0: that of the class")},
    {SIZE(struct object, width_m, "0: that of the class")},
    {SIZE(struct object, height_m, "0: that of the class")},
    {FIELD_REAL_IN(struct object, travelled_m, 0, 1e9, "distance since the scene began")},
    {EXTRA(struct object)},
    {0},
};

const struct record object_record = {
    FIELD_TABLE(struct object, object_fields, "object", "A road user or thing: truth.")};

#define WIDTH(member, help) OPTIONAL_REAL(struct class_level, member, 0, 30, help), .absent = -1

static const struct field class_level_fields[] = {
    {WIDTH(constant_db, "from body to body, as a sensor's level_constant_db; absent: that")},
    {WIDTH(slow_db, "as a body and the ego drive, as a sensor's level_slow_db; absent: that")},
    {WIDTH(fast_db, "over aspect and range, as a sensor's level_fast_db; absent: that")},
    {0},
};

const struct record class_level_record = {
    FIELD_TABLE(struct class_level, class_level_fields, "level",
                "Standard deviations of the levels of a class's bodies.")};

static const struct field class_document_fields[] = {
    {NAME(struct class_document, class, "name of the vehicle document")},
    {NAME(struct class_document, digest, "digest of the document")},
    {OPTIONAL_REAL(struct class_document, rear_axle_x_m, -1e3, 1e3,
                   "from the centre of the box; absent: 5/18 of the length behind it")},
    {OPTIONAL_RECORD(struct class_document, level, &class_level_record,
                     "how its bodies' levels vary, where not as the sensor has it")},
    {OPTIONAL_REAL(struct class_document, cell_max_m, 0.01, 100,
                   "coarsest range cell that its reflectors are made for; absent: any")},
    {0},
};

static const struct record class_document_record = {
    FIELD_TABLE(struct class_document, class_document_fields, "class document",
                "The vehicle document that described a class.")};

static const struct field sensor_view_fields[] = {
    {NAME(struct sensor_view, name, "unique in the suite")},
    {PLACE(struct sensor_view, mount_x_m, "from the centre of the ego's box")},
    {PLACE(struct sensor_view, mount_y_m, "from the centre of the ego's box")},
    {OPTIONAL_REAL(struct sensor_view, mount_z_m, 0, 100,
                   "height above the road; absent: not known")},
    {ANGLE(struct sensor_view, mount_yaw_rad, "boresight, from the ego's heading")},
    {FIELD_REAL_IN(struct sensor_view, field_of_view_rad, 0, 2 * PI, "full width")},
    {RANGE(struct sensor_view, range_max_m, "greatest range")},
    {FIELD_REAL_IN(struct sensor_view, cell_range_m, 0, 2e6,
                   "stated cell, full width: the unit of scores")},
    {FIELD_REAL_IN(struct sensor_view, cell_range_rate_mps, 0, 2e5,
                   "stated cell, full width: the unit of scores")},
    {OPTIONAL_REAL(struct sensor_view, resolution_range_m, 0, 1e7,
                   "so far from a stronger echo, in range, an echo has a cell of its own; absent: "
                   "not known")},
    {OPTIONAL_REAL(struct sensor_view, resolution_range_rate_mps, 0, 1e6,
                   "the same in range rate; absent: not known")},
    {OPTIONAL_REAL(struct sensor_view, azimuth_cell_rad, 0, 2 * PI,
                   "cell in azimuth of scores; absent: a twentieth of the field of view")},
    {OPTIONAL_REAL(struct sensor_view, carrier_hz, 0, 1e12, "carrier frequency")},
    {OPTIONAL_REAL(struct sensor_view, cycle_s, 0, 1e6,
                   "time from scan to scan; absent: a scan in every frame")},
    {FIELD_FLAG_OF(struct sensor_view, measured, "does the frame have a scan of this sensor?")},
    {OPTIONAL_REAL(struct sensor_view, age_s, 0, 1e6,
                   "how long before the frame's time was what the scan shows")},
    {0},
};

const struct record sensor_view_record = {
    FIELD_TABLE(struct sensor_view, sensor_view_fields, "sensor", "A sensor of the suite.")};

static const struct field sensors_fields[] = {
    {NAME(struct sensors, suite, "name of the suite document, without folder and .json")},
    {NAME(struct sensors, digest, "digest of the values of the suite and its tables")},
    {OPTIONAL_NAME(struct sensors, effects, "selection given to glint-ideal; absent: auto")},
    {FIELD_LIST_OF(struct sensors, list, &sensor_view_record, "sensors by name")},
    {0},
};

static const struct record sensors_record = {
    FIELD_TABLE(struct sensors, sensors_fields, "suite", "The sensors of the ego.")};

static const struct field echo_fields[] = {
    {NAME(struct echo, sensor, "name in the suite")},
    ECHO_NAMES(struct echo),
    IDEAL_VALUES(struct echo),
    {OPTIONAL_REAL(struct echo, departure_azimuth_rad, -PI, PI,
                   "azimuth at which the wave departs, on the paths wall_object and object_wall")},
    {OPTIONAL_REAL(struct echo, height_m, 0, 1e7,
                   "height of the reflector over the road; absent: not known")},
    {OPTIONAL_REAL(struct echo, extent_m, 0, 1e7,
                   "from the reflector's lowest to its highest part; absent: a point")},
    {OPTIONAL_CHOICE(struct echo, moving_part, reflectors_moving_parts,
                     "part of the object that turns or swings there")},
    {OPTIONAL_REAL(struct echo, ground_rate_mps, -1e5, 1e5,
                   "part of the range rate that the object's motion over ground makes")},
    {OPTIONAL_REAL(struct echo, heading_rad, -PI, PI, "heading of the object, from boresight")},
    {EFFECTS(struct echo, "effects that changed one of these values")},
    {MARGINS(struct echo)},
    {EXTRA(struct echo)},
    {0},
};

const struct record echo_record = {
    FIELD_TABLE(struct echo, echo_fields, "echo",
                "What a sensor would read of a reflector along one path, exactly."),
    .present_offset = offsetof(struct echo, present)};

static const struct field contributor_fields[] = {
    ECHO_NAMES(struct contributor),
    IDEAL_VALUES(struct contributor),
    {FIELD_REAL_IN(struct contributor, weight, 0, 1, "share of the cell's amplitude")},
    {0},
};

const struct record contributor_record = {
    FIELD_TABLE(struct contributor, contributor_fields, "contributor", "An echo and its weight."),
    .present_offset = offsetof(struct contributor, present)};

static const struct field element_fields[] = {
    {POINTER(struct phasor, re, "real part")},
    {POINTER(struct phasor, im, "imaginary part")},
    {0},
};

static const struct record element_record = {
    FIELD_TABLE(struct phasor, element_fields, "element", "Signal of a virtual element.")};

static const struct field cell_fields[] = {
    {NAME(struct cell, sensor, "name in the suite")},
    {RANGE(struct cell, range_m, "weighted mean of the members")},
    {AZIMUTH(struct cell, azimuth_rad, "read from the superposed pointers, without noise")},
    {ELEVATION(struct cell, elevation_rad, "mean of the members and their images, by power")},
    {RATE(struct cell, range_rate_mps, "weighted mean of the members")},
    {AMPLITUDE(struct cell, amplitude, "sum of the members' amplitudes")},
    {OPTIONAL_FLAG(struct cell, below_threshold,
                   "only noise can lift the cell over the threshold")},
    {POINTER(struct cell, sum_re, "sum channel without noise")},
    {POINTER(struct cell, sum_im, "sum channel without noise")},
    {POINTER(struct cell, delta_re, "delta channel without noise")},
    {POINTER(struct cell, delta_im, "delta channel without noise")},
    {UNDECIDED(struct cell)},
    {OPTIONAL_REAL(struct cell, interference, 0, 1e300,
                   "power of other radars over that of the sensor's own noise")},
    {EFFECTS(struct cell, "effects that changed a value of the cell or of a member")},
    {FIELD_LIST_OF(struct cell, members, &contributor_record, "the leader first")},
    {OPTIONAL_LIST(struct cell, elements, &element_record,
                   "of an array, by place from the right; absent: a single echo")},
    {MARGINS(struct cell)},
    {EXTRA(struct cell)},
    {0},
};

const struct record cell_record = {
    FIELD_TABLE(struct cell, cell_fields, "cell", "A resolution cell before noise."),
    .present_offset = offsetof(struct cell, present)};

#define QUALITY_GROUP(name) FIELD_OPTIONAL, .group = QUALITY_##name
#define QUALITY_REAL(member, group, low, high, help)                                               \
    FIELD_REAL_IN(struct quality, member, low, high, help), QUALITY_GROUP(group)
#define QUALITY_PLACE(member, group, help) QUALITY_REAL(member, group, -1e8, 1e8, help)
#define QUALITY_FLAG(member, help)                                                                 \
    FIELD_FLAG_OF(struct quality, member, help), QUALITY_GROUP(MERGED)

static const struct field quality_fields[] = {
    {QUALITY_REAL(snr_db, NOISE, -1e4, 1e4, "power over that of the noise")},
    {QUALITY_REAL(rcs_dbsm, RCS, -1e5, 1e5, "cross section by amplitude, range and azimuth")},
    {QUALITY_REAL(range_sd_m, ERRORS, 0, 1e6, "standard deviation")},
    {QUALITY_REAL(range_rate_sd_mps, ERRORS, 0, 1e6, "standard deviation")},
    {QUALITY_REAL(azimuth_sd_rad, ERRORS, 0, PI, "standard deviation")},
    {QUALITY_REAL(elevation_sd_rad, ELEVATION, 0, PI, "standard deviation")},
    {QUALITY_REAL(existence, NOISE, 0, 1, "probability of an echo, not noise alone")},
    {QUALITY_REAL(range_rate_interval_mps, FOLDS, 0, 1e6, "range rates this far apart read alike")},
    {FIELD_INTEGER_IN(struct quality, ambiguity_number, -1e6, 1e6,
                      "true range rate less the reported one, in such intervals"),
     QUALITY_GROUP(FOLDS)},
    {FIELD_FLAG_OF(struct quality, looks_merged,
                   "do the channels or elements show several echoes, beyond noise?"),
     QUALITY_GROUP(POINTERS)},
    {QUALITY_FLAG(merged_objects, "are contributors of several objects?")},
    {QUALITY_FLAG(merged_reflectors, "are contributors of several reflectors?")},
    {QUALITY_REAL(range_rate_over_ground_mps, EGO, -1e6, 1e6, "0 for what stands")},
    {QUALITY_PLACE(x_sensor_m, MOUNT, "from the sensor, along its boresight")},
    {QUALITY_PLACE(y_sensor_m, MOUNT, "from the sensor, to the left of its boresight")},
    {QUALITY_PLACE(x_centre_m, MOUNT, "from the centre of the ego's box, forward")},
    {QUALITY_PLACE(y_centre_m, MOUNT, "from the centre of the ego's box, to the left")},
    {QUALITY_PLACE(x_rear_axle_m, EGO, "from the middle of the rear axle, forward")},
    {QUALITY_PLACE(y_rear_axle_m, EGO, "from the middle of the rear axle, to the left")},
    {QUALITY_PLACE(x_world_m, EGO, "from the frame's origin, as objects")},
    {QUALITY_PLACE(y_world_m, EGO, "from the frame's origin, as objects")},
    {0},
};

const struct record quality_record = {
    FIELD_TABLE(struct quality, quality_fields, "quality",
                "What the sensor tells of a detection's quality; labels are exact."),
    .present_offset = offsetof(struct quality, present)};

static const struct field target_fields[] = {
    {NAME(struct target, sensor, "name in the suite")},
    {FIELD_REAL_IN(struct target, range_m, 0, 1e7, "as reported")},
    {AZIMUTH(struct target, azimuth_rad, "as reported")},
    {FIELD_REAL_IN(struct target, elevation_rad, -PI, PI, "as reported, positive upwards"),
     FIELD_OPTIONAL, .group = VALUE_ELEVATION},
    {FIELD_REAL_IN(struct target, range_rate_mps, -1e6, 1e6, "as reported")},
    {FIELD_REAL_IN(struct target, amplitude_db, -1e4, 1e4, "as reported, 20 log10")},
    {UNDECIDED(struct target)},
    {RANGE(struct target, cell_range_m, "of the cell, without noise")},
    {AZIMUTH(struct target, cell_azimuth_rad, "of the cell, without noise")},
    {ELEVATION(struct target, cell_elevation_rad, "of the cell, without noise")},
    {RATE(struct target, cell_range_rate_mps, "of the cell, without noise")},
    {AMPLITUDE(struct target, cell_amplitude, "sum of the contributors' amplitudes, linear")},
    {AMPLITUDE(struct target, cell_sum, "of the cell's sum pointer, without noise, linear"),
     FIELD_OPTIONAL},
    {EFFECTS(struct target, "effects that changed a value of the target or of a contributor")},
    {FIELD_LIST_OF(struct target, contributors, &contributor_record, "the leader first")},
    {MARGINS(struct target)},
    {OPTIONAL_RECORD(struct target, quality, &quality_record, "what the sensor tells of it")},
    {EXTRA(struct target)},
    {0},
};

const struct record target_record = {
    FIELD_TABLE(struct target, target_fields, "target", "A detection with its exact label."),
    .present_offset = offsetof(struct target, present)};

static const struct field lost_echo_fields[] = {
    {ECHO_ID(struct lost_echo, object, FIELD_NAME, "id of the object")},
    {ECHO_REFLECTOR(struct lost_echo)},
    {ECHO_PATH(struct lost_echo), FIELD_OPTIONAL},
    ECHO_MIRROR(struct lost_echo),
    {OPTIONAL_REAL(struct lost_echo, range_m, 0, 1e8,
                   "of the echo, or of a reflector without one")},
    {AZIMUTH(struct lost_echo, azimuth_rad, "of the same"), FIELD_OPTIONAL},
    {OPTIONAL_NAME(struct lost_echo, by, "id of the object that blocks it")},
    {OPTIONAL_REAL(struct lost_echo, shortfall_db, 0, 1e5, "threshold over amplitude")},
    {MARGINS(struct lost_echo)},
    {0},
};

const struct record lost_echo_record = {FIELD_TABLE(struct lost_echo, lost_echo_fields, "lost echo",
                                                    "An echo that is part of no target."),
                                        .inherited = &lost_echo_fields[0]};

static const struct field lost_group_fields[] = {
    {NAME(struct lost_group, sensor, "name in the suite")},
    {NAME(struct lost_group, stage, "stage that lost them")},
    {NAME(struct lost_group, reason,
          "why they are part of no target, or a word of the stage's own"),
     .choices = frame_losses},
    {OPTIONAL_CHOICE(struct lost_group, effect, effects_names,
                     "effect to which the reason belongs"),
     .absent = EFFECT_NONE},
    {FIELD_LIST_OF(struct lost_group, echoes, &lost_echo_record,
                   "by object, reflector, path; absent are the object of the echo before and the "
                   "path direct")},
    {0},
};

const struct record lost_group_record = {FIELD_TABLE(struct lost_group, lost_group_fields,
                                                     "group of lost echoes",
                                                     "Echoes that one stage lost for one reason.")};

static const struct field path_count_fields[] = {
    {FIELD_CHOICE_OF(struct path_count, path, frame_paths, "path of the echoes")},
    {FIELD_INTEGER_IN(struct path_count, echoes, 0, 1e12, "echoes that were made")},
    {0},
};

static const struct record path_count_record = {
    FIELD_TABLE(struct path_count, path_count_fields, "count by path",
                "How many echoes of one path were made.")};

static const struct field count_fields[] = {
    {NAME(struct count, sensor, "name in the suite")},
    {FIELD_INTEGER_IN(struct count, pairs, 0, 1e12, "pairs of this sensor with a reflector")},
    {FIELD_LIST_OF(struct count, paths, &path_count_record, "echoes made, by path")},
    {0},
};

static const struct record count_record = {
    FIELD_TABLE(struct count, count_fields, "count", "What one sensor has to account for.")};

#define PART(bit) FIELD_OPTIONAL, .group = (bit)

static const struct field frame_fields[] = {
    {FIELD_INTEGER_IN(struct frame, version, FRAME_OLDEST_VERSION, FRAME_VERSION,
                      "version of this schema"),
     .beyond = "; a newer glint reads it"},
    {NAME(struct frame, scene, "unique in a set: source, ego, variant")},
    {FIELD_INTEGER_IN(struct frame, frame, 0, 9007199254740991, "number in the scene, from 0")},
    {FIELD_REAL_IN(struct frame, time_s, -1e10, 1e10,
                   "end of the interval that the frame stands for")},
    {FIELD_REAL_IN(struct frame, interval_s, 1e-9, 1e6,
                   "the frame stands for (time_s - interval_s, time_s]")},
    {OPTIONAL_FLAG(struct frame, last, "is this the scene's last frame?")},
    {FIELD_SEED_OF(struct frame, seed, "seed of all random numbers, 64 bits, decimal")},
    {NAME(struct frame, ego, "id of the object that carries the sensors")},
    {OPTIONAL_REAL(struct frame, origin_x_m, -1e9, 1e9,
                   "origin of the frame's coordinates in those of the source")},
    {OPTIONAL_REAL(struct frame, origin_y_m, -1e9, 1e9,
                   "origin of the frame's coordinates in those of the source")},
    {FIELD_SET_OF(struct frame, sections, sections_names,
                  "what it carries by choice, now or once it is made; absent: objects"),
     FIELD_OPTIONAL, .absent = CARRY_BY_DEFAULT},
    {OPTIONAL_RECORD(struct frame, conditions, &conditions_record,
                     "road, weather and other radars")},
    {OPTIONAL_LIST(struct frame, roadside, &roadside_strip_record,
                   "what stands still beside the road and is no object"),
     FIELD_STEADY},
    {FIELD_LIST_OF(struct frame, objects, &object_record, "objects, the ego among them: truth"),
     PART(PART_OBJECTS)},
    {FIELD_LIST_OF(struct frame, vehicles, &class_document_record,
                   "documents that described the classes of the objects, by class"),
     PART(PART_VEHICLES), FIELD_STEADY},
    {FIELD_LIST_OF(struct frame, reflectors, &reflector_set_record, "reflector sets by model"),
     PART(PART_REFLECTORS)},
    {FIELD_RECORD_OF(struct frame, sensors, &sensors_record, "suite of sensors"),
     PART(PART_SENSORS)},
    {FIELD_LIST_OF(struct frame, echoes, &echo_record,
                   "ideal echoes by sensor, object, reflector, path"),
     PART(PART_ECHOES)},
    {FIELD_LIST_OF(struct frame, cells, &cell_record, "resolution cells by sensor and leader"),
     PART(PART_CELLS)},
    {FIELD_LIST_OF(struct frame, targets, &target_record,
                   "target lists by sensor, each in its sensor's order"),
     PART(PART_TARGETS)},
    {FIELD_LIST_OF(struct frame, lost, &lost_group_record, "lost echoes by sensor, stage, reason"),
     PART(PART_LOST)},
    {FIELD_LIST_OF(struct frame, counts, &count_record, "what there is to account for, by sensor"),
     PART(PART_COUNTS)},
    {FIELD_LIST_OF(struct frame, visibility, &sighting_record,
                   "how much a sensor sees of each object, by sensor and object"),
     PART(PART_VISIBILITY)},
    {EXTRA(struct frame)},
    {0},
};

const struct record frame_record = {
    FIELD_TABLE(struct frame, frame_fields, "frame",
                "All that is known about one scene in one interval of time."),
    .present_offset = offsetof(struct frame, present),
    .document_offset = offsetof(struct frame, document),
    .line_offset = offsetof(struct frame, line)};

static int read(const char *line, size_t length, struct frame *frame, struct diag *diag)
{
    return record_read(line, length, &frame_record, frame, frame->arena, frame->list_cache, diag);
}

int frame_text_read(const char *line, size_t length, struct frame *frame, struct diag *diag)
{
    frame_clear(frame);
    return read(line, length, frame, diag);
}

int frame_text_take(const char *line, size_t length, unsigned unread, struct frame *frame,
                    struct diag *diag)
{
    frame_clear(frame);
    size_t members = sizeof frame_fields / sizeof *frame_fields;
    frame->line.texts = arena_get(frame->arena, members * sizeof *frame->line.texts);
    frame->line.same = ~0U;
    frame->line.unread = unread;
    int result = read(line, length, frame, diag);
    frame->line.unread &= frame->present;
    return result;
}

int frame_text_read_left(struct frame *frame, unsigned parts, struct diag *diag)
{
    return record_read_left(&frame_record, parts, frame, frame->arena, frame->list_cache, diag);
}

int frame_text_write(const struct frame *frame, struct text *text, struct diag *diag)
{
    size_t begin = text->length;
    record_write(&frame_record, frame, frame->list_cache, text);
    size_t length = text->length - begin;
    if (length > FRAME_TEXT_SIZE) {
        text->length = begin;
        return diag_fail(diag, DIAG_DATA, "a line of %zu bytes; at most %d are allowed", length,
                         FRAME_TEXT_SIZE);
    }
    return 0;
}
