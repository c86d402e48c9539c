/* Tables in the layout of the INTERACTION data set. Files of pedestrians lack heading and sizes,
 * and a row may leave these cells empty; then the yaw is that of the velocity. Rows stand in any
 * order. */
#include "recorded/recorded_table.h"

static const struct recorded_column columns[] = {
    RECORDED_ID("track_id"),
    RECORDED_RECORDING("case_id"),
    RECORDED_TIME_IN("timestamp_ms", 1e-3),
    RECORDED_TIME_IN("timestamp_us", 1e-6),
    RECORDED_TIME_IN("timestamp_s", 1),
    RECORDED_CLASS("agent_type", RECORDED_NEEDED),
    RECORDED_VALUE("x", x_m, RECORDED_NEEDED, -1e9, 1e9, 1, 0),
    RECORDED_VALUE("y", y_m, RECORDED_NEEDED, -1e9, 1e9, 1, 0),
    RECORDED_VALUE("vx", vx_mps, RECORDED_NEEDED, -1e4, 1e4, 1, 0),
    RECORDED_VALUE("vy", vy_mps, RECORDED_NEEDED, -1e4, 1e4, 1, 0),
    RECORDED_VALUE("psi_rad", yaw_rad, RECORDED_TOGETHER, -1e3, 1e3, 1, 0),
    RECORDED_VALUE("length", length_m, RECORDED_TOGETHER, 0, 1e6, 1, 0),
    RECORDED_VALUE("width", width_m, RECORDED_TOGETHER, 0, 1e6, 1, 0),
    {0},
};

#define INTERACTION RECORDED_WORD
#include "recorded/recorded_words.def"

const struct recorded_layout interaction_table_layout = {
    .format = {RECORDED_TABLE, .name = "a table of INTERACTION", .id_name = "track_id",
               .words = words},
    .mark = "track_id",
    .kinds = {{columns, NULL, 0}},
};
