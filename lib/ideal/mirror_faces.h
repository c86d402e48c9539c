/* The mirrors that are turned to a sensor. */
#pragma once

#include "geometry/mirror.h"
#include "ideal/look.h"

/* Bodies with a mirror in line that ends where a mirror begins, or begins where it ends. */
struct mirror_joints {
    bool known;
    const struct look_body *before, *after;
    bool shares_end; /* a mirror begins exactly there, bit by bit */
};

/* A mirror in the world whose outer face is turned to the sensor. */
struct mirror_face {
    const struct look_body *body;
    int64_t number; /* among the body's mirrors, from 1 */
    struct mirror mirror;
    struct vec2 along; /* unit vector from a to b */
    const struct mirror_plane *plane;
    struct material_permittivity permittivity; /* of its material at the sensor's carrier */
    bool in_view;                              /* false: surely out of the field of view */
    struct mirror_joints *joints;              /* found at the first bounce */
};

struct mirror_faces {
    LIST_OF(struct mirror_face) list;
};

/* The mirrors that may have a path: every path touches its mirror within the sensor's range and,
 * under auto, less than 90 deg off boresight. */
struct mirror_faces mirror_faces_of(const struct look *look);

const struct mirror_joints *mirror_faces_joints(const struct look *look,
                                                const struct mirror_face *face);

/* True if the mirror has a bounce for the place. A bounce exactly on an end that two mirrors share
 * belongs to the next one. */
bool mirror_faces_bounce(const struct look *look, const struct mirror_face *face, struct vec2 place,
                         struct vec2 *bounce);
