/* Where frames come from: a scenario document played in time, or a recorded trajectory table. Both
 * are a number of frames, each with the objects that are there. */
#ifndef PLAYBACK_H
#define PLAYBACK_H

#include "frame/frame.h"
#include "traffic/scenario.h"
#include "traffic/trajectory.h"

struct playback {
    const char *ego;
    struct vec2 origin_m; /* of the frames' coordinates in the source's */
    int64_t frames;
    struct scenario *scenario;          /* either this */
    const struct recorded_step **steps; /* or these, in which the ego was recorded */
};

/* Opens a source by its name: a table by its ending (.csv, .csv.gz), else the scenario of that name
 * (or path), else the table of that name. ego may be NULL if a scenario names its own. What the
 * scene holds lies in the arena. */
int playback_open(struct playback *scene, const char *source, const char *ego, struct arena *arena,
                  struct diag *diag);

/* "tracks/7" for ../tracks.csv.gz and ego 7. */
const char *playback_name(const char *source, const char *ego, struct arena *arena);

/* Fills time, interval, origin and objects of frame number 0 <= number < frames. */
void playback_frame(const struct playback *scene, int64_t number, struct frame *frame);

/* Refuses objects of that frame that no frame can hold, as they are too far from its origin, say,
 * or turn too fast, and names their row (DIAG_DATA) or their object in the scenario (DIAG_CONFIG).
 */
int playback_check(const struct playback *scene, int64_t number, const struct frame *frame,
                   struct diag *diag);

#endif
