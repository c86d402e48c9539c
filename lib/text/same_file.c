#include "text/same_file.h"

#include <stdlib.h>
#include <sys/stat.h>

#include "base/arena.h"

static const char *last_part(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash != NULL ? slash + 1 : path;
}

/* Like stat of the path's folder. */
static int stat_folder(const char *path, struct stat *status)
{
    size_t length = (size_t)(last_part(path) - path);
    char *folder = memory_get(length + 2);
    memcpy(folder, path, length);
    memcpy(folder + length, ".", 2);
    int result = stat(folder, status);
    free(folder);
    return result;
}

bool same_file(const char *a, const char *b)
{
    struct stat first, second;
    bool there = stat(a, &first) == 0;
    if (there != (stat(b, &second) == 0))
        return false;
    if (!there && (strcmp(last_part(a), last_part(b)) != 0 || stat_folder(a, &first) != 0 ||
                   stat_folder(b, &second) != 0))
        return false;
    return !S_ISCHR(first.st_mode) && first.st_dev == second.st_dev &&
           first.st_ino == second.st_ino;
}
