/* Other radars that raise the noise floor (EFFECTS 12).
 *
 * A radar in view is heard one way, EIRP G lambda^2/((4 pi)^2 R^2), far above echoes, but chirps of
 * other slopes cross the receiver's band only for a moment: on average over the hits, its power
 * over the noise counts by the share of the time that it is in band. What it adds counts as noise:
 * the floor rises by 1 + INR in power. Several interferers add their ratios. */
#ifndef INTERFERER_H
#define INTERFERER_H

/* 10 lg(k T0 B/1 mW) + noise figure, T0 = 290 K; bandwidth > 0. */
double interferer_noise_dbm(double bandwidth_hz, double noise_figure_db);

/* gain_db is the receiver's towards the interferer; wavelength and range > 0. */
double interferer_power_dbm(double eirp_dbm, double gain_db, double wavelength_m, double range_m);

/* The part of a chirp during which another radar is in band, 2 B/(|slope difference| T), at most 1:
 * equal slopes stay in band. bandwidth is the receiver's (IF), > 0; chirp > 0. */
double interferer_overlap(double bandwidth_hz, double slope_difference_hzps, double chirp_s);

/* The effective ratio of interference to noise, in power. hit_share in [0, 1]: the part of the
 * chirps that are crossed at all. */
double interferer_ratio(double power_dbm, double noise_dbm, double overlap, double hit_share);

/* What the noise's amplitude is multiplied by, sqrt(1 + INR). */
double interferer_noise_factor(double ratio);

#endif
