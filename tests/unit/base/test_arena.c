#include "check.h"

#include <sys/wait.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/diag.h"
#include "sample.h"

TEST(memory_is_zeroed_aligned_and_does_not_overlap)
{
    struct arena arena = {0};
    uint64_t random = 1;
    for (int round = 0; round < 3; round++) {
        char *places[2000];
        size_t sizes[2000];
        for (int i = 0; i < 2000; i++) {
            sizes[i] = sample_bits(&random) % (i % 100 == 0 ? 200000 : 300);
            places[i] = arena_get(&arena, sizes[i]);
            assert_int_equal((uintptr_t)places[i] % _Alignof(max_align_t), 0);
            for (size_t j = 0; j < sizes[i]; j++)
                assert_true(places[i][j] == 0);
            memset(places[i], i % 127 + 1, sizes[i]);
        }
        for (int i = 0; i < 2000; i++)
            for (size_t j = 0; j < sizes[i]; j++)
                assert_true(places[i][j] == i % 127 + 1);
        arena_clear(&arena);
    }
    arena_free(&arena);
    assert_null(arena.blocks);
}

TEST(a_cleared_arena_keeps_its_room)
{
    struct arena arena = {0};
    void *first = NULL;
    const struct arena_block *block = NULL;
    for (int round = 0; round < 10; round++) {
        void *start = arena_get(&arena, 1);
        for (int i = 0; i < 300; i++)
            arena_get(&arena, 5000);
        arena_get(&arena, 1000000);
        /* The first round takes many blocks, the second one block, and that stays. */
        if (round == 1) {
            first = start;
            block = arena.blocks;
        } else if (round > 1) {
            assert_ptr_equal(start, first);
            assert_ptr_equal(arena.blocks, block);
        }
        arena_clear(&arena);
    }
    arena_free(&arena);
}

TEST(text_is_copied_and_ended)
{
    struct arena arena = {0};
    const char *copy = arena_text(&arena, "abcdef", 3);
    assert_string_equal(copy, "abc");
    assert_string_equal(arena_text(&arena, NULL, 0), "");
    arena_clear(&arena);
    arena_free(&arena);
    arena_clear(&arena);
    arena_free(&arena);
}

TEST(lists_grow_and_keep_their_items)
{
    struct arena arena = {0};
    struct item {
        int64_t number;
        char more[40];
    };
    for (int round = 0; round < 3; round++) {
        LIST_OF(struct item) list = {0};
        for (int64_t i = 0; i < 10000; i++) {
            struct item *item = list_add(&list, &arena);
            assert_int_equal(item->number, 0);
            assert_int_equal(item->more[39], 0);
            item->number = i;
            item->more[39] = 'x';
            assert_true(list.count <= list.room);
        }
        assert_int_equal(list.count, 10000);
        for (int64_t i = 0; i < 10000; i++)
            assert_int_equal(list.items[i].number, i);
        arena_clear(&arena);
    }
    arena_free(&arena);
}

/* Runs in a child process, because it ends the program. */
static int exit_code_of(void (*ask)(void))
{
    pid_t child = fork();
    if (child == 0) {
        close(STDERR_FILENO);
        ask();
        _exit(0);
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void ask_the_arena_for_everything(void)
{
    struct arena arena = {0};
    arena_get(&arena, SIZE_MAX - 8);
}

static void ask_the_arena_for_half_of_everything(void)
{
    struct arena arena = {0};
    arena_get(&arena, SIZE_MAX / 2);
}

TEST(a_request_too_large_ends_the_program_with_71)
{
    assert_int_equal(exit_code_of(ask_the_arena_for_everything), DIAG_MEMORY);
    assert_int_equal(exit_code_of(ask_the_arena_for_half_of_everything), DIAG_MEMORY);
}
