#include "text/data_folder.h"

#include <stdlib.h>

#include "text/path.h"

const char *data_folder_of_program(struct arena *arena)
{
    enum { ROOM = 4096 };
    char *path = arena_get(arena, ROOM);
    if (path_of_program(path, ROOM) == 0)
        return "";
    char *slash = strrchr(path, '/');
    slash[1] = '\0';
    return path;
}

int data_folder_check(const char *named_by, const char *folder, struct diag *diag)
{
    if (path_is_folder(folder))
        return 0;
    return diag_fail(diag, DIAG_CONFIG, "%s: \"%s\" is no folder", named_by, folder);
}

int data_folder_list(const char *own, const char *kind, struct data_folders *folders,
                     struct arena *arena, struct diag *diag)
{
    const char *given = getenv("GLINT_DATA"), *beside = data_folder_of_program(arena);
    const char *inner = strcmp(kind, "pipelines") == 0 ? "" : "data/";
    *folders = (struct data_folders){0};
    if (own != NULL)
        folders->paths[folders->count++] = arena_format(arena, "%s/", own);
    if (given != NULL && *given != '\0') {
        if (data_folder_check("GLINT_DATA", given, diag) != 0)
            return -1;
        folders->paths[folders->count++] = arena_format(arena, "%s/%s/", given, kind);
    }
    if (*beside != '\0') {
        folders->paths[folders->count++] =
            arena_format(arena, "%s../share/glint/%s%s/", beside, inner, kind);
        folders->paths[folders->count++] =
            arena_format(arena, "%s../../%s%s/", beside, inner, kind);
    }
    folders->paths[folders->count++] = arena_format(arena, "data/%s/", kind);
    return 0;
}
