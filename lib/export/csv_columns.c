#include "export/csv_columns.h"

#include "base/number.h"
#include "text/csv_table.h"

/* Room for a name with all its quotes doubled, two around it, and a comma. */
enum { NAME_ROOM = 2 * FIELD_NAME_SIZE + 3 };

static bool is_among(const char *const *names, const char *name)
{
    while (*names != NULL && strcmp(*names, name) != 0)
        names++;
    return *names != NULL;
}

static void add_record(struct csv_columns *columns, const char *before, const struct record *record,
                       const struct field *embedded, const char *const *without,
                       struct arena *arena)
{
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        const char *name = arena_format(arena, "%s%s", before, field->name);
        bool is_one = field->kind != FIELD_LIST && field->kind != FIELD_NAMES &&
                      field->kind != FIELD_RAW && field->kind != FIELD_NOTES;
        if (!is_one || is_among(without, name))
            continue;
        if (field->kind == FIELD_RECORD)
            add_record(columns, arena_format(arena, "%s_", name), field->record, field, without,
                       arena);
        else
            *list_add(&columns->list, arena) = (struct csv_column){
                name, field, record, embedded != NULL ? embedded->offset : 0, embedded};
    }
}

void csv_columns_add(struct csv_columns *columns, const struct record *record,
                     const char *const *without, struct arena *arena)
{
    add_record(columns, "", record, NULL, without, arena);
}

static void add_name(const char *name, struct text *row)
{
    row->length += csv_table_quote(name, text_room(row, NAME_ROOM), NAME_ROOM);
}

static void add_set(const struct field *field, uint64_t set, struct text *row)
{
    for (uint64_t rest = set; rest != 0; rest &= rest - 1) {
        text_add_word(row, rest == set ? "" : " ");
        text_add_word(row, field->choices[__builtin_ctzll(rest)]);
    }
}

static void add_whole(int64_t value, struct text *row)
{
    char *at = text_room(row, NUMBER_SIZE + 1);
    *at = '-';
    row->length += value < 0;
    row->length +=
        number_write_whole(value < 0 ? 0 - (uint64_t)value : (uint64_t)value, at + (value < 0));
}

void csv_columns_add_cell(const struct field *field, const void *base, struct text *row)
{
    switch (field->kind) {
    case FIELD_REAL:
        row->length += number_write(FIELD_LOAD(double, field, base), text_room(row, NUMBER_SIZE));
        break;
    case FIELD_INTEGER:
        add_whole(FIELD_LOAD(int64_t, field, base), row);
        break;
    case FIELD_SEED:
        row->length +=
            number_write_whole(FIELD_LOAD(uint64_t, field, base), text_room(row, NUMBER_SIZE));
        break;
    case FIELD_NAME:
        add_name(FIELD_LOAD(const char *, field, base), row);
        break;
    case FIELD_CHOICE:
        text_add_word(row, field->choices[FIELD_LOAD(int, field, base)]);
        break;
    case FIELD_SET:
        add_set(field, FIELD_LOAD(uint64_t, field, base), row);
        break;
    default:
        text_add_word(row, FIELD_LOAD(bool, field, base) ? "true" : "false");
    }
}

static bool has_word(const struct field *field, const void *owner)
{
    return field->kind == FIELD_CHOICE && field->choices[FIELD_LOAD(int, field, owner)] != NULL;
}

/* Is there a value to write? Flags are always there, choices where they have a word, numbers where
 * columns are to have zeros. */
static inline bool has_value(const struct csv_columns *columns, const struct csv_column *column,
                             const void *owner)
{
    enum field_kind kind = column->field->kind;
    return !column->field->optional || kind == FIELD_FLAG || has_word(column->field, owner) ||
           (columns->zeros && (kind == FIELD_REAL || kind == FIELD_INTEGER)) ||
           field_present(column->record, column->field, owner);
}

static void end_cell(struct text *row)
{
    *text_room(row, 1) = ',';
    row->length++;
}

void csv_columns_write_names(const struct csv_columns *columns, struct text *row)
{
    for (size_t i = 0; i < columns->list.count; i++) {
        text_add_word(row, columns->list.items[i].name);
        end_cell(row);
    }
}

const void *csv_columns_owner(const struct csv_columns *columns, size_t i, const void *base,
                              bool *there)
{
    const struct csv_column *column = &columns->list.items[i];
    if (base == NULL)
        return NULL;
    if (i == 0 || column->embedded != column[-1].embedded)
        *there = column->embedded == NULL || field_present(column->record, column->embedded, base);
    const void *owner = (const char *)base + column->offset;
    return *there && has_value(columns, column, owner) ? owner : NULL;
}

static void write_empty(size_t count, struct text *row)
{
    memset(text_room(row, count), ',', count);
    row->length += count;
}

/* The cells of the columns from begin to end, which are members of one struct. */
static void write_cells(const struct csv_columns *columns, const struct csv_column *begin,
                        const struct csv_column *end, const void *base, struct text *row)
{
    const void *owner = (const char *)base + begin->offset;
    for (const struct csv_column *column = begin; column < end; column++) {
        if (has_value(columns, column, owner))
            csv_columns_add_cell(column->field, owner, row);
        end_cell(row);
    }
}

void csv_columns_write(const struct csv_columns *columns, const void *base, struct text *row)
{
    const struct csv_column *column = columns->list.items, *last = column + columns->list.count;
    while (column < last) {
        const struct csv_column *begin = column;
        const struct field *embedded = begin->embedded;
        while (column < last && column->embedded == embedded)
            column++;
        bool there =
            base != NULL && (embedded == NULL || field_present(begin->record, embedded, base));
        if (there)
            write_cells(columns, begin, column, base, row);
        else
            write_empty((size_t)(column - begin), row);
    }
}

void csv_columns_end_row(struct text *row)
{
    row->bytes[row->length - 1] = '\n';
}
