/* Range, azimuth and gain of a reflector at another height. A reflector above or below the sensor
 * is farther away than in the plane, its range rate is smaller, its echo weaker, and a linear array
 * reads the angle of a cone, sin(azimuth read) = sin(azimuth) cos(elevation) (MODEL 14.2). */
#pragma once

struct slant {
    double range_m; /* slant */
    /* Sine and cosine of the elevation, positive upwards. Range rates in the plane are multiplied
     * by the cosine. */
    double sine, cosine;
};

/* distance_m >= 0 is the range in the plane, height_m the reflector's height less the sensor's. The
 * elevation is 0 where both are 0. At equal heights the range is the distance, bit by bit, and the
 * cosine 1. */
struct slant slant_of(double distance_m, double height_m);

/* The azimuth that a linear array reads of a reflector at this azimuth in the plane, in [-pi, pi].
 * It lies on the same side of the array, 0 and pi/2 included, and never beyond 90 deg less the
 * elevation. Bit by bit the same at elevation 0. Within 4 ulp. */
double slant_azimuth_rad(struct slant elevation, double azimuth_rad);

/* The factor on amplitude of a beam that is Gaussian in elevation, for both ways together:
 * 2^-(elevation/half_width)^2. One way the beam is down by half in power, 3.01 dB, at
 * half_width_rad > 0 (5 to 10 deg for radars of cars, assumed); both ways double the decibels, so
 * the factor on amplitude is the one-way factor on power. */
double slant_amplitude_factor(struct slant elevation, double half_width_rad);
