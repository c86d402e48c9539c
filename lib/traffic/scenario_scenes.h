/* Scenes of a scenario: each one is drawn and played.
 *
 * A scene depends on the source's name, its own number and the seed. So any split of the numbers
 * gives the same frames, and two sources share no draw. A scene ends where the ego leaves its road,
 * or with the scenario. */
#pragma once

#include "traffic/road_traffic.h"
#include "traffic/scenario.h"

struct scenario_scenes {
    struct scenario_document document;
    const char *ego;             /* of all scenes; NULL: that of the scenario */
    const char *name;            /* of the source; part of the address of all draws */
    const char *title;           /* of scenes; NULL: the names of source and ego */
    double radius_m;             /* objects farther from the ego are left out; < 0: none are */
    double flow;                 /* factor on all arrivals */
    double rate_hz, duration_s;  /* replace those of the scenario, unless the rate is 0 */
    bool numbered;               /* names of scenes end with their numbers */
    int64_t first, end;          /* numbers of the scenes, end not included */
    int64_t number;              /* of the present scene, else of the next */
    struct random_address draws; /* address of the present scene */
    struct scenario *scenario;   /* the present scene; NULL: none */
    const char *scene;           /* its name */
    int64_t frame, frames;       /* number of its next frame; number of its frames */
    struct road_traffic roads;
    bool on_road;       /* the ego is a vehicle of the roads */
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
