/* The documents that glint knows, each found by its name, read and checked: vehicles, scenarios and
 * sensor suites. All they hold lies in the given arena; NULL after a message (DIAG_CONFIG). */
#ifndef CATALOGUE_H
#define CATALOGUE_H

#include "contour.h"
#include "reflectors.h"
#include "scenario.h"
#include "sensing_target_3gpp.h"
#include "suite.h"

/* One class of road users or things (data/vehicles/). */
struct vehicle {
    const char *origin;
    double length_m, width_m, height_m; /* where an object of the class gives none */
    struct reflector_set reflectors;    /* worn_by is empty */
    enum sensing_target_3gpp sensing_target; /* for glint-extract-3gpp */
    struct contour contour;             /* for glint-extract-contour */
};

extern const struct record vehicle_record;

const struct vehicle *catalogue_vehicle(const char *class, struct arena *arena, struct diag *diag);
struct scenario *catalogue_scenario(const char *name, struct arena *arena, struct diag *diag);

/* A suite with the tables it names, its derived members, and its digest: a 64-bit hash over the
 * document and every table. */
const struct suite *catalogue_suite(const char *name, struct arena *arena, struct diag *diag);

#endif
