/* Addresses of random numbers, from frame, sensor and echo.
 *
 * An address (random.h) holds the frame's seed, scene and number, the sensor, and the identity of
 * the echo. Random numbers of a cell have the address of its leader. */
#pragma once

#include "base/random.h"
#include "frame/frame.h"

/* The address of a sensor's whole scan, with no echo. */
struct random_address draw_address_of_scan(const struct frame *frame, const char *sensor);

/* The address of an echo in that scan. */
struct random_address draw_address_in(struct random_address scan, struct echo_id id);

/* The address of an echo: both of the above in one. */
struct random_address draw_address_of(const struct frame *frame, const char *sensor,
                                      struct echo_id id);
