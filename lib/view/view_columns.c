#include "view/view_columns.h"

#include <string.h>

static const char *const column_names[COLUMN_COUNT] = {
    [COLUMN_FRAME_TIME] = "frame_time_s",
    [COLUMN_OBJECT_X] = "object_x_m",
    [COLUMN_OBJECT_Y] = "object_y_m",
    [COLUMN_OBJECT_YAW] = "object_yaw_rad",
    [COLUMN_OBJECT_VX] = "object_vx_mps",
    [COLUMN_OBJECT_VY] = "object_vy_mps",
    [COLUMN_OBJECT_LENGTH] = "object_length_m",
    [COLUMN_OBJECT_WIDTH] = "object_width_m",
    [COLUMN_SCAN_X] = "scan_x_m",
    [COLUMN_SCAN_Y] = "scan_y_m",
    [COLUMN_SCAN_YAW] = "scan_yaw_rad",
    [COLUMN_SCAN_VX] = "scan_vx_mps",
    [COLUMN_SCAN_VY] = "scan_vy_mps",
    [COLUMN_SCAN_AGE] = "scan_age_s",
    [COLUMN_TARGET_RANGE] = "target_range_m",
    [COLUMN_TARGET_AZIMUTH] = "target_azimuth_rad",
    [COLUMN_TARGET_RATE] = "target_range_rate_mps",
    [COLUMN_TARGET_AMPLITUDE] = "target_amplitude_db",
    [COLUMN_TARGET_CELL_RANGE] = "target_cell_range_m",
    [COLUMN_TARGET_CELL_AZIMUTH] = "target_cell_azimuth_rad",
    [COLUMN_TARGET_CELL_RATE] = "target_cell_range_rate_mps",
    [COLUMN_TARGET_CELL_AMPLITUDE] = "target_cell_amplitude",
    [COLUMN_CONTRIBUTOR_RANGE] = "contributor_range_m",
    [COLUMN_CONTRIBUTOR_AZIMUTH] = "contributor_azimuth_rad",
    [COLUMN_CONTRIBUTOR_RATE] = "contributor_range_rate_mps",
    [COLUMN_CONTRIBUTOR_ERCS] = "contributor_ercs",
    [COLUMN_CONTRIBUTOR_WEIGHT] = "contributor_weight",
    [COLUMN_DETAIL_SHORTFALL] = "detail_shortfall_db",
    [COLUMN_FRAME_SCENE] = "frame_scene",
    [COLUMN_FRAME_NUMBER] = "frame_number",
    [COLUMN_FRAME_OBJECTS] = "frame_objects",
    [COLUMN_FRAME_SCANS] = "frame_scans",
    [COLUMN_OBJECT_ID] = "object_id",
    [COLUMN_OBJECT_CLASS] = "object_class",
    [COLUMN_SCAN_SENSOR] = "scan_sensor",
    [COLUMN_SCAN_MEASURED] = "scan_measured",
    [COLUMN_SCAN_TARGETS] = "scan_targets",
    [COLUMN_SCAN_FATES] = "scan_fates",
    [COLUMN_SCAN_DETAILS] = "scan_details",
    [COLUMN_TARGET_UNDECIDED] = "target_sign_undecided",
    [COLUMN_TARGET_EFFECTS] = "target_effects",
    [COLUMN_TARGET_CONTRIBUTORS] = "target_contributors",
    [COLUMN_CONTRIBUTOR_OBJECT] = "contributor_object",
    [COLUMN_CONTRIBUTOR_REFLECTOR] = "contributor_reflector",
    [COLUMN_CONTRIBUTOR_PATH] = "contributor_path",
    [COLUMN_CONTRIBUTOR_MIRROR] = "contributor_mirror",
    [COLUMN_CONTRIBUTOR_NUMBER] = "contributor_number",
    [COLUMN_FATE_OBJECT] = "fate_object",
    [COLUMN_FATE_PATTERN] = "fate_pattern",
    [COLUMN_DETAIL_OBJECT] = "detail_object",
    [COLUMN_DETAIL_REFLECTOR] = "detail_reflector",
    [COLUMN_DETAIL_PATH] = "detail_path",
    [COLUMN_DETAIL_MIRROR] = "detail_mirror",
    [COLUMN_DETAIL_NUMBER] = "detail_number",
    [COLUMN_DETAIL_BY] = "detail_by",
    [COLUMN_PATTERN_ITEMS] = "pattern_items",
    [COLUMN_ITEM_REFLECTOR] = "item_reflector",
    [COLUMN_ITEM_PATH] = "item_path",
    [COLUMN_ITEM_MIRROR] = "item_mirror",
    [COLUMN_ITEM_NUMBER] = "item_number",
    [COLUMN_ITEM_STAGE] = "item_stage",
    [COLUMN_ITEM_REASON] = "item_reason",
    [COLUMN_ITEM_EFFECT] = "item_effect",
};

void view_columns_add_real(struct view_columns *columns, enum view_column column, double value,
                           struct arena *arena)
{
    *list_add(&columns->list[column].reals, arena) = (float)value;
}

void view_columns_add_count(struct view_columns *columns, enum view_column column, uint32_t value,
                            struct arena *arena)
{
    *list_add(&columns->list[column].counts, arena) = value;
}

static size_t column_count(const struct view_columns *columns, enum view_column column)
{
    return column < COLUMN_FIRST_COUNT ? columns->list[column].reals.count
                                       : columns->list[column].counts.count;
}

/* Bytes for each number of a column. */
static size_t column_width(const struct view_columns *columns, enum view_column column)
{
    if (column < COLUMN_FIRST_COUNT)
        return 4;
    uint32_t most = 0;
    for (size_t i = 0; i < columns->list[column].counts.count; i++) {
        uint32_t number = columns->list[column].counts.items[i];
        most = number > most ? number : most;
    }
    return most < 1 << 8 ? 1 : most < 1 << 16 ? 2 : 4;
}

/* Bytes of a column up to the next multiple of 12: whole groups of base64, and aligned for any
 * number. */
static size_t column_size(const struct view_columns *columns, enum view_column column)
{
    return (column_count(columns, column) * column_width(columns, column) + 11) / 12 * 12;
}

void view_columns_write_places(const struct view_columns *columns, struct text *text)
{
    size_t begin = 0;
    text_add_word(text, "\"columns\":{\n");
    for (enum view_column column = 0; column < COLUMN_COUNT; column++) {
        if (column > 0)
            text_add_word(text, ",\n");
        text_format(text, "\"%s\":{\"type\":\"%c%zu\",\"count\":%zu,\"begin\":%zu}",
                    column_names[column], column < COLUMN_FIRST_COUNT ? 'f' : 'u',
                    column_width(columns, column), column_count(columns, column), begin);
        begin += column_size(columns, column) / 3 * 4;
    }
    text_add_word(text, "}");
}

/* Writes a number little-endian, the order of every machine that runs a browser. */
static void put_number(unsigned char *byte, uint32_t number, size_t width)
{
    for (size_t i = 0; i < width; i++)
        byte[i] = (unsigned char)(number >> 8 * i);
}

static uint32_t column_number(const struct view_columns *columns, enum view_column column,
                              size_t index)
{
    if (column >= COLUMN_FIRST_COUNT)
        return columns->list[column].counts.items[index];
    uint32_t bits;
    memcpy(&bits, &columns->list[column].reals.items[index], sizeof bits);
    return bits;
}

static void write_base64(struct text *text, const unsigned char *bytes, size_t size)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    char *out = text_room(text, size / 3 * 4);
    for (size_t i = 0; i < size; i += 3) {
        unsigned group = (unsigned)bytes[i] << 16 | (unsigned)bytes[i + 1] << 8 | bytes[i + 2];
        for (int shift = 18; shift >= 0; shift -= 6)
            *out++ = digits[group >> shift & 63];
    }
    text->length += size / 3 * 4;
}

void view_columns_write(const struct view_columns *columns, struct text *text)
{
    enum { CHUNK = 12 * 1024 };
    unsigned char bytes[CHUNK];
    for (enum view_column column = 0; column < COLUMN_COUNT; column++) {
        size_t count = column_count(columns, column), width = column_width(columns, column);
        for (size_t index = 0; index < count;) {
            size_t used = 0;
            for (; index < count && used < CHUNK; index++, used += width)
                put_number(bytes + used, column_number(columns, column, index), width);
            size_t padded = (used + 11) / 12 * 12;
            memset(bytes + used, 0, padded - used);
            write_base64(text, bytes, padded);
        }
    }
}
