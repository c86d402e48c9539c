#include "view/view_head.h"

#include "text/record_text.h"

struct reason {
    const char *name;
    bool notable;
};

struct effect_set {
    uint64_t effects;
};

struct head {
    int64_t open_frame;
    LIST_OF(const char *) names, paths, effects;
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
    {FIELD_FLAG_OF(struct view_scene, ended, "does the stream have its last frame?")},
    {0},
};
static const struct record scene_record = {
    .name = "scene", .size = sizeof(struct view_scene), .fields = scene_fields};

static const struct field head_fields[] = {
    {FIELD_INTEGER_IN(struct head, open_frame, -1, 0x1p53,
                      "number of the frame to open; -1: the page's choice")},
    {FIELD_NAMES_OF(struct head, names, "names, by number")},
    {FIELD_NAMES_OF(struct head, paths, "paths of echoes, by number")},
    {FIELD_NAMES_OF(struct head, effects, "effects, by number")},
    {FIELD_LIST_OF(struct head, reasons, &reason_record, "reasons of losses, by number")},
    {FIELD_LIST_OF(struct head, effect_sets, &effect_set_record, "sets of effects, by number")},
    {FIELD_LIST_OF(struct head, scenes, &scene_record, "scenes, by number")},
    {FIELD_LIST_OF(struct head, sensors, &sensor_view_record, "sensors, by number")},
    {FIELD_LIST_OF(struct head, columns, &view_column_place_record, "places of the columns")},
    {0},
};
static const struct record head_record = {
    .name = "head", .size = sizeof(struct head), .fields = head_fields};

/* Adds the lists whose items the columns refer to by number. */
static void add_numbered(const struct view_data *data, struct head *head)
{
    struct arena *arena = data->arena;
    for (size_t i = 0; i < data->names.list.count; i++)
        *list_add(&head->names, arena) = data->names.list.items[i].text;
    for (enum path path = 0; frame_path_name(path) != NULL; path++)
        *list_add(&head->paths, arena) = frame_path_name(path);
    for (int effect = 0; effect < EFFECT_COUNT; effect++)
        *list_add(&head->effects, arena) = effects_names[effect];
    for (enum loss loss = 0; frame_loss_name(loss) != NULL; loss++)
        *list_add(&head->reasons, arena) =
            (struct reason){frame_loss_name(loss), view_frame_loss_is_notable(loss)};
    for (size_t i = 0; i < data->own_reasons.list.count; i++)
        *list_add(&head->reasons, arena) =
            (struct reason){data->own_reasons.list.items[i].text, true};
    for (size_t i = 0; i < data->effect_sets.list.count; i++)
        memcpy(list_add(&head->effect_sets, arena), data->effect_sets.list.items[i].text,
               sizeof(uint64_t));
}

void view_head_write(const struct view_data *data, int64_t open_frame, struct text *text)
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
    record_text_write(&head_record, &head, NULL, &plain);
    for (size_t i = 0; i < plain.length; i++)
        if (plain.bytes[i] == '<')
            text_add_word(text, "\\u003c");
        else
            text_add(text, plain.bytes + i, 1);
    text_free(&plain);
}
