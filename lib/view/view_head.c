#include "view/view_head.h"

#include <inttypes.h>
#include <string.h>

#include "base/number.h"

static void write_word(struct text *text, const char *word)
{
    size_t begin = text->length;
    text_add_json(text, word, strlen(word));
    struct text plain = {0};
    text_add(&plain, text->bytes + begin, text->length - begin);
    text->length = begin;
    for (size_t i = 0; i < plain.length; i++)
        if (plain.bytes[i] == '<')
            text_add_word(text, "\\u003c");
        else
            text_add(text, plain.bytes + i, 1);
    text_free(&plain);
}

static void write_number(struct text *text, double value)
{
    text->length += number_write(value, text_room(text, NUMBER_SIZE));
}

/* "key": before a value; a comma too, unless the object has just begun. */
static void write_key(struct text *text, const char *key)
{
    char before = text->bytes[text->length - 1];
    text_format(text, "%s\"%s\":", before == '{' ? "" : ",", key);
}

static void write_named_number(struct text *text, const char *key, double value)
{
    write_key(text, key);
    write_number(text, value);
}

static void write_named_word(struct text *text, const char *key, const char *word)
{
    write_key(text, key);
    write_word(text, word);
}

static void write_named_flag(struct text *text, const char *key, bool flag)
{
    write_key(text, key);
    text_add_word(text, flag ? "true" : "false");
}

static void write_separator(struct text *text, size_t index)
{
    if (index > 0)
        text_add_word(text, ",\n");
}

static void write_names(const struct view_data *data, struct text *text)
{
    text_add_word(text, "\"names\":[");
    for (size_t i = 0; i < data->names.names.count; i++) {
        write_separator(text, i);
        write_word(text, data->names.names.items[i].text);
    }
    text_add_word(text, "],\n\"reasons\":[");
    for (enum loss loss = 0; frame_loss_name(loss) != NULL; loss++) {
        write_separator(text, loss);
        text_add_word(text, "{");
        write_named_word(text, "name", frame_loss_name(loss));
        write_named_flag(text, "near", view_frame_loss_is_notable(loss));
        text_add_word(text, "}");
    }
    text_add_word(text, "],\n\"paths\":[");
    for (enum path path = 0; frame_path_name(path) != NULL; path++) {
        write_separator(text, path);
        write_word(text, frame_path_name(path));
    }
    text_add_word(text, "],\n");
}

/* The effects by name, and the sets that labels hold as lists of their numbers. */
static void write_effects(const struct view_data *data, struct text *text)
{
    text_add_word(text, "\"effects\":[");
    for (int i = 0; i < EFFECT_COUNT; i++) {
        write_separator(text, (size_t)i);
        write_word(text, effects_names[i]);
    }
    text_add_word(text, "],\n\"effect_sets\":[");
    for (size_t i = 0; i < data->effect_sets.names.count; i++) {
        uint64_t set;
        memcpy(&set, data->effect_sets.names.items[i].text, sizeof set);
        write_separator(text, i);
        const char *separator = "[";
        for (int effect = 0; effect < EFFECT_COUNT; effect++)
            if ((set & EFFECT_BIT(effect)) != 0) {
                text_format(text, "%s%d", separator, effect);
                separator = ",";
            }
        text_add_word(text, set == 0 ? "[]" : "]");
    }
    text_add_word(text, "],\n");
}

static void write_scenes(const struct view_data *data, struct text *text)
{
    text_add_word(text, "\"scenes\":[");
    for (size_t i = 0; i < data->scenes.count; i++) {
        const struct view_scene *scene = &data->scenes.items[i];
        write_separator(text, i);
        text_format(text, "{\"name\":%" PRIu32 ",\"ego\":%" PRIu32 ",\"suite\":%" PRIu32,
                    scene->name, scene->ego, scene->suite);
        write_named_number(text, "first_frame", (double)scene->first_frame);
        write_named_number(text, "start_s", scene->start_s);
        write_named_number(text, "anchor_x_m", scene->anchor_x_m);
        write_named_number(text, "anchor_y_m", scene->anchor_y_m);
        write_named_flag(text, "account", scene->account);
        write_named_flag(text, "ended", scene->ended);
        text_add_word(text, "}");
    }
    text_add_word(text, "],\n");
}

static void write_sensors(const struct view_data *data, struct text *text)
{
    text_add_word(text, "\"sensors\":[");
    for (size_t i = 0; i < data->sensors.count; i++) {
        const struct sensor_view *sensor = &data->sensors.items[i];
        write_separator(text, i);
        text_add_word(text, "{");
        write_named_word(text, "name", sensor->name);
        write_named_number(text, "field_of_view_rad", sensor->field_of_view_rad);
        write_named_number(text, "range_max_m", sensor->range_max_m);
        write_named_number(text, "cell_range_m", sensor->cell_range_m);
        write_named_number(text, "cell_range_rate_mps", sensor->cell_range_rate_mps);
        text_add_word(text, "}");
    }
    text_add_word(text, "],\n");
}

static void write_points(const struct reflector_set *set, struct text *text)
{
    write_key(text, "points");
    text_add_word(text, "[");
    for (size_t i = 0; i < set->points.count; i++) {
        const struct point_reflector *point = &set->points.items[i];
        write_separator(text, i);
        text_add_word(text, "{");
        write_named_word(text, "name", point->name);
        write_named_number(text, "x", point->x);
        write_named_number(text, "y", point->y);
        write_named_number(text, "inset_m", point->inset_m);
        write_named_number(text, "facing_rad", point->facing_rad);
        text_add_word(text, "}");
    }
    text_add_word(text, "]");
}

static void write_line(struct text *text, const char *name, const double ends[4], double spacing_m)
{
    text_add_word(text, "{");
    write_named_word(text, "name", name);
    write_named_number(text, "from_x", ends[0]);
    write_named_number(text, "from_y", ends[1]);
    write_named_number(text, "to_x", ends[2]);
    write_named_number(text, "to_y", ends[3]);
    if (spacing_m > 0)
        write_named_number(text, "spacing_m", spacing_m);
    text_add_word(text, "}");
}

static void write_lines(const struct reflector_set *set, struct text *text)
{
    write_key(text, "planes");
    text_add_word(text, "[");
    for (size_t i = 0; i < set->planes.count; i++) {
        const struct plane_reflector *plane = &set->planes.items[i];
        double ends[] = {plane->from_x, plane->from_y, plane->to_x, plane->to_y};
        write_separator(text, i);
        write_line(text, plane->name, ends, 0);
    }
    text_add_word(text, "]");
    write_key(text, "rows");
    text_add_word(text, "[");
    for (size_t i = 0; i < set->rows.count; i++) {
        const struct post_row *row = &set->rows.items[i];
        double ends[] = {row->from_x, row->from_y, row->to_x, row->to_y};
        write_separator(text, i);
        write_line(text, row->name, ends, row->spacing_m);
    }
    text_add_word(text, "]");
}

static void write_classes(const struct view_data *data, struct text *text)
{
    text_add_word(text, "\"classes\":[");
    for (size_t i = 0; i < data->models.list.count; i++) {
        const struct view_model *model = &data->models.list.items[i];
        write_separator(text, i);
        text_add_word(text, "{");
        write_named_word(text, "name", model->class);
        write_named_flag(text, "known", model->vehicle != NULL);
        const struct reflector_set none = {0};
        const struct reflector_set *set =
            model->vehicle != NULL ? &model->vehicle->reflectors : &none;
        write_points(set, text);
        write_lines(set, text);
        text_add_word(text, "}");
    }
    text_add_word(text, "],\n");
}

void view_head_write(const struct view_data *data, int64_t open_frame, struct text *text)
{
    text_format(text, "{\"open_frame\":%" PRId64 ",\n", open_frame);
    write_names(data, text);
    write_effects(data, text);
    write_scenes(data, text);
    write_sensors(data, text);
    write_classes(data, text);
    view_columns_write_places(&data->columns, text);
    text_add_word(text, "}\n");
}
