/* Setup and teardown for cmocka: a fresh directory with one file in it and an arena, for tests that
 * read what they write. The file's name is the constant SCRATCH_FILE. */
#pragma once

#include <unistd.h>

#include "base/arena.h"
#include "check.h"

struct scratch {
    char directory[64];
    char path[96];
    struct arena arena;
};

static inline int make_scratch(void **state)
{
    struct scratch *scratch = calloc(1, sizeof *scratch);
    assert_non_null(scratch);
    strcpy(scratch->directory, "/tmp/glint-test-XXXXXX");
    assert_non_null(mkdtemp(scratch->directory));
    snprintf(scratch->path, sizeof scratch->path, "%s/%s", scratch->directory, SCRATCH_FILE);
    *state = scratch;
    return 0;
}

static inline int remove_scratch(void **state)
{
    struct scratch *scratch = *state;
    arena_free(&scratch->arena);
    unlink(scratch->path);
    rmdir(scratch->directory);
    free(scratch);
    return 0;
}

#define SCRATCH_TEST(name) TEST_WITH(make_scratch, remove_scratch, struct scratch *scratch, name)
