#include "score/track.h"

#include "base/sort.h"
#include "frame/frame_order.h"

static const struct field track_fields[] = {
    {FIELD_NAME_OF(struct track, id,
                   "unique in the line; constant for an object; a number is its digits"),
     .or_number = true},
    {FIELD_REAL_IN(struct track, x_m, -1e7, 1e7,
                   "centre of the object's box, in the frame's coordinates")},
    {FIELD_REAL_IN(struct track, y_m, -1e7, 1e7,
                   "centre of the object's box, in the frame's coordinates")},
    {FIELD_REAL_IN(struct track, vx_mps, -1e4, 1e4, "velocity over ground")},
    {FIELD_REAL_IN(struct track, vy_mps, -1e4, 1e4, "velocity over ground")},
    {FIELD_RAW_OF(struct track, extra, "any value, for your own use; not read")},
    {0},
};

static const struct record track_record = {
    FIELD_TABLE(struct track, track_fields, "track", "A track of an object.")};

static const struct field list_fields[] = {
    {FIELD_NAME_OF(struct track_list, scene, "scene of the frame")},
    {FIELD_INTEGER_IN(struct track_list, frame, 0, 0x1p53, "number of the frame in its scene")},
    {OPTIONAL_REAL(struct track_list, time_s, -1e10, 1e10, "time of the frame; compared if given"),
     .section = TRACK_TIME},
    {FIELD_LIST_OF(struct track_list, tracks, &track_record,
                   "the tracks, in any order; may be empty")},
    {FIELD_RAW_OF(struct track_list, extra, "any value, for your own use; not read")},
    {0},
};

const struct record track_list_record = {
    FIELD_TABLE(struct track_list, list_fields, "tracks",
                "A tracker's tracks in one frame: a line for glint-score-tracks."),
    .present_offset = offsetof(struct track_list, present)};

_Static_assert(offsetof(struct track, id) == 0, "frame_order_names compares it");

int track_order(struct track_list *list, struct arena *arena, struct diag *diag)
{
    sort_list(&list->tracks, frame_order_names, arena);
    for (size_t i = 1; i < list->tracks.count; i++)
        if (frame_order_names(&list->tracks.items[i - 1], &list->tracks.items[i]) == 0)
            return diag_fail(diag, DIAG_DATA, "tracks: the id \"%s\" stands twice",
                             list->tracks.items[i].id);
    return 0;
}
