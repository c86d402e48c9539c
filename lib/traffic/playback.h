/* Frames of a scenario document, played in time. */
#ifndef PLAYBACK_H
#define PLAYBACK_H

#include "frame/frame.h"
#include "traffic/scenario.h"

struct playback {
    const char *ego;
    struct vec2 origin_m; /* origin of the frames' coordinates in those of the source */
    int64_t frames;
    struct scenario *scenario;
};

/* Opens the scenario of that name or path. ego is the id of the ego; NULL leaves it to the
 * scenario. What the playback holds lies in the arena. */
int playback_open(struct playback *playback, const char *source, const char *ego,
                  struct arena *arena, struct diag *diag);

/* Fills time, interval, origin and objects of frame number 0 <= number < frames. */
void playback_frame(const struct playback *playback, int64_t number, struct frame *frame);

/* Refuses a frame with an object out of the bounds of its record, for instance too far from the
 * origin or turning too fast (DIAG_CONFIG). The message names its id and the frame. */
int playback_check(const struct frame *frame, struct diag *diag);

#endif
