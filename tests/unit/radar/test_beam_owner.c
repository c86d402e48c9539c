#include "check.h"

#include "radar/beam_owner.h"

enum { MOST = 4 };

struct parts {
    double part[MOST][MOST]; /* [echo][beam] */
    double amplitude[MOST];
    size_t owner[MOST];
};

static double part_of(const void *of, size_t echo, size_t beam)
{
    const struct parts *parts = of;
    return parts->part[echo][beam];
}

static double amplitude_of(const void *of, size_t echo)
{
    const struct parts *parts = of;
    return parts->amplitude[echo];
}

static struct beam_owner owners_of(struct parts *parts, size_t echoes, size_t beams)
{
    struct beam_owner owners = {
        .beams = beams,
        .echoes = echoes,
        .part = part_of,
        .amplitude = amplitude_of,
        .of = parts,
        .owner = parts->owner,
    };
    beam_owner_find(&owners);
    return owners;
}

TEST(the_largest_part_of_at_least_half_owns_an_echo)
{
    struct parts parts = {
        .part = {{0.5, 0.6, 0.55}, {0.5, 0.5, 0}, {0.49, 0.3, 0.1}, {0, 0, 0.5}},
    };
    owners_of(&parts, 4, 3);
    assert_int_equal(parts.owner[0], 1);
    assert_int_equal(parts.owner[1], 0);
    assert_true(parts.owner[2] == BEAM_OWNER_NONE);
    assert_int_equal(parts.owner[3], 2);
}

TEST(without_beams_no_echo_has_an_owner)
{
    struct parts parts = {.part = {{1}}};
    owners_of(&parts, 1, 0);
    assert_true(parts.owner[0] == BEAM_OWNER_NONE);
}

TEST(a_beam_shows_its_own_echoes_in_their_order)
{
    struct parts parts = {.part = {{1, 0}, {0, 1}, {0.7, 0}}, .amplitude = {1, 50, 3}};
    struct beam_owner owners = owners_of(&parts, 3, 2);
    size_t shown[MOST];
    bool repeats = true;
    assert_int_equal(beam_owner_shown(&owners, 0, 0, shown, &repeats), 2);
    assert_int_equal(shown[0], 0);
    assert_int_equal(shown[1], 2);
    assert_false(repeats);
}

/* The first echo is the other beam's; of the second and third, which make the same, the second
 * counts, and has an owner from then on. */
TEST(a_beam_without_an_echo_of_its_own_shows_the_one_that_makes_most_of_it)
{
    struct parts parts = {.part = {{1, 0.1}, {0.4, 0.4}, {0.2, 0.2}}, .amplitude = {2, 5, 10}};
    struct beam_owner owners = owners_of(&parts, 3, 2);
    size_t shown[MOST];
    bool repeats = true;
    assert_int_equal(beam_owner_shown(&owners, 1, 2, shown, &repeats), 1);
    assert_int_equal(shown[0], 1);
    assert_false(repeats);
    assert_int_equal(parts.owner[1], 1);
    parts.amplitude[0] = 100;
    parts.owner[1] = BEAM_OWNER_NONE;
    assert_int_equal(beam_owner_shown(&owners, 1, 2, shown, &repeats), 1);
    assert_int_equal(shown[0], 0);
    assert_true(repeats);
    assert_int_equal(parts.owner[0], 0);
}

TEST(what_makes_too_little_of_a_beam_is_not_shown)
{
    struct parts parts = {.part = {{1, 0.1}}, .amplitude = {2}};
    struct beam_owner owners = owners_of(&parts, 1, 2);
    size_t shown[MOST];
    bool repeats;
    assert_int_equal(beam_owner_shown(&owners, 1, 0.21, shown, &repeats), 0);
    assert_false(repeats);
    assert_int_equal(beam_owner_shown(&owners, 1, 0.2, shown, &repeats), 1);
}
