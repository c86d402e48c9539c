/* A library to preload that makes one call of a program fail. tests/tools/faults builds and
 * preloads it.
 *
 *     FAILING_CALL     malloc (with calloc and realloc), write, fsync, rename or close
 *     FAILING_NUMBER   which of these calls fails, from 1; absent: none
 *     FAILING_COUNTS   a file that gets the number of all these calls, in this order, when the
 * program exits
 *
 * A call that fails has done nothing but close, which has closed the file. write fails as on a full
 * disk, the other files as after an error of the device. Only calls from outside the C library are
 * seen, and only those of the process that was started, as its children have no counts of their
 * own. */
#define _GNU_SOURCE /* NOLINT(bugprone-reserved-identifier): for RTLD_NEXT */
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum call { CALL_MALLOC, CALL_WRITE, CALL_FSYNC, CALL_RENAME, CALL_CLOSE, CALLS };
static const char *const names[CALLS] = {"malloc", "write", "fsync", "rename", "close"};

static long counts[CALLS];
static long failing_number;
static int failing_call = -1;

/* The C library's own, under names that only it has. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *memory, size_t size);

void *malloc(size_t size);
void *calloc(size_t count, size_t size);
void *realloc(void *memory, size_t size);

__attribute__((constructor)) static void begin(void)
{
    const char *call = getenv("FAILING_CALL"), *number = getenv("FAILING_NUMBER");
    for (int i = 0; i < CALLS && call != NULL; i++)
        if (strcmp(names[i], call) == 0)
            failing_call = i;
    failing_number = number != NULL ? atol(number) : 0;
    memset(counts, 0, sizeof counts);
}

__attribute__((destructor)) static void end(void)
{
    const char *path = getenv("FAILING_COUNTS");
    long all[CALLS];
    memcpy(all, counts, sizeof all);
    failing_call = -1;
    FILE *file = path != NULL ? fopen(path, "w") : NULL;
    for (int i = 0; i < CALLS && file != NULL; i++)
        fprintf(file, "%s %ld\n", names[i], all[i]);
    if (file != NULL)
        fclose(file);
}

static bool fails(enum call call)
{
    bool now = ++counts[call] == failing_number && (int)call == failing_call;
    if (now)
        errno = call == CALL_MALLOC ? ENOMEM : call == CALL_WRITE ? ENOSPC : EIO;
    return now;
}

void *malloc(size_t size)
{
    return fails(CALL_MALLOC) ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size)
{
    return fails(CALL_MALLOC) ? NULL : __libc_calloc(count, size);
}

void *realloc(void *memory, size_t size)
{
    return fails(CALL_MALLOC) ? NULL : __libc_realloc(memory, size);
}

#define REAL(type, name) ((type)dlsym(RTLD_NEXT, name))

ssize_t write(int fd, const void *bytes, size_t size)
{
    return fails(CALL_WRITE)
               ? -1
               : REAL(ssize_t(*)(int, const void *, size_t), "write")(fd, bytes, size);
}

int fsync(int fd)
{
    return fails(CALL_FSYNC) ? -1 : REAL(int (*)(int), "fsync")(fd);
}

int rename(const char *from, const char *to)
{
    return fails(CALL_RENAME) ? -1 : REAL(int (*)(const char *, const char *), "rename")(from, to);
}

int close(int fd)
{
    bool now = fails(CALL_CLOSE);
    int error = errno, result = REAL(int (*)(int), "close")(fd);
    if (now)
        errno = error;
    return now ? -1 : result;
}
