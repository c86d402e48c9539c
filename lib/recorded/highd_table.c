/* Tables in the layout of the highD data set: axes of an image, x to the right and y down, and of a
 * box its upper left corner. Its width is the length of the vehicle. Rows stand by track. */
#include "recorded/recorded_table.h"

static const struct recorded_column columns[] = {
    RECORDED_ID("id"),
    RECORDED_FRAME("frame"),
    RECORDED_VALUE("x", x_m, RECORDED_NEEDED, -1e9, 1e9, 1, 0),
    RECORDED_VALUE("y", y_m, RECORDED_NEEDED, -1e9, 1e9, -1, 0),
    RECORDED_VALUE("width", length_m, RECORDED_NEEDED, 0, 1e6, 1, 0),
    RECORDED_VALUE("height", width_m, RECORDED_NEEDED, 0, 1e6, 1, 0),
    RECORDED_VALUE("xVelocity", vx_mps, RECORDED_NEEDED, -1e4, 1e4, 1, 0),
    RECORDED_VALUE("yVelocity", vy_mps, RECORDED_NEEDED, -1e4, 1e4, -1, 0),
    {0},
};

#define HIGHD RECORDED_WORD
#include "recorded/recorded_words.def"

static void complete(struct recorded_cells *cells)
{
    struct recorded_row *row = &cells->row;
    row->x_m += row->length_m / 2;
    row->y_m -= row->width_m / 2;
}

/* Slower than 1 m/s a vehicle in a jam may move anywhere within the noise of its place, which is
 * that of an image. */
const struct recorded_layout highd_table_layout = {
    .format = {RECORDED_TABLE, .name = "a table of highD", .id_name = "id", .words = words,
               .slow_mps = 1},
    .mark = "xVelocity",
    .kinds = {{columns, NULL, 0}},
    .beside = {"id", "drivingDirection"},
    .complete = complete,
};
