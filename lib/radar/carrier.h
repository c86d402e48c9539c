/* The carrier wave: its polarization, and the phase that an echo's way there and back costs (MODEL
 * 8.2). */
#ifndef CARRIER_H
#define CARRIER_H

/* Which way the electric field swings: along the surface of the road or across it. */
enum polarization { POLARIZATION_HORIZONTAL, POLARIZATION_VERTICAL };

/* What is left of the turns 2 R / wavelength, in [-1/2, 1/2], when the whole ones are taken off:
 * the phase 4 pi R / wavelength over 2 pi (NUMERICS 39). range_m in [0, 1e6], carrier_hz in
 * [1e9, 1e12]: within 2e-16 of a turn, however many there are. The echo lags by it. */
double carrier_phase_turns(double range_m, double carrier_hz);

#endif
