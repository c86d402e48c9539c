/* Folders of data, where documents are looked up by name.
 *
 * These are $GLINT_DATA, then ../share/glint/data and ../../data beside the executable, then
 * ./data. Each has a folder for every kind of documents, as data/vehicles. A GLINT_DATA that is no
 * folder is refused (DIAG_CONFIG). */
#pragma once

#include "base/arena.h"
#include "base/diag.h"

/* The folder of the running executable, with a slash at its end; "" if the system does not tell
 * it. */
const char *data_folder_of_program(struct arena *arena);

/* Refuses a path that is no folder (DIAG_CONFIG); the message names the option or variable that
 * gives the path. */
int data_folder_check(const char *named_by, const char *folder, struct diag *diag);

/* Folders of documents of a kind, in the order of search; all end with a slash. */
struct data_folders {
    const char *paths[5];
    size_t count;
};

/* own is a folder of the user that is searched first and holds documents of this kind alone, or
 * NULL. The folder of shipped pipelines lies beside data/, not in it. The folders need not be
 * there. 0, or -1 after a message. */
int data_folder_list(const char *own, const char *kind, struct data_folders *folders,
                     struct arena *arena, struct diag *diag);
