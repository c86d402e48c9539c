#include "check.h"

#include "base/hash.h"

/* FNV-1a of the piece and its end, with the published offset and prime; then splitmix64's mix. The
 * prime is 2^40 + 0x1b3, so the product is a shift and a small product. */
static uint64_t independent(const unsigned char *bytes, size_t length)
{
    uint64_t hash = UINT64_C(14695981039346656037);
    for (size_t i = 0; i <= length; i++) {
        hash ^= i < length ? bytes[i] : 0x100;
        hash = (hash << 40) + hash * 435;
    }
    hash ^= hash >> 30;
    hash *= UINT64_C(13787848793156543929);
    hash ^= hash >> 27;
    hash *= UINT64_C(10723151780598845931);
    return hash ^ hash >> 31;
}

TEST(the_hash_is_fnv_with_an_end_and_a_mix)
{
    unsigned char bytes[300];
    for (size_t i = 0; i < sizeof bytes; i++)
        bytes[i] = (unsigned char)(i * 37);
    for (size_t length = 0; length <= sizeof bytes; length++)
        assert_true(hash_bytes(HASH_START, bytes, length) == independent(bytes, length));
    assert_true(hash_text(HASH_START, "radar") == hash_bytes(HASH_START, "radar", 5));
}

TEST(the_end_of_a_piece_counts)
{
    static const char *const pieces[][2] = {
        {"a", "bc"}, {"ab", "c"}, {"abc", ""}, {"", "abc"}, {"bc", "a"}};
    uint64_t hashes[5];
    for (size_t i = 0; i < 5; i++) {
        hashes[i] = hash_text(hash_text(HASH_START, pieces[i][0]), pieces[i][1]);
        assert_true(hashes[i] != hash_text(HASH_START, "abc"));
        for (size_t j = 0; j < i; j++)
            assert_true(hashes[i] != hashes[j]);
    }
    assert_true(hash_bytes(HASH_START, "\0", 1) != hash_bytes(HASH_START, "\0\0", 2));
}
