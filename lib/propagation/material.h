/* Permittivity of materials, and Fresnel's reflection at their surface.
 *
 * Permittivities are those of ITU-R P.2040-3, table 3. Its fits hold from 1 to 100 GHz, brick's to
 * 40 GHz, glass's from 0.1 GHz. The surface is that of a half space, the angle of incidence counts
 * from the normal (MODEL 14.1). The electric field is parallel to the surface (TE) or lies in the
 * plane of incidence (TM): an upright field is TE at a wall and TM at the road (MODEL 14.10). */
#pragma once

#include <complex.h>

enum material { MATERIAL_NONE, MATERIAL_CONCRETE, MATERIAL_BRICK, MATERIAL_GLASS, MATERIAL_METAL };
extern const char *const material_names[]; /* in documents, ending with NULL */

enum material_field { MATERIAL_TE, MATERIAL_TM };

struct material_permittivity {
    double real; /* eps' >= 1, relative */
    double loss; /* eps'' >= 0, relative */
};

/* The permittivity at carrier_hz > 0. MATERIAL_NONE has that of air, 1. */
struct material_permittivity material_permittivity(enum material material, double carrier_hz);

/* The coefficient, on amplitude, for cosine in [0, 1]: at most 1 in size, -1 at grazing incidence.
 */
double _Complex material_reflection(const struct material_permittivity *permittivity,
                                    enum material_field field, double cosine);
