#include "export/npy_columns.h"

#include <math.h>

#include "base/number.h"

/* NumPy wants data at a multiple of 64 bytes, behind a magic word, a version and the length of the
 * text. Spaces fill the text up, so that a number of rows of any size fits. */
enum { HEAD_BEGIN = 10, HEAD_UNIT = 64, CELL_SIZE = 8, ROWS_WIDTH = 20 };

struct npy_names npy_columns_begin(struct arena *arena)
{
    struct npy_names names = {.list = intern_begin(64, arena), .arena = arena};
    intern_word(&names.list, "", arena);
    text_room(&names.word, 1); /* a set without words is a text, too */
    return names;
}

void npy_columns_write_names(const struct npy_names *names, struct text *text)
{
    for (size_t i = 0; i < names->list.list.count; i++) {
        const struct intern_name *name = &names->list.list.items[i];
        text_add_word(text, i == 0 ? "[" : ",\n");
        text_add_json(text, name->text, name->length);
    }
    text_add_word(text, "]\n");
}

void npy_columns_end(struct npy_names *names)
{
    text_free(&names->word);
}

/* The type of a column for NumPy. A flag has one byte; the seven behind it are a column without a
 * name. */
static const char *type_of(const struct field *field)
{
    if (field->kind == FIELD_REAL)
        return "'<f8'";
    if (field->kind == FIELD_INTEGER)
        return "'<i8'";
    if (field->kind == FIELD_FLAG)
        return "'|b1'), ('', '|V7'";
    return "'<u8'";
}

void npy_columns_write_head(const struct csv_columns *lists, size_t count, int64_t rows,
                            struct text *text)
{
    size_t begin = text->length;
    text_add(text, "\x93NUMPY\x01\x00..", HEAD_BEGIN);
    text_add_word(text, "{'descr': [");
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < lists[i].list.count; j++)
            text_format(text, "('%s', %s), ", lists[i].list.items[j].name,
                        type_of(lists[i].list.items[j].field));
    text_format(text, "], 'fortran_order': False, 'shape': (%*lld,)}", ROWS_WIDTH, (long long)rows);
    while ((text->length + 1 - begin) % HEAD_UNIT != 0)
        text_add_word(text, " ");
    text_add_word(text, "\n");
    size_t length = text->length - begin - HEAD_BEGIN;
    text->bytes[begin + HEAD_BEGIN - 2] = (char)(length & 0xff);
    text->bytes[begin + HEAD_BEGIN - 1] = (char)(length >> 8);
}

/* The number of the cell's text in the list of names. */
static uint64_t word_of(const struct field *field, const void *base, struct npy_names *names)
{
    if (field->kind == FIELD_NAME)
        return intern_word(&names->list, FIELD_LOAD(const char *, field, base), names->arena);
    names->word.length = 0;
    csv_columns_add_cell(field, base, &names->word);
    return intern_number(&names->list, names->word.bytes, names->word.length, names->arena);
}

static uint64_t cell_of(const struct field *field, const void *base, struct npy_names *names)
{
    if (field->kind == FIELD_REAL)
        return number_bits(base != NULL ? FIELD_LOAD(double, field, base) : (double)NAN);
    if (field->kind == FIELD_INTEGER)
        return base != NULL ? (uint64_t)FIELD_LOAD(int64_t, field, base) : UINT64_MAX;
    if (base == NULL)
        return 0;
    return field->kind == FIELD_FLAG ? FIELD_LOAD(bool, field, base) : word_of(field, base, names);
}

void npy_columns_write(const struct csv_columns *columns, const void *base, struct npy_names *names,
                       struct text *row)
{
    char *at = text_room(row, CELL_SIZE * columns->list.count);
    bool there = false;
    for (size_t i = 0; i < columns->list.count; i++) {
        const void *owner = csv_columns_owner(columns, i, base, &there);
        text_put_word(at + CELL_SIZE * i, cell_of(columns->list.items[i].field, owner, names));
    }
    row->length += CELL_SIZE * columns->list.count;
}
