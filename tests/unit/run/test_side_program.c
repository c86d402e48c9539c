/* A shell, which runs what it reads, stands in for a program that fails. */
#include "check.h"

#include <string.h>

#include "run/side_program.h"

struct run {
    struct text output;
    int64_t cpu_ns;
    struct diag diag;
    int result;
};

static struct run run_shell(const char *path, const char *script)
{
    struct run run = {0};
    struct text input = {0};
    text_add_word(&input, script);
    run.result = side_program_run(path, (char *[]){(char[]){"glint"}, NULL}, &input, &run.output,
                                  &run.cpu_ns, &run.diag);
    text_free(&input);
    return run;
}

static void output_and_time_are_added(void **state)
{
    (void)state;
    struct run run =
        run_shell("/bin/sh", "echo one; n=0; while [ $n -lt 9999 ]; do n=$((n+1)); done");
    assert_int_equal(run.result, 0);
    assert_int_equal(run.output.length, 4);
    assert_memory_equal(run.output.bytes, "one\n", 4);
    assert_true(run.cpu_ns > 0);
    text_free(&run.output);
}

static void its_failure_is_told_with_a_code_that_glint_has(void **state)
{
    (void)state;
    static const struct {
        const char *path, *script, *message;
        enum diag_code code;
    } cases[] = {
        {"/bin/sh", "exit 65", "/bin/sh: failed with exit status 65", DIAG_DATA},
        {"/bin/sh", "exit 3", "/bin/sh: failed with exit status 3", DIAG_INTERNAL},
        {"/bin/sh", "exit 127", "/bin/sh: failed with exit status 127", DIAG_INTERNAL},
        {"/bin/sh", "kill -9 $$", "/bin/sh: ended by signal 9", DIAG_INTERNAL},
        {"/bin/nothing", "", "/bin/nothing: cannot be started", DIAG_INTERNAL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        struct run run = run_shell(cases[i].path, cases[i].script);
        assert_int_equal(run.result, -1);
        assert_int_equal(run.diag.code, cases[i].code);
        assert_string_equal(run.diag.text, cases[i].message);
        text_free(&run.output);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(output_and_time_are_added),
        cmocka_unit_test(its_failure_is_told_with_a_code_that_glint_has),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
