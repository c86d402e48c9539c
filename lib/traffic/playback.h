/* Frames of objects from a scenario or a recording. A playback is a scenario document played in
 * time, or a recorded trajectory table; both are a number of frames, each with the objects of its
 * time. */
#ifndef PLAYBACK_H
#define PLAYBACK_H

#include "frame/frame.h"
#include "traffic/scenario.h"
#include "traffic/trajectory.h"

struct playback {
    const char *ego;
    struct vec2 origin_m; /* origin of the frames' coordinates in those of the source */
    int64_t frames;
    struct scenario *scenario;          /* a scenario, or NULL */
    const struct recorded_step **steps; /* or the steps of a table in which the ego was recorded */
};

/* Opens a source by its name: a table if the name ends in .csv or .csv.gz, else the scenario of
 * that name or path, else the table of that name. ego is the id of the ego; NULL leaves it to the
 * scenario. What the playback holds lies in the arena. */
int playback_open(struct playback *playback, const char *source, const char *ego,
                  struct arena *arena, struct diag *diag);

/* The name of a scene, "tracks/7" for the source ../tracks.csv.gz and ego 7. */
const char *playback_name(const char *source, const char *ego, struct arena *arena);

/* Fills time, interval, origin and objects of frame number 0 <= number < frames. */
void playback_frame(const struct playback *playback, int64_t number, struct frame *frame);

/* Refuses a frame with an object out of the bounds of its record, for instance too far from the
 * origin or turning too fast. The message names the object's row in the table (DIAG_DATA) or its id
 * and frame in the scenario (DIAG_CONFIG). */
int playback_check(const struct playback *playback, int64_t number, const struct frame *frame,
                   struct diag *diag);

#endif
