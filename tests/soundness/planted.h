/* What a planted fault may need to know. Every program of this folder links one planted_*.c; those
 * with a fault in it define a module of lib/ anew, so that the linker leaves the sound one out. */
#ifndef SOUNDNESS_PLANTED_H
#define SOUNDNESS_PLANTED_H

/* Called before each run of the chain over a scene. */
void planted_begin(void);

#endif
