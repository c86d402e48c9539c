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
    for (int i = 0; set >> i != 0; i++) {
        if ((set >> i & 1) == 0)
            continue;
        text_add_word(row, field->choices[i]);
        if (set >> i > 1)
            text_add_word(row, " ");
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
    if (field->kind == FIELD_REAL)
        row->length += number_write(FIELD_LOAD(double, field, base), text_room(row, NUMBER_SIZE));
    else if (field->kind == FIELD_INTEGER)
        add_whole(FIELD_LOAD(int64_t, field, base), row);
    else if (field->kind == FIELD_SEED)
        row->length +=
            number_write_whole(FIELD_LOAD(uint64_t, field, base), text_room(row, NUMBER_SIZE));
    else if (field->kind == FIELD_NAME)
        add_name(FIELD_LOAD(const char *, field, base), row);
    else if (field->kind == FIELD_CHOICE)
        text_add_word(row, field->choices[FIELD_LOAD(int, field, base)]);
    else if (field->kind == FIELD_SET)
        add_set(field, FIELD_LOAD(uint64_t, field, base), row);
    else
        text_add_word(row, FIELD_LOAD(bool, field, base) ? "true" : "false");
}

static bool has_word(const struct field *field, const void *owner)
{
    return field->kind == FIELD_CHOICE && field->choices[FIELD_LOAD(int, field, owner)] != NULL;
}

/* Is there a value to write? Flags are always there, choices where they have a word, numbers where
 * columns are to have zeros. */
static bool has_value(const struct csv_columns *columns, const struct csv_column *column,
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

void csv_columns_write(const struct csv_columns *columns, const void *base, struct text *row)
{
    bool there = false;
    for (size_t i = 0; i < columns->list.count; i++) {
        const void *owner = csv_columns_owner(columns, i, base, &there);
        if (owner != NULL)
            csv_columns_add_cell(columns->list.items[i].field, owner, row);
        end_cell(row);
    }
}

void csv_columns_end_row(struct text *row)
{
    row->bytes[row->length - 1] = '\n';
}
