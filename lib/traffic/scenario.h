/* Scenarios of data/scenarios/: objects, roads, conditions. */
#pragma once

#include "base/random.h"
#include "frame/frame.h"
#include "traffic/actor.h"
#include "traffic/road.h"

struct scenario {
    const char *origin;
    const char *ego;
    double rate_hz;
    double duration_s;
    struct conditions conditions;
    LIST_OF(struct roadside_strip) roadside;
    LIST_OF(struct actor) objects;
    LIST_OF(struct roadway) roads; /* lib/traffic/road_traffic.h */
    double warmup_s;
    const char *arriving_ego; /* id of the ego if arrivals have ego_m; else NULL */
    struct vec2 origin_m;     /* of the frames' coordinates in those of the document */
};

extern const struct record scenario_record;

/* Refuses an unknown ego or interferer, an id of two objects or roads, a name that cannot be a
 * class, and what actor_check refuses. */
int scenario_check(struct scenario *scenario, struct diag *diag);

/* Moves every place by -origin_m, before anything is computed: large coordinates cost precision. */
void scenario_shift(struct scenario *scenario, struct vec2 origin_m);

/* The number of frames, and the time i / rate_hz of frame i, from 0. But for rounding the last
 * frame is not after duration_s. */
int64_t scenario_frames(const struct scenario *scenario);
double scenario_time_s(const struct scenario *scenario, int64_t number);

/* The object of this id; NULL if there is none. */
const struct actor *scenario_object(const struct scenario *scenario, const char *id);

/* The document of a scenario, whose values may be distributions (variation_draw). */
struct scenario_document {
    const char *path;
    const char *line;
};

/* Finds and reads the document of this name or path. */
int scenario_read(const char *name, struct scenario_document *document, struct arena *arena,
                  struct diag *diag);

/* A scene of the document: drawn at the address, checked, and shifted to the origin of its frames.
 * ego replaces the scenario's own unless it is NULL. NULL after a message (DIAG_CONFIG). */
struct scenario *scenario_draw(const struct scenario_document *document,
                               struct random_address address, const char *ego, struct arena *arena,
                               struct diag *diag);

/* The origin of frames with an ego that begins here: whole metres near it if it is more than 1 km
 * from the origin of the source (as in UTM), else that origin. */
struct vec2 scenario_frame_origin(struct vec2 ego_m);

/* Fills time, interval, origin, conditions and the scenario's objects of frame `number`. */
void scenario_fill(const struct scenario *scenario, int64_t number, struct frame *frame);

/* Refuses a frame with an object out of the bounds of its record, for instance too far from the
 * origin (DIAG_CONFIG). The message names its id and the frame. */
int scenario_check_frame(const struct frame *frame, struct diag *diag);
