/* Documents of classes of road users and things.
 *
 * A document in data/vehicles/ has the size, the reflection centres and other models of a class. */
#pragma once

#include "documents/reflector_models.h"
#include "frame/frame.h"

struct vehicle {
    const char *origin;
    double length_m, width_m, height_m;      /* for objects that have no size of their own */
    double rear_axle_x_m;                    /* from the centre of the box; 0: not given */
    struct class_level level;                /* of its bodies, in place of the sensor's */
    struct reflector_set reflectors;         /* belongs to no object yet */
    enum sensing_target_3gpp sensing_target; /* for glint-extract-3gpp */
    struct contour contour;                  /* for glint-extract-contour */
    struct surface surface;                  /* of that contour */
    double cell_max_m; /* coarsest range cell that its reflectors are made for; 0: any */
    char digest[17];   /* of the document */
};

extern const struct record vehicle_record;

/* Refuses a class that is a path, or has an ending other than .json (DIAG_DATA). */
int vehicle_check_class(const char *class, struct diag *diag);

/* Finds, reads and checks the document of a class, in `folder` first unless that is NULL, then in
 * the other places (text/document.h). It lies in the arena. NULL after a message (DIAG_CONFIG). */
const struct vehicle *vehicle_load(const char *class, const char *folder, struct arena *arena,
                                   struct diag *diag);

/* Refuses the vehicle (DIAG_CONFIG) if the frame names another document of its class. */
int vehicle_check_frame(const struct vehicle *vehicle, const struct frame *frame,
                        struct diag *diag);
