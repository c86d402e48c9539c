/* Rise of a receiver's noise by another radar's chirps (MODEL 14.17).
 *
 * A radar in view is received one way, far above echoes. Chirps of another slope cross the
 * receiver's band for a part of the time; the power received in that time counts as noise. */
#pragma once

/* The receiver's own noise, 10 lg(k T0 B/1 mW) + noise figure, with T0 = 290 K; bandwidth > 0. */
double interferer_noise_dbm(double bandwidth_hz, double noise_figure_db);

/* The power received from an interferer. gain_db is the receiver's antenna gain towards it;
 * wavelength and range > 0. */
double interferer_power_dbm(double eirp_dbm, double gain_db, double wavelength_m, double range_m);

/* The part of the receiver's chirp, of length T, in which an interferer is within the band W around
 * the chirp: W/(|slope difference| T), at most 1, and 1 for equal slopes. W is the highest beat
 * frequency, twice that for real samples, as their image band folds. band_hz, chirp_s > 0. */
double interferer_overlap(double band_hz, double slope_difference_hzps, double chirp_s);

/* The mean INR, a ratio of powers. hit_share in [0, 1] is the part of the receiver's chirps that an
 * interfering chirp crosses at all. */
double interferer_ratio(double power_dbm, double noise_dbm, double overlap, double hit_share);

/* The factor on the noise's amplitude, sqrt(1 + INR). */
double interferer_noise_factor(double ratio);

/* A detection threshold on an amplitude, which rises with the noise. */
double interferer_threshold(double threshold, double ratio);
