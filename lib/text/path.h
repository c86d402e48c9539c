/* Where a path leads: its folder, its links, equal files.
 *
 * Strings that are returned as char * are the caller's to free. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

/* The descriptor that the path stands for, as for a shell's >: "-",
 * /dev/stdout, /dev/fd/N, /proc/self/fd/N; -1: none. */
int path_descriptor(const char *path);

/* Writes the path of the running executable; returns its length, or 0 and "" if the system does not
 * tell it. */
size_t path_of_program(char *path, size_t size);

/* True if the path leads to something that is neither a regular file nor a folder. */
bool path_is_special(const char *path);

/* The last part of the path: its name in its folder. */
const char *path_name(const char *path);

/* The folder of the path, as "a/." or ".". */
char *path_folder(const char *path);

/* The path at the end of a chain of links. There need be no file of that name. */
char *path_target(const char *path);

/* True if two paths lead to one file. Files are compared by device and inode, so a link and another
 * spelling of the path are the same file. Two files that are not there are the same if they would
 * have one name in one folder, also through links. A terminal or another character device never
 * counts as the same file, because writing to it destroys nothing. */
bool path_same_file(const char *a, const char *b);

/* True for a folder, or a link that leads to one. */
bool path_is_folder(const char *path);
