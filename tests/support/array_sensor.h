/* Arrays of one transmitter and a row of receivers. */
#pragma once

#include "documents/suite.h"

/* The array of count receivers this many wavelengths apart. */
static inline struct array array_row(size_t count, double spacing, enum array_taper taper)
{
    struct array_element transmit = {0}, receive[ARRAY_MOST_ELEMENTS];
    struct array_layout layout = {.taper = taper};
    for (size_t n = 0; n < count; n++)
        receive[n].place = spacing * (double)n;
    layout.transmit.items = &transmit;
    layout.receive.items = receive;
    layout.transmit.count = 1;
    layout.receive.count = count;
    return array_of(&layout);
}

/* Gives the sensor, which must not have one, such an array without a taper. */
static inline void array_sensor_add(struct sensor *sensor, size_t count, double spacing)
{
    sensor->beams = array_row(count, spacing, TAPER_RECTANGULAR);
    sensor->array.transmit.count = 1;
    sensor->array.receive.count = count;
    sensor->antenna.pattern = ANTENNA_ARRAY;
    sensor->angle_estimator = MONOPULSE_BEAMS;
}
