/* A file that takes its name when it is whole.
 *
 * Until then it has no name, in the folder where it will be. Where the file system has no files
 * without names (NFS) it is called .glint-PROCESS-NUMBER@HOST. The process removes it, also when a
 * signal ends it. What SIGKILL leaves behind is removed by the next process of that host that
 * writes into the folder. A lock (flock) tells it from the file of a process that runs; where there
 * are no locks it stays, and so does what other hosts left. A name that is taken is never written
 * or replaced, and no link is followed.
 *
 * A file that was there is replaced, and so is whole at any time. The new one has its mode and,
 * where the user may give it away, its owner and its group. Other names of the old file (hard
 * links) keep the old bytes. */
#pragma once

#include <stdbool.h>

struct whole_file;

/* Makes a file that will be called path, whose last part must be no link. NULL with errno: a
 * folder, a file that may not be written, a name that is too long, a folder that is not there; or a
 * file that can be written but not replaced: a folder that may not be written (EACCES), somebody
 * else's file in a sticky folder (EPERM), a file that is mounted by itself (EBUSY). */
struct whole_file *whole_file_make(const char *path);

/* Where to write. The file owns it. */
int whole_file_descriptor(const struct whole_file *file);

/* Gives the file its name: 0, or -1 with errno. */
int whole_file_take_name(struct whole_file *file);

/* Closes the file, which is gone unless it has its name: 0, or -1 with errno. */
int whole_file_close(struct whole_file *file);
