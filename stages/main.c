/* The main of every program. A file is what its name says: glint-NAME is that stage or tool, and
 * any other name is glint itself. */
#include <stdio.h>

#include "run/chain.h"
#include "run/pipeline_process.h"
#include "text/path.h"

/* The name of the file that runs, or else the name that it was called by: a file keeps its meaning
 * behind a link of another name. NULL: neither begins with glint-. */
static const char *own_name(char *path, size_t size, const char *called)
{
    path_of_program(path, size);
    const char *name = stage_name_in_path(path);
    return name != NULL || called == NULL ? name : stage_name_in_path(called);
}

int main(int count, char **words)
{
    char path[4096];
    const char *name = own_name(path, sizeof path, words[0]);
    if (name == NULL)
        return pipeline_process_main(count, words);
    const struct stage *stage = stage_by_name(name);
    if (stage != NULL)
        return chain_main(stage, count, words);
    fprintf(stderr, "glint-%s: this file's name is that of no stage or tool in it\n", name);
    return DIAG_USAGE;
}
