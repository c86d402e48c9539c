/* Columns of numbers in which glint-view's page gets frames. Real numbers are written in single
 * precision, whole numbers as narrowly as the largest of the column allows. view_data.h says what
 * the columns hold. */
#ifndef VIEW_COLUMNS_H
#define VIEW_COLUMNS_H

#include <stdint.h>

#include "base/arena.h"
#include "base/text.h"

/* Columns of real numbers first. */
enum view_column {
    COLUMN_FRAME_TIME,
    COLUMN_OBJECT_X,
    COLUMN_OBJECT_Y,
    COLUMN_OBJECT_YAW,
    COLUMN_OBJECT_VX,
    COLUMN_OBJECT_VY,
    COLUMN_OBJECT_LENGTH,
    COLUMN_OBJECT_WIDTH,
    COLUMN_SCAN_X,
    COLUMN_SCAN_Y,
    COLUMN_SCAN_YAW,
    COLUMN_SCAN_VX,
    COLUMN_SCAN_VY,
    COLUMN_SCAN_AGE,
    COLUMN_TARGET_RANGE,
    COLUMN_TARGET_AZIMUTH,
    COLUMN_TARGET_RATE,
    COLUMN_TARGET_AMPLITUDE,
    COLUMN_TARGET_CELL_RANGE,
    COLUMN_TARGET_CELL_AZIMUTH,
    COLUMN_TARGET_CELL_RATE,
    COLUMN_TARGET_CELL_AMPLITUDE,
    COLUMN_CONTRIBUTOR_RANGE,
    COLUMN_CONTRIBUTOR_AZIMUTH,
    COLUMN_CONTRIBUTOR_RATE,
    COLUMN_CONTRIBUTOR_ERCS,
    COLUMN_CONTRIBUTOR_WEIGHT,
    COLUMN_DETAIL_SHORTFALL,
    COLUMN_FIRST_COUNT,
    COLUMN_FRAME_SCENE = COLUMN_FIRST_COUNT,
    COLUMN_FRAME_NUMBER,
    COLUMN_FRAME_OBJECTS,
    COLUMN_FRAME_SCANS,
    COLUMN_OBJECT_ID,
    COLUMN_OBJECT_CLASS,
    COLUMN_SCAN_SENSOR,
    COLUMN_SCAN_MEASURED,
    COLUMN_SCAN_TARGETS,
    COLUMN_SCAN_FATES,
    COLUMN_SCAN_DETAILS,
    COLUMN_TARGET_UNDECIDED,
    COLUMN_TARGET_EFFECTS,
    COLUMN_TARGET_CONTRIBUTORS,
    COLUMN_CONTRIBUTOR_OBJECT,
    COLUMN_CONTRIBUTOR_REFLECTOR,
    COLUMN_CONTRIBUTOR_PATH,
    COLUMN_CONTRIBUTOR_MIRROR,
    COLUMN_CONTRIBUTOR_NUMBER,
    COLUMN_FATE_OBJECT,
    COLUMN_FATE_PATTERN,
    COLUMN_DETAIL_OBJECT,
    COLUMN_DETAIL_REFLECTOR,
    COLUMN_DETAIL_PATH,
    COLUMN_DETAIL_MIRROR,
    COLUMN_DETAIL_NUMBER,
    COLUMN_DETAIL_BY,
    COLUMN_PATTERN_ITEMS,
    COLUMN_ITEM_REFLECTOR,
    COLUMN_ITEM_PATH,
    COLUMN_ITEM_MIRROR,
    COLUMN_ITEM_NUMBER,
    COLUMN_ITEM_STAGE,
    COLUMN_ITEM_REASON,
    COLUMN_ITEM_EFFECT,
    COLUMN_COUNT
};

struct view_columns {
    struct {
        LIST_OF(float) reals;
        LIST_OF(uint32_t) counts;
    } list[COLUMN_COUNT];
};

/* Appends a number: reals to columns before COLUMN_FIRST_COUNT, whole numbers to the others. */
void view_columns_add_real(struct view_columns *columns, enum view_column column, double value,
                           struct arena *arena);
void view_columns_add_count(struct view_columns *columns, enum view_column column, uint32_t value,
                            struct arena *arena);

/* Writes type, count and place of each column by its name, as JSON. */
void view_columns_write_places(const struct view_columns *columns, struct text *text);

/* Writes all columns in base64, each beginning at a multiple of 16 characters. */
void view_columns_write(const struct view_columns *columns, struct text *text);

#endif
