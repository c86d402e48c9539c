#include "score/score_table.h"

#include <inttypes.h>
#include <stdio.h>

#include "base/units.h"

enum { NAME_WIDTH = 24, UNIT_WIDTH = 12, COLUMN_WIDTH = 12 };

struct table {
    const struct score *scores;
    const char *const *heads;
    size_t count;
    const char *distance; /* the unit of GOSPA and OSPA, and that of the parts of its square */
    const char *square;
    double *row; /* a figure for each score; NAN: it has none */
    struct text *text;
};

/* A column is at least as wide as its head. */
static int width_of(const struct table *table, size_t i)
{
    int head = (int)strlen(table->heads[i]);
    return head + 2 > COLUMN_WIDTH ? head + 2 : COLUMN_WIDTH;
}

/* Figures that the decimals cannot tell from 0, and very large ones, have an exponent. */
static void write_figure(double value, int decimals, int width, struct text *text)
{
    double size = fabs(value);
    bool plain = size == 0 || decimals < 4 || (size >= 0.00005 && size < 1e6);
    if (isnan(value))
        text_format(text, "%*s", width, "-");
    else
        text_format(text, plain ? "%*.*f" : "%*.*e", width, plain ? decimals : 3, value);
}

static void write_row(const struct table *table, const char *name, const char *unit, int decimals)
{
    bool any = false;
    for (size_t i = 0; i < table->count; i++)
        any = any || !isnan(table->row[i]);
    if (!any)
        return;
    text_format(table->text, "%-*s%-*s", NAME_WIDTH, name, UNIT_WIDTH, unit);
    for (size_t i = 0; i < table->count; i++)
        write_figure(table->row[i], decimals, width_of(table, i), table->text);
    text_add_word(table->text, "\n");
}

/* The figures of a field, of the score itself or of a record at this offset in it. */
static void fill_row(const struct table *table, const struct record *record,
                     const struct field *field, size_t offset, double scale)
{
    for (size_t i = 0; i < table->count; i++) {
        const char *base = (const char *)&table->scores[i] + offset;
        table->row[i] = !field_present(record, field, base) ? (double)NAN
                        : field->kind == FIELD_INTEGER ? (double)FIELD_LOAD(int64_t, field, base)
                                                       : scale * FIELD_LOAD(double, field, base);
    }
}

/* "azimuth rms" and all the others of the differences in a component, angles in degrees. */
static void write_component(const struct table *table, const struct field *component)
{
    const char *unit = field_unit(component->name);
    bool angle = strcmp(unit, "rad") == 0;
    int length = (int)(strrchr(component->name, '_') - component->name);
    for (const struct field *field = component->record->fields; field->name != NULL; field++) {
        char name[80];
        snprintf(name, sizeof name, "%.*s %s", length, component->name, field->name);
        fill_row(table, component->record, field, component->offset, angle ? 180 / PI : 1);
        write_row(table, name, angle ? "deg" : unit, 4);
    }
}

static void write_rates(const struct table *table)
{
    const struct score *scores = table->scores;
    for (size_t i = 0; i < table->count; i++)
        table->row[i] = 100.0 * (double)scores[i].missed_count / (double)scores[i].true_count;
    write_row(table, "missed", "% of true", 1);
    for (size_t i = 0; i < table->count; i++)
        table->row[i] = 100.0 * (double)scores[i].false_count / (double)scores[i].listed_count;
    write_row(table, "false", "% of listed", 1);
}

static void write_table(const struct table *table)
{
    text_format(table->text, "%-*s%-*s", NAME_WIDTH, "", UNIT_WIDTH, "unit");
    for (size_t i = 0; i < table->count; i++)
        text_format(table->text, "%*s", width_of(table, i), table->heads[i]);
    text_add_word(table->text, "\n");
    for (const struct field *field = score_record.fields; field->name != NULL; field++) {
        bool squared = field->offset >= offsetof(struct score, gospa_localisation) &&
                       field->offset <= offsetof(struct score, gospa_false);
        if (field->kind == FIELD_INTEGER || field->kind == FIELD_REAL)
            fill_row(table, &score_record, field, 0, 1);
        if (field->kind == FIELD_INTEGER)
            write_row(table, field->name, "", 0);
        else if (field->kind == FIELD_REAL)
            write_row(table, field->name, squared ? table->square : table->distance, 4);
        else if (field->kind == FIELD_RECORD)
            write_component(table, field);
        if (field->offset == offsetof(struct score, false_count))
            write_rates(table);
    }
}

static void write_frames(int64_t frames, int64_t only_true, int64_t only_listed, struct text *text)
{
    text_format(text, "%" PRId64 " frames", frames);
    if (only_true + only_listed > 0)
        text_format(text,
                    " in both streams, %" PRId64 " in the truth alone, %" PRId64
                    " in the scored stream alone",
                    only_true, only_listed);
}

void score_table_summary(const struct score_summary *summary, struct text *text,
                         struct arena *arena)
{
    size_t sensors = summary->sensors.count;
    struct score *scores = arena_get(arena, (sensors + 1) * sizeof *scores);
    const char **heads = arena_get(arena, (sensors + 1) * sizeof *heads);
    for (size_t i = 0; i < sensors; i++) {
        scores[i] = summary->sensors.items[i];
        heads[i] = scores[i].sensor;
    }
    scores[sensors] = summary->all;
    heads[sensors] = "all";
    write_frames(summary->frames, summary->true_frames, summary->listed_frames, text);
    text_format(text, "; distances in cells, cut off at %g; in azimuth a cell is ",
                summary->cutoff);
    if (summary->azimuth_cell_rad > 0)
        text_format(text, "%g deg\n", summary->azimuth_cell_rad * (180 / PI));
    else
        text_add_word(text, "a twentieth of the view\n");
    write_table(&(struct table){
        .scores = scores,
        .heads = heads,
        .count = sensors == 1 ? 1 : sensors + 1,
        .distance = "cells",
        .square = "cells^2",
        .row = arena_get(arena, (sensors + 1) * sizeof(double)),
        .text = text,
    });
}

void score_table_track_summary(const struct score_track_summary *summary, struct text *text)
{
    write_frames(summary->frames, summary->true_frames, summary->listed_frames, text);
    text_format(text, "; distances in metres, cut off at %g; %" PRId64 " identity switches\n",
                summary->cutoff_m, summary->id_switches);
    write_table(&(struct table){&summary->all, (const char *const[]){"all"}, 1, "m", "m^2",
                                (double[1]){0}, text});
}

/* The column of the scenes' names is as wide as the longest of them. */
void score_table_ensemble(const struct ensemble_score *score, struct text *text)
{
    int width = 32;
    for (size_t i = 0; i < score->scenes.count; i++)
        if ((int)strlen(score->scenes.items[i].scene) > width)
            width = (int)strlen(score->scenes.items[i].scene);
    text_format(text, "%-*s %8s %9s %9s %11s %11s\n", width, "scene", "lists", "targets",
                "in truth", "D", "error");
    for (size_t i = 0; i < score->scenes.count; i++) {
        const struct ensemble_scene_score *scene = &score->scenes.items[i];
        text_format(text, "%-*s %8" PRId64 " %9.2f %9.2f %11.5f %11.5f\n", width, scene->scene,
                    scene->lists, scene->listed_targets, scene->true_targets, scene->energy,
                    scene->energy_error);
    }
    text_format(text, "mean %.5f, 95 %% interval %.5f to %.5f\n", score->energy, score->low,
                score->high);
}
