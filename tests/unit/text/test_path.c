#include "scratch.h"

#include "text/path.h"

SCRATCH_TEST(a_path_may_stand_for_a_descriptor)
{
    static const struct {
        const char *path;
        int descriptor;
    } cases[] = {{"-", 1},           {"/dev/stdout", 1},      {"/dev/fd/12", 12},
                 {"/dev/fd/", -1},   {"/proc/self/fd/0", 0},  {"/proc/thread-self/fd/7", 7},
                 {"/dev/fd/1a", -1}, {"/dev/fd/1/more", -1},  {"dev/fd/1", -1},
                 {"", -1},           {"/dev/stdout.txt", -1}, {"/dev/null", -1}};
    for (size_t i = 0; i < COUNT(cases); i++)
        assert_int_equal(path_descriptor(cases[i].path), cases[i].descriptor);
}

SCRATCH_TEST(a_path_is_a_folder_and_a_name)
{
    static const char *const cases[][3] = {
        {"a", ".", "a"}, {"/a", "/.", "a"}, {"b/c/a", "b/c/.", "a"}, {"b/", "b/.", ""}};
    for (size_t i = 0; i < 4; i++) {
        char *folder = path_folder(cases[i][0]);
        assert_string_equal(folder, cases[i][1]);
        assert_string_equal(path_name(cases[i][0]), cases[i][2]);
        free(folder);
    }
}

SCRATCH_TEST(devices_and_pipes_are_special)
{
    assert_true(path_is_special("/dev/null"));
    assert_false(path_is_special(scratch->directory));
    assert_false(path_is_special(scratch->path));
    fclose(fopen(scratch->path, "w"));
    assert_false(path_is_special(scratch->path));
}

/* file <- link <- longer, and other <- absolute; none of the files is there at first. */
static void make_links(struct scratch *scratch)
{
    assert_int_equal(symlink(SCRATCH_FILE, scratch_in(scratch, "link")), 0);
    assert_int_equal(symlink("./link", scratch_in(scratch, "longer")), 0);
    assert_int_equal(symlink(scratch_in(scratch, "other"), scratch_in(scratch, "absolute")), 0);
}

static void remove_links(struct scratch *scratch)
{
    static const char *const names[] = {"link", "longer", "absolute", "twin"};
    for (size_t i = 0; i < 4; i++)
        unlink(scratch_in(scratch, names[i]));
}

SCRATCH_TEST(links_lead_to_a_path_whether_its_file_is_there_or_not)
{
    make_links(scratch);
    for (int there = 0; there < 2; there++) {
        char *target = path_target(scratch_in(scratch, "longer"));
        assert_true(path_same_file(target, scratch->path));
        assert_string_equal(path_name(target), SCRATCH_FILE);
        free(target);
        target = path_target(scratch_in(scratch, "absolute"));
        assert_string_equal(target, scratch_in(scratch, "other"));
        free(target);
        fclose(fopen(scratch->path, "w"));
    }
    remove_links(scratch);
}

SCRATCH_TEST(two_paths_to_one_file_are_the_same_whether_it_is_there_or_not)
{
    static const char *const same[] = {"file", "./file", "link", "longer"};
    static const char *const others[] = {"other", "absolute", "nowhere/file"};
    make_links(scratch);
    for (int there = 0; there < 2; there++) {
        for (size_t i = 0; i < 4; i++) {
            for (size_t j = 0; j < 4; j++)
                assert_true(
                    path_same_file(scratch_in(scratch, same[i]), scratch_in(scratch, same[j])));
            for (size_t j = 0; j < 3; j++)
                assert_false(
                    path_same_file(scratch_in(scratch, same[i]), scratch_in(scratch, others[j])));
        }
        assert_true(path_same_file(scratch_in(scratch, "other"), scratch_in(scratch, "absolute")));
        fclose(fopen(scratch->path, "w"));
    }
    assert_int_equal(link(scratch->path, scratch_in(scratch, "twin")), 0);
    assert_true(path_same_file(scratch_in(scratch, "twin"), scratch_in(scratch, "longer")));
    assert_false(path_same_file("/dev/null", "/dev/null"));
    remove_links(scratch);
}
