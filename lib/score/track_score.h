/* A tracker's tracks, compared with the objects that are there.
 *
 * The distance of a track and an object is that of their centres in the plane, in metres. An
 * identity switch is an object that is paired with another track than when it was paired last in
 * its scene, however long ago. */
#ifndef TRACK_SCORE_H
#define TRACK_SCORE_H

#include "frame/frame.h"
#include "score/score.h"
#include "score/track.h"

/* Which objects a tracker is expected to have. The ego never is one. */
enum track_truth {
    TRACK_TRUTH_IN_VIEW,  /* the centre is within the range and field of view of some sensor */
    TRACK_TRUTH_DETECTED, /* some target of the frame has an echo of it */
    TRACK_TRUTH_ALL,
};
extern const char *const track_score_truths[];

/* Is what decides that in the frame? Refuses with DIAG_DATA. */
int track_score_check(const struct frame *frame, enum track_truth truth, struct diag *diag);

/* Does the object count? classes is a list of names with commas between, NULL for any. */
bool track_score_counts(const struct frame *frame, const struct object *object,
                        enum track_truth truth, const char *classes);

/* Who was paired with whom last, by scene. Lies in the arena it is given, and grows with the
 * objects. A zeroed one is empty. */
struct track_pairing {
    const char *scene, *object, *track;
};
struct track_memory {
    LIST_OF(struct track_pairing) pairings;
};

/* Notes a pair; true if that is a switch. */
bool track_score_switches(struct track_memory *memory, const char *scene, const char *object,
                          const char *track, struct arena *arena);

/* A scene is over: its pairings are forgotten. */
void track_score_forget(struct track_memory *memory, const char *scene);

/* Adds one frame to the tally, with tracks in the order of their ids. Pairs are noted in memory,
 * which lies in the lasting arena. Returns how many switches there were. */
int64_t track_score_frame(struct score_tally *tally, const struct frame *frame,
                          const struct track_list *list, enum track_truth truth,
                          const char *classes, double cutoff_m, struct track_memory *memory,
                          struct arena *lasting);

#endif
