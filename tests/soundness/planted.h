/* The interface of a planted fault. Every program of this folder links one planted_*.c, and the
 * linker sends calls of FUNCTION to the __wrap_FUNCTION that it defines: an unsound decision in
 * place of the one in lib/, which is __real_FUNCTION. */
#pragma once

/* Called before each run of the chain over a scene. */
void planted_begin(void);
