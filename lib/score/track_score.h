/* A tracker's tracks: line format, and score against the objects.
 *
 * The distance of a track and an object is that of their centres in the plane, in metres. An
 * identity switch is an object that is paired with another track than when it was last paired in
 * its scene, however long ago. A track that is paired with no object and lies on one that is not
 * expected is excused: it is no false track, and is not counted. */
#pragma once

#include "base/intern.h"
#include "frame/frame.h"
#include "score/score.h"

/* A track, in the coordinates of the frame's objects: the centre of the object's box, relative to
 * the frame's origin, and the velocity of that centre over ground. */
struct track {
    const char *id; /* constant while the tracker takes it for the same object */
    double x_m, y_m, vx_mps, vy_mps;
    double variance_x_m2, covariance_xy_m2, variance_y_m2; /* of the place */
    const char *extra;
    unsigned present; /* TRACK_COVARIANCE: the track has the covariance of its place */
};

enum { TRACK_COVARIANCE = 1 << 0 };

enum { TRACK_TIME = 1 << 0 };

struct track_list {
    const char *scene;
    int64_t frame;
    double time_s;
    LIST_OF(struct track) tracks;
    const char *extra;
    unsigned present; /* TRACK_TIME: the line has time_s */
};

extern const struct record track_list_record;

/* Sorts the tracks by id; refuses an id of two tracks, and a covariance that is not positive
 * definite (DIAG_DATA). */
int track_score_order(struct track_list *list, struct arena *arena, struct diag *diag);

/* The objects that a tracker is expected to have. The ego is never one. */
enum track_truth {
    TRACK_TRUTH_IN_VIEW,  /* objects whose centre is within range and field of view of a sensor */
    TRACK_TRUTH_DETECTED, /* objects with an echo in a target of the frame */
    TRACK_TRUTH_ALL,
};
extern const char *const track_score_truths[];

/* Refuses a frame without the part that decides which objects count (DIAG_DATA). */
int track_score_check(const struct frame *frame, enum track_truth truth, struct diag *diag);

/* Classes of what stands beside the road. */
#define TRACK_SCORE_STRUCTURES "guardrail,post,wall"

/* True if the tracker is expected to have the object. classes is a list of names separated by
 * commas, NULL for any but structures. */
bool track_score_counts(const struct frame *frame, const struct object *object,
                        enum track_truth truth, const char *classes);

enum { TRACK_SCORE_CUTOFF_M = 5 }; /* tracks so far off an object are not paired with it */
enum { TRACK_SCORE_BESIDE_M = 2 }; /* tracks at most so far off the box of an object lie on it */

/* The last track of every object, by scene. It lies in the arena it is given and grows with the
 * objects. A zeroed one is empty. */
struct track_pairing {
    const char *scene, *object, *track;
};
struct track_memory {
    LIST_OF(struct track_pairing) pairings;
};

/* Records a pair. Returns the track that it replaces (an identity switch), or NULL. */
const char *track_score_replaced(struct track_memory *memory, const char *scene, const char *object,
                                 const char *track, struct arena *arena);

/* Forgets the pairs of a scene that is over. */
void track_score_forget(struct track_memory *memory, const char *scene);

/* An expected object and its track, and the distance of their centres. object is NULL for a false
 * or excused track, track for a missed object. */
struct track_pair {
    const struct object *object;
    const struct track *track;
    double apart_m;
    bool excused;
};

struct track_pairs {
    LIST_OF(struct track_pair) list;
};

/* Pairs as the score does: all expected objects, and then all other tracks, each in the order of
 * their ids. The pairs lie in the frame's arena. */
struct track_pairs track_score_pairs(const struct frame *frame, const struct track_list *list,
                                     enum track_truth truth, const char *classes);

/* Adds one frame, with tracks in the order of their ids, to the tally. Pairs are recorded in
 * memory, which lies in the lasting arena. Where no sensor measured, no object can be detected: the
 * tracks are counted as a scan of their own. Returns the number of identity switches. */
int64_t track_score_frame(struct score_tally *tally, const struct frame *frame,
                          const struct track_list *list, enum track_truth truth,
                          const char *classes, struct track_memory *memory, struct arena *lasting);

/* Adds the classes of the frame's objects but the ego to those seen. */
void track_score_note_classes(struct intern *seen, const struct frame *frame, struct arena *arena);

/* Refuses a class of the list, as of track_score_counts, that was not seen and that no vehicle
 * document describes: it is misspelt (DIAG_DATA). */
int track_score_check_classes(struct intern *seen, const char *classes, struct arena *arena,
                              struct diag *diag);
