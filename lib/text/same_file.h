/* Whether two paths lead to one file.
 *
 * Files are compared by device and inode, so a link and another spelling of the path are the same
 * file. Two files that are not there are the same if they would have one name in one folder. A
 * terminal or another device is never the same: whoever writes to one of them harms nobody. */
#pragma once

#include <stdbool.h>

bool same_file(const char *a, const char *b);
