/* Tables in the layout of NGSIM, in feet, of the middle of the front bumper. Local_Y points along
 * the road and Local_X to its right. There are no headings; ids come again for other vehicles. */
#include "recorded/recorded_table.h"

#define FOOT_M 0.3048
#define FEET(name, member, low, scale)                                                             \
    RECORDED_VALUE(name, member, RECORDED_NEEDED, low, 1e9, (scale)*FOOT_M, 0)

/* Frames of two files begin with the same number, so that the stamp goes before. */
static const struct recorded_column columns[] = {
    RECORDED_ID("Vehicle_ID"),
    RECORDED_RECORDING("Location"),
    RECORDED_TIME_IN("Frame_ID", 0.1),
    RECORDED_TIME_IN("Global_Time", 1e-3),
    RECORDED_CLASS("v_Class", RECORDED_NEEDED),
    FEET("Local_Y", x_m, -1e9, 1),
    FEET("Local_X", y_m, -1e9, -1),
    FEET("v_Length", length_m, 0, 1),
    FEET("v_Width", width_m, 0, 1),
    {0},
};

const char *const ngsim_table_names[] = {
    "Vehicle_ID", "Frame_ID",  "Total_Frames",  "Global_Time",  "Local_X", "Local_Y", "Global_X",
    "Global_Y",   "v_Length",  "v_Width",       "v_Class",      "v_Vel",   "v_Acc",   "Lane_ID",
    "Preceding",  "Following", "Space_Headway", "Time_Headway", NULL};

#define NGSIM RECORDED_WORD
#include "recorded/recorded_words.def"

const struct recorded_layout ngsim_table_layout = {
    .format = {RECORDED_TABLE, .name = "a table of NGSIM", .id_name = "Vehicle_ID", .words = words,
               .slow_mps = 1},
    .mark = "Vehicle_ID",
    .kinds = {{columns, NULL, 0.5}},
};
