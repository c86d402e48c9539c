/* Angles, wavelengths and decibels. Amplitude and power decibels never share a helper; glint's wire
 * and its decisions are linear, decibels appear only in documents (thresholds), in targets and in
 * losses.
 */
#ifndef UNITS_H
#define UNITS_H

#define PI 3.14159265358979323846
#define SPEED_OF_LIGHT_MPS 299792458.0

/* 20 log10: amplitude must be positive. */
double units_amplitude_db(double amplitude);

/* How far amplitude >= 0 stays below a positive threshold, in dB >= 0; at most 1e4, which also
 * stands for an amplitude of 0. */
double units_shortfall_db(double threshold, double amplitude);

/* 10^(db/20). */
double units_amplitude_from_db(double db);

/* Of a carrier, which must be positive. */
double units_wavelength_m(double carrier_hz);

/* The same direction in (-pi, pi], which -PI is not: within 1e-15 rad of every finite angle, 1e300
 * rad too (NUMERICS 38). */
double units_wrap_rad(double angle_rad);

/* sin(x)/x, 1 at 0. Within 2 ulp for |x| <= 3 without a series: sin is accurate near 0. */
double units_si(double x);

#endif
