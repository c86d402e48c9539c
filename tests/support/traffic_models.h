/* The vehicles of random traffic, from the shipped documents. */
#pragma once

#include "check.h"
#include "documents/vehicle.h"
#include "traffic/random_traffic.h"

static inline void load_traffic_models(struct random_traffic_model models[TRAFFIC_CLASSES],
                                       struct arena *documents)
{
    for (enum random_traffic_class class = 0; class < TRAFFIC_CLASSES; class ++) {
        struct diag diag = {0};
        const struct vehicle *vehicle =
            vehicle_load(random_traffic_class_name(class), NULL, documents, &diag);
        if (vehicle == NULL)
            fail_msg("%s", diag.text);
        models[class] = (struct random_traffic_model){vehicle->length_m, vehicle->width_m,
                                                      &vehicle->reflectors};
    }
}
