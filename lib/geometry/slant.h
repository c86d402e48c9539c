/* What a radar in the plane makes of a reflector at another height (EFFECTS 19): it is farther
 * away, its range rate smaller, its echo weaker, and a linear array reads the angle of a cone,
 * sin(azimuth read) = sin(azimuth) cos(elevation). */
#ifndef SLANT_H
#define SLANT_H

struct slant {
    double range_m; /* slant */
    /* Of the elevation; height is positive upwards. The cosine is also what multiplies range rates
     * in the plane. */
    double sine, cosine;
};

/* distance >= 0 is the range in the plane. Elevation 0 where both are 0. At equal heights the range
 * is the distance, bit by bit, and the cosine 1. */
struct slant slant_of(double distance_m, double height_m);

/* What is read of an azimuth in [-pi, pi]: on the same side of the array, 0 and pi/2 included, and
 * never beyond 90 deg less the elevation. Bit by bit the same at elevation 0. Within 4 ulp. */
double slant_azimuth_rad(struct slant elevation, double azimuth_rad);

/* The factor on amplitude of a Gaussian beam, there and back: 2^-(elevation/half_width)^2. One way
 * it is down by half, 3.01 dB, at half_width > 0 (5 to 10 deg for cars' radars [A]), two ways by
 * twice that in power; which in amplitude is the one-way factor on power. */
double slant_amplitude_factor(struct slant elevation, double half_width_rad);

#endif
