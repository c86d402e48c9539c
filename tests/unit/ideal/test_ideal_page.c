/* The numbers that lib/ideal/MODEL.md prints. */
#include "support/knife_edge.h"
#include "support/printed.h"

#include "base/elementary.h"
#include "base/units.h"
#include "geometry/kinematics.h"
#include "geometry/mirror.h"
#include "geometry/obstruction.h"
#include "propagation/ground_return.h"
#include "propagation/micro_doppler.h"
#include "propagation/reflection.h"
#include "radar/radar_equation.h"

static const struct vec2 ahead = {1, 0}, origin = {0, 0}, still = {0, 0};

/* A ghost's power beside that of the direct echo, in dB. */
static double power_db(struct mirror_ghost ghost, const struct kinematics *direct)
{
    double ratio = direct->range_m / ghost.kinematics.range_m;
    return 20 * log10(ghost.ercs_factor * ratio * ratio);
}

static void check_path(const char *text, struct mirror_ghost ghost, const struct kinematics *direct)
{
    PRINTED("14.1", text, ghost.kinematics.range_m, ghost.kinematics.range_rate_mps,
            ghost.kinematics.azimuth_rad / DEGREE, power_db(ghost, direct));
}

TEST(the_example_of_ghosts)
{
    struct vec2 place_m = {30, -2}, velocity_mps = {-5, 0};
    struct mirror mirror = mirror_of((struct vec2){-10, 4}, (struct vec2){50, 4},
                                     (struct motion){.yaw_rad = 0}, origin);
    struct mirror_image image = mirror_image(&mirror, place_m, velocity_mps);
    struct kinematics direct = kinematics_of(origin, still, ahead, place_m, velocity_mps);
    struct kinematics seen = kinematics_of(origin, still, ahead, image.place_m, image.velocity_mps);
    PRINTED("14.1", "direct # m # m/s # deg", direct.range_m, direct.range_rate_mps,
            direct.azimuth_rad / DEGREE);
    check_path("wall_object # # # # dB",
               mirror_ghost_one_way(0.9, &direct, &seen, direct.azimuth_rad), &direct);
    check_path("object_wall # # # #", mirror_ghost_one_way(0.9, &direct, &seen, seen.azimuth_rad),
               &direct);
    check_path("wall_object_wall # # # #", mirror_ghost_both_ways(0.9, &seen), &direct);
}

TEST(materials_of_mirrors)
{
    struct material_permittivity concrete = reflection_permittivity(MATERIAL_CONCRETE, 77e9);
    PRINTED("14.1", "concrete has # TE, # TM at 60 deg",
            cabs(reflection_fresnel(&concrete, MATERIAL_TE, 0.5)),
            cabs(reflection_fresnel(&concrete, MATERIAL_TM, 0.5)));
    PRINTED("14.1", "sqrt(λ d), is # m for 5 m at 77 GHz", sqrt(5 * units_wavelength_m(77e9)));
    PRINTED("14.1", "where D is # at 60 deg", reflection_divergence(20, 1.5, 0.5, 5));
}

static struct slant raised(double distance_m)
{
    return kinematics_slant(distance_m, 0.5);
}

TEST(elevations)
{
#define OVER(d) raised(d).range_m - (d)
    PRINTED("14.2", "R - d is #, #, #, # m and cos ε #, #, #, #", OVER(3), OVER(5), OVER(10),
            OVER(30), raised(3).cosine, raised(5).cosine, raised(10).cosine, raised(30).cosine);
}

/* The loss under a van that begins there, by the wave that the road mirrors. */
static double under_db(double from_m)
{
    double to_m = from_m + 6.5;
    const struct vec2 van[] = {{from_m, -1.08}, {to_m, -1.08}, {to_m, 1.08}, {from_m, 1.08}};
    const struct obstruction_line line = {{0, 0}, {40, 0}, 0.5, -0.48};
    const struct obstruction_heights body = {0.19, 2.86};
    struct obstruction past = obstruction_of(van, 4, body, &line, units_wavelength_m(76.5e9));
    return -units_amplitude_db(past.factor);
}

static double asphalt_db(double degrees)
{
    struct two_ray_road asphalt = {.permittivity = {5, 0.25}, .roughness_m = 1e-3};
    double wavelength_m = units_wavelength_m(76.5e9);
    double _Complex once =
        reflection_road(&asphalt, POLARIZATION_VERTICAL, wavelength_m, sin(degrees * DEGREE));
    return -2 * units_amplitude_db(cabs(once));
}

TEST(heights)
{
    PRINTED("14.3", "dry asphalt takes # dB there and back at 1.4 deg", asphalt_db(1.4));
    PRINTED("14.3", "there and back, in dB # # # # # # # # # # #", under_db(8), under_db(10),
            under_db(12), under_db(13), under_db(14), under_db(18), under_db(20), under_db(21),
            under_db(22), under_db(24), under_db(26));
}

static double shadow_db(double carrier_hz)
{
    return 2 *
           knife_edge_db(obstruction_edge_parameter(0.3, 15, 15, units_wavelength_m(carrier_hz)));
}

TEST(edges)
{
    PRINTED("14.4", "J is #, #, # dB at nu = 0, 1, 2, where Fresnel's integral has #, #, #.",
            knife_edge_db(0), knife_edge_db(1), knife_edge_db(2), knife_edge_exact_db(0),
            knife_edge_exact_db(1), knife_edge_exact_db(2));
    PRINTED("14.4", "loses # dB at the edge itself, nothing from # Fresnel radii outside on",
            2 * knife_edge_db(0), 0.78 / sqrt(2));
    PRINTED("14.4", "over 30 m it loses # dB at 24.125 GHz, # dB at 76.5 GHz", shadow_db(24.125e9),
            shadow_db(76.5e9));
}

static double rail_ercs(double range_m)
{
    return radar_ercs(reflection_curved_cross_section_m2((double)INFINITY, 0.04, range_m));
}

TEST(curvature_and_latency)
{
    PRINTED("14.5", "so # at 10 m and # at 100 m", rail_ercs(10), rail_ercs(100));
    PRINTED("14.6", "# m at 30 m/s and 50 ms", 30 * 0.05);
}

TEST(wheels_and_limbs)
{
    double part_mps = 13.8889 * cos(30 * DEGREE);
    double square = (1 - 0.3 * 0.3 * 0.3) / (3 * 0.7);
    PRINTED("14.11", "give 0 to # m/s, a deviation of # m/s sqrt(<ρ^2>), with <ρ^2> = #",
            micro_doppler_wheel_rate_mps(part_mps, part_mps, (struct wheel_point){1, 0}),
            part_mps / sqrt(2), square);
    PRINTED("14.12", "P(n = 0) is # for limbs and # for wheels", exp(-MICRO_DOPPLER_LIMB_COUNT),
            exp(-MICRO_DOPPLER_WHEEL_COUNT));
}

TEST(clutter)
{
    struct motion ego = {.velocity_mps = {20, 0}, .yaw_rate_radps = 0.3};
    struct sensor_pose pose = kinematics_sensor_pose(&ego, 3.6, 0.7, 0);
    double rate_mps = ground_return_range_rate_mps(pose.velocity_mps, pose.boresight, 40 * DEGREE);
    PRINTED("14.13", "at (3.6, 0.7) m make # m/s at 40 deg", rate_mps);
    PRINTED("14.13", "0.003 per m^2 make # points in the beam of `lrr77-full`",
            0.003 * ground_return_area_m2(0.2, 250, 18 * DEGREE));
}
