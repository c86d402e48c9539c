/* Angles, wavelengths and decibels. Decibels of amplitude and of power never share a function.
 * Streams and decisions are linear; decibels appear only in documents (thresholds), in targets and
 * in losses. */
#pragma once

#define PI 3.14159265358979323846
#define SPEED_OF_LIGHT_MPS 299792458.0

/* 20 log10 of amplitude >= 0; -infinity at 0. */
double units_amplitude_db(double amplitude);

/* The dB, at least 0, by which amplitude >= 0 falls short of a positive threshold; at most 1e4,
 * which also stands for an amplitude of 0. */
double units_shortfall_db(double threshold, double amplitude);

/* 10^(db/20). */
double units_amplitude_from_db(double db);

/* The natural logarithm of 10^(db/20). */
double units_amplitude_logarithm(double db);

/* The wavelength of a carrier, which must be positive. */
double units_wavelength_m(double carrier_hz);

/* The same direction in (-pi, pi], never -PI, within 1e-15 rad for every finite angle. */
double units_wrap_rad(double angle_rad);

/* sin(x)/x, 1 at 0. Within 2 ulp for |x| <= 3 without a series: sin is accurate near 0. */
double units_si(double x);

/* The nearest multiple of step, halves away from 0. The value is unchanged if step is 0 or |value /
 * step| is at least 2^52. */
double units_rounded(double value, double step);
