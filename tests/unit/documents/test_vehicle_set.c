#include "scratch.h"

#include <sys/stat.h>

#include "documents/vehicle_set.h"

/* A folder of data with the set "own", which has a document of cars alone. */
static int make_data(void **state)
{
    make_scratch(state);
    struct scratch *scratch = *state;
    mkdir(scratch_in(scratch, "own"), 0777);
    mkdir(scratch_in(scratch, "own/vehicles"), 0777);
    mkdir(scratch_in(scratch, "empty"), 0777);
    scratch_write(scratch_in(scratch, "own/vehicles/car.json"), "{}");
    mkdir(scratch_in(scratch, "vehicles"), 0777);
    assert_int_equal(symlink(".", scratch_in(scratch, "itself")), 0);
    return setenv("GLINT_DATA", scratch->directory, 1);
}

static int remove_data(void **state)
{
    unsetenv("GLINT_DATA");
    return remove_scratch(state);
}

FIXTURE(make_data, remove_data);

static bool has(const struct document_names *sets, const char *word)
{
    for (size_t i = 0; i < sets->names.count; i++)
        if (strcmp(sets->names.items[i], word) == 0)
            return true;
    return false;
}

TEST_OF(scratch, a_word_means_the_folder_of_a_set)
{
    const char *folder;
    assert_done(vehicle_set_folder, "--vehicles", "own", &folder, &scratch->arena);
    assert_string_equal(folder, scratch_in(scratch, "own/vehicles"));
    assert_done(vehicle_set_folder, "--vehicles", "detailed", &folder, &scratch->arena);
    assert_non_null(strstr(folder, "data/detailed/vehicles"));
}

TEST_OF(scratch, no_folder_stands_before_the_papers)
{
    static const char *const words[] = {NULL, "paper"};
    for (size_t i = 0; i < COUNT(words); i++) {
        const char *folder = "before";
        assert_done(vehicle_set_folder, "--vehicles", words[i], &folder, &scratch->arena);
        assert_null(folder);
    }
}

TEST_OF(scratch, anything_but_a_bare_name_is_the_path_of_a_folder)
{
    const char *folder;
    assert_done(vehicle_set_folder, "--vehicles", scratch->directory, &folder, &scratch->arena);
    assert_string_equal(folder, scratch->directory);
    assert_refused(DIAG_CONFIG, "vehicles: \"./own\" is no folder", vehicle_set_folder, "vehicles",
                   "./own", &folder, &scratch->arena);
}

TEST_OF(scratch, an_unknown_word_gets_the_nearest_set_and_all_sets)
{
    const char *folder;
    struct diag diag = {0};
    assert_int_equal(vehicle_set_folder("vehicles", "detaild", &folder, &scratch->arena, &diag),
                     -1);
    assert_int_equal(diag.code, DIAG_CONFIG);
    static const char begin[] =
        "vehicles: \"detaild\" is no set of vehicles (did you mean detailed?); expected paper, ";
    assert_memory_equal(diag.text, begin, sizeof begin - 1);
    assert_non_null(strstr(diag.text, ", own, "));
    assert_non_null(strstr(diag.text, "or the path of a folder: ./detaild"));
}

/* A document that the folder named first does not have, and one that no folder has. */
TEST_OF(scratch, a_document_is_found_by_its_digest_in_any_set)
{
    unsetenv("GLINT_DATA");
    struct diag diag = {0};
    const char *folder;
    assert_done(vehicle_set_folder, "", "detailed", &folder, &scratch->arena);
    const struct vehicle *paper = vehicle_load("car", NULL, &scratch->arena, &diag);
    const struct vehicle *detailed = vehicle_load("car", folder, &scratch->arena, &diag);
    assert_string_not_equal(paper->digest, detailed->digest);
    const struct {
        const char *digest, *folder;
        const struct vehicle *found;
    } cases[] = {
        {NULL, NULL, paper},
        {NULL, folder, detailed},
        {paper->digest, NULL, paper},
        {paper->digest, folder, paper},
        {detailed->digest, NULL, detailed},
        {detailed->digest, folder, detailed},
        {"0123456789abcdef", NULL, paper},
        {"0123456789abcdef", folder, detailed},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        const struct vehicle *found =
            vehicle_set_load("car", cases[i].digest, cases[i].folder, &scratch->arena, &diag);
        assert_string_equal(found->digest, cases[i].found->digest);
        assert_int_equal(found->reflectors.points.count, cases[i].found->reflectors.points.count);
    }
    setenv("GLINT_DATA", scratch->directory, 1);
}

TEST_OF(scratch, sets_are_listed_by_the_classes_that_they_have)
{
    struct document_names all, cars, vans;
    assert_done(vehicle_set_list, NULL, &all, &scratch->arena);
    assert_done(vehicle_set_list, "car", &cars, &scratch->arena);
    assert_done(vehicle_set_list, "van", &vans, &scratch->arena);
    assert_true(has(&all, "own") && has(&cars, "own") && !has(&vans, "own"));
    assert_true(has(&all, "detailed") && has(&cars, "detailed") && has(&vans, "detailed"));
    assert_false(has(&all, "empty") || has(&all, "paper") || has(&all, "itself"));
}
