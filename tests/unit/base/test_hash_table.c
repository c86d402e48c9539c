#include "check.h"

#include "base/hash.h"

enum { COUNT = 4096 };

static bool is_word(const void *words, uint32_t number, const void *wanted)
{
    return strcmp(((const char *const *)words)[number], wanted) == 0;
}

static uint32_t *slot_of(const struct hash_table *table, const char *const *words, const char *word)
{
    uint64_t hash = hash_table_hash(0, word, strlen(word));
    return hash_table_slot(table, hash, is_word, words, word);
}

/* Twice as many as the table was made for still fit. */
TEST(what_went_in_is_found_again)
{
    static char text[COUNT][16];
    const char *words[COUNT];
    struct hash_table table = hash_table_begin(COUNT / 2, check_arena());
    for (uint32_t i = 0; i < COUNT; i++) {
        snprintf(text[i], sizeof text[i], "vehicle_%u", i);
        words[i] = text[i];
        uint32_t *slot = slot_of(&table, words, words[i]);
        assert_int_equal(*slot, 0);
        *slot = i + 1;
    }
    for (uint32_t i = 0; i < COUNT; i++)
        assert_int_equal(*slot_of(&table, words, words[i]), i + 1);
}

/* The most of these hashes that belong into one slot of twice as many. */
static int most_in_a_slot(const uint64_t *hashes)
{
    static int taken[2 * COUNT];
    int most = 0;
    memset(taken, 0, sizeof taken);
    for (int i = 0; i < COUNT; i++) {
        int *slot = &taken[(hashes[i] >> 32) * 2 * COUNT >> 32];
        most = ++*slot > most ? *slot : most;
    }
    return most;
}

/* Names that differ at any place, and small numbers, spread as if by chance: more than 8 in a slot
 * then have a probability below 1e-4. */
TEST(the_hash_spreads_names_and_numbers)
{
    static const char *const begins[] = {"", "car_", "row_of_posts_", "articulated_truck_"};
    static const char *const ends[] = {"", "_left", "_of_the_left_rear_wheel_house"};
    uint64_t hashes[COUNT];
    for (int form = 0; form < 12; form++) {
        for (int i = 0; i < COUNT; i++) {
            char name[64];
            int length = snprintf(name, sizeof name, "%s%d%s", begins[form % 4], i, ends[form / 4]);
            hashes[i] = hash_table_hash(0, name, (size_t)length);
        }
        assert_in_range(most_in_a_slot(hashes), 1, 8);
    }
    for (int shift = 0; shift <= 48; shift += 8) {
        for (uint64_t i = 0; i < COUNT; i++)
            hashes[i] = hash_table_mix(1, i << shift);
        assert_in_range(most_in_a_slot(hashes), 1, 8);
    }
}

TEST(a_hash_goes_on_from_an_earlier_one)
{
    assert_true(hash_table_hash(1, "a", 1) != hash_table_hash(2, "a", 1));
    assert_true(hash_table_hash(0, "", 0) != hash_table_hash(0, "\0", 1));
    assert_true(hash_table_hash(0, "12345678", 8) != hash_table_hash(0, "1234567812345678", 16));
}
