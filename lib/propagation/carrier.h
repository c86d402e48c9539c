/* Phase lag of an echo, and polarization of its carrier.
 *
 * An echo at range R lags the carrier by 4 pi R / wavelength (MODEL 8.2). */
#pragma once

/* Direction of the electric field: parallel to the road or upright. */
enum polarization { POLARIZATION_HORIZONTAL, POLARIZATION_VERTICAL };

/* The lag of an echo in turns, 2 R / wavelength less the nearest whole number, in [-1/2, 1/2]. For
 * range_m in [0, 1e6] and carrier_hz in [1e9, 1e12] it is within 2e-16 of a turn, however many
 * turns there are (hard case 39). */
double carrier_phase_turns(double range_m, double carrier_hz);
