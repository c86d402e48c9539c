#include "score/track.h"

#include <string.h>

#include "base/sort.h"

static const struct field track_fields[] = {
    {FIELD_NAME_OF(struct track, id, "unique in the line; stays with its object")},
    {FIELD_REAL_IN(struct track, x_m, -1e7, 1e7, "centre of the box, as objects have it")},
    {FIELD_REAL_IN(struct track, y_m, -1e7, 1e7, "centre of the box, as objects have it")},
    {FIELD_REAL_IN(struct track, vx_mps, -1e4, 1e4, "over ground")},
    {FIELD_REAL_IN(struct track, vy_mps, -1e4, 1e4, "over ground")},
    {FIELD_RAW_OF(struct track, extra, "yours: not looked at")},
    {0},
};

static const struct record track_record = {
    .name = "track",
    .help = "An object as the tracker has it.",
    .size = sizeof(struct track),
    .fields = track_fields,
};

static const struct field list_fields[] = {
    {FIELD_NAME_OF(struct track_list, scene, "of the frame")},
    {FIELD_INTEGER_IN(struct track_list, frame, 0, 0x1p53, "its number in the scene")},
    {FIELD_REAL_IN(struct track_list, time_s, -1e10, 1e10, "if given, the frame's"), FIELD_OPTIONAL,
     .section = TRACK_TIME},
    {FIELD_LIST_OF(struct track_list, tracks, &track_record, "in any order; may be empty")},
    {FIELD_RAW_OF(struct track_list, extra, "yours: not looked at")},
    {0},
};

const struct record track_list_record = {
    .name = "tracks",
    .help = "What a tracker says of one frame: a line for glint-score-tracks.",
    .size = sizeof(struct track_list),
    .fields = list_fields,
    .present_offset = offsetof(struct track_list, present),
};

static int compare(const void *left, const void *right)
{
    return strcmp(((const struct track *)left)->id, ((const struct track *)right)->id);
}

int track_order(struct track_list *list, struct arena *arena, struct diag *diag)
{
    sort_list(&list->tracks, compare, arena);
    for (size_t i = 1; i < list->tracks.count; i++)
        if (compare(&list->tracks.items[i - 1], &list->tracks.items[i]) == 0)
            return diag_fail(diag, DIAG_DATA, "tracks: the id \"%s\" stands twice",
                             list->tracks.items[i].id);
    return 0;
}
