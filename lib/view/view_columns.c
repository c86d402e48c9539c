#include "view/view_columns.h"

static const struct {
    const char *key;
    char kind;
} table[] = {
#define COLUMN(name, key, kind) {key, kind},
#include "view/view_columns.def"
};

static const struct field place_fields[] = {
    {FIELD_NAME_OF(struct view_column_place, name, "of the column")},
    {FIELD_NAME_OF(struct view_column_place, type, "kind and bytes of its numbers")},
    {FIELD_INTEGER_IN(struct view_column_place, count, 0, 0x1p53, "of numbers")},
    {FIELD_INTEGER_IN(struct view_column_place, begin, 0, 0x1p53, "number of its first character")},
    {0},
};

const struct record view_column_place_record = {
    .name = "column", .size = sizeof(struct view_column_place), .fields = place_fields};

void view_columns_add_real(struct view_columns *columns, enum view_column column, double value,
                           struct arena *arena)
{
    float real = (float)value;
    memcpy(list_add(&columns->list[column], arena), &real, sizeof real);
}

void view_columns_add_count(struct view_columns *columns, enum view_column column, uint32_t value,
                            struct arena *arena)
{
    *list_add(&columns->list[column], arena) = value;
}

/* Bytes for each number of a column. */
static size_t column_width(const struct view_columns *columns, enum view_column column)
{
    uint32_t most = 0;
    for (size_t i = 0; i < columns->list[column].count; i++) {
        uint32_t number = columns->list[column].items[i];
        most = number > most ? number : most;
    }
    return table[column].kind == 'f' ? 4 : most < 1 << 8 ? 1 : most < 1 << 16 ? 2 : 4;
}

void view_columns_places(const struct view_columns *columns, struct view_column_place *places)
{
    static const char *const whole[] = {[1] = "u1", [2] = "u2", [4] = "u4"};
    size_t begin = 0;
    for (enum view_column column = 0; column < COLUMN_COUNT; column++) {
        size_t count = columns->list[column].count, width = column_width(columns, column);
        places[column] = (struct view_column_place){table[column].key,
                                                    table[column].kind == 'f' ? "f4" : whole[width],
                                                    (int64_t)count, (int64_t)begin};
        begin += (count * width + 11) / 12 * 16;
    }
}

/* Writes a number little-endian, the order of every machine that runs a browser. */
static void put_number(unsigned char *byte, uint32_t number, size_t width)
{
    for (size_t i = 0; i < width; i++)
        byte[i] = (unsigned char)(number >> 8 * i);
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

/* Fills each column up to a multiple of 12 bytes: whole groups of base64, and aligned for any
 * number. */
void view_columns_write(const struct view_columns *columns, struct text *text)
{
    enum { CHUNK = 12 * 1024 };
    unsigned char bytes[CHUNK];
    for (enum view_column column = 0; column < COLUMN_COUNT; column++) {
        size_t count = columns->list[column].count, width = column_width(columns, column);
        for (size_t index = 0; index < count;) {
            size_t used = 0;
            for (; index < count && used < CHUNK; index++, used += width)
                put_number(bytes + used, columns->list[column].items[index], width);
            size_t padded = (used + 11) / 12 * 12;
            memset(bytes + used, 0, padded - used);
            write_base64(text, bytes, padded);
        }
    }
}
