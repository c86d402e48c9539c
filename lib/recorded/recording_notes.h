/* What a recording tells on standard error at its end.
 *
 * Nothing of it is a fault: it says what was spread, left out or cut, and how often. */
#pragma once

struct diag;
struct recording;

/* Adds a sentence for each, in one line. */
void recording_notes(const struct recording *recording, struct diag *diag);
