#define _GNU_SOURCE /* NOLINT(bugprone-reserved-identifier): for O_TMPFILE, which is Linux's */
#include "text/whole_file.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/arena.h"

struct whole_file {
    int fd;
    char *path, *temporary;
    bool named;     /* the file is called temporary */
    bool copied;    /* the bytes go into the file that is there */
    pid_t remover;  /* 0: none is needed */
    int remover_fd; /* closed when this process ends */
};

/* Sets a new temporary name in the folder of the path. */
static void choose_name(struct whole_file *file)
{
    const char *slash = strrchr(file->path, '/');
    int folder = slash != NULL ? (int)(slash + 1 - file->path) : 0;
    uint64_t digits = 0;
    while (getrandom(&digits, sizeof digits, 0) < 0 && errno == EINTR)
        continue;
    snprintf(file->temporary, (size_t)folder + sizeof ".glint-0123456789abcdef",
             "%.*s.glint-%016llx", folder, file->path, (unsigned long long)digits);
}

/* Opens a new file without a name in the path's folder; -1 where the file system has none. It gets
 * its name through /proc later. */
static int open_unnamed(const char *path)
{
    int fd = -1;
#ifdef O_TMPFILE
    const char *slash = strrchr(path, '/');
    size_t length = slash == path ? 1 : slash != NULL ? (size_t)(slash - path) : 0;
    char *folder = memory_get(length + 2);
    snprintf(folder, length + 2, "%.*s", (int)length, length > 0 ? path : "");
    if (access("/proc/self/fd", X_OK) == 0)
        fd = open(length > 0 ? folder : ".", O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
    free(folder);
#endif
    return fd;
}

/* Waits, deaf to signals, until the other end of the pipe is closed, and removes the file. */
static _Noreturn void remove_at_end(int pipe_end, const char *name)
{
    char byte;
    setsid();
    dup2(pipe_end, STDIN_FILENO);
    close_range(STDIN_FILENO + 1, ~0U, 0);
    if (read(STDIN_FILENO, &byte, 1) == 0)
        unlink(name);
    _exit(0);
}

/* Starts the process that removes the file. Where none can be started, a killed run leaves the file
 * behind. */
static void start_remover(struct whole_file *file)
{
    int ends[2];
    sigset_t all, before;
    if (pipe2(ends, O_CLOEXEC) != 0)
        return;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, &before);
    file->remover = fork();
    if (file->remover == 0)
        remove_at_end(ends[0], file->temporary);
    sigprocmask(SIG_SETMASK, &before, NULL);
    close(ends[0]);
    if (file->remover > 0)
        file->remover_fd = ends[1];
    else
        close(ends[1]);
}

static int open_named(struct whole_file *file)
{
    int fd;
    do {
        choose_name(file);
        fd = open(file->temporary, O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    } while (fd < 0 && errno == EEXIST);
    file->named = fd >= 0;
    if (file->named)
        start_remover(file);
    return fd;
}

/* Is the path free, or a file that may be written? Decides how a file that is there is kept. */
static bool may_write(struct whole_file *file, struct stat *there)
{
    if (stat(file->path, there) != 0)
        return errno == ENOENT;
    if (S_ISDIR(there->st_mode))
        errno = EISDIR;
    file->copied = there->st_nlink > 1;
    return !S_ISDIR(there->st_mode) && access(file->path, W_OK) == 0;
}

static int open_file(struct whole_file *file)
{
    struct stat there = {0};
    if (!may_write(file, &there))
        return -1;
    int fd = open_unnamed(file->path);
    if (fd < 0)
        fd = open_named(file);
    if (fd >= 0 && there.st_nlink > 0 &&
        (fchown(fd, there.st_uid, there.st_gid) != 0 || fchmod(fd, there.st_mode & 07777) != 0))
        file->copied = true;
    return fd;
}

struct whole_file *whole_file_make(const char *path)
{
    size_t size = strlen(path) + 1;
    struct whole_file *file = memory_get(sizeof *file);
    *file = (struct whole_file){
        .path = memcpy(memory_get(size), path, size),
        .temporary = memory_get(size + sizeof ".glint-0123456789abcdef"),
    };
    file->fd = open_file(file);
    if (file->fd >= 0)
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

/* Gives a file without a name a temporary one. */
static int name_file(struct whole_file *file)
{
    char source[64];
    int result = 0;
    snprintf(source, sizeof source, "/proc/self/fd/%d", file->fd);
    while (result == 0 && !file->named) {
        choose_name(file);
        file->named = linkat(AT_FDCWD, source, AT_FDCWD, file->temporary, AT_SYMLINK_FOLLOW) == 0;
        result = file->named || errno == EEXIST ? 0 : -1;
    }
    return result;
}

/* Writes the bytes into the file that is there, as a shell's > would. */
static int copy_into(const struct whole_file *file)
{
    char bytes[16 * 1024];
    off_t at = 0;
    ssize_t got = 1;
    int fd = open(file->path, O_WRONLY | O_TRUNC | O_CLOEXEC);
    while (fd >= 0 && got > 0) {
        got = pread(file->fd, bytes, sizeof bytes, at);
        for (ssize_t done = 0, more = 0; done < got && got > 0; done += more) {
            more = write(fd, bytes + done, (size_t)(got - done));
            if (more < 0)
                got = -1;
        }
        at += got;
    }
    bool whole = fd >= 0 && got == 0 && fsync(fd) == 0;
    return fd >= 0 && close(fd) == 0 && whole ? 0 : -1;
}

static int replace(struct whole_file *file)
{
    if (name_file(file) != 0)
        return -1;
    if (rename(file->temporary, file->path) != 0)
        return -1;
    file->named = false;
    return 0;
}

int whole_file_take_name(struct whole_file *file)
{
    sigset_t all, before;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, &before);
    int result = file->copied ? copy_into(file) : replace(file);
    if (result != 0 && errno == EBUSY) /* a file that is mounted by itself */
        result = copy_into(file);
    int why = errno;
    sigprocmask(SIG_SETMASK, &before, NULL);
    errno = why;
    return result;
}

int whole_file_close(struct whole_file *file)
{
    if (file->named)
        unlink(file->temporary);
    int result = file->fd >= 0 ? close(file->fd) : 0, why = errno;
    if (file->remover > 0) {
        close(file->remover_fd);
        while (waitpid(file->remover, NULL, 0) < 0 && errno == EINTR)
            continue;
    }
    free(file->path);
    free(file->temporary);
    free(file);
    errno = why;
    return result;
}
