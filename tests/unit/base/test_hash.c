#include "check.h"

#include "base/hash.h"

enum { SAMPLES = 200000 };

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

static int compare(const void *left, const void *right)
{
    uint64_t a = *(const uint64_t *)left, b = *(const uint64_t *)right;
    return (a > b) - (a < b);
}

/* Names like those of objects: no two hashes are equal, and every bit of the hash is set half of
 * the time. */
TEST(similar_names_have_unrelated_hashes)
{
    uint64_t *hashes = malloc(SAMPLES * sizeof *hashes);
    int set[64] = {0};
    for (int i = 0; i < SAMPLES; i++) {
        char name[24];
        size_t length = (size_t)snprintf(name, sizeof name, "veh_%d", i);
        hashes[i] = hash_bytes(HASH_START, name, length);
        for (int bit = 0; bit < 64; bit++)
            set[bit] += (int)(hashes[i] >> bit & 1);
    }
    /* Six standard deviations of a fair coin. */
    for (int bit = 0; bit < 64; bit++)
        assert_close((double)set[bit], SAMPLES / 2.0, 6 * sqrt(SAMPLES / 4.0));
    qsort(hashes, SAMPLES, sizeof *hashes, compare);
    for (int i = 1; i < SAMPLES; i++)
        assert_true(hashes[i - 1] != hashes[i]);
    free(hashes);
}

/* One bit of input turns half of the output's bits. */
TEST(every_bit_of_the_input_counts)
{
    unsigned char bytes[16] = "0123456789abcde";
    uint64_t plain = hash_bytes(HASH_START, bytes, sizeof bytes);
    int turned = 0;
    for (size_t bit = 0; bit < 8 * sizeof bytes; bit++) {
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        uint64_t change = hash_bytes(HASH_START, bytes, sizeof bytes) ^ plain;
        bytes[bit / 8] ^= (unsigned char)(1 << bit % 8);
        int count = 0;
        for (int i = 0; i < 64; i++)
            count += (int)(change >> i & 1);
        assert_in_range(count, 10, 54);
        turned += count;
    }
    assert_close(turned / (8.0 * sizeof bytes), 32.0, 2);
}
