#include "check.h"

#include "frame/margins.h"

TEST(a_margin_is_the_least_that_was_noted)
{
    struct margins margins = {0};
    assert_int_equal(margins.present, 0);
    margins_note(&margins, MARGIN_LEADER, 3);
    margins_note(&margins, MARGIN_LEADER, 2);
    margins_note(&margins, MARGIN_LEADER, 5);
    margins_note(&margins, MARGIN_SIGN, 0);
    margins_note(&margins, MARGIN_SIGHT, (double)INFINITY);
    margins_note(&margins, MARGIN_LIMIT_M, (double)NAN);
    assert_int_equal(margins.present, MARGIN_LEADER | MARGIN_SIGN);
    assert_close(margins.leader_db, 2, 0);
    assert_close(margins.sign, 0, 0);
}

TEST(every_kind_has_its_member)
{
    struct margins margins = {0};
    for (int kind = 0; kind < 7; kind++)
        margins_note(&margins, (enum margin)(1 << kind), kind);
    const double members[] = {margins.sight_m,   margins.threshold_db, margins.leader_db,
                              margins.cell_edge, margins.sign,         margins.limit_db,
                              margins.limit_m};
    for (int kind = 0; kind < 7; kind++)
        assert_close(members[kind], kind, 0);
    assert_int_equal(margins.present, 127);
}

TEST(merging_keeps_the_least_of_each)
{
    struct margins one = {0}, other = {0};
    margins_note(&one, MARGIN_SIGHT, 1);
    margins_note(&one, MARGIN_SIGN, 0.5);
    margins_note(&other, MARGIN_SIGHT, 2);
    margins_note(&other, MARGIN_SIGN, 0.25);
    margins_note(&other, MARGIN_LIMIT_M, 7);
    margins_merge(&one, &other);
    assert_int_equal(one.present, MARGIN_SIGHT | MARGIN_SIGN | MARGIN_LIMIT_M);
    assert_close(one.sight_m, 1, 0);
    assert_close(one.sign, 0.25, 0);
    assert_close(one.limit_m, 7, 0);
    margins_merge(&other, &(struct margins){0});
    assert_close(other.sight_m, 2, 0);
}

TEST(amplitudes_are_apart_in_decibels)
{
    static const double cases[][3] = {{10, 1, 20}, {1, 10, 20},          {3, 3, 0},
                                      {0, 1, 1e4}, {1e300, 1e-300, 1e4}, {100, 1, 40}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++)
        assert_close(margins_between_db(cases[i][0], cases[i][1]), cases[i][2], 1e-12);
}
