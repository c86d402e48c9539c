#include "run/stage.h"

#include "text/path.h"

const struct stage *stage_by_name(const char *name)
{
    for (size_t i = 0; stages[i] != NULL; i++)
        if (strcmp(stages[i]->name, name) == 0)
            return stages[i];
    return NULL;
}

const char *stage_name_in_path(const char *path)
{
    const char *name = path_name(path);
    return strncmp(name, "glint-", 6) == 0 ? name + 6 : NULL;
}
