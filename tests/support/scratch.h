/* Setup and teardown for cmocka: a fresh directory for files and an arena, for tests that read what
 * they write. The path of the file SCRATCH_FILE in it is at hand; no file is there at first. */
#pragma once

#include <dirent.h>
#include <unistd.h>

#include "base/arena.h"
#include "check.h"

#ifndef SCRATCH_FILE
#define SCRATCH_FILE "file"
#endif

struct scratch {
    char directory[64];
    char path[96];
    struct arena arena;
};

/* The path of a name in the directory, in the scratch's arena. */
static inline char *scratch_in(struct scratch *scratch, const char *name)
{
    char path[512];
    int length = snprintf(path, sizeof path, "%s/%s", scratch->directory, name);
    return arena_text(&scratch->arena, path, (size_t)length);
}

static inline void scratch_write(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

/* How many files there are in the directory. */
static inline int scratch_count(const struct scratch *scratch)
{
    DIR *list = opendir(scratch->directory);
    int count = -2; /* . and .. */
    while (readdir(list) != NULL)
        count++;
    closedir(list);
    return count;
}

static inline int make_scratch(void **state)
{
    struct scratch *scratch = check_make(state, sizeof *scratch);
    strcpy(scratch->directory, "/tmp/glint-test-XXXXXX");
    assert_non_null(mkdtemp(scratch->directory));
    snprintf(scratch->path, sizeof scratch->path, "%s/%s", scratch->directory, SCRATCH_FILE);
    return 0;
}

/* Removes a folder and all that is in it. */
static inline void scratch_remove(const char *folder)
{
    DIR *list = opendir(folder);
    assert_non_null(list);
    for (const struct dirent *entry; (entry = readdir(list)) != NULL;) {
        char path[512];
        if (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0)
            continue;
        assert_true(snprintf(path, sizeof path, "%s/%s", folder, entry->d_name) < 512);
        if (unlink(path) != 0)
            scratch_remove(path);
    }
    closedir(list);
    assert_int_equal(rmdir(folder), 0);
}

static inline int remove_scratch(void **state)
{
    struct scratch *scratch = *state;
    scratch_remove(scratch->directory);
    arena_free(&scratch->arena);
    free(scratch);
    return 0;
}

#define SCRATCH_TEST(name) TEST_WITH(make_scratch, remove_scratch, struct scratch *scratch, name)
