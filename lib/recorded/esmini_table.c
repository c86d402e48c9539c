/* The log of esmini --csv_logger: a row for each step, with columns for everybody. The place is
 * that of the reference point, usually below the rear axle, and the box lies around another. The
 * log says no classes, so they are those of the names, or else follow from the box. */
#include "base/vec2.h"
#include "recorded/recorded_table.h"

enum { BOX_X, BOX_Y };

static const struct recorded_column columns[] = {
    RECORDED_ID("Entity_Name [-]"),
    RECORDED_CLASS("Entity_Name [-]", RECORDED_NEEDED),
    RECORDED_TIME_IN("TimeStamp [s]", 1),
    RECORDED_VALUE("World_Position_X [m]", x_m, RECORDED_NEEDED, -1e9, 1e9, 1, 0),
    RECORDED_VALUE("World_Position_Y [m]", y_m, RECORDED_NEEDED, -1e9, 1e9, 1, 0),
    RECORDED_VALUE("Vel_X [m/s]", vx_mps, RECORDED_NEEDED, -1e4, 1e4, 1, 0),
    RECORDED_VALUE("Vel_Y [m/s]", vy_mps, RECORDED_NEEDED, -1e4, 1e4, 1, 0),
    RECORDED_VALUE("World_Heading_Angle [rad]", yaw_rad, RECORDED_NEEDED, -1e3, 1e3, 1, 0),
    RECORDED_VALUE("Heading_Angle_Rate [rad/s]", yaw_rate_radps, RECORDED_NEEDED, -1e3, 1e3, 1, 0),
    RECORDED_ASIDE("bb_x [m]", BOX_X, -1e6, 1e6),
    RECORDED_ASIDE("bb_y [m]", BOX_Y, -1e6, 1e6),
    RECORDED_VALUE("bb_length [m]", length_m, RECORDED_NEEDED, 0, 1e6, 1, 0),
    RECORDED_VALUE("bb_width [m]", width_m, RECORDED_NEEDED, 0, 1e6, 1, 0),
    RECORDED_VALUE("bb_height [m]", height_m, RECORDED_NEEDED, 0, 1e6, 1, 0),
    {0},
};

#define ESMINI RECORDED_WORD
#include "recorded/recorded_words.def"

static const char *word_of(const struct recorded_row *row)
{
    if (row->length_m <= 1.2)
        return words[0].word;
    if (row->width_m <= 1.2)
        return words[1].word;
    return words[row->length_m <= 5.6 ? 2 : row->length_m <= 7 ? 3 : 4].word;
}

/* The velocity of a point of a body that turns differs from that of another. */
static void complete(struct recorded_cells *cells)
{
    struct recorded_row *row = &cells->row;
    struct vec2 heading = vec2_heading(row->yaw_rad);
    double x_m = cells->aside[BOX_X] * heading.x - cells->aside[BOX_Y] * heading.y;
    double y_m = cells->aside[BOX_X] * heading.y + cells->aside[BOX_Y] * heading.x;
    row->x_m += x_m;
    row->y_m += y_m;
    row->vx_mps -= row->yaw_rate_radps * y_m;
    row->vy_mps += row->yaw_rate_radps * x_m;
    row->likely = word_of(row);
}

const struct recorded_layout esmini_table_layout = {
    .format = {RECORDED_TABLE, .name = "a log of esmini", .id_name = "Entity_Name", .by_time = true,
               .words = words},
    .mark = "TimeStamp [s]",
    .kinds = {{columns, NULL, 0}},
    .wide = true,
    .complete = complete,
};
