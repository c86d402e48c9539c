#include "view/view_frame.h"

#include <assert.h>

struct motion view_frame_ego(const struct frame *frame, double age_s)
{
    const struct object *ego = frame_object(frame, frame->ego);
    return ego != NULL ? frame_motion(ego, age_s)
                       : (struct motion){.velocity_mps = {(double)NAN, (double)NAN}};
}

struct view_scan view_frame_scan(const struct frame *frame, const struct sensor_view *sensor)
{
    struct view_scan scan = {.age_s = sensor->age_s};
    struct motion ego = view_frame_ego(frame, scan.age_s);
    scan.pose =
        kinematics_sensor_pose(&ego, sensor->mount_x_m, sensor->mount_y_m, sensor->mount_yaw_rad);
    return scan;
}

struct vec2 view_frame_place(const struct view_scan *scan, double range_m, double azimuth_rad)
{
    struct vec2 heading = vec2_heading(scan->pose.yaw_rad + azimuth_rad);
    return vec2_add(scan->pose.position_m, vec2_scale(range_m, heading));
}

struct box view_frame_box(const struct object *object, const struct vehicle *vehicle)
{
    struct box box = {frame_motion(object, 0), vec2_heading(object->yaw_rad), object->length_m,
                      object->width_m};
    if (box.length_m == 0 && vehicle != NULL)
        box.length_m = vehicle->length_m;
    if (box.width_m == 0 && vehicle != NULL)
        box.width_m = vehicle->width_m;
    return box;
}

bool view_frame_loss_is_notable(enum loss reason)
{
    return reason != LOSS_FACING_AWAY && reason != LOSS_NO_SPECULAR &&
           reason != LOSS_OUT_OF_RANGE && reason != LOSS_OUT_OF_VIEW && reason != LOSS_SWITCHED_OFF;
}

static bool is_asked_for(const struct view_model *model, const char *class, const char *digest)
{
    return strcmp(model->class, class) == 0 && (digest == NULL || model->vehicle == NULL ||
                                                strcmp(model->vehicle->digest, digest) == 0);
}

const struct vehicle *view_frame_vehicle(struct view_models *models, const char *class,
                                         const char *digest)
{
    assert(models->arena != NULL);
    for (size_t i = 0; i < models->list.count; i++)
        if (is_asked_for(&models->list.items[i], class, digest))
            return models->list.items[i].vehicle;
    struct diag unused = {0};
    struct view_model *model = list_add(&models->list, models->arena);
    model->class = arena_text(models->arena, class, strlen(class));
    model->vehicle = vehicle_set_load(class, digest, models->folder, models->arena, &unused);
    return model->vehicle;
}

int view_frame_check_vehicles(struct view_models *models, const struct frame *frame,
                              struct diag *diag)
{
    for (size_t i = 0; i < frame->vehicles.count; i++) {
        const struct class_document *used = &frame->vehicles.items[i];
        const struct vehicle *vehicle = view_frame_vehicle(models, used->class, used->digest);
        if (vehicle != NULL && vehicle_check_frame(vehicle, frame, diag) != 0)
            return -1;
    }
    return 0;
}
