/* Runs the tests of the files that a program is linked from, file by file.
 *
 *     PROGRAM                 all tests
 *     PROGRAM FILE            those of a file, as test_field
 *     PROGRAM FILE TEST       one test
 *
 * The exit status is 1 if a test or a fixture fails, 64 if there is no such test. */
#include "check.h"

#include "base/arena.h"
#include "base/text.h"

extern const struct check_entry *const __start_check_entries[];
extern const struct check_entry *const __stop_check_entries[];

double check_cases(double usual)
{
    const char *cases = getenv("CASES");
    return cases != NULL ? atof(cases) : usual;
}

static struct arena arena;

struct arena *check_arena(void)
{
    return &arena;
}

static struct arena text_arena;
static LIST_OF(struct text *) texts;

struct text *check_text(void)
{
    struct text *text = arena_get(&text_arena, sizeof *text);
    *list_add(&texts, &text_arena) = text;
    return text;
}

void check_end(void)
{
    for (size_t i = 0; i < texts.count; i++)
        text_free(texts.items[i]);
    texts.count = texts.room = 0;
    arena_free(&text_arena);
    arena_free(&arena);
}

/* The name of a file without folder and ending. */
struct name {
    const char *text;
    int length;
};

static struct name name_of(const char *file)
{
    const char *slash = strrchr(file, '/');
    const char *text = slash != NULL ? slash + 1 : file;
    return (struct name){text, (int)strcspn(text, ".")};
}

static int by_place(const void *left, const void *right)
{
    const struct check_entry *a = *(const struct check_entry *const *)left;
    const struct check_entry *b = *(const struct check_entry *const *)right;
    int files = strcmp(a->file, b->file);
    return files != 0 ? files : a->line - b->line;
}

static bool is_fixture(const struct check_entry *entry)
{
    return entry->test.name == NULL;
}

static bool is_in(const struct check_entry *entry, const char *file)
{
    struct name name = name_of(entry->file);
    return strlen(file) == (size_t)name.length && strncmp(file, name.text, strlen(file)) == 0;
}

/* A fixture is wanted with any test of its file. */
static bool is_wanted(const struct check_entry *entry, int count, char **words)
{
    if (count > 1 && !is_in(entry, words[1]))
        return false;
    return count < 3 || is_fixture(entry) || strcmp(entry->test.name, words[2]) == 0;
}

/* cmocka prints that a teardown of a group failed, but does not count it. A teardown that ends by
 * a failed assertion does not return. */
static CMFixtureFunction group_teardown;
static bool group_is_torn_down;

static int counted_teardown(void **state)
{
    group_is_torn_down = false;
    int status = group_teardown(state);
    group_is_torn_down = status == 0;
    return status;
}

/* Runs tests between a setup and a teardown, which may be NULL; gives the number of failures. */
static int run_between(const struct CMUnitTest *tests, size_t count, CMFixtureFunction setup,
                       CMFixtureFunction teardown)
{
    group_teardown = teardown;
    group_is_torn_down = true;
    int failed = _cmocka_run_group_tests("tests", tests, count, setup,
                                         teardown != NULL ? counted_teardown : NULL);
    return failed + !group_is_torn_down;
}

/* Runs the tests that come next, to the next fixture or file. Sets the number of their entries;
 * gives that of the failures. */
static int run_group(const struct check_entry *const *entries, size_t count, size_t *taken)
{
    struct CMUnitTest *tests = calloc(count, sizeof *tests);
    if (tests == NULL)
        abort();
    CMFixtureFunction setup = NULL, teardown = NULL;
    *taken = 0;
    if (is_fixture(entries[0])) {
        setup = entries[0]->test.setup_func;
        teardown = entries[0]->test.teardown_func;
        *taken = 1;
    }
    size_t found = 0;
    for (; *taken < count && !is_fixture(entries[*taken]); ++*taken) {
        if (strcmp(entries[*taken]->file, entries[0]->file) != 0)
            break;
        tests[found++] = entries[*taken]->test;
    }
    struct name name = name_of(entries[0]->file);
    if (found > 0)
        print_message("[   FILE   ] %.*s\n", name.length, name.text);
    int failed = found > 0 ? run_between(tests, found, setup, teardown) : 0;
    free(tests);
    return failed;
}

int main(int count, char **words)
{
    size_t all = (size_t)(__stop_check_entries - __start_check_entries), wanted = 0, tests = 0;
    const struct check_entry **entries = calloc(all, sizeof *entries);
    if (entries == NULL)
        abort();
    for (size_t i = 0; i < all; i++)
        if (is_wanted(__start_check_entries[i], count, words)) {
            entries[wanted++] = __start_check_entries[i];
            tests += !is_fixture(__start_check_entries[i]);
        }
    if (tests == 0 || count > 3) {
        fprintf(stderr, "%s: no such test; its words are FILE and TEST, as test_field\n", words[0]);
        return 64;
    }
    qsort(entries, wanted, sizeof *entries, by_place);
    int failed = 0;
    size_t taken = 0;
    for (size_t done = 0; done < wanted; done += taken)
        failed += run_group(entries + done, wanted - done, &taken);
    free(entries);
    return failed != 0;
}
