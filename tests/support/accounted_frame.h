/* A frame of two sensors, "left" and "right", in which every echo is accounted for.
 *
 * Of each sensor's three direct pairs, two echoes are in its target (corner of b, rear of a) and
 * one is lost (corner of a). The objects are e, the ego, b and a, not in order. */
#pragma once

#include "frame/frame.h"

static inline struct contributor accounted_echo(const char *object, const char *reflector)
{
    return (struct contributor){.id.object = object, .id.reflector = reflector, .weight = 1};
}

static inline struct cell accounted_cell(struct arena *arena, const char *sensor, size_t count,
                                         const struct contributor *members)
{
    struct cell cell = {.sensor = sensor, .amplitude = 1};
    for (size_t i = 0; i < count; i++)
        *list_add(&cell.members, arena) = members[i];
    return cell;
}

static inline void accounted_sensor(struct frame *frame, const char *sensor)
{
    *list_add(&frame->sensors.list, frame->arena) = (struct sensor_view){.name = sensor};
    frame_count_pairs(frame, sensor, 3);
    frame_count_echoes(frame, sensor, PATH_DIRECT, 2);
    struct cell cell = accounted_cell(
        frame->arena, sensor, 2,
        (struct contributor[]){accounted_echo("b", "corner"), accounted_echo("a", "rear")});
    frame_add_target(frame, &cell, 3);
    frame_lose(frame, "ideal", sensor, LOSS_OUT_OF_VIEW,
               &(struct lost_echo){.id.object = "a", .id.reflector = "corner"});
}

static inline struct frame accounted_frame(struct arena *arena)
{
    struct frame frame = {.arena = arena};
    field_clear(&frame_record, &frame);
    frame.arena = arena;
    frame.scene = "s";
    frame.interval_s = 1;
    frame.ego = "e";
    frame.sections |= CARRY_ACCOUNT;
    static const char *const ids[] = {"e", "b", "a"};
    for (size_t i = 0; i < 3; i++)
        *list_add(&frame.objects, arena) = (struct object){.id = ids[i], .class = "car"};
    accounted_sensor(&frame, "right");
    accounted_sensor(&frame, "left");
    frame.sensors.suite = "pair";
    frame.sensors.digest = "0";
    frame.present = PART_OBJECTS | PART_SENSORS | PART_TARGETS | PART_LOST | PART_COUNTS;
    return frame;
}
