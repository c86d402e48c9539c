#include "foxglove.h"
#include "base/number.h"
#include "geometry/kinematics.h"
#include "scan_point.h"

#define TIME(ns) (double)(uint64_t)((ns) / TRACE_SECOND_NS), (double)((ns) % TRACE_SECOND_NS)
#define TURN(yaw_rad) elementary_sin((yaw_rad) / 2), elementary_cos((yaw_rad) / 2)

/* Appends a pattern with these numbers and words. */
static void fill(struct text *text, const char *pattern, const double *numbers,
                 const char *const *words)
{
    for (; *pattern != '\0'; pattern++)
        if (*pattern == '#')
            text->length += number_write(*numbers++, text_room(text, NUMBER_SIZE));
        else if (*pattern == '%')
            text->length += number_write_whole((uint64_t)*numbers++, text_room(text, NUMBER_SIZE));
        else if (*pattern == '@')
            text_add_json(text, *words, strlen(*words)), words++;
        else
            text_add(text, pattern, 1);
}

/* Floats, and then whole numbers, of four bytes each: a multiple of three bytes. */
enum { REALS = 9, COLUMNS = 12, POINT_SIZE = 4 * COLUMNS };

static void add_point(struct trace *trace, const struct target *target, struct text *base64)
{
    struct scan_point point = scan_point_of(trace, target);
    const struct quality *quality = &target->quality;
    bool over_ground = (quality->present & QUALITY_EGO) != 0;
    const float reals[REALS] = {(float)point.place_m.x,
                                (float)point.place_m.y,
                                (float)point.up_m,
                                (float)target->range_m,
                                (float)target->azimuth_rad,
                                (float)target->range_rate_mps,
                                over_ground ? (float)quality->range_rate_over_ground_mps : NAN,
                                (float)target->amplitude_db,
                                quality->present & QUALITY_RCS ? (float)quality->rcs_dbsm : NAN};
    uint32_t words[COLUMNS] = {[REALS] = point.object, point.path, point.contributors};
    unsigned char bytes[POINT_SIZE];
    memcpy(words, reals, sizeof reals);
    for (int i = 0; i < POINT_SIZE; i++)
        bytes[i] = (unsigned char)(words[i / 4] >> i % 4 * 8);
    text_add_base64(base64, bytes, POINT_SIZE);
}

void foxglove_add_points(struct trace *trace, const struct sensor_view *sensor, struct text *text)
{
    const struct frame *frame = trace->frame;
    uint64_t time_ns = trace_ns(trace, frame->time_s - sensor->age_s);
    struct motion ego = frame_motion(frame_object(frame, frame->ego), sensor->age_s);
    struct sensor_pose pose =
        kinematics_sensor_pose(&ego, sensor->mount_x_m, sensor->mount_y_m, sensor->mount_yaw_rad);
    struct text base64 = {0};
    for (size_t i = 0; i < frame->targets.count; i++)
        if (frame_same_name(frame->targets.items[i].sensor, sensor->name))
            add_point(trace, &frame->targets.items[i], &base64);
    text_add(&base64, "", 1);
    fill(text, foxglove_points,
         (double[]){TIME(time_ns), pose.position_m.x, pose.position_m.y, sensor->mount_z_m,
                    TURN(pose.yaw_rad)},
         (const char *[]){base64.bytes});
    text_free(&base64);
}

/* Every update replaces all entities. */
void foxglove_add_scene(struct trace *trace, struct text *text)
{
    const struct frame *frame = trace->frame;
    const double above_m = 0.5;
    fill(text, "{\"deletions\":[{\"timestamp\":{\"sec\":%,\"nsec\":%},\"type\":1,\"id\":\"\"}],",
         (double[]){TIME(trace->time_ns)}, NULL);
    text_add_word(text, "\"entities\":[");
    for (size_t i = 0; i < frame->objects.count; i++) {
        const struct object *object = &frame->objects.items[i];
        const char *label = arena_format(frame->arena, "%s (%s)", object->id, object->class);
        text_add(text, ",", i > 0);
        fill(text, foxglove_entity,
             (double[]){TIME(trace->time_ns), trace_object(trace, object->id), object->x_m,
                        object->y_m, object->height_m / 2, TURN(object->yaw_rad), object->length_m,
                        object->width_m, object->height_m, object->x_m, object->y_m,
                        object->height_m + above_m},
             (const char *[]){object->id, object->class, label});
    }
    text_add_word(text, "]}");
}
