#include "check.h"

#include "base/intern.h"
#include "sample.h"

TEST(names_are_numbered_as_they_come)
{
    struct arena *arena = check_arena();
    struct intern names = {0};
    char word[16];
    for (int round = 0; round < 2; round++)
        for (unsigned i = 0; i < 5000; i++) {
            snprintf(word, sizeof word, "w%u", i);
            assert_int_equal(intern_word(&names, word, arena), i);
        }
    assert_int_equal(intern_number(&names, "w1\0x", 4, arena), 5000);
    assert_int_equal(intern_word(&names, "", arena), 5001);
    assert_string_equal(intern_text(&names, 4999), "w4999");
    assert_memory_equal(intern_text(&names, 5000), "w1\0x", 5);
}

/* Names of all lengths, some equal at both ends: each gets its own bytes, and equal names one
 * pointer. */
TEST(equal_names_are_one_pointer_and_others_are_not)
{
    struct arena *arena = check_arena();
    struct intern names = intern_begin(10, arena);
    uint64_t random = 1;
    for (int i = 0; i < 100000; i++) {
        char name[64];
        int length = snprintf(name, sizeof name, "%.*s%llu%s", (int)(sample_bits(&random) % 12),
                              "beginning___", (unsigned long long)sample_bits(&random) % 3000,
                              i % 2 ? "_and_an_end" : "");
        /* Not NUL-terminated, and exactly this much memory, for a sanitizer to see. */
        char *bare = malloc((size_t)length);
        memcpy(bare, name, (size_t)length);
        const char *kept = intern_text(&names, intern_number(&names, bare, (size_t)length, arena));
        assert_string_equal(kept, name);
        assert_ptr_equal(intern_text(&names, intern_word(&names, name, arena)), kept);
        free(bare);
    }
}
