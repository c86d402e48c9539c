/* Tables in the layout of inD, rounD, exiD and uniD. Headings are in degrees, sizes of pedestrians
 * and bicycles are 0, and a trailer is a track beside that of its vehicle. Rows stand by track. */
#include "base/units.h"
#include "recorded/recorded_table.h"

static const struct recorded_column columns[] = {
    RECORDED_ID("trackId"),
    RECORDED_RECORDING("recordingId"),
    RECORDED_FRAME("frame"),
    RECORDED_VALUE("xCenter", x_m, RECORDED_NEEDED, -1e9, 1e9, 1, 0),
    RECORDED_VALUE("yCenter", y_m, RECORDED_NEEDED, -1e9, 1e9, 1, 0),
    RECORDED_VALUE("heading", yaw_rad, RECORDED_NEEDED, -1e3, 1e3, PI / 180, 0),
    RECORDED_VALUE("width", width_m, RECORDED_NEEDED, 0, 1e6, 1, 0),
    RECORDED_VALUE("length", length_m, RECORDED_NEEDED, 0, 1e6, 1, 0),
    RECORDED_VALUE("xVelocity", vx_mps, RECORDED_NEEDED, -1e4, 1e4, 1, 0),
    RECORDED_VALUE("yVelocity", vy_mps, RECORDED_NEEDED, -1e4, 1e4, 1, 0),
    {0},
};

#define IND RECORDED_WORD
#include "recorded/recorded_words.def"

const struct recorded_layout ind_table_layout = {
    .format = {RECORDED_TABLE, .name = "a table of inD", .id_name = "trackId", .words = words},
    .mark = "xCenter",
    .kinds = {{columns, NULL, 0}},
    .beside = {"trackId", NULL},
};
