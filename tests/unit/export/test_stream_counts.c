#include "check.h"

#include "export/stream_counts.h"

enum { MANY = 2500 };

/* What is written of a frame of traffic with so many cars and one truck. */
static void check_shares(size_t cars, const char *first, const char *second)
{
    static struct object objects[MANY + 1];
    for (size_t i = 0; i <= cars; i++) {
        objects[i] = (struct object){.class = i < cars ? "car" : "truck"};
        objects[i].id = arena_format(check_arena(), "%zu", i);
    }
    struct frame frame = {.scene = "s", .last = true, .objects = {objects, cars + 1, MANY + 1}};
    struct stream_counts counts = {.arena = check_arena()};
    struct text *text = check_text();
    assert_done(stream_counts_add, &counts, &frame);
    stream_counts_write(&counts, text);
    text_add(text, "", 1);
    assert_non_null(strstr(text->bytes, first));
    assert_non_null(strstr(text->bytes, second));
    arena_free(&counts.open_names);
}

TEST(a_share_reads_as_none_or_all_only_if_it_is)
{
    check_shares(0, "          1  100.0 %  truck\n", "1 objects");
    check_shares(249, "        249   99.6 %  car\n", "          1    0.4 %  truck\n");
    check_shares(1998, "       1998   99.9 %  car\n", "          1    0.1 %  truck\n");
    check_shares(2499, "       2499  99.96 %  car\n", "          1   0.04 %  truck\n");
}
