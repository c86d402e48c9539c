/* For O_TMPFILE. */
#define _GNU_SOURCE
#define SCRATCH_FILE "a"
#include "scratch.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/utsname.h>
#include <sys/wait.h>

#include "text/input.h"
#include "text/output.h"

/* Replace functions of the system (Makefile). A test can have a file system without files without
 * names, one without locks, and a file that cannot be replaced. */
static bool names_only;
static bool lockless;
static bool irreplaceable;

/* True if the file system of the scratch folder has files without names. */
static bool has_unnamed(const char *folder)
{
    int file = open(folder, O_TMPFILE | O_WRONLY, 0666);
    return file >= 0 && close(file) == 0;
}

int __real_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...);

int __wrap_open(const char *path, int flags, ...)
{
    if (names_only && (flags & O_TMPFILE) == O_TMPFILE) {
        errno = EOPNOTSUPP;
        return -1;
    }
    return __real_open(path, flags, 0666);
}

int __real_flock(int fd, int operation);
int __wrap_flock(int fd, int operation);

int __wrap_flock(int fd, int operation)
{
    if (!lockless)
        return __real_flock(fd, operation);
    errno = ENOLCK;
    return -1;
}

int __real_rename(const char *from, const char *to);
int __wrap_rename(const char *from, const char *to);

int __wrap_rename(const char *from, const char *to)
{
    errno = EBUSY;
    return irreplaceable ? -1 : __real_rename(from, to);
}

static struct text *read_all(const char *path)
{
    struct text *text = check_text();
    struct diag diag = {0};
    struct input *input = input_open(path, &diag);
    if (input == NULL || input_all(input, SIZE_MAX, text, &diag) != 0)
        fail_msg("%s", diag.text);
    input_close(input);
    return text;
}

static struct text *sample_text(size_t length)
{
    struct text *text = check_text();
    for (size_t i = 0; i < length; i++)
        text_add(text, &"0123456789abcde\n"[(i * i / 7 + i / 1000) % 16], 1);
    return text;
}

/* Writes in pieces of the given size. */
static void write_file(const char *path, const struct text *text, size_t piece)
{
    struct diag diag = {0};
    struct output *output = output_open(path, &diag);
    assert_non_null(output);
    for (size_t at = 0; at < text->length; at += piece)
        assert_done(output_write, output, text->bytes + at,
                    piece < text->length - at ? piece : text->length - at);
    assert_done(output_close, output, 1);
}

/* The system is as it is again. */
static int remove_output(void **state)
{
    names_only = lockless = irreplaceable = false;
    return remove_scratch(state);
}

#define OUTPUT_TEST(name) TEST_WITH(make_scratch, remove_output, struct scratch *scratch, name)

OUTPUT_TEST(written_bytes_can_be_read)
{
    static const size_t lengths[] = {0, 1, 65535, 65536, 65537, 500000},
                        pieces[] = {1, 100, 65536, 65537, 500000};
    for (size_t i = 0; i < 6; i++)
        for (size_t j = i > 4 ? 1 : 0; j < 5; j++)
            for (int packed = 0; packed < 2; packed++) {
                const char *path = packed ? scratch_in(scratch, "a.gz") : scratch->path;
                struct text *text = sample_text(lengths[i]);
                write_file(path, text, pieces[j]);
                struct text *back = read_all(path);
                assert_int_equal(back->length, text->length);
                if (text->length > 0)
                    assert_memory_equal(back->bytes, text->bytes, text->length);
            }
    assert_int_equal(scratch_count(scratch), 2);
}

OUTPUT_TEST(appended_text_is_written_in_whole_pieces)
{
    static const size_t lengths[] = {1, 1000, 65535, 65536, 200000};
    struct text *all = check_text();
    struct diag diag = {0};
    struct output *output = output_open(scratch->path, &diag);
    assert_non_null(output);
    for (size_t i = 0; i < 100; i++) {
        struct text *line = sample_text(lengths[i % 5]);
        text_add(output_text(output), line->bytes, line->length);
        text_add(all, line->bytes, line->length);
        assert_done(output_send, output);
        assert_int_equal(output_text(output)->length, all->length % 65536);
    }
    assert_done(output_close, output, 1);
    struct text *back = read_all(scratch->path);
    assert_int_equal(back->length, all->length);
    assert_memory_equal(back->bytes, all->bytes, all->length);
}

OUTPUT_TEST(a_head_is_written_over_the_first_bytes_whether_they_are_held_or_not)
{
    static const size_t lengths[] = {5, 65536, 200000};
    for (size_t i = 0; i < 3; i++) {
        struct text *text = sample_text(lengths[i]);
        struct diag diag = {0};
        struct output *output = output_open(scratch->path, &diag);
        assert_done(output_write, output, text->bytes, text->length);
        assert_done(output_write_head, output, "head", 4);
        assert_done(output_write, output, "end", 3);
        assert_done(output_close, output, true);
        memcpy(text->bytes, "head", 4);
        text_add(text, "end", 3);
        struct text *back = read_all(scratch->path);
        assert_int_equal(back->length, text->length);
        assert_memory_equal(back->bytes, text->bytes, text->length);
    }
}

OUTPUT_TEST(gz_is_gzip_and_depends_on_nothing_but_its_content)
{
    struct text *text = sample_text(200000);
    unsigned char first[70000], second[70000];
    size_t lengths[2];
    for (int i = 0; i < 2; i++) {
        char other[128];
        snprintf(other, sizeof other, "%s/other%d.gz", scratch->directory, i);
        write_file(other, text, i ? 1000 : 70001);
        FILE *file = fopen(other, "rb");
        lengths[i] = fread(i ? second : first, 1, sizeof first, file);
        fclose(file);
        unlink(other);
        sleep(i == 0);
    }
    assert_int_equal(lengths[0], lengths[1]);
    assert_in_range(lengths[0], 100, sizeof first - 1);
    assert_memory_equal(first, second, lengths[0]);
    /* The magic, deflate, no flags (so no name), no time. */
    assert_memory_equal(first, "\x1f\x8b\x08\0\0\0\0\0", 8);
}

static void rewrite(struct scratch *scratch, const char *path, bool whole)
{
    struct text *old = check_text(), *new = sample_text(100000), *back;
    text_add_word(old, "old");
    write_file(path, old, 3);
    int before = scratch_count(scratch);
    int temporary = has_unnamed(scratch->directory) ? 0 : 1;
    struct diag diag = {0};
    struct output *output = output_open(path, &diag);
    assert_done(output_write, output, new->bytes, new->length);
    assert_done(output_finish, output);
    back = read_all(path);
    assert_int_equal(back->length, 3);
    assert_int_equal(scratch_count(scratch), before + temporary);
    assert_done(output_close, output, whole);
    assert_int_equal(scratch_count(scratch), before);
    back = read_all(path);
    assert_int_equal(back->length, whole ? new->length : old->length);
}

OUTPUT_TEST(the_name_is_taken_only_when_the_file_is_complete)
{
    for (int i = 0; i < 8; i++) {
        names_only = (i & 1) != 0;
        rewrite(scratch, (i & 2) != 0 ? scratch_in(scratch, "a.gz") : scratch->path, (i & 4) != 0);
    }
}

OUTPUT_TEST(a_file_that_is_replaced_keeps_its_mode)
{
    struct diag diag = {0};
    struct stat status;
    for (int round = 0; round < 2; round++) {
        names_only = round == 1;
        int file = open(scratch->path, O_WRONLY | O_CREAT | O_TRUNC);
        assert_true(file >= 0 && fchmod(file, 0640) == 0 && close(file) == 0);
        struct output *output = output_open(scratch->path, &diag);
        assert_non_null(output);
        assert_done(output_close, output, true);
        assert_int_equal(stat(scratch->path, &status), 0);
        assert_int_equal(status.st_mode & 07777, 0640);
    }
}

static void expect_bytes(const char *path, const char *bytes)
{
    struct text *back = read_all(path);
    assert_int_equal(back->length, strlen(bytes));
    assert_memory_equal(back->bytes, bytes, back->length);
}

/* A whole file of these bytes. */
static void write_word(const char *path, const char *word)
{
    struct text *text = check_text();
    text_add_word(text, word);
    write_file(path, text, text->length);
}

/* A process that has written a file but not named it, and then ends: by the signal or, for 0, by
 * itself. Returns its number. */
static pid_t end_early(const char *path, int signal)
{
    int code = 0;
    pid_t child = fork();
    if (child == 0) {
        struct diag diag = {0};
        /* A run in the background inherits that SIGINT or SIGHUP is ignored. */
        if (signal != 0 && signal != SIGKILL)
            sigaction(signal, &(struct sigaction){.sa_handler = SIG_DFL}, NULL);
        struct output *output = output_open(path, &diag);
        output_write(output, "half", 4, &diag);
        output_finish(output, &diag);
        if (signal != 0)
            raise(signal);
        output_close(output, false, &diag);
        _exit(DIAG_MEMORY);
    }
    assert_int_equal(waitpid(child, &code, 0), child);
    assert_int_equal(signal, WIFSIGNALED(code) ? WTERMSIG(code) : 0);
    return child;
}

/* The library's unlink and rename are these: a process can be killed before its Nth change of a
 * name. */
static int changes_left = -1;

static void change_name(void)
{
    if (changes_left >= 0 && changes_left-- == 0)
        raise(SIGKILL);
}

int unlink(const char *path)
{
    change_name();
    return unlinkat(AT_FDCWD, path, 0);
}

int rename(const char *from, const char *to)
{
    change_name();
    return renameat(AT_FDCWD, from, AT_FDCWD, to);
}

enum { TOGETHER = 3 };

/* Writes three files that belong together; true if that was ended before its Nth change of a name.
 */
static bool write_together(const char *const *paths, const char *word, int changes)
{
    int code = 0;
    pid_t child = fork();
    if (child == 0) {
        struct output *outputs[TOGETHER];
        struct diag diag = {0};
        changes_left = changes;
        for (int i = 0; i < TOGETHER; i++) {
            outputs[i] = output_open(paths[i], &diag);
            output_write(outputs[i], word, 3, &diag);
        }
        _exit(output_close_all(outputs, TOGETHER, true, &diag) == 0 ? 0 : DIAG_IO);
    }
    assert_int_equal(waitpid(child, &code, 0), child);
    assert_true(WIFSIGNALED(code) || WEXITSTATUS(code) == 0);
    return WIFSIGNALED(code);
}

OUTPUT_TEST(files_that_belong_together_are_never_old_beside_new)
{
    char names[TOGETHER][96];
    const char *paths[TOGETHER] = {names[0], names[1], names[2]};
    int kills = 0, before = scratch_count(scratch);
    bool killed = true;
    for (int i = 0; i < TOGETHER; i++)
        snprintf(names[i], sizeof names[i], "%s/%d.csv", scratch->directory, i);
    for (int changes = 0; killed; changes++) {
        int old = 0, new = 0;
        assert_false(write_together(paths, "old", -1));
        killed = write_together(paths, "new", changes);
        kills += killed;
        for (int i = 0; i < TOGETHER; i++) {
            if (access(paths[i], F_OK) != 0)
                continue;
            struct text *text = read_all(paths[i]);
            old += memcmp(text->bytes, "old", 3) == 0;
            new += memcmp(text->bytes, "new", 3) == 0;
        }
        assert_true(old == 0 || new == 0);
        assert_true(killed || new == TOGETHER);
    }
    assert_int_equal(kills,
                     3 * TOGETHER); /* an old file goes aside, a new one comes, the old ends */
    assert_int_equal(scratch_count(scratch), before + TOGETHER);
    for (int i = 0; i < TOGETHER; i++)
        unlink(paths[i]);
}

/* "DIRECTORY/.glint-PROCESS-NUMBER@HOST" */
static const char *temporary(struct scratch *scratch, pid_t process, int number)
{
    static char path[256];
    struct utsname system;
    uname(&system);
    snprintf(path, sizeof path, "%s/.glint-%d-%d@%s", scratch->directory, (int)process, number,
             system.nodename);
    return path;
}

OUTPUT_TEST(a_run_that_is_ended_leaves_the_folder_as_it_was)
{
    static const int signals[] = {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGPIPE, SIGXCPU, 0};
    write_word(scratch->path, "old");
    int before = scratch_count(scratch);
    for (int i = 0; i < 7; i++) {
        if (signals[i] != 0 && !has_unnamed(scratch->directory))
            continue;
        end_early(scratch->path, signals[i]);
        assert_int_equal(scratch_count(scratch), before);
        expect_bytes(scratch->path, "old");
    }
    end_early(scratch->path, SIGKILL);
    if (has_unnamed(scratch->directory))
        assert_int_equal(scratch_count(scratch), before);
}

OUTPUT_TEST(what_a_killed_run_leaves_is_named_plainly_and_removed_by_the_next)
{
    struct diag diag = {0};
    write_word(scratch->path, "old");
    unlink(scratch_in(scratch, "a.gz"));
    int before = scratch_count(scratch);
    names_only = true;
    struct output *running = output_open(scratch_in(scratch, "a.gz"), &diag);
    pid_t killed = end_early(scratch->path, SIGKILL);
    assert_int_equal(access(temporary(scratch, killed, 1), F_OK), 0);
    expect_bytes(scratch->path, "old");
    write_word(scratch->path, "new");
    assert_int_equal(access(temporary(scratch, killed, 1), F_OK), -1);
    assert_int_equal(access(temporary(scratch, getpid(), 1), F_OK), 0);
    assert_done(output_close, running, true);
    unlink(scratch_in(scratch, "a.gz"));
    assert_int_equal(scratch_count(scratch), before);
}

/* Whose file another host's temporary is, nobody here can know, and without locks nobody at all. */
OUTPUT_TEST(a_temporary_file_that_may_be_in_use_stays)
{
    const char *foreign = scratch_in(scratch, ".glint-1-1@elsewhere");
    names_only = true;
    write_word(scratch->path, "old");
    write_word(foreign, "another host's");
    lockless = true;
    pid_t killed = end_early(scratch->path, SIGKILL);
    write_word(scratch->path, "new");
    assert_int_equal(unlink(temporary(scratch, killed, 1)), 0);
    lockless = false;
    write_word(scratch->path, "newer");
    expect_bytes(scratch->path, "newer");
    expect_bytes(foreign, "another host's");
}

OUTPUT_TEST(a_full_disk_leaves_the_folder_as_it_was)
{
    struct text *new = sample_text(100000);
    write_word(scratch->path, "old");
    int before = scratch_count(scratch);
    for (int i = 0; i < 2; i++) {
        names_only = i == 1;
        int code = -1;
        pid_t child = fork();
        if (child == 0) {
            struct diag diag = {0};
            signal(SIGXFSZ, SIG_IGN);
            setrlimit(RLIMIT_FSIZE, &(struct rlimit){1000, 1000});
            struct output *output = output_open(scratch->path, &diag);
            output_write(output, new->bytes, new->length, &diag);
            output_close(output, true, &diag);
            _exit((int)diag.code);
        }
        assert_int_equal(waitpid(child, &code, 0), child);
        assert_int_equal(WEXITSTATUS(code), DIAG_IO);
        assert_int_equal(scratch_count(scratch), before);
        expect_bytes(scratch->path, "old");
    }
}

/* Somebody who guessed the temporary name has made a link of that name. */
OUTPUT_TEST(a_planted_link_is_neither_followed_nor_removed)
{
    const char *victim = scratch_in(scratch, "victim");
    write_word(victim, "precious");
    const char *planted = temporary(scratch, getpid(), 1);
    assert_int_equal(symlink("victim", planted), 0);
    for (int i = 0; i < 2; i++) {
        names_only = i == 1;
        write_word(scratch->path, "old");
        int before = scratch_count(scratch);
        write_word(scratch->path, "new");
        expect_bytes(scratch->path, "new");
        expect_bytes(victim, "precious");
        expect_bytes(planted, "precious");
        assert_int_equal(scratch_count(scratch), before);
    }
}

OUTPUT_TEST(two_writers_of_one_name_each_leave_a_whole_file)
{
    write_word(scratch->path, "old");
    int before = scratch_count(scratch);
    for (int i = 0; i < 2; i++) {
        names_only = i == 1;
        struct diag diag = {0};
        struct output *first = output_open(scratch->path, &diag);
        struct output *second = output_open(scratch->path, &diag);
        assert_done(output_write, first, "first", 5);
        assert_done(output_write, second, "second", 6);
        assert_done(output_close, first, true);
        expect_bytes(scratch->path, "first");
        assert_done(output_close, second, true);
        expect_bytes(scratch->path, "second");
        assert_int_equal(scratch_count(scratch), before);
    }
}

OUTPUT_TEST(the_other_name_of_a_file_that_is_replaced_keeps_the_old_bytes)
{
    const char *twin = scratch_in(scratch, "twin");
    for (int i = 0; i < 2; i++) {
        names_only = i == 1;
        write_word(scratch->path, "old");
        assert_int_equal(link(scratch->path, twin), 0);
        end_early(scratch->path, 0);
        expect_bytes(scratch->path, "old");
        write_word(scratch->path, "new");
        expect_bytes(scratch->path, "new");
        expect_bytes(twin, "old");
        unlink(twin);
    }
}

OUTPUT_TEST(a_file_that_turns_out_to_be_irreplaceable_keeps_its_bytes)
{
    write_word(scratch->path, "old");
    int before = scratch_count(scratch);
    for (int i = 0; i < 2; i++) {
        struct diag diag = {0};
        names_only = i == 1;
        struct output *output = output_open(scratch->path, &diag);
        assert_done(output_write, output, "new", 3);
        irreplaceable = true;
        assert_int_equal(output_close(output, true, &diag), -1);
        irreplaceable = false;
        assert_int_equal(diag.code, DIAG_CANNOT_CREATE);
        assert_non_null(strstr(diag.text, "busy; no new file can take the place of this one"));
        expect_bytes(scratch->path, "old");
        assert_int_equal(scratch_count(scratch), before);
    }
}

/* What a user without rights finds: the message, and the old bytes. */
static void expect_refused(struct scratch *scratch, const char *message)
{
    int code = -1;
    pid_t child = fork();
    if (child == 0) {
        struct diag diag = {0};
        bool ordinary = geteuid() != 0 || setuid(65534) == 0;
        bool refused = output_open(scratch->path, &diag) == NULL;
        _exit(ordinary && refused && strstr(diag.text, message) ? 0 : 1);
    }
    assert_int_equal(waitpid(child, &code, 0), child);
    assert_int_equal(code, 0);
    expect_bytes(scratch->path, "old");
}

OUTPUT_TEST(a_file_that_may_be_written_but_not_replaced_is_refused_at_once)
{
    write_word(scratch->path, "old");
    assert_int_equal(chmod(scratch->path, 0666), 0);
    assert_int_equal(chmod(scratch->directory, 0555), 0);
    expect_refused(scratch, ": Permission denied; no new file can take the place of this one: ");
    if (geteuid() == 0) {
        assert_int_equal(chmod(scratch->directory, 01777), 0);
        expect_refused(scratch, ": Operation not permitted; no new file can take the place of ");
    } else {
        print_message("left out, for it takes root: somebody else's file in a sticky folder\n");
    }
    assert_int_equal(chmod(scratch->directory, 0700), 0);
}

/* The user who replaces it owns the new one, which gives no rights of the old owner's. */
OUTPUT_TEST(somebody_elses_file_is_replaced)
{
    struct stat status;
    if (geteuid() != 0) {
        print_message("left out, for it takes root: somebody else's file\n");
        return;
    }
    write_word(scratch->path, "old");
    assert_int_equal(chmod(scratch->path, 06766), 0);
    assert_int_equal(chmod(scratch->directory, 0777), 0);
    int code = -1;
    pid_t child = fork();
    if (child == 0) {
        bool ordinary = setgid(65533) == 0 && setuid(65534) == 0;
        write_word(scratch->path, "new");
        _exit(!ordinary);
    }
    assert_int_equal(waitpid(child, &code, 0), child);
    assert_int_equal(code, 0);
    expect_bytes(scratch->path, "new");
    assert_int_equal(stat(scratch->path, &status), 0);
    assert_int_equal(status.st_uid, 65534);
    assert_int_equal(status.st_mode & 07777, 0766);
    assert_int_equal(chmod(scratch->directory, 0700), 0);
}

OUTPUT_TEST(a_file_that_may_not_be_written_is_refused_at_once)
{
    write_word(scratch->path, "old");
    assert_int_equal(chmod(scratch->path, 0444), 0);
    assert_int_equal(chmod(scratch->directory, 0777), 0);
    expect_refused(scratch, ": Permission denied");
    assert_int_equal(chmod(scratch->directory, 0700), 0);
}

OUTPUT_TEST(a_link_to_nothing_makes_the_file_that_it_names)
{
    const char *second = scratch_in(scratch, "link");
    struct stat status;
    unlink(scratch->path);
    assert_int_equal(symlink("fifo", second), 0);
    assert_int_equal(symlink("a", scratch_in(scratch, "fifo")), 0);
    for (int i = 0; i < 2; i++) {
        write_word(second, i == 0 ? "made" : "again");
        expect_bytes(scratch->path, i == 0 ? "made" : "again");
        assert_true(lstat(second, &status) == 0 && S_ISLNK(status.st_mode));
        assert_true(lstat(scratch_in(scratch, "fifo"), &status) == 0 && S_ISLNK(status.st_mode));
        assert_true(lstat(scratch->path, &status) == 0 && S_ISREG(status.st_mode));
    }
    unlink(scratch->path);
    assert_int_equal(symlink("link", scratch->path), 0);
    struct diag diag = {0};
    assert_null(output_open(second, &diag));
    assert_non_null(strstr(diag.text, ": Too many levels of symbolic links"));
}

OUTPUT_TEST(a_name_may_be_as_long_as_the_file_system_allows)
{
    char path[400];
    struct diag diag = {0};
    for (int letters = 255; letters <= 256; letters++) {
        names_only = !names_only;
        snprintf(path, sizeof path, "%s/%0*d", scratch->directory, letters, 0);
        struct output *output = output_open(path, &diag);
        assert_int_equal(output != NULL, letters == 255);
        if (output != NULL)
            assert_done(output_close, output, true);
        unlink(path);
    }
    assert_non_null(strstr(diag.text, ": File name too long"));
}

/* What a shell's > would do: the bytes go where the descriptor stands, behind what is there. */
OUTPUT_TEST(an_open_descriptor_is_written_directly)
{
    static const char *const folders[] = {"/dev/fd", "/proc/self/fd"};
    char path[64], link[128];
    snprintf(link, sizeof link, "%s/link", scratch->directory);
    for (int i = 0; i < 4; i++) {
        write_word(scratch->path, "");
        int file = open(scratch->path, O_WRONLY);
        assert_int_equal(write(file, "before ", 7), 7);
        snprintf(path, sizeof path, "%s/%d", folders[i % 2], file);
        assert_int_equal(symlink(path, link), 0);
        write_word(i < 2 ? path : link, "between ");
        assert_int_equal(write(file, "after", 5), 5);
        expect_bytes(scratch->path, "before between after");
        assert_int_equal(close(file), 0);
        unlink(link);
    }
}

OUTPUT_TEST(a_descriptor_that_cannot_be_written_is_refused)
{
    char path[64];
    write_word(scratch->path, "old");
    int file = open(scratch->path, O_RDONLY);
    snprintf(path, sizeof path, "/dev/fd/%d", file);
    for (int i = 0; i < 2; i++) { /* open for reading, and not open */
        struct diag diag = {0};
        assert_null(output_open(path, &diag));
        assert_int_equal(diag.code, DIAG_IO);
        assert_non_null(strstr(diag.text, ": Bad file descriptor"));
        assert_int_equal(close(file), i == 0 ? 0 : -1);
    }
    expect_bytes(scratch->path, "old");
}

OUTPUT_TEST(the_message_says_why_a_file_cannot_be_created_and_nothing_is_left)
{
    int before = scratch_count(scratch);
    struct diag diag = {0};
    assert_null(output_open("/nonexistent/a", &diag));
    assert_string_equal(diag.text, "/nonexistent/a: No such file or directory");
    assert_int_equal(diag.code, DIAG_CANNOT_CREATE);
    diag = (struct diag){0};
    assert_null(output_open(scratch->directory, &diag));
    assert_non_null(strstr(diag.text, ": Is a directory"));
    assert_int_equal(diag.code, DIAG_CANNOT_CREATE);
    assert_int_equal(scratch_count(scratch), before);
}

TEST(a_full_device_is_noticed_at_the_latest_when_it_is_closed)
{
    static const size_t lengths[] = {1, 65536, 65537, 1000000};
    for (size_t i = 0; i < 4; i++) {
        struct text *text = sample_text(lengths[i]);
        struct diag diag = {0};
        struct output *output = output_open("/dev/full", &diag);
        assert_non_null(output);
        int written = output_write(output, text->bytes, text->length, &diag);
        assert_int_equal(written, lengths[i] >= 65536 ? -1 : 0);
        int closed = output_close(output, written == 0, &diag);
        assert_true(written != 0 || closed != 0);
        assert_string_equal(diag.text, "/dev/full: No space left on device");
        assert_int_equal(diag.code, DIAG_IO);
    }
}

OUTPUT_TEST(pipes_and_devices_are_written_directly)
{
    struct diag diag = {0};
    struct output *output = output_open("/dev/null", &diag);
    assert_done(output_write, output, "abc", 3);
    assert_done(output_close, output, 0);
    struct stat status;
    assert_int_equal(stat("/dev/null", &status), 0);
    assert_true(S_ISCHR(status.st_mode));
    assert_int_equal(mkfifo(scratch_in(scratch, "fifo"), 0600), 0);
    pid_t child = fork();
    if (child == 0) {
        output = output_open(scratch_in(scratch, "fifo"), &diag);
        output_write(output, "through", 7, &diag);
        _exit(output_close(output, 1, &diag) != 0);
    }
    expect_bytes(scratch_in(scratch, "fifo"), "through");
    int code = -1;
    assert_int_equal(waitpid(child, &code, 0), child);
    assert_int_equal(code, 0);
}

static long waiting_in(int fd)
{
    int bytes = 0;
    assert_int_equal(ioctl(fd, FIONREAD, &bytes), 0);
    return bytes;
}

OUTPUT_TEST(nothing_is_written_behind_bytes_that_are_lost)
{
    struct diag diag = {0};
    struct text *text = sample_text(70000);
    const char *path = scratch_in(scratch, "fifo");
    signal(SIGPIPE, SIG_IGN);
    unlink(path);
    assert_int_equal(mkfifo(path, 0600), 0);
    int reader = open(path, O_RDONLY | O_NONBLOCK);
    struct output *output = output_open(path, &diag);
    close(reader);
    text_add(output_text(output), text->bytes, text->length);
    assert_int_equal(output_send(output, &diag), -1);
    reader = open(path, O_RDONLY | O_NONBLOCK);
    assert_int_equal(output_close(output, true, &diag), -1);
    assert_int_equal(waiting_in(reader), 0);
    close(reader);
    signal(SIGPIPE, SIG_DFL);
}

OUTPUT_TEST(a_pipe_takes_no_head_behind_its_bytes)
{
    struct diag diag = {0};
    unlink(scratch_in(scratch, "fifo"));
    assert_int_equal(mkfifo(scratch_in(scratch, "fifo"), 0600), 0);
    int reader = open(scratch_in(scratch, "fifo"), O_RDONLY | O_NONBLOCK);
    struct output *output = output_open(scratch_in(scratch, "fifo"), &diag);
    assert_int_equal(output_write_head(output, "head", 4, &diag), -1);
    assert_int_equal(diag.code, DIAG_IO);
    assert_string_equal(diag.text + strlen(diag.text) - 12, "Illegal seek");
    output_close(output, false, &diag);
    close(reader);
}

OUTPUT_TEST(what_a_pipe_holds_back_is_flushed)
{
    struct diag diag = {0};
    unlink(scratch_in(scratch, "fifo"));
    assert_int_equal(mkfifo(scratch_in(scratch, "fifo"), 0600), 0);
    int reader = open(scratch_in(scratch, "fifo"), O_RDONLY | O_NONBLOCK);
    struct output *output = output_open(scratch_in(scratch, "fifo"), &diag);
    assert_done(output_flush, output);
    assert_done(output_write, output, "held", 4);
    assert_int_equal(waiting_in(reader), 0);
    assert_done(output_flush, output);
    assert_int_equal(waiting_in(reader), 4);
    assert_done(output_close, output, true);
    assert_int_equal(waiting_in(reader), 4);
    close(reader);
}

/* Nobody can read a file before it has its name, and the bytes of a .gz do not depend on time. */
OUTPUT_TEST(files_keep_what_they_hold_back)
{
    for (int packed = 0; packed <= 1; packed++) {
        struct diag diag = {0};
        struct output *output =
            output_open(packed ? scratch_in(scratch, "a.gz") : scratch->path, &diag);
        assert_done(output_write, output, "held", 4);
        assert_done(output_flush, output);
        assert_int_equal(output_text(output)->length, 4);
        assert_done(output_close, output, true);
    }
}
