/* Extraction of 3GPP's model: cars get five scattering points with lobes, people one point (MODEL
 * 2.8). */
#include "run/extraction.h"

static void describe(const void *state, const struct vehicle *vehicle, struct reflector_set *set,
                     struct arena *arena)
{
    (void)state;
    if (vehicle->sensing_target != SENSING_TARGET_3GPP_NONE)
        reflector_models_of_3gpp(vehicle->sensing_target, set, arena);
}

static int extract_3gpp_step(void *state, struct frame *frame, struct runner *runner)
{
    return extraction_step(state, frame, runner, describe, NULL);
}

const struct stage stage_extract_3gpp = {
    .name = "extract-3gpp",
    .summary = "Write the scattering points of 3GPP TR 38.901 for every object.",
    .details =
        "Stands in for glint-extract. A class whose document says sensing_target vehicle becomes "
        "five points in the middles of front, left, back, right and roof. Each has the report's "
        "lobe in azimuth and elevation, over a floor that is seen from all around. A class with "
        "sensing_target human becomes one point that is the same from everywhere. All other "
        "classes keep the reflectors of their document. Every class mirrors and hides as its "
        "document says. Elevations differ from level only for sensors with mount_z_m. The "
        "report's fluctuation is a property of the sensor: fluctuation log_normal, 3.41 dB for "
        "vehicles.",
    .options = &extraction_record,
    .reads = PART_OBJECTS,
    .writes = PART_REFLECTORS | PART_VEHICLES,
    .start = extraction_start,
    .step = extract_3gpp_step,
};
