#include "osi_trace.h"
#include "base/elementary.h"
#include "base/number.h"
#include "osi_trace.pb-c.h"
#include "scan_point.h"

#define SET(message, member, value) ((message)->has_##member = 1, (message)->member = (value))
#define NEW(trace, message) new_message(trace, &osi3__##message##__descriptor)
#define LIST(trace, list, count)                                                                   \
    ((list) = arena_get((trace)->frame->arena, (count) * sizeof *(list)))
#define NUMBERS(trace, message, ...)                                                               \
    numbers(trace, &osi3__##message##__descriptor, (const double[]){__VA_ARGS__},                  \
            sizeof((double[]){__VA_ARGS__}) / sizeof(double))

static void *new_message(struct trace *trace, const ProtobufCMessageDescriptor *descriptor)
{
    void *message = arena_get(trace->frame->arena, descriptor->sizeof_message);
    protobuf_c_message_init(descriptor, message);
    return message;
}

/* A message with these values of its first fields, which are numbers. */
static void *numbers(struct trace *trace, const ProtobufCMessageDescriptor *descriptor,
                     const double *values, size_t count)
{
    char *message = new_message(trace, descriptor);
    for (size_t i = 0; i < count; i++) {
        const ProtobufCFieldDescriptor *field = &descriptor->fields[i];
        char *at = message + field->offset;
        memcpy(message + field->quantifier_offset, &(protobuf_c_boolean){1}, sizeof(int));
        if (field->type == PROTOBUF_C_TYPE_DOUBLE)
            memcpy(at, &values[i], sizeof(double));
        else if (field->type == PROTOBUF_C_TYPE_UINT64 || field->type == PROTOBUF_C_TYPE_INT64)
            memcpy(at, &(uint64_t){(uint64_t)values[i]}, 8);
        else
            memcpy(at, &(uint32_t){(uint32_t)values[i]}, sizeof(uint32_t));
    }
    return message;
}

static Osi3__InterfaceVersion *version(struct trace *trace)
{
    return NUMBERS(trace, interface_version, 3, 8, 0);
}

static Osi3__Timestamp *stamp(struct trace *trace, double time_s)
{
    uint64_t time_ns = trace_ns(trace, time_s), whole_s = time_ns / TRACE_SECOND_NS;
    return NUMBERS(trace, timestamp, (double)whole_s, (double)(time_ns % TRACE_SECOND_NS));
}

static Osi3__Identifier *object_id(struct trace *trace, const char *id)
{
    enum { MOST_DIGITS = 15 };
    uint64_t named = OSI_TRACE_NAMED + trace_object(trace, id) - 1;
    size_t digits = strspn(id, "0123456789");
    bool zeros = id[0] == '0' && digits > 1;
    double number = (double)named;
    if (id[digits] == '\0' && digits <= MOST_DIGITS && !zeros)
        number_read(id, id + digits, &number);
    return NUMBERS(trace, identifier, number);
}

/* The origin of the vehicle: the middle of its rear axle, on the road. */
static Osi3__MountingPosition *at_origin(struct trace *trace)
{
    Osi3__MountingPosition *mounting = NEW(trace, mounting_position);
    mounting->position = NUMBERS(trace, vector3d, 0, 0, 0);
    mounting->orientation = NUMBERS(trace, orientation3d, 0, 0, 0);
    return mounting;
}

static Osi3__MountingPosition *mount_of(struct trace *trace, const struct sensor_view *sensor)
{
    const struct frame *frame = trace->frame;
    double axle_x_m = frame_rear_axle_x_m(frame, frame_object(frame, frame->ego));
    Osi3__MountingPosition *mounting = NEW(trace, mounting_position);
    mounting->position = NUMBERS(trace, vector3d, sensor->mount_x_m - axle_x_m, sensor->mount_y_m);
    if (sensor->mount_z_m != 0)
        SET(mounting->position, z, sensor->mount_z_m);
    mounting->orientation = NUMBERS(trace, orientation3d, 0, 0, sensor->mount_yaw_rad);
    return mounting;
}

/* ---- the truth ---- */

enum object_kind { MOVING, VEHICLE, STATIONARY };

enum { TYPE_OTHER = 1, TYPE_VEHICLE = 2, TYPE_PEDESTRIAN = 3 };

struct type {
    enum object_kind kind;
    int32_t number;
    const char *class;
};

static bool is_host(const struct trace *trace, const struct object *object)
{
    return frame_same_name(object->id, trace->frame->ego);
}

/* A host is a moving object, even if it is a post beside the road. */
static struct type type_of(const struct trace *trace, const struct object *object)
{
    static const struct type types[] = {
#define OSI_FIRST(kind, number, word, class) {kind, number, class},
#include "osi_classes.def"
        {VEHICLE, TYPE_OTHER, "articulated_truck"},
    };
    bool moves = is_host(trace, object) || object->vx_mps != 0 || object->vy_mps != 0 ||
                 object->yaw_rate_radps != 0;
    for (size_t i = 0; i < sizeof types / sizeof *types; i++)
        if (strcmp(types[i].class, object->class) == 0 && !(moves && types[i].kind == STATIONARY))
            return types[i];
    return (struct type){MOVING, TYPE_OTHER, object->class};
}

/* The id and the class as texts, for which OSI has no other field. */
static Osi3__ExternalReference *source(struct trace *trace, const struct object *object)
{
    Osi3__ExternalReference *source = NEW(trace, external_reference);
    source->type = (char *)"glint.object";
    source->n_identifier = 2;
    LIST(trace, source->identifier, 2);
    source->identifier[0] = (char *)object->id;
    source->identifier[1] = (char *)object->class;
    return source;
}

/* The box stands on the plane z = 0. */
static Osi3__Base *body(struct trace *trace, const struct object *object)
{
    const struct frame *frame = trace->frame;
    Osi3__Base *base = NEW(trace, base);
    base->dimension =
        NUMBERS(trace, dimension3d, object->length_m, object->width_m, object->height_m);
    base->position = NUMBERS(trace, vector3d, frame->origin_x_m + object->x_m,
                             frame->origin_y_m + object->y_m, object->height_m / 2);
    base->orientation = NUMBERS(trace, orientation3d, 0, 0, object->yaw_rad);
    return base;
}

static void add_stationary(struct trace *trace, const struct object *object, int32_t type,
                           Osi3__GroundTruth *truth)
{
    Osi3__StationaryObject *own = NEW(trace, stationary_object);
    own->id = object_id(trace, object->id);
    own->body = body(trace, object);
    own->classification = NUMBERS(trace, stationary_object__classification, type);
    own->n_source_reference = 1;
    *LIST(trace, own->source_reference, 1) = source(trace, object);
    truth->stationary_object[truth->n_stationary_object++] = own;
}

static void add_moving(struct trace *trace, const struct object *object, struct type type,
                       Osi3__GroundTruth *truth)
{
    Osi3__MovingObject *own = NEW(trace, moving_object);
    own->id = object_id(trace, object->id);
    own->body = body(trace, object);
    own->body->velocity = NUMBERS(trace, vector3d, object->vx_mps, object->vy_mps, 0);
    own->body->orientation_rate = NUMBERS(trace, orientation3d, 0, 0, object->yaw_rate_radps);
    own->n_source_reference = 1;
    *LIST(trace, own->source_reference, 1) = source(trace, object);
    SET(own, type, type.kind == VEHICLE ? TYPE_VEHICLE : type.number);
    if (own->type == TYPE_PEDESTRIAN)
        own->pedestrian_attributes = NEW(trace, moving_object__pedestrian_attributes);
    if (type.kind == VEHICLE)
        own->vehicle_classification =
            NUMBERS(trace, moving_object__vehicle_classification, type.number);
    if (type.kind == VEHICLE || is_host(trace, object)) {
        double axle_x_m = frame_rear_axle_x_m(trace->frame, object);
        own->vehicle_attributes = NEW(trace, moving_object__vehicle_attributes);
        own->vehicle_attributes->bbcenter_to_rear =
            NUMBERS(trace, vector3d, axle_x_m, 0, -object->height_m / 2);
    }
    truth->moving_object[truth->n_moving_object++] = own;
}

static Osi3__GroundTruth *ground_truth(struct trace *trace)
{
    const struct frame *frame = trace->frame;
    Osi3__GroundTruth *truth = NEW(trace, ground_truth);
    truth->version = version(trace);
    truth->timestamp = stamp(trace, frame->time_s);
    truth->host_vehicle_id = object_id(trace, frame->ego);
    LIST(trace, truth->moving_object, frame->objects.count);
    LIST(trace, truth->stationary_object, frame->objects.count);
    for (size_t i = 0; i < frame->objects.count; i++) {
        struct type type = type_of(trace, &frame->objects.items[i]);
        if (type.kind == STATIONARY)
            add_stationary(trace, &frame->objects.items[i], type.number, truth);
        else
            add_moving(trace, &frame->objects.items[i], type, truth);
    }
    return truth;
}

/* The view of all sensors together, whose frame is that of the vehicle. */
static Osi3__SensorView *sensor_view(struct trace *trace)
{
    Osi3__SensorView *view = NEW(trace, sensor_view);
    view->global_ground_truth = ground_truth(trace);
    view->version = view->global_ground_truth->version;
    view->timestamp = view->global_ground_truth->timestamp;
    view->host_vehicle_id = view->global_ground_truth->host_vehicle_id;
    view->sensor_id = NUMBERS(trace, identifier, 0);
    view->mounting_position = at_origin(trace);
    return view;
}

/* ---- detections ---- */

#define CLASS(name) OSI3__DETECTION_CLASSIFICATION__DETECTION_CLASSIFICATION_##name

/* By the label: noise, the ground, a ghost, or what stands or moves there. */
static Osi3__DetectionClassification class_of(const struct contributor *from)
{
    if (from == NULL || from->id.path == PATH_FALSE_ALARM)
        return CLASS(CLUTTER);
    if (from->id.path == PATH_CLUTTER)
        return frame_same_name(from->id.object, "roadside") ? CLASS(OTHER) : CLASS(OVERDRIVABLE);
    return frame_shows_object(from->id.path) ? CLASS(OTHER) : CLASS(INVALID);
}

/* The radial velocity of OSI is positive towards the sensor. Its elevation is a turn about the axis
 * to the left, by the right-hand rule: positive is down. A range rate that may be folded has an
 * ambiguity of its own, as its alternatives are in no list. */
static Osi3__RadarDetection *detection_of(struct trace *trace, const struct target *target,
                                          double number)
{
    const struct quality *quality = &target->quality;
    Osi3__RadarDetection *own = NEW(trace, radar_detection);
    own->position = NUMBERS(trace, spherical3d, target->range_m, scan_point_azimuth_rad(target));
    if ((target->present & VALUE_ELEVATION) != 0)
        SET(own->position, elevation, 0 - target->elevation_rad);
    SET(own, radial_velocity, 0 - target->range_rate_mps);
    own->ambiguity_id =
        NUMBERS(trace, identifier, (quality->present & QUALITY_FOLDS) != 0 ? number : 0);
    SET(own, classification, class_of(frame_strongest(target)));
    if ((quality->present & QUALITY_NOISE) != 0) {
        SET(own, existence_probability, quality->existence);
        SET(own, snr, quality->snr_db);
    }
    if ((quality->present & QUALITY_RCS) != 0)
        SET(own, rcs, quality->rcs_dbsm);
    if ((quality->present & QUALITY_ERRORS) != 0) {
        own->position_rmse =
            NUMBERS(trace, spherical3d, quality->range_sd_m, quality->azimuth_sd_rad);
        if ((quality->present & QUALITY_ELEVATION) != 0)
            SET(own->position_rmse, elevation, quality->elevation_sd_rad);
        SET(own, radial_velocity_rmse, quality->range_rate_sd_mps);
    }
    return own;
}

/* A frame's line has room for fewer targets than a count of 32 bits. */
static Osi3__RadarDetectionData *radar_of(struct trace *trace, const struct sensor_view *sensor)
{
    const struct frame *frame = trace->frame;
    Osi3__RadarDetectionData *own = NEW(trace, radar_detection_data);
    Osi3__SensorDetectionHeader *header = own->header = NEW(trace, sensor_detection_header);
    header->measurement_time = stamp(trace, frame->time_s - sensor->age_s);
    SET(header, cycle_counter, (uint64_t)frame->frame);
    header->mounting_position = mount_of(trace, sensor);
    SET(header, data_qualifier,
        OSI3__SENSOR_DETECTION_HEADER__DATA_QUALIFIER__DATA_QUALIFIER_AVAILABLE);
    SET(header, number_of_valid_detections, 0);
    header->sensor_id =
        NUMBERS(trace, identifier, (double)(sensor - frame->sensors.list.items) + 1);
    LIST(trace, own->detection, frame->targets.count);
    for (size_t i = 0; i < frame->targets.count; i++) {
        const struct target *target = &frame->targets.items[i];
        if (!frame_same_name(target->sensor, sensor->name))
            continue;
        own->detection[own->n_detection] =
            detection_of(trace, target, (double)own->n_detection + 1);
        header->number_of_valid_detections +=
            own->detection[own->n_detection++]->classification != CLASS(INVALID);
    }
    return own;
}

static Osi3__SensorData *sensor_data(struct trace *trace)
{
    const struct frame *frame = trace->frame;
    double youngest_s = (double)INFINITY;
    Osi3__SensorData *own = NEW(trace, sensor_data);
    Osi3__FeatureData *features = own->feature_data = NEW(trace, feature_data);
    own->version = features->version = version(trace);
    own->timestamp = stamp(trace, frame->time_s);
    own->sensor_id = NUMBERS(trace, identifier, 0);
    own->mounting_position = at_origin(trace);
    own->n_sensor_view = 1;
    *LIST(trace, own->sensor_view, 1) = sensor_view(trace);
    LIST(trace, features->radar_sensor, frame->sensors.list.count);
    for (size_t i = 0; i < frame->sensors.list.count; i++) {
        const struct sensor_view *sensor = &frame->sensors.list.items[i];
        if (!sensor->measured)
            continue;
        features->radar_sensor[features->n_radar_sensor++] = radar_of(trace, sensor);
        youngest_s = elementary_min(youngest_s, sensor->age_s);
    }
    if (features->n_radar_sensor > 0)
        own->last_measurement_time = stamp(trace, frame->time_s - youngest_s);
    return own;
}

void osi_trace_add(struct trace *trace, struct text *text)
{
    const Osi3__SensorData *data = sensor_data(trace);
    char *room = text_room(text, osi3__sensor_data__get_packed_size(data));
    text->length += osi3__sensor_data__pack(data, (uint8_t *)room);
}
