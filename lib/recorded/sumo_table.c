/* SUMO's floating car data as a table, in both spellings of its columns. Rows ascend in time. Steps
 * without anyone are not in a table. */
#include "base/units.h"
#include "recorded/recorded_table.h"
#include "recorded/sumo_types.h"

/* The place is the middle of the front bumper, the angle in degrees clockwise from north. The
 * speed serves where there is only one step: velocities are those of the places. */
#define COLUMNS(table, prefix, time)                                                               \
    static const struct recorded_column table[] = {                                                \
        RECORDED_ID(prefix "id"),                                                                  \
        RECORDED_TIME_IN(time, 1),                                                                 \
        RECORDED_CLASS(prefix "type", RECORDED_OPTIONAL),                                          \
        RECORDED_VALUE(prefix "x", x_m, RECORDED_NEEDED, -1e9, 1e9, 1, 0),                         \
        RECORDED_VALUE(prefix "y", y_m, RECORDED_NEEDED, -1e9, 1e9, 1, 0),                         \
        RECORDED_VALUE(prefix "angle", yaw_rad, RECORDED_NEEDED, -1e3, 1e3, -PI / 180, -90),       \
        RECORDED_VALUE(prefix "speed", speed_mps, RECORDED_OPTIONAL, -1e4, 1e4, 1, 0),             \
        {.name = NULL}}
COLUMNS(vehicles, "vehicle_", "timestep_time");
COLUMNS(persons, "person_", "timestep_time");
COLUMNS(containers, "container_", "timestep_time");
COLUMNS(plain, "", "time");

#define FORMAT                                                                                     \
    {                                                                                              \
        RECORDED_TABLE, .name = "a table of SUMO", .id_name = "id", .by_time = true,               \
                        .words = sumo_types_words, .of_sumo = true                                 \
    }

const struct recorded_layout sumo_table_layout = {
    .format = FORMAT,
    .mark = "timestep_time",
    .kinds = {{vehicles, "DEFAULT_VEHTYPE", 0.5},
              {persons, "DEFAULT_PEDTYPE", 0.5},
              {containers, "DEFAULT_CONTAINERTYPE", 0.5}},
};

const struct recorded_layout sumo_table_plain_layout = {
    .format = FORMAT, .mark = "angle", .kinds = {{plain, "DEFAULT_VEHTYPE", 0.5}}};
