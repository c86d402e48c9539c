#include "radar/beam_owner.h"

void beam_owner_find(const struct beam_owner *beams)
{
    for (size_t echo = 0; echo < beams->echoes; echo++) {
        double most = 0;
        beams->owner[echo] = BEAM_OWNER_NONE;
        for (size_t beam = 0; beam < beams->beams; beam++) {
            double part = beams->part(beams->of, echo, beam);
            if (part >= BEAM_OWNER_LEAST_PART && part > most) {
                most = part;
                beams->owner[echo] = beam;
            }
        }
    }
}

/* The echo that makes most of a beam's amplitude. */
static size_t dominant_of(const struct beam_owner *beams, size_t beam, double least)
{
    size_t dominant = BEAM_OWNER_NONE;
    double most = 0;
    for (size_t echo = 0; echo < beams->echoes; echo++) {
        double amplitude = beams->amplitude(beams->of, echo) * beams->part(beams->of, echo, beam);
        if (amplitude < least)
            continue;
        if (dominant == BEAM_OWNER_NONE || amplitude > most) {
            most = amplitude;
            dominant = echo;
        }
    }
    return dominant;
}

size_t beam_owner_shown(const struct beam_owner *beams, size_t beam, double least, size_t *shown,
                        bool *repeats)
{
    size_t count = 0;
    *repeats = false;
    for (size_t echo = 0; echo < beams->echoes; echo++)
        if (beams->owner[echo] == beam)
            shown[count++] = echo;
    if (count > 0)
        return count;
    size_t dominant = dominant_of(beams, beam, least);
    if (dominant == BEAM_OWNER_NONE)
        return 0;
    *repeats = beams->owner[dominant] != BEAM_OWNER_NONE;
    if (!*repeats)
        beams->owner[dominant] = beam;
    shown[0] = dominant;
    return 1;
}
