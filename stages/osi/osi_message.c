#include "osi_message.h"
#include <stdbool.h>

#include "osi_message.pb-c.h"

static void *arena_give(void *arena, size_t size)
{
    return arena_room(arena, size);
}

static void leave_to_arena(void *arena, void *memory)
{
    (void)arena;
    (void)memory;
}

/* True of a ground truth, but not of the other messages that a GroundTruth and a SensorView have in
 * its place. */
static bool is_truth(const Osi3__GroundTruth *truth)
{
    return truth != NULL && (truth->timestamp != NULL || truth->n_moving_object > 0);
}

/* Fields of SensorData and SensorView, from feature_data on, which a GroundTruth does not have. */
static bool has_foreign_fields(const Osi3__GroundTruth *truth)
{
    enum { FEATURE_DATA = 26 };
    for (unsigned i = 0; i < truth->base.n_unknown_fields; i++)
        if (truth->base.unknown_fields[i].tag >= FEATURE_DATA)
            return true;
    return false;
}

static struct osi_message of_view(const Osi3__SensorView *view)
{
    struct osi_message message = {0};
    if (view == NULL || !is_truth(view->global_ground_truth))
        return message;
    message.truth = view->global_ground_truth;
    message.host = view->host_vehicle_id;
    message.time = message.truth->timestamp;
    if (message.host == NULL)
        message.host = message.truth->host_vehicle_id;
    if (message.time == NULL)
        message.time = view->timestamp;
    return message;
}

static struct osi_message of_data(const Osi3__SensorDataViews *data)
{
    struct osi_message message = {0};
    if (data == NULL)
        return message;
    for (size_t i = 0; message.truth == NULL && i < data->n_sensor_view; i++)
        message = of_view(data->sensor_view[i]);
    if (message.truth != NULL && message.time == NULL)
        message.time = data->timestamp;
    return message;
}

static struct osi_message of_truth(const Osi3__GroundTruth *truth)
{
    if (truth == NULL || has_foreign_fields(truth))
        return (struct osi_message){0};
    return (struct osi_message){truth, truth->host_vehicle_id, truth->timestamp};
}

struct osi_message osi_message_unpack(const void *bytes, size_t length, struct arena *arena)
{
    ProtobufCAllocator allocator = {arena_give, leave_to_arena, arena};
    struct osi_message message =
        of_data(osi3__sensor_data_views__unpack(&allocator, length, bytes));
    if (message.truth == NULL)
        message = of_view(osi3__sensor_view__unpack(&allocator, length, bytes));
    if (message.truth == NULL)
        message = of_truth(osi3__ground_truth__unpack(&allocator, length, bytes));
    return message;
}
