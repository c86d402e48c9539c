#define _GNU_SOURCE /* NOLINT(bugprone-reserved-identifier): for O_TMPFILE, which is Linux's */
#include "text/whole_file.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "base/arena.h"
#include "base/text.h"
#include "text/path.h"

#define MARK ".glint-"
enum { DESCRIPTORS = 100 }; /* that are looked at when a signal ends the process */

struct whole_file {
    int fd;
    char *path, *folder;
    struct text temporary;
    bool named; /* the file is called temporary */
};

static bool has_name(int fd, int folder, const char *name)
{
    struct stat open, named;
    return fstat(fd, &open) == 0 && fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
           open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

/* Removes an open temporary file, unless another process holds its lock. */
static void remove_unlocked(int fd, int folder, const char *name)
{
    if (flock(fd, LOCK_EX | LOCK_NB) == 0 && has_name(fd, folder, name))
        unlinkat(folder, name, 0);
}

/* Removes what processes of this host that were killed left in the folder. */
static void remove_leftovers(const char *folder)
{
    struct utsname system;
    uname(&system);
    DIR *list = opendir(folder);
    for (const struct dirent *entry; list != NULL && (entry = readdir(list)) != NULL;) {
        const char *name = entry->d_name, *host = strrchr(name, '@');
        bool ours = host != NULL && strncmp(name, MARK, sizeof MARK - 1) == 0 &&
                    strcmp(host + 1, system.nodename) == 0;
        int fd = ours ? openat(dirfd(list), name, O_RDWR | O_NOFOLLOW | O_NONBLOCK) : -1;
        if (fd >= 0) {
            remove_unlocked(fd, dirfd(list), name);
            close(fd);
        }
    }
    if (list != NULL)
        closedir(list);
}

/* Removes the temporary files that this process has open, and lets the signal end it. */
static void end_by(int signal)
{
    char link[] = "/proc/self/fd/00", path[PATH_MAX], *digits = strrchr(link, '/') + 1;
    for (int fd = STDERR_FILENO + 1; fd < DESCRIPTORS; fd++) {
        digits[0] = (char)('0' + (fd < 10 ? fd : fd / 10));
        digits[1] = (char)(fd < 10 ? 0 : '0' + fd % 10);
        ssize_t length = readlink(link, path, sizeof path - 1);
        path[length > 0 ? length : 0] = '\0';
        if (strncmp(path_name(path), MARK, sizeof MARK - 1) == 0)
            remove_unlocked(fd, AT_FDCWD, path);
    }
    raise(signal);
}

/* From here on a signal that would end the process removes its temporary files first. */
static void expect_signals(void)
{
    static const int signals[] = {SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM, SIGXCPU, SIGXFSZ};
    struct sigaction end = {.sa_handler = end_by, .sa_flags = (int)SA_RESETHAND}, before;
    sigfillset(&end.sa_mask);
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++)
        if (sigaction(signals[i], NULL, &before) == 0 && before.sa_handler == SIG_DFL)
            sigaction(signals[i], &end, NULL);
}

/* Gives the file the first temporary name that is free; makes the file if it is not open yet. Other
 * processes leave a locked file alone. One of them may have found it before it was locked and
 * removed it: then the next name is tried. */
static int name_file(struct whole_file *file)
{
    struct utsname system;
    char source[64];
    bool open_already = file->fd >= 0;
    uname(&system);
    snprintf(source, sizeof source, "/proc/self/fd/%d", file->fd);
    for (int number = 1; !file->named; number++) {
        file->temporary.length = 0;
        text_format(&file->temporary, "%s/" MARK "%ld-%d@%s", file->folder, (long)getpid(), number,
                    system.nodename);
        const char *name = file->temporary.bytes;
        if (!open_already)
            file->fd = open(name, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        bool made = open_already ? linkat(AT_FDCWD, source, AT_FDCWD, name, AT_SYMLINK_FOLLOW) == 0
                                 : file->fd >= 0;
        if (!made && errno != EEXIST)
            return -1;
        bool locked = made && (flock(file->fd, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK);
        file->named = locked && has_name(file->fd, AT_FDCWD, name);
        if (made && !file->named && !open_already)
            close(file->fd);
    }
    return 0;
}

/* Is the path free, or a file that may be written and replaced? Else errno says why not. In a
 * sticky folder only the owners of file and folder may replace a file. */
static bool may_take(const struct whole_file *file, struct stat *there)
{
    struct stat folder;
    struct statx mount = {0};
    if (stat(file->path, there) != 0 || stat(file->folder, &folder) != 0)
        return errno == ENOENT;
    if (!S_ISDIR(there->st_mode) && access(file->path, W_OK) != 0)
        return false;
    statx(AT_FDCWD, file->path, 0, 0, &mount);
    bool kept = (folder.st_mode & S_ISVTX) != 0 && geteuid() != 0 && there->st_uid != geteuid() &&
                folder.st_uid != geteuid();
    errno = S_ISDIR(there->st_mode)                               ? EISDIR
            : (mount.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0 ? EBUSY
            : kept                                                ? EPERM
                                                                  : 0;
    return errno == 0;
}

/* Opens a file with the mode and the owner of the one that is there. Where the owner
 * cannot be kept, the set-user-ID and set-group-ID bits are dropped: a program would run as another
 * user. */
static int open_file(struct whole_file *file)
{
    struct stat there = {0};
    if (!may_take(file, &there))
        return -1;
    if (access("/proc/self/fd", X_OK) == 0) /* through which the file gets its name later */
        file->fd = open(file->folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
    flock(file->fd, LOCK_EX | LOCK_NB);
    if (file->fd < 0) {
        remove_leftovers(file->folder);
        expect_signals();
        if (name_file(file) != 0)
            return -1;
    }
    if (there.st_nlink == 0)
        return 0;
    mode_t kept = fchown(file->fd, there.st_uid, there.st_gid) == 0 ? 07777 : 0777;
    return fchmod(file->fd, there.st_mode & kept);
}

struct whole_file *whole_file_make(const char *path)
{
    size_t size = strlen(path) + 1;
    struct whole_file *file = memory_get(sizeof *file);
    *file = (struct whole_file){
        .fd = -1,
        .path = memcpy(memory_get(size), path, size),
        .folder = path_folder(path),
    };
    if (open_file(file) >= 0)
        return file;
    int why = errno;
    whole_file_close(file);
    errno = why;
    return NULL;
}

int whole_file_descriptor(const struct whole_file *file)
{
    return file->fd;
}

int whole_file_take_name(struct whole_file *file)
{
    sigset_t all, before;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, &before);
    int result = name_file(file) == 0 ? rename(file->temporary.bytes, file->path) : -1, why = errno;
    file->named = file->named && result != 0;
    sigprocmask(SIG_SETMASK, &before, NULL);
    errno = why;
    return result;
}

int whole_file_close(struct whole_file *file)
{
    if (file->named)
        unlink(file->temporary.bytes);
    int result = file->fd >= 0 ? close(file->fd) : 0, why = errno;
    text_free(&file->temporary);
    free(file->path);
    free(file->folder);
    free(file);
    errno = why;
    return result;
}
