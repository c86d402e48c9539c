#include "export/foxglove.h"
/* needs: libprotobuf-c */
#include "base/number.h"
#include "geometry/kinematics.h"

/* Appends a pattern, with the next number for #, the next word as a JSON string for @, and a
 * quotation mark for '. */
static void fill(struct text *text, const char *pattern, const double *numbers,
                 const char *const *words)
{
    for (; *pattern != '\0'; pattern++)
        if (*pattern == '#')
            text->length += number_write(*numbers++ + 0.0, text_room(text, NUMBER_SIZE));
        else if (*pattern == '@')
            text_add_json(text, *words, strlen(*words)), words++;
        else
            text_add(text, *pattern == '\'' ? "\"" : pattern, 1);
}

#define NUMBERS(...) ((const double[]){__VA_ARGS__})
#define WORDS(...) ((const char *const[]){__VA_ARGS__})
#define TIME(time_ns) (double)((time_ns) / 1000000000), (double)((time_ns) % 1000000000)
#define POSE(x, y, z, yaw) (x), (y), (z), elementary_sin((yaw) / 2), elementary_cos((yaw) / 2)
#define A_TIME "{'sec':#,'nsec':#}"
#define A_POSE "{'position':{'x':#,'y':#,'z':#},'orientation':{'x':0,'y':0,'z':#,'w':#}}"
#define A_TEXT                                                                                     \
    "{'pose':" A_POSE ",'billboard':true,'font_size':12,'scale_invariant':true,"                   \
    "'color':{'r':1,'g':1,'b':1,'a':1},'text':@}"
/* To its list of texts; with its time, id, metadata and cubes. */
#define AN_ENTITY(metadata, cubes)                                                                 \
    "{'timestamp':" A_TIME ",'frame_id':'world','lifetime':{'sec':0,'nsec':0},"                    \
    "'frame_locked':false,'arrows':[],'spheres':[],'cylinders':[],'lines':[],'triangles':[],"      \
    "'models':[],'id':@,'metadata':[" metadata "],'cubes':[" cubes "],'texts':["

static struct sensor_pose pose_of(const struct frame *frame, const struct sensor_view *sensor)
{
    struct motion ego = frame_motion(frame_object(frame, frame->ego), sensor->age_s);
    return kinematics_sensor_pose(&ego, sensor->mount_x_m, sensor->mount_y_m,
                                  sensor->mount_yaw_rad);
}

/* The place of a target from its sensor. */
static struct vec2 place_of(const struct target *target)
{
    return vec2_scale(target->range_m, vec2_heading(target->azimuth_rad));
}

/* ---- points: floats and whole numbers of four bytes, by foxglove_columns ---- */

enum { REALS = 9, COLUMNS = 12, POINT_SIZE = 4 * COLUMNS };

/* Types 7 and 5. */
static const char columns[] =
    "[{'name':'x','offset':0,'type':7},{'name':'y','offset':4,'type':7},"
    "{'name':'z','offset':8,'type':7},{'name':'range_m','offset':12,'type':7},"
    "{'name':'azimuth_rad','offset':16,'type':7},{'name':'range_rate_mps','offset':20,'type':7},"
    "{'name':'range_rate_over_ground_mps','offset':24,'type':7},"
    "{'name':'amplitude_db','offset':28,'type':7},{'name':'rcs_dbsm','offset':32,'type':7},"
    "{'name':'object','offset':36,'type':5},{'name':'path','offset':40,'type':5},"
    "{'name':'contributors','offset':44,'type':5}]";

static void put_point(struct foxglove *own, const struct frame *frame, const struct target *target,
                      unsigned char *bytes)
{
    const struct contributor *from = frame_strongest(target);
    const struct quality *quality = &target->quality;
    struct vec2 place_m = place_of(target);
    bool known = from != NULL && frame_object(frame, from->id.object) != NULL;
    const float reals[REALS] = {
        (float)place_m.x,
        (float)place_m.y,
        0,
        (float)target->range_m,
        (float)target->azimuth_rad,
        (float)target->range_rate_mps,
        (quality->present & QUALITY_EGO) != 0 ? (float)quality->range_rate_over_ground_mps : NAN,
        (float)target->amplitude_db,
        (quality->present & QUALITY_RCS) != 0 ? (float)quality->rcs_dbsm : NAN};
    uint32_t words[COLUMNS] = {
        [REALS] = known ? intern_word(&own->objects, from->id.object, own->arena) + 1 : 0,
        [REALS + 1] = from != NULL ? from->id.path : PATH_FALSE_ALARM,
        [REALS + 2] = (uint32_t)target->contributors.count};
    memcpy(words, reals, sizeof reals);
    for (int i = 0; i < POINT_SIZE; i++)
        bytes[i] = (unsigned char)(words[i / 4] >> i % 4 * 8);
}

void foxglove_add_points(struct foxglove *own, const struct frame *frame,
                         const struct sensor_view *sensor, uint64_t time_ns, struct text *text)
{
    struct sensor_pose pose = pose_of(frame, sensor);
    fill(text, "{'timestamp':" A_TIME ",'frame_id':'world','pose':" A_POSE ",'point_stride':#,",
         NUMBERS(TIME(time_ns), POSE(pose.position_m.x, pose.position_m.y, 0, pose.yaw_rad),
                 POINT_SIZE),
         NULL);
    fill(text, "'fields':", NULL, NULL);
    fill(text, columns, NULL, NULL);
    fill(text, ",'data':'", NULL, NULL);
    for (size_t i = 0; i < frame->targets.count; i++) {
        unsigned char bytes[POINT_SIZE];
        if (!frame_same_name(frame->targets.items[i].sensor, sensor->name))
            continue;
        put_point(own, frame, &frame->targets.items[i], bytes);
        text_add_base64(text, bytes, POINT_SIZE);
    }
    fill(text, "'}", NULL, NULL);
}

/* ---- boxes and labels ---- */

static void add_box(struct foxglove *own, const struct frame *frame, const struct object *object,
                    uint64_t time_ns, struct text *text)
{
    char number[NUMBER_SIZE] = {0};
    number_write_whole(intern_word(&own->objects, object->id, own->arena) + 1, number);
    fill(text,
         AN_ENTITY("{'key':'object','value':@},{'key':'class','value':@}",
                   "{'pose':" A_POSE ",'size':{'x':#,'y':#,'z':#},"
                   "'color':{'r':0.3,'g':0.6,'b':1,'a':0.4}}") A_TEXT "]},",
         NUMBERS(TIME(time_ns),
                 POSE(object->x_m, object->y_m, object->height_m / 2, object->yaw_rad),
                 object->length_m, object->width_m, object->height_m,
                 POSE(object->x_m, object->y_m, object->height_m + 0.5, 0)),
         WORDS(object->id, number, object->class,
               arena_format(frame->arena, "%s (%s)", object->id, object->class)));
}

/* "slow_1 corner_rl direct +2": the strongest contributor, and how many there are besides. */
static void add_label(const struct frame *frame, const struct target *target, struct text *text)
{
    const struct contributor *from = frame_strongest(target);
    struct sensor_pose pose = pose_of(frame, frame_view(frame, target->sensor));
    struct vec2 place_m = vec2_add(pose.position_m, vec2_turn(place_of(target), pose.boresight));
    const char *label = "", *more = "";
    if (from != NULL)
        label = arena_format(frame->arena, "%s %s %s", from->id.object, from->id.reflector,
                             frame_paths[from->id.path]);
    if (target->contributors.count > 1)
        more = arena_format(frame->arena, " +%zu", target->contributors.count - 1);
    fill(text, A_TEXT, NUMBERS(POSE(place_m.x, place_m.y, 0, 0)),
         WORDS(arena_format(frame->arena, "%s%s", label, more)));
}

/* Every update replaces all that stood there. */
void foxglove_add_scene(struct foxglove *own, const struct frame *frame, uint64_t time_ns,
                        struct text *text)
{
    fill(text, "{'deletions':[{'timestamp':" A_TIME ",'type':1,'id':''}],'entities':[",
         NUMBERS(TIME(time_ns)), NULL);
    for (size_t i = 0; i < frame->objects.count; i++)
        add_box(own, frame, &frame->objects.items[i], time_ns, text);
    fill(text, AN_ENTITY("", ""), NUMBERS(TIME(time_ns)), WORDS(""));
    for (size_t i = 0; i < frame->targets.count; i++) {
        text_add(text, ",", i > 0);
        add_label(frame, &frame->targets.items[i], text);
    }
    fill(text, "]}]}", NULL, NULL);
}
