/* Effects that the document of a sensor describes.
 *
 * Only effects that a sensor may lack count: neither those of every sensor, such as threshold, nor
 * those that the scene describes, such as clutter and rain. Levels of bodies stand for fluctuation:
 * a sensor with levels does not lack it. */
#pragma once

#include "documents/suite.h"

/* The set of effects (frame/effects.h) that the sensor's document does not describe. */
uint64_t suite_effects_missing(const struct sensor *sensor);

/* A shipped suite that describes all effects but a few. */
struct suite_effects_example {
    const char *name;
    uint64_t missing; /* the set of effects that its sensors lack, too */
};

/* The example whose sensors reach about as far as this one. */
struct suite_effects_example suite_effects_example(const struct sensor *sensor);
