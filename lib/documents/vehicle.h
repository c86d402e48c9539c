/* Documents of classes of road users and things. They hold size, reflection centres and other
 * models of a class (data/vehicles/). */
#pragma once

#include "documents/reflector_models.h"
#include "frame/frame.h"

struct vehicle {
    const char *origin;
    double length_m, width_m, height_m;      /* for objects that have no size of their own */
    double rear_axle_x_m;                    /* from the centre of the box; 0: not given */
    struct reflector_set reflectors;         /* belongs to no object yet */
    enum sensing_target_3gpp sensing_target; /* for glint-extract-3gpp */
    struct contour contour;                  /* for glint-extract-contour */
    char digest[17];                         /* of the document */
};

extern const struct record vehicle_record;

/* Refuses what cannot be a class: a path, or a name with a dot that is no file NAME.json of the
 * working folder (DIAG_DATA). */
int vehicle_check_class(const char *class, struct diag *diag);

/* Finds, reads and checks the document of a class: in folder, if that is not NULL, before all other
 * places (text/document.h). All it holds lies in the arena; NULL after a message (DIAG_CONFIG). */
const struct vehicle *vehicle_load(const char *class, const char *folder, struct arena *arena,
                                   struct diag *diag);

/* Refuses the vehicle (DIAG_CONFIG) if the frame names another document of its class. */
int vehicle_check_frame(const struct vehicle *vehicle, const struct frame *frame,
                        struct diag *diag);
