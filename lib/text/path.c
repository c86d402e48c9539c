#include "text/path.h"

#include <limits.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/arena.h"

enum { LINKS = 40 }; /* Linux follows as many for one path */

int path_descriptor(const char *path)
{
    static const char *const folders[] = {"/dev/fd/", "/proc/self/fd/", "/proc/thread-self/fd/"};
    if (strcmp(path, "-") == 0 || strcmp(path, "/dev/stdout") == 0)
        return STDOUT_FILENO;
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        size_t length = strlen(folders[i]),
               digits = strspn(path + strnlen(path, length), "0123456789");
        if (strncmp(path, folders[i], length) == 0 && digits > 0 && path[length + digits] == '\0')
            return (int)strtol(path + length, NULL, 10);
    }
    return -1;
}

size_t path_of_program(char *path, size_t size)
{
    size_t length = 0;
#ifdef PLAIN_POSIX
    (void)size;
#else
    ssize_t told = readlink("/proc/self/exe", path, size - 1);
    length = told > 0 ? (size_t)told : 0;
#endif
    path[length] = '\0';
    return length;
}

bool path_is_special(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

const char *path_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

/* The name in the folder of the path. */
static char *beside(const char *path, const char *name)
{
    size_t folder = (size_t)(path_name(path) - path), length = strlen(name);
    char *joined = memory_get(folder + length + 1);
    memcpy(joined, path, folder);
    memcpy(joined + folder, name, length + 1);
    return joined;
}

char *path_folder(const char *path)
{
    return beside(path, ".");
}

char *path_target(const char *path)
{
    char *at = beside(path, path_name(path));
    for (int i = 0; i < LINKS && path_descriptor(at) < 0 && !path_is_special(at); i++) {
        char target[PATH_MAX];
        ssize_t length = readlink(at, target, sizeof target - 1);
        if (length < 0)
            break;
        target[length] = '\0';
        char *next = beside(target[0] != '/' ? at : "", target);
        free(at);
        at = next;
    }
    return at;
}

/* Whether two files that are not there would have one name in one folder. */
static bool same_place(const char *a, const char *b)
{
    struct stat first, second;
    char *folders[] = {path_folder(a), path_folder(b)};
    bool same = strcmp(path_name(a), path_name(b)) == 0 && stat(folders[0], &first) == 0 &&
                stat(folders[1], &second) == 0 && first.st_dev == second.st_dev &&
                first.st_ino == second.st_ino;
    free(folders[0]);
    free(folders[1]);
    return same;
}

bool path_same_file(const char *a, const char *b)
{
    struct stat first, second;
    bool there = stat(a, &first) == 0;
    if (there != (stat(b, &second) == 0))
        return false;
    if (there)
        return !S_ISCHR(first.st_mode) && first.st_dev == second.st_dev &&
               first.st_ino == second.st_ino;
    char *targets[] = {path_target(a), path_target(b)};
    bool same = same_place(targets[0], targets[1]);
    free(targets[0]);
    free(targets[1]);
    return same;
}

bool path_is_folder(const char *path)
{
    struct stat status;
    return stat(path, &status) == 0 && S_ISDIR(status.st_mode);
}
