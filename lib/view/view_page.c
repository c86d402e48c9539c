#include "view/view_page.h"

#include <assert.h>

#include "text/record_write.h"
#include "view/view_marks.h"

struct reason {
    const char *name;
    bool notable;
};

struct effect_set {
    uint64_t effects;
};

struct head {
    int64_t open_frame;
    LIST_OF(const char *) names, paths, kinds, effects, light, dark;
    LIST_OF(struct view_shape) shapes;
    LIST_OF(struct reason) reasons;
    LIST_OF(struct effect_set) effect_sets;
    LIST_OF(struct view_scene) scenes;
    LIST_OF(struct sensor_view) sensors;
    LIST_OF(struct view_column_place) columns;
};

static const struct field reason_fields[] = {
    {FIELD_NAME_OF(struct reason, name, "its name in frames")},
    {FIELD_FLAG_OF(struct reason, notable, "is such a loss shown on the map?")},
    {0},
};
static const struct record reason_record = {
    .name = "reason", .size = sizeof(struct reason), .fields = reason_fields};

static const struct field effect_set_fields[] = {
    {FIELD_SET_OF(struct effect_set, effects, effects_names, "effects that changed a target")},
    {0},
};
static const struct record effect_set_record = {
    .name = "effects", .size = sizeof(struct effect_set), .fields = effect_set_fields};

static const struct field ground_fields[] = {
    {FIELD_NAME_OF(struct view_ground, kind, "what it is")},
    {FIELD_REAL_IN(struct view_ground, from_x_m, -1e10, 1e10, "where it begins")},
    {FIELD_REAL_IN(struct view_ground, from_y_m, -1e10, 1e10, "where it begins")},
    {FIELD_REAL_IN(struct view_ground, to_x_m, -1e10, 1e10, "where it ends")},
    {FIELD_REAL_IN(struct view_ground, to_y_m, -1e10, 1e10, "where it ends")},
    {FIELD_REAL_IN(struct view_ground, width_m, 0, 100, "half of it to each side; 0: a line")},
    {0},
};
static const struct record ground_record = {
    .name = "ground", .size = sizeof(struct view_ground), .fields = ground_fields};

#define NAME_NUMBER(member)                                                                        \
    FIELD_INTEGER_IN(struct view_scene, member, 0, UINT32_MAX, "number of its name")
static const struct field scene_fields[] = {
    {NAME_NUMBER(name)},
    {FIELD_SEED_OF(struct view_scene, seed, "tells it from scenes of the same name")},
    {NAME_NUMBER(ego)},
    {NAME_NUMBER(suite)},
    {FIELD_INTEGER_IN(struct view_scene, first_frame, 0, 0x1p53,
                      "number of the first frame in the stream")},
    {FIELD_REAL_IN(struct view_scene, start_s, -1e10, 1e10, "time of that frame")},
    {FIELD_REAL_IN(struct view_scene, anchor_x_m, -1e10, 1e10, "place of the ego in that frame")},
    {FIELD_REAL_IN(struct view_scene, anchor_y_m, -1e10, 1e10, "place of the ego in that frame")},
    {OPTIONAL_LIST(struct view_scene, ground, &ground_record, "lines and bands on the ground")},
    {FIELD_FLAG_OF(struct view_scene, ended, "does the stream have its last frame?")},
    {0},
};
static const struct record scene_record = {
    .name = "scene", .size = sizeof(struct view_scene), .fields = scene_fields};

static const struct field place_fields[] = {
    {FIELD_NAME_OF(struct view_column_place, name, "of the column")},
    {FIELD_NAME_OF(struct view_column_place, type, "kind and bytes of its numbers")},
    {FIELD_INTEGER_IN(struct view_column_place, count, 0, 0x1p53, "of numbers")},
    {FIELD_INTEGER_IN(struct view_column_place, begin, 0, 0x1p53, "number of its first character")},
    {0},
};

static const struct record place_record = {
    .name = "column", .size = sizeof(struct view_column_place), .fields = place_fields};

static const struct field shape_fields[] = {
    {FIELD_INTEGER_IN(struct view_shape, corners, 0, 100, "0: a circle")},
    {FIELD_REAL_IN(struct view_shape, inner, 0, 1, "radius of a star's inner corners; 0: none")},
    {FIELD_REAL_IN(struct view_shape, turn_rad, 0, 10, "first corner, clockwise from the top")},
    {FIELD_REAL_IN(struct view_shape, size, 0, 10, "radius, in radii of a mark")},
    {0},
};
static const struct record shape_record = {
    .name = "shape", .size = sizeof(struct view_shape), .fields = shape_fields};

static const struct field head_fields[] = {
    {FIELD_INTEGER_IN(struct head, open_frame, -1, 0x1p53,
                      "number of the frame to open; -1: the page's choice")},
    {FIELD_NAMES_OF(struct head, names, "names, by number")},
    {FIELD_NAMES_OF(struct head, paths, "paths of echoes, by number")},
    {FIELD_NAMES_OF(struct head, kinds, "kinds of targets, by the number of their path")},
    {FIELD_NAMES_OF(struct head, light, "colours of sensors on light paper")},
    {FIELD_NAMES_OF(struct head, dark, "colours of sensors on dark paper")},
    {FIELD_LIST_OF(struct head, shapes, &shape_record, "shapes of targets, by sensor")},
    {FIELD_NAMES_OF(struct head, effects, "effects, by number")},
    {FIELD_LIST_OF(struct head, reasons, &reason_record, "reasons of losses, by number")},
    {FIELD_LIST_OF(struct head, effect_sets, &effect_set_record, "sets of effects, by number")},
    {FIELD_LIST_OF(struct head, scenes, &scene_record, "scenes, by number")},
    {FIELD_LIST_OF(struct head, sensors, &sensor_view_record, "sensors, by number")},
    {FIELD_LIST_OF(struct head, columns, &place_record, "places of the columns")},
    {0},
};
static const struct record head_record = {
    .name = "head", .size = sizeof(struct head), .fields = head_fields};

/* Adds the lists whose items the columns refer to by number. */
static void add_numbered(const struct view_data *data, struct head *head)
{
    struct arena *arena = data->arena;
    for (size_t i = 0; i < data->columns.names.list.count; i++)
        *list_add(&head->names, arena) = data->columns.names.list.items[i].text;
    for (enum path path = 0; frame_paths[path] != NULL; path++) {
        *list_add(&head->paths, arena) = frame_paths[path];
        *list_add(&head->kinds, arena) = view_marks_kind(path);
    }
    for (int i = 0; i < VIEW_COLOURS; i++) {
        *list_add(&head->light, arena) = view_marks_light[i];
        *list_add(&head->dark, arena) = view_marks_dark[i];
    }
    for (int i = 0; i < VIEW_SHAPES; i++)
        *list_add(&head->shapes, arena) = view_marks_shapes[i];
    for (int effect = 0; effect < EFFECT_COUNT; effect++)
        *list_add(&head->effects, arena) = effects_names[effect];
    for (enum loss loss = 0; frame_losses[loss] != NULL; loss++)
        *list_add(&head->reasons, arena) =
            (struct reason){frame_losses[loss], view_frame_loss_is_notable(loss)};
    for (size_t i = 0; i < data->losses.own_reasons.list.count; i++)
        *list_add(&head->reasons, arena) =
            (struct reason){data->losses.own_reasons.list.items[i].text, true};
    for (size_t i = 0; i < data->effect_sets.list.count; i++)
        memcpy(list_add(&head->effect_sets, arena), data->effect_sets.list.items[i].text,
               sizeof(uint64_t));
}

void view_page_write_head(const struct view_data *data, int64_t open_frame, struct text *text)
{
    struct view_column_place places[COLUMN_COUNT];
    struct head head = {
        .open_frame = open_frame,
        .scenes = {data->scenes.items, data->scenes.count, 0},
        .sensors = {data->sensors.items, data->sensors.count, 0},
        .columns = {places, COLUMN_COUNT, 0},
    };
    struct text plain = {0};
    view_columns_places(&data->columns, places);
    add_numbered(data, &head);
    record_write(&head_record, &head, NULL, &plain);
    for (size_t i = 0; i < plain.length; i++)
        if (plain.bytes[i] == '<')
            text_add_word(text, "\\u003c");
        else
            text_add(text, plain.bytes + i, 1);
    text_free(&plain);
}

/* Adds the page from *from up to the mark; moves *from behind the mark. */
static void add_page(struct text *text, const char **from, const char *mark)
{
    const char *at = strstr(*from, mark);
    assert(at != NULL);
    text_add(text, *from, (size_t)(at - *from));
    *from = at + strlen(mark);
}

void view_page_write(const struct view_data *data, int64_t open_frame, struct text *text)
{
    const char *from = view_page;
    add_page(text, &from, "@head@\n");
    view_page_write_head(data, open_frame, text);
    add_page(text, &from, "@columns@\n");
    view_columns_write(&data->columns, text);
    text_add_word(text, from);
}
