#include "score/score_table.h"

#include <inttypes.h>
#include <string.h>

enum { NAME_WIDTH = 28, COLUMN_WIDTH = 12 };

static void write_cell(const struct record *record, const struct field *field, const void *base,
                       struct text *text)
{
    if (!field_present(record, field, base)) {
        text_format(text, "%*s", COLUMN_WIDTH, "-");
    } else if (field->kind == FIELD_INTEGER) {
        text_format(text, "%*" PRId64, COLUMN_WIDTH, FIELD_LOAD(int64_t, field, base));
    } else {
        text_format(text, "%*.4g", COLUMN_WIDTH, FIELD_LOAD(double, field, base));
    }
}

/* Writes the rows of a record that lies at this offset in each score. */
static void write_rows(const struct record *record, const char *prefix, const struct score *scores,
                       size_t offset, size_t count, struct text *text)
{
    for (const struct field *field = record->fields; field->name != NULL; field++) {
        bool any = false;
        for (size_t i = 0; i < count; i++)
            any = any || field_present(record, field, (const char *)&scores[i] + offset);
        if (any && field->kind == FIELD_RECORD)
            write_rows(field->record, field->name, scores, offset + field->offset, count, text);
        if (!any || (field->kind != FIELD_INTEGER && field->kind != FIELD_REAL))
            continue;
        size_t before = text->length;
        text_format(text, "%s%s%s", prefix, prefix[0] != '\0' ? " " : "", field->name);
        text_format(text, "%*s", NAME_WIDTH - (int)(text->length - before), "");
        for (size_t i = 0; i < count; i++)
            write_cell(record, field, (const char *)&scores[i] + offset, text);
        text_add_word(text, "\n");
    }
}

void score_table_write(const struct score *scores, const char *const *heads, size_t count,
                       struct text *text)
{
    text_format(text, "%*s", NAME_WIDTH, "");
    for (size_t i = 0; i < count; i++)
        text_format(text, " %*s", COLUMN_WIDTH - 1, heads[i]);
    text_add_word(text, "\n");
    write_rows(&score_record, "", scores, 0, count, text);
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
        text_format(text, "%g rad\n", summary->azimuth_cell_rad);
    else
        text_add_word(text, "a twentieth of the view\n");
    bool single = sensors == 1;
    score_table_write(scores, heads, single ? 1 : sensors + 1, text);
}

void score_table_track_summary(const struct score_track_summary *summary, struct text *text)
{
    write_frames(summary->frames, summary->true_frames, summary->listed_frames, text);
    text_format(text, "; distances in metres, cut off at %g; %" PRId64 " identity switches\n",
                summary->cutoff_m, summary->id_switches);
    score_table_write(&summary->all, (const char *const[]){"all"}, 1, text);
}

void score_table_ensemble(const struct ensemble_score *score, struct text *text)
{
    text_format(text, "%-32s %8s %9s %9s %11s %11s\n", "scene", "lists", "targets", "in truth", "D",
                "error");
    for (size_t i = 0; i < score->scenes.count; i++) {
        const struct ensemble_scene_score *scene = &score->scenes.items[i];
        text_format(text, "%-32s %8" PRId64 " %9.2f %9.2f %11.5f %11.5f\n", scene->scene,
                    scene->lists, scene->listed_targets, scene->true_targets, scene->energy,
                    scene->energy_error);
    }
    text_format(text, "mean %.5f, 95 %% interval %.5f to %.5f\n", score->energy, score->low,
                score->high);
}
