/* Scenes of a scenario: each one is drawn and played.
 *
 * A scene is determined by the source's name, its number and the seed, so any split of the numbers
 * gives the same frames, and two sources share no draw. Within a scene frames come one after
 * another, and the last is that where the ego leaves its road, or that at the end of the scenario.
 */
#pragma once

#include "traffic/road_traffic.h"
#include "traffic/scenario.h"

struct scenario_scenes {
    struct scenario_document document;
    const char *ego;             /* of all scenes; NULL: each one's own */
    const char *name;            /* of the source; part of the address of all draws */
    const char *title;           /* of scenes; NULL: the source's name and the ego's */
    double radius_m;             /* objects farther from the ego are left out; below 0: none are */
    double flow;                 /* factor of all arrivals */
    double rate_hz, duration_s;  /* in place of the scenario's own, unless the rate is 0 */
    bool numbered;               /* does the number follow in a scene's name? */
    int64_t first, end;          /* numbers of the scenes, end not included */
    int64_t number;              /* of the scene that plays, or else of the next */
    struct random_address draws; /* address of the scene that plays */
    struct scenario *scenario;   /* the scene that plays; NULL: none */
    const char *scene;           /* its name */
    int64_t frame, frames;       /* its next frame, and how many it has */
    struct road_traffic roads;
    bool on_road;       /* is the ego one of their vehicles? */
    struct arena arena; /* of the scene */
};

/* Reads "A:B", scenes A to B - 1 (--scenes); NULL is scene 0 alone, whose name has no number. */
int scenario_scenes_choose(struct scenario_scenes *scenes, const char *range, struct diag *diag);

/* Fills header and objects of the next frame, whose seed is set: 1; 0 at the end; -1 after a
 * message. */
int scenario_scenes_next(struct scenario_scenes *scenes, struct frame *frame, struct diag *diag);

/* How many frames there are if all scenes are as long as the present one. */
int64_t scenario_scenes_frames(const struct scenario_scenes *scenes);

/* Frees what is left of the last scene. */
void scenario_scenes_close(struct scenario_scenes *scenes);
