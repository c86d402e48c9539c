#include "view/view_losses.h"

#include <assert.h>

#include "base/sort.h"
#include "view/view_frame.h"

/* The numbers that tell what a lost echo is and why it is lost. The columns DETAIL_OBJECT to
 * DETAIL_NUMBER have the first of them, the columns ITEM_REFLECTOR to ITEM_EFFECT all but the
 * object, in this order. */
enum {
    LOST_OBJECT,
    LOST_REFLECTOR,
    LOST_PATH,
    LOST_MIRROR,
    LOST_NUMBER,
    LOST_STAGE,
    LOST_REASON,
    LOST_EFFECT,
    LOST_NUMBERS,
};

/* A lost echo, before it is added to its object's pattern. */
struct loss_row {
    uint32_t of[LOST_NUMBERS];
};

/* A scan whose losses are packed. */
struct loss_scan {
    struct view_losses *losses;
    struct view_columns *columns;
    const struct frame *frame;
    const struct view_scan *scan;
    uint32_t scene;
    LIST_OF(struct loss_row) rows;
};

static void add_detail(struct view_columns *columns, const struct loss_row *row,
                       const struct lost_echo *echo)
{
    view_columns_real(columns, COLUMN_DETAIL_SHORTFALL, echo->shortfall_db);
    view_columns_real(columns, COLUMN_DETAIL_RANGE, echo->range_m);
    view_columns_real(columns, COLUMN_DETAIL_AZIMUTH, echo->azimuth_rad);
    for (int i = LOST_OBJECT; i <= LOST_NUMBER; i++)
        view_columns_count(columns, (enum view_column)(COLUMN_DETAIL_OBJECT + i), row->of[i]);
    view_columns_count(columns, COLUMN_DETAIL_BY, view_columns_optional_name(columns, echo->by));
}

/* Orders by object; within one, in any order that is the same for the same losses. */
static int compare_rows(const void *left, const void *right)
{
    const struct loss_row *a = left, *b = right;
    for (int i = LOST_OBJECT; i <= LOST_REASON; i++)
        if (a->of[i] != b->of[i])
            return a->of[i] < b->of[i] ? -1 : 1;
    return 0;
}

/* The spot of a reflector. The first loss that needs no other detail says where it is. */
static struct vec2 spot_of(const struct loss_scan *scan, const struct loss_row *row,
                           struct vec2 place)
{
    struct view_losses *losses = scan->losses;
    struct view_columns *columns = scan->columns;
    const uint32_t key[] = {scan->scene, row->of[LOST_OBJECT], row->of[LOST_REFLECTOR]};
    uint32_t number = intern_number(&losses->spot_keys, key, sizeof key, columns->arena);
    if (number == losses->spots.count) {
        *list_add(&losses->spots, columns->arena) = place;
        view_columns_real(columns, COLUMN_SPOT_X, place.x);
        view_columns_real(columns, COLUMN_SPOT_Y, place.y);
        view_columns_count(columns, COLUMN_SPOT_SCENE, scan->scene);
        view_columns_count(columns, COLUMN_SPOT_OBJECT, row->of[LOST_OBJECT]);
        view_columns_count(columns, COLUMN_SPOT_REFLECTOR, row->of[LOST_REFLECTOR]);
    }
    return losses->spots.items[number];
}

/* True if the lost echo was within 5 cm of its reflector, as only direct echoes are, or if its
 * place is not known. */
static bool is_at_spot(const struct loss_scan *scan, const struct loss_row *row,
                       const struct lost_echo *echo)
{
    const struct object *object = frame_object_of(scan->frame, &echo->id);
    if (echo->range_m == 0)
        return true;
    if (object == NULL || echo->id.path != PATH_DIRECT)
        return false;
    struct motion body = frame_motion(object, scan->scan->age_s);
    struct vec2 place = vec2_turn_back(
        vec2_sub(view_frame_place(scan->scan, echo->range_m, echo->azimuth_rad), body.position_m),
        vec2_heading(body.yaw_rad));
    struct vec2 spot = spot_of(scan, row, place);
    return vec2_length(vec2_sub(place, spot)) <= 0.05;
}

static uint32_t reason_of(const struct loss_scan *scan, const struct lost_group *group)
{
    enum loss loss = frame_loss_of(group->reason);
    if (loss != LOSS_OWN)
        return loss;
    const char *words = frame_loss_words(group, scan->frame->arena);
    return LOSS_OWN + intern_word(&scan->losses->own_reasons, words, scan->columns->arena);
}

/* Adds a row for each loss of the group; returns how many have a detail. */
static uint32_t collect_losses(struct loss_scan *scan, const struct lost_group *group)
{
    struct view_columns *columns = scan->columns;
    uint32_t details = 0;
    uint32_t stage = view_columns_name(columns, group->stage);
    uint32_t reason = reason_of(scan, group);
    for (size_t i = 0; i < group->echoes.count; i++) {
        const struct lost_echo *echo = &group->echoes.items[i];
        struct loss_row *row = list_add(&scan->rows, scan->frame->arena);
        row->of[LOST_OBJECT] = view_columns_object(columns, &echo->id);
        row->of[LOST_REFLECTOR] = view_columns_name(columns, echo->id.reflector);
        row->of[LOST_PATH] = echo->id.path;
        row->of[LOST_MIRROR] = view_columns_optional_name(columns, echo->id.mirror);
        row->of[LOST_NUMBER] = (uint32_t)echo->id.number;
        row->of[LOST_STAGE] = stage;
        row->of[LOST_REASON] = reason;
        row->of[LOST_EFFECT] = group->effect;
        if (echo->by != NULL || echo->shortfall_db != 0 || !is_at_spot(scan, row, echo)) {
            add_detail(columns, row, echo);
            details++;
        }
    }
    return details;
}

/* Adds the fate of an object, of which all these rows are. */
static void add_fate(const struct loss_scan *scan, const struct loss_row *rows, size_t count)
{
    enum { ITEM = LOST_NUMBERS - LOST_REFLECTOR };
    assert(count > 0);
    struct view_columns *columns = scan->columns;
    size_t size = count * ITEM * sizeof(uint32_t);
    uint32_t *items = arena_get(scan->frame->arena, size);
    for (size_t i = 0; i < count; i++)
        memcpy(items + i * ITEM, rows[i].of + LOST_REFLECTOR, ITEM * sizeof *items);
    view_columns_count(columns, COLUMN_FATE_OBJECT, rows->of[LOST_OBJECT]);
    size_t known = scan->losses->patterns.list.count;
    uint32_t pattern = intern_number(&scan->losses->patterns, items, size, columns->arena);
    view_columns_count(columns, COLUMN_FATE_PATTERN, pattern);
    if (pattern < known)
        return;
    view_columns_count(columns, COLUMN_PATTERN_ITEMS, (uint32_t)count);
    for (size_t i = 0; i < count * ITEM; i++)
        view_columns_count(columns, (enum view_column)(COLUMN_ITEM_REFLECTOR + i % ITEM), items[i]);
}

void view_losses_add(struct view_losses *losses, struct view_columns *columns,
                     const struct frame *frame, const struct view_scan *scan, uint32_t scene,
                     const char *sensor)
{
    struct loss_scan own = {
        .losses = losses, .columns = columns, .frame = frame, .scan = scan, .scene = scene};
    uint32_t details = 0, fates = 0;
    for (size_t i = 0; i < frame->lost.count; i++)
        if (strcmp(frame->lost.items[i].sensor, sensor) == 0)
            details += collect_losses(&own, &frame->lost.items[i]);
    sort_list(&own.rows, compare_rows, frame->arena);
    const struct loss_row *rows = own.rows.items;
    size_t begin = 0;
    for (size_t i = 1; i <= own.rows.count; i++) {
        if (i < own.rows.count && rows[i].of[LOST_OBJECT] == rows[begin].of[LOST_OBJECT])
            continue;
        add_fate(&own, rows + begin, i - begin);
        fates++;
        begin = i;
    }
    view_columns_count(columns, COLUMN_SCAN_FATES, fates);
    view_columns_count(columns, COLUMN_SCAN_DETAILS, details);
}
