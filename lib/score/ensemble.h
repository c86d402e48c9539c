/* Target lists of many seeds, compared as random lists (MODEL 11.2).
 *
 * Two streams hold the same scenes, each of several independent seeds. For every scene, frame and
 * sensor the lists of the seeds are samples of two random lists. Their energy distance is averaged
 * over the frames and sensors of a scene, and then over scenes. */
#pragma once

#include "base/intern.h"
#include "base/text.h"
#include "frame/frame.h"
#include "score/energy_distance.h"
#include "text/field.h"

struct ensemble_scene;

/* The seeds of each scene in one stream, with their target lists. */
struct ensemble {
    struct arena *arena; /* memory of all that the ensemble keeps */
    struct intern names; /* of scenes: a name's number is that of its scene */
    LIST_OF(struct ensemble_scene) scenes;
};

struct ensemble_scene_score {
    const char *scene;
    int64_t lists;                    /* frames times the sensors that measured on both sides */
    int64_t true_lists, listed_lists; /* that one side alone has, which are not compared */
    int64_t true_seeds, listed_seeds;
    double true_targets, listed_targets; /* mean number in a list */
    double energy;                       /* D, dimensionless, of embedded lists */
    double energy_error;                 /* its standard error, by the jackknife over seeds */
    double low, high;                    /* its 95 % interval over seeds; not written */
};

struct ensemble_score {
    LIST_OF(struct ensemble_scene_score) scenes;
    double energy;    /* mean of the scenes' energies */
    double low, high; /* 95 % interval of energy: bootstrap over scenes; for one scene over its
                       * seeds */
};

extern const struct record ensemble_score_record;

/* The targets of one sensor of a frame, embedded and closed. Cells are those of the view, a
 * twentieth of the field of view in azimuth, 3 dB of level; what it makes lies in the arena. */
struct embedded_list ensemble_embed(const struct frame *frame, const struct sensor_view *view,
                                    struct arena *arena);

/* Adds the lists of a frame, of every sensor. Refuses a frame that does
 * not come behind the last one of its scene and seed (DIAG_DATA). */
int ensemble_add(struct ensemble *ensemble, const struct frame *frame, struct diag *diag);

/* Scores listed against truth. Cells are those of the sensors of the truth; azimuth_cell_rad counts
 * as one cell of azimuth (0: a twentieth of the field of view), 3 dB as one of level. Refuses with
 * DIAG_DATA streams of other scenes, frames, times or sensors, seeds of one scene with other
 * frames or scans, scenes of fewer than 3 seeds on either side, a seed on both sides, scenes in
 * which no sensor measured on both sides, and a truth whose cells have no width or differ between
 * seeds. */
int ensemble_compare(const struct ensemble *truth, struct ensemble *listed, double azimuth_cell_rad,
                     struct arena *arena, struct ensemble_score *score, struct diag *diag);

/* Writes a table for people: the energy distance of every scene, a row each, and of all together.
 */
void ensemble_table(const struct ensemble_score *score, struct text *text);
