/* What a scan shows beyond the reflectors of ideal: points on rolling wheels (EFFECTS 8), limbs of
 * people who walk (18) and clutter of the ground (9).
 *
 * They are echoes that are received like all others. A wheel's and a limb's are of the object and
 * reflector that they were made for, their parent, on the path wheel or limb, number 1 and on; they
 * have its height, time, effects and margins, and a part of its cross section. Their parent is a
 * direct echo: ghosts have none. It stays as it is, so that of a wheel or a person that does not
 * move along the sight line, whose parts all have its rate, nothing is made. Clutter is of the
 * object "clutter", which is no object of the frame, and its reflector "ground". */
#ifndef SCATTERERS_H
#define SCATTERERS_H

#include "sensor/received_echo.h"

/* Points of clutter in a scan: of more, those with higher numbers are left out, so that it is
 * thinner everywhere alike. */
enum { SCATTERERS_MOST_CLUTTER = 1000 };

/* All of one scan, of the effects that the reception simulates; memory comes from the frame's
 * arena. What would be out of the sensor's range or view is not made. */
struct echo_span scatterers_of(const struct reception *reception);

/* Counts them in the frame. */
void scatterers_count(struct frame *frame, const char *sensor, struct echo_span scatterers);

#endif
