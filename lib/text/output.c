#ifndef PLAIN_POSIX
#define _GNU_SOURCE /* NOLINT(bugprone-reserved-identifier): for O_TMPFILE and statx of Linux */
#endif
#include "text/output.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <unistd.h>

#include "base/arena.h"
#include "text/packing.h"
#include "text/path.h"

#define MARK ".glint-"

/* A file without a name in the folder where it will be. Where the file system has no files without
 * names (NFS) it is called .glint-PROCESS-NUMBER@HOST. If a signal ends the process, the file stays
 * until the next process of that host that writes into the folder removes it. A running process
 * holds a lock (flock) on its file; without locks such files stay, as do those of other hosts. A
 * file that exists is never written or replaced, and no link is followed. */
struct whole_file {
    int fd;
    char *path, *folder;
    struct text temporary, aside; /* its name until it has its own; and that of the old file */
    bool named;                   /* the file is called temporary */
    bool replaces, taken;         /* the old file is aside; this one has its name */
};

static char *copy(const char *text)
{
    size_t size = strlen(text) + 1;
    return memcpy(memory_get(size), text, size);
}

static bool has_name(int fd, int folder, const char *name)
{
    struct stat open, named;
    return fstat(fd, &open) == 0 && fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) == 0 &&
           open.st_dev == named.st_dev && open.st_ino == named.st_ino;
}

/* Removes the files in the folder that ended processes of this host left: those without a lock. */
static void remove_leftovers(const char *folder)
{
    struct utsname system;
    uname(&system);
    DIR *list = opendir(folder);
    const struct dirent *entry;
    if (list == NULL)
        return;
    while ((entry = readdir(list)) != NULL) {
        const char *name = entry->d_name, *host = strrchr(name, '@');
        bool ours = host != NULL && strncmp(name, MARK, sizeof MARK - 1) == 0 &&
                    strcmp(host + 1, system.nodename) == 0;
        int fd = ours ? openat(dirfd(list), name, O_RDWR | O_NOFOLLOW | O_NONBLOCK) : -1;
        if (fd >= 0 && flock(fd, LOCK_EX | LOCK_NB) == 0 && has_name(fd, dirfd(list), name))
            unlinkat(dirfd(list), name, 0);
        if (fd >= 0)
            close(fd);
    }
    closedir(list);
}

/* Gives the file the first temporary name that is free; makes the file if it is not open yet.
 * Another process may find the file before it is locked, and remove it: then the next name is
 * tried. */
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

/* A file without a name in the folder, where the system has such files; -1 elsewhere. It gets its
 * name through a folder of Linux. */
static int open_unnamed(const char *folder)
{
#ifdef O_TMPFILE
    if (access("/proc/self/fd", X_OK) == 0)
        return open(folder, O_TMPFILE | O_RDWR | O_CLOEXEC, 0666);
#endif
    (void)folder;
    return -1;
}

/* True if the system tells that a file is mounted by itself. */
static bool is_mounted(const char *path)
{
#ifdef STATX_ATTR_MOUNT_ROOT
    struct statx mount = {0};
    statx(AT_FDCWD, path, 0, 0, &mount);
    return (mount.stx_attributes & STATX_ATTR_MOUNT_ROOT) != 0;
#else
    (void)path;
    return false;
#endif
}

/* True if the path is free, or a file that may be written and replaced; errno has the reason if
 * not. In a sticky folder only the owners of file and folder may replace a file. */
static bool may_take(const struct whole_file *file, struct stat *there)
{
    struct stat folder;
    if (stat(file->path, there) != 0 || stat(file->folder, &folder) != 0)
        return errno == ENOENT;
    if (!S_ISDIR(there->st_mode) && access(file->path, W_OK) != 0)
        return false;
    bool kept = (folder.st_mode & S_ISVTX) != 0 && geteuid() != 0 && there->st_uid != geteuid() &&
                folder.st_uid != geteuid();
    int reason = kept ? EPERM : 0;
    if (S_ISDIR(there->st_mode))
        reason = EISDIR;
    else if (is_mounted(file->path))
        reason = EBUSY;
    errno = reason;
    return reason == 0;
}

/* Opens a file with the mode and the owner of the one that is there. Where the owner cannot be
 * kept, the set-user-ID and set-group-ID bits are dropped: a program would run as another user. */
static int open_file(struct whole_file *file)
{
    struct stat there = {0};
    if (!may_take(file, &there))
        return -1;
    file->fd = open_unnamed(file->folder);
    flock(file->fd, LOCK_EX | LOCK_NB);
    if (file->fd < 0) {
        remove_leftovers(file->folder);
        if (name_file(file) != 0)
            return -1;
    }
    if (there.st_nlink == 0)
        return 0;
    mode_t kept = fchown(file->fd, there.st_uid, there.st_gid) == 0 ? 07777 : 0777;
    return fchmod(file->fd, there.st_mode & kept);
}

/* Closes the file, which is gone unless it has its name: 0, or -1 with errno. */
static int close_file(struct whole_file *file)
{
    if (file->named)
        unlink(file->temporary.bytes);
    int result = file->fd >= 0 ? close(file->fd) : 0, why = errno;
    text_free(&file->temporary);
    text_free(&file->aside);
    free(file->path);
    free(file->folder);
    free(file);
    errno = why;
    return result;
}

/* Makes a file that will be called path, whose last part is no link. NULL with errno: a folder, a
 * file that may not be written, a name that is too long, a folder that is not there; or a file that
 * can be written but not replaced: a folder that may not be written (EACCES), somebody else's file
 * in a sticky folder (EPERM), a file that is mounted by itself (EBUSY). */
static struct whole_file *make_file(const char *path)
{
    struct whole_file *file = memory_get(sizeof *file);
    *file = (struct whole_file){.fd = -1, .path = copy(path), .folder = path_folder(path)};
    if (open_file(file) >= 0)
        return file;
    int why = errno;
    close_file(file);
    errno = why;
    return NULL;
}

static void block_signals(sigset_t *before)
{
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, before);
}

/* Gives the file its name: 0, or -1 with errno. */
static int take_name(struct whole_file *file)
{
    sigset_t before;
    block_signals(&before);
    int result = name_file(file) == 0 ? rename(file->temporary.bytes, file->path) : -1, why = errno;
    file->named = file->named && result != 0;
    file->taken = result == 0;
    sigprocmask(SIG_SETMASK, &before, NULL);
    errno = why;
    return result;
}

/* Takes the memory for both names: where there is none, the program ends before a file has one. */
static void reserve_names(struct whole_file *file)
{
    struct utsname system;
    size_t size = strlen(file->folder) + sizeof MARK + 64 + sizeof system.nodename;
    text_room(&file->temporary, size);
    text_room(&file->aside, size);
}

/* Gives the old file of this name, if there is one, a name like the temporary ones, with which the
 * next run removes it if this one is killed: 0, or -1 with errno. */
static int set_aside(struct whole_file *file)
{
    remove_leftovers(file->folder);
    if (name_file(file) != 0)
        return -1;
    const char *name = file->temporary.bytes;
    int stem = (int)(strrchr(name, '@') - name);
    text_format(&file->aside, "%.*s-old%s", stem, name, name + stem);
    file->replaces = rename(file->path, file->aside.bytes) == 0;
    return file->replaces || errno == ENOENT ? 0 : -1;
}

/* Removes the old file, or gives it its name again. */
static void end_aside(struct whole_file *file, bool whole)
{
    if (file->replaces && whole)
        unlink(file->aside.bytes);
    else if (file->replaces)
        rename(file->aside.bytes, file->path);
    else if (file->taken && !whole)
        unlink(file->path);
}

/* ---- outputs ---- */

enum { PIECE_SIZE = 64 * 1024 }; /* bytes that a pipe takes at once */

struct output {
    int fd;
    struct packer *packer;   /* NULL for plain output */
    char *name;              /* as it was given, for messages */
    struct whole_file *file; /* NULL if the path is written directly */
    struct text held;        /* text that is not written yet */
    struct text packed;      /* the same, packed */
    bool failed; /* something that was written is lost: the file must not take its name */
};

static void discard(struct output *output)
{
    packing_pack_end(output->packer);
    free(output->name);
    text_free(&output->held);
    text_free(&output->packed);
    free(output);
}

static int cannot_create(const char *name, struct diag *diag)
{
    int why = errno;
    bool kept = (why == EACCES || why == EPERM || why == EBUSY) && access(name, W_OK) == 0;
    errno = why;
    return diag_fail(diag, diag_code_by_errno(DIAG_CANNOT_CREATE), "%s: %s%s", name, strerror(why),
                     kept ? "; no new file can take the place of this one: name another one, or "
                            "let the shell write into it (>)"
                          : "");
}

static int cannot_write(struct output *output, struct diag *diag)
{
    bool standard = strcmp(output->name, "-") == 0;
    output->failed = true;
    return diag_fail(diag, diag_code_by_errno(DIAG_IO), "%s: %s",
                     standard ? "stdout" : output->name, strerror(errno));
}

/* Standard output itself, or a copy of another descriptor. Refuses one that is not open for
 * writing. */
static int open_descriptor(struct output *output, int number, struct diag *diag)
{
    int flags = fcntl(number, F_GETFL);
    if (flags >= 0 && (flags & O_ACCMODE) != O_RDONLY)
        output->fd =
            number == STDOUT_FILENO ? number : fcntl(number, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
    else
        errno = EBADF;
    return output->fd < 0 ? cannot_write(output, diag) : 0;
}

static int open_path(struct output *output, const char *path, struct diag *diag)
{
    int number = path_descriptor(path);
    if (number >= 0)
        return open_descriptor(output, number, diag);
    if (path_is_special(path))
        output->fd = open(path, O_WRONLY | O_TRUNC | O_CLOEXEC);
    else if ((output->file = make_file(path)) != NULL)
        output->fd = output->file->fd;
    return output->fd < 0 ? cannot_create(output->name, diag) : 0;
}

struct output *output_open(const char *path, struct diag *diag)
{
    struct output *output = memory_get(sizeof *output);
    *output = (struct output){.fd = -1, .name = copy(path)};
    /* A file at its greatest size is an error of the write, as on a full disk, and no signal. */
    signal(SIGXFSZ, SIG_IGN);
    char *target = path_target(path);
    enum packing packing = packing_of_name(target);
    int result = packing_check(packing, diag) == 0 ? open_path(output, target, diag) : -1;
    if (result == 0 && packing != PACKING_NONE)
        output->packer = packing_pack_begin(packing);
    free(target);
    if (result == 0)
        return output;
    if (output->file != NULL)
        close_file(output->file);
    discard(output);
    return NULL;
}

int output_write_all(int fd, const char *bytes, size_t length)
{
    struct pollfd file = {.fd = fd, .events = POLLOUT};
    while (length > 0) {
        ssize_t written = write(fd, bytes, length);
        if (written < 0 && errno != EINTR && !(errno == EAGAIN && poll(&file, 1, -1) > 0))
            return -1;
        if (written > 0) {
            bytes += written;
            length -= (size_t)written;
        }
    }
    return 0;
}

/* Packs bytes and writes what comes out: 0, or -1 with errno. */
static int write_packed(struct output *output, const char *bytes, size_t length, bool end)
{
    output->packed.length = 0;
    packing_pack_add(output->packer, bytes, length, end, &output->packed);
    return output_write_all(output->fd, output->packed.bytes, output->packed.length);
}

/* Writes the first bytes that are held; the others move up. Nothing is written behind bytes that
 * are lost. */
static int send_first(struct output *output, size_t length, struct diag *diag)
{
    struct text *held = &output->held;
    if (output->failed)
        return -1;
    int result = output->packer != NULL ? write_packed(output, held->bytes, length, false)
                                        : output_write_all(output->fd, held->bytes, length);
    held->length -= length;
    if (held->length > 0)
        memmove(held->bytes, held->bytes + length, held->length);
    return result == 0 ? 0 : cannot_write(output, diag);
}

struct text *output_text(struct output *output)
{
    return &output->held;
}

bool output_prints(const struct output *output)
{
    return output->held.length > 0 && isatty(output->fd);
}

int output_send(struct output *output, struct diag *diag)
{
    size_t whole = output->held.length / PIECE_SIZE * PIECE_SIZE;
    return whole == 0 ? 0 : send_first(output, whole, diag);
}

int output_flush(struct output *output, struct diag *diag)
{
    bool awaited = output->file == NULL && output->packer == NULL;
    return awaited ? send_first(output, output->held.length, diag) : 0;
}

int output_write(struct output *output, const char *bytes, size_t length, struct diag *diag)
{
    while (length > 0) {
        size_t taken = length < PIECE_SIZE ? length : PIECE_SIZE;
        text_add(&output->held, bytes, taken);
        if (output_send(output, diag) != 0)
            return -1;
        bytes += taken;
        length -= taken;
    }
    return 0;
}

int output_write_head(struct output *output, const char *bytes, size_t length, struct diag *diag)
{
    if (send_first(output, output->held.length, diag) != 0)
        return -1;
    if (lseek(output->fd, 0, SEEK_SET) == 0 && output_write_all(output->fd, bytes, length) == 0 &&
        lseek(output->fd, 0, SEEK_END) >= 0)
        return 0;
    return cannot_write(output, diag);
}

int output_finish(struct output *output, struct diag *diag)
{
    send_first(output, output->held.length, diag);
    if (output->packer != NULL && !output->failed && write_packed(output, NULL, 0, true) != 0)
        cannot_write(output, diag);
    packing_pack_end(output->packer);
    output->packer = NULL;
    if (output->file != NULL && !output->failed && fsync(output->fd) != 0)
        cannot_write(output, diag);
    return output->failed ? -1 : 0;
}

int output_close(struct output *output, bool whole, struct diag *diag)
{
    int result = output_finish(output, diag);
    if (output->file != NULL && whole && result == 0 && take_name(output->file) != 0)
        result = cannot_create(output->name, diag);
    int closed = output->file != NULL ? close_file(output->file) : close(output->fd);
    if (closed != 0 && result == 0)
        result = cannot_write(output, diag);
    discard(output);
    return result;
}

/* Gives all finished files their names. The old files of these names go aside before the first new
 * one comes, and come back if there is a failure. */
static int name_together(struct output *const *outputs, size_t count, struct diag *diag)
{
    int result = 0;
    for (size_t i = 0; i < count; i++)
        if (outputs[i]->file != NULL)
            reserve_names(outputs[i]->file);
    for (size_t i = 0; i < count && result == 0; i++)
        if (outputs[i]->file != NULL && set_aside(outputs[i]->file) != 0)
            result = cannot_create(outputs[i]->name, diag);
    for (size_t i = 0; i < count && result == 0; i++)
        if (outputs[i]->file != NULL && take_name(outputs[i]->file) != 0)
            result = cannot_create(outputs[i]->name, diag);
    for (size_t i = 0; i < count; i++)
        if (outputs[i]->file != NULL)
            end_aside(outputs[i]->file, result == 0);
    return result;
}

int output_close_all(struct output **outputs, size_t count, bool whole, struct diag *diag)
{
    sigset_t before;
    size_t files = 0;
    int result = 0;
    for (size_t i = 0; i < count; i++) {
        files += outputs[i]->file != NULL;
        result = output_finish(outputs[i], diag) != 0 ? -1 : result;
    }
    block_signals(&before);
    whole = whole && result == 0;
    if (whole && files > 1) {
        result = name_together(outputs, count, diag);
        whole = false; /* none has a name to take any more */
    }
    for (size_t i = 0; i < count; i++)
        result = output_close(outputs[i], whole, diag) != 0 ? -1 : result;
    sigprocmask(SIG_SETMASK, &before, NULL);
    return result;
}

int output_print(const char *bytes, size_t length, struct diag *diag)
{
    struct output *output = output_open("-", diag);
    if (output == NULL)
        return -1;
    output_write(output, bytes, length, diag);
    return output_close(output, true, diag);
}
