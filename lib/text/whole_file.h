/* A file that takes its name when it is whole.
 *
 * Until then it has no name, in the folder where it will be. Where the file system has no files
 * without names it is called `.glint-` and 16 random digits, and a process that waits for the end
 * of this one removes it, however this one ends. A name that is taken is never opened or replaced,
 * and no link is followed.
 *
 * A file that was there keeps its mode and its owner. If it has several names (hard links), belongs
 * to somebody else or is mounted by itself, it is not replaced: the whole bytes are copied into it
 * at the end. */
#pragma once

#include <stdbool.h>

struct whole_file;

/* Makes a file that will be called path, whose last part must be no link. NULL with errno: a
 * folder, a file that may not be written, a name that is too long, a folder that is not there. */
struct whole_file *whole_file_make(const char *path);

/* Where to write. The file owns it. */
int whole_file_descriptor(const struct whole_file *file);

/* Gives the file its name: 0, or -1 with errno. */
int whole_file_take_name(struct whole_file *file);

/* Closes the file, which is gone unless it has its name: 0, or -1 with errno. */
int whole_file_close(struct whole_file *file);
