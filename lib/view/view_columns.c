#include "view/view_columns.h"

void view_columns_real(struct view_columns *columns, enum view_column column, double value)
{
    float real = (float)value;
    memcpy(list_add(&columns->list[column], columns->arena), &real, sizeof real);
}

void view_columns_count(struct view_columns *columns, enum view_column column, uint32_t value)
{
    *list_add(&columns->list[column], columns->arena) = value;
}

uint32_t view_columns_name(struct view_columns *columns, const char *word)
{
    return intern_word(&columns->names, word, columns->arena);
}

uint32_t view_columns_optional_name(struct view_columns *columns, const char *word)
{
    return word != NULL ? 1 + view_columns_name(columns, word) : 0;
}

/* What is of no object has a number of its own, even if an object has its name: the 0 at the end of
 * the word is part of it then. */
uint32_t view_columns_object(struct view_columns *columns, const struct echo_id *echo)
{
    size_t length = strlen(echo->object) + (frame_has_object(echo->path) ? 0 : 1);
    return intern_number(&columns->names, echo->object, length, columns->arena);
}

static const struct {
    const char *key;
    char kind;
} table[] = {
#define COLUMN(name, key, kind) {key, kind},
#include "view/view_columns.def"
};

/* Bytes for each number of a column. */
static size_t column_width(const struct view_columns *columns, enum view_column column)
{
    uint32_t most = 0;
    if (table[column].kind == 'f')
        return 4;
    for (size_t i = 0; i < columns->list[column].count; i++) {
        uint32_t number = columns->list[column].items[i];
        most = number > most ? number : most;
    }
    if (most < 1 << 8)
        return 1;
    return most < 1 << 16 ? 2 : 4;
}

void view_columns_places(const struct view_columns *columns, struct view_column_place *places)
{
    static const char *const whole[] = {[1] = "u1", [2] = "u2", [4] = "u4"};
    size_t begin = 0;
    for (enum view_column column = 0; column < COLUMN_COUNT; column++) {
        size_t count = columns->list[column].count;
        size_t width = column_width(columns, column);
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

/* Fills each column up to a multiple of 12 bytes: whole groups of base64, and aligned for any
 * number. */
void view_columns_write(const struct view_columns *columns, struct text *text)
{
    enum { CHUNK = 12 * 1024 };
    unsigned char bytes[CHUNK];
    for (enum view_column column = 0; column < COLUMN_COUNT; column++) {
        size_t width = column_width(columns, column);
        size_t used = 0;
        for (size_t i = 0; i < columns->list[column].count; i++) {
            put_number(bytes + used, columns->list[column].items[i], width);
            used += width;
            if (used == CHUNK) {
                text_add_base64(text, bytes, used);
                used = 0;
            }
        }
        size_t padded = (used + 11) / 12 * 12;
        memset(bytes + used, 0, padded - used);
        text_add_base64(text, bytes, padded);
    }
}
