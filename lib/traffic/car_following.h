/* Car following by the Intelligent Driver Model, and exact stops.
 *
 * Treiber, Hennecke and Helbing, "Congested traffic states in empirical observations and
 * microscopic simulations" (2000), with exponent 4 and s1 = 0: behind a leader at v_l, s ahead,
 *
 *     dv/dt = a (1 - (v/v0)^4 - (s* / s)^2),  s* = s0 + max(0, v T + v (v - v_l) / (2 sqrt(a b))),
 *
 * so that at the leader's speed the gap is (s0 + v T) / sqrt(1 - (v/v0)^4). */
#pragma once

/* All positive; the headway may be 0. */
struct car_following {
    double speed_mps;         /* v0, wanted on a free road */
    double headway_s;         /* T */
    double gap_m;             /* s0, when standing */
    double acceleration_mps2; /* a */
    double deceleration_mps2; /* b, comfortable */
};

/* gap_m: from bumper to bumper, INFINITY on a free road; negative infinity at a gap of 0. */
double car_following_acceleration_mps2(const struct car_following *driver, double speed_mps,
                                       double gap_m, double leader_mps);

/* Moves on for duration_s at a constant acceleration. Who comes to a stop on the way stands from
 * there, exactly where the parabola has its vertex: the speed is never negative. */
void car_following_move(double *place_m, double *speed_mps, double acceleration_mps2,
                        double duration_s);
