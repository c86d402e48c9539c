#include "check.h"

#include "base/units.h"
#include "propagation/reflection.h"
#include "sample.h"

static double size(double _Complex reflection)
{
    return hypot(creal(reflection), cimag(reflection));
}

/* Conductivities of ITU-R P.2040-3 at 10 and 77 GHz, times 17.98 over the frequency. */
TEST(permittivities_are_those_of_the_recommendation)
{
    static const struct {
        enum material material;
        double real, loss_10, loss_77;
    } rows[] = {
        {MATERIAL_NONE, 1, 0, 0},
        {MATERIAL_CONCRETE, 5.24, 0.503074, 0.322518},
        {MATERIAL_BRICK, 3.91, 0.061854, 0.011136},
        {MATERIAL_GLASS, 6.31, 0.141414, 0.282727},
        {MATERIAL_METAL, 1, 1.798e7, 2335064.935065},
    };
    for (size_t i = 0; i < COUNT(rows); i++) {
        struct material_permittivity low = reflection_permittivity(rows[i].material, 10e9);
        struct material_permittivity high = reflection_permittivity(rows[i].material, 77e9);
        assert_close(low.real, rows[i].real, 0);
        assert_close(high.real, rows[i].real, 0);
        assert_close(low.loss, rows[i].loss_10, 5.1e-7);
        assert_close(high.loss, rows[i].loss_77, 5.1e-7);
    }
}

TEST(metal_mirrors_everything_but_at_its_brewster_angle)
{
    struct material_permittivity metal = reflection_permittivity(MATERIAL_METAL, 77e9);
    for (double cosine = 0.01; cosine <= 1; cosine += 0.01) {
        assert_true(size(reflection_fresnel(&metal, MATERIAL_TE, cosine)) > 0.999);
        assert_true(size(reflection_fresnel(&metal, MATERIAL_TM, cosine)) > 0.9);
    }
}

TEST(at_brewsters_angle_nothing_of_a_field_in_the_plane_of_incidence_is_left)
{
    for (double real = 1.5; real < 20; real += 0.5) {
        struct material_permittivity permittivity = {real, 0};
        double cosine = 1 / sqrt(1 + real);
        assert_close(size(reflection_fresnel(&permittivity, MATERIAL_TM, cosine)), 0, 1e-15);
        assert_true(size(reflection_fresnel(&permittivity, MATERIAL_TE, cosine)) > 0.15);
    }
}

/* Snell's angle behind the surface, and the impedances there and here. */
TEST(reflection_agrees_with_snells_law)
{
    uint64_t sample = 14;
    for (int i = 0; i < 10000; i++) {
        struct material_permittivity permittivity = {sample_between(&sample, 1.01, 40),
                                                     sample_between(&sample, 0, 40)};
        double cosine = sample_between(&sample, 0, 1);
        double _Complex index = csqrt(permittivity.real - permittivity.loss * (double _Complex)I);
        double _Complex onward = csqrt(1 - (1 - cosine * cosine) / (index * index));
        double _Complex te = (cosine - index * onward) / (cosine + index * onward);
        double _Complex tm = (index * cosine - onward) / (index * cosine + onward);
        assert_close(size(reflection_fresnel(&permittivity, MATERIAL_TE, cosine) - te), 0, 1e-13);
        assert_close(size(reflection_fresnel(&permittivity, MATERIAL_TM, cosine) - tm), 0, 1e-13);
    }
}

TEST(grazing_waves_come_back_turned_over)
{
    for (enum material material = MATERIAL_CONCRETE; material <= MATERIAL_METAL; material++) {
        struct material_permittivity permittivity = reflection_permittivity(material, 24.125e9);
        for (int tm = 0; tm < 2; tm++)
            assert_close(
                size(reflection_fresnel(&permittivity, tm ? MATERIAL_TM : MATERIAL_TE, 0) + 1), 0,
                0);
    }
}
