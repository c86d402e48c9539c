/* A sensor with an array of one transmitter and a row of receivers. */
#pragma once

#include "documents/suite.h"

/* Gives the sensor, which must not have one, count receivers this many wavelengths apart. The array
 * has no taper. */
static inline void array_sensor_add(struct sensor *sensor, size_t count, double spacing)
{
    struct array_element transmit = {0}, receive[ARRAY_MOST_ELEMENTS];
    struct array_layout layout = {.taper = TAPER_RECTANGULAR};
    for (size_t n = 0; n < count; n++)
        receive[n].place = spacing * (double)n;
    layout.transmit.items = &transmit;
    layout.receive.items = receive;
    layout.transmit.count = sensor->array.transmit.count = 1;
    layout.receive.count = sensor->array.receive.count = count;
    sensor->beams = array_of(&layout);
    sensor->antenna.pattern = ANTENNA_ARRAY;
    sensor->angle_estimator = MONOPULSE_BEAMS;
}
