#include "mcap_ros.h"
#include "ros.h"

enum { TRANSFORMS = 1, OBJECTS, FIXED_COUNT = OBJECTS }; /* channels that are of no sensor */

static struct mcap_schema schema_of(const char *name, const char *definition)
{
    /* rosbag2 plays topics with its default quality of service. */
    static const char *const metadata[] = {"offered_qos_profiles", "", NULL};
    return (struct mcap_schema){name, "ros2msg", "cdr", definition, strlen(definition), metadata};
}

void mcap_ros_begin(struct mcap_log *log)
{
    struct mcap_schema transforms = schema_of("tf2_msgs/msg/TFMessage", ros_transforms);
    struct mcap_schema markers = schema_of("visualization_msgs/msg/MarkerArray", ros_markers);
    log->trace.begin_s = ROS_BEGIN_S;
    log->trace.end_s = ROS_END_S;
    mcap_file_begin(&log->file, "ros2");
    mcap_file_add_channel(&log->file, "/tf", &transforms);
    mcap_file_add_channel(&log->file, "/objects", &markers);
}

/* Notes a time. Returns false if it was noted before: tf2 complains of a stamp that comes twice. */
static bool note_time(struct mcap_ros_times *sent, uint64_t time_ns)
{
    for (size_t i = 0; i < MCAP_ROS_RECENT && i < sent->count; i++)
        if (sent->ns[i] == time_ns)
            return false;
    sent->ns[sent->count++ % MCAP_ROS_RECENT] = time_ns;
    return true;
}

static void add_transforms(struct mcap_log *log, struct mcap_ros_times *sent, double age_s)
{
    if (!note_time(sent, trace_ns(&log->trace, log->trace.frame->time_s - age_s)))
        return;
    ros_add_transforms(&log->trace, age_s, &log->message);
    mcap_log_add_message(log, TRANSFORMS);
}

static int check_names(const struct frame *frame, struct diag *diag)
{
    for (size_t i = 0; i < frame->sensors.list.count; i++) {
        const struct sensor_view *sensor = &frame->sensors.list.items[i];
        if (sensor->measured && !ros_takes_name(sensor->name))
            return diag_fail(
                diag, DIAG_DATA,
                "sensors: \"%s\" is no name in ROS 2; expected at most 200 letters, digits "
                "and _, no digit first",
                sensor->name);
    }
    return 0;
}

/* Transforms come before the points and boxes that need them. */
int mcap_ros_add(struct mcap_log *log, struct mcap_ros_times *sent, struct diag *diag)
{
    const struct frame *frame = log->trace.frame;
    if (check_names(frame, diag) != 0)
        return -1;
    for (size_t i = 0; i < frame->sensors.list.count; i++)
        if (frame->sensors.list.items[i].measured)
            add_transforms(log, sent, frame->sensors.list.items[i].age_s);
    add_transforms(log, sent, 0);
    ros_add_boxes(&log->trace, &log->message);
    mcap_log_add_message(log, OBJECTS);
    struct mcap_schema points = schema_of("sensor_msgs/msg/PointCloud2", ros_point_cloud);
    return mcap_log_add_points(log, FIXED_COUNT, &points, ros_add_points, diag);
}
