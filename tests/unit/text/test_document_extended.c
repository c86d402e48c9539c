#include "check.h"

#include "text/document.h"

static void assert_extended(const char *base, const char *own, const char *expected)
{
    assert_string_equal(document_extended(base, own, check_arena()), expected);
}

TEST(members_of_a_document_stand_before_those_of_its_base)
{
    assert_extended("{\"a\":1,\"b\":2}", "{\"extends\":\"x\",\"b\":3,\"c\":4}",
                    "{\"a\":1,\"b\":3,\"c\":4}");
    assert_extended("{\"a\":1}", "{\"extends\":\"x\"}", "{\"a\":1}");
}

TEST(objects_are_merged_and_other_values_replaced)
{
    assert_extended("{\"a\":{\"b\":1,\"c\":{\"d\":2}},\"e\":[1,2],\"f\":1}",
                    "{\"a\":{\"c\":{\"d\":3,\"g\":4}},\"e\":[5],\"f\":{\"h\":6}}",
                    "{\"a\":{\"b\":1,\"c\":{\"d\":3,\"g\":4}},\"e\":[5],\"f\":{\"h\":6}}");
}

TEST(null_takes_a_member_of_the_base_away)
{
    assert_extended("{\"a\":1,\"b\":{\"c\":2,\"d\":3}}", "{\"a\":null,\"b\":{\"c\":null}}",
                    "{\"b\":{\"d\":3}}");
    assert_extended("{\"a\":1}", "{\"b\":null}", "{\"a\":1}");
}

TEST(items_with_names_are_merged_by_name_and_new_ones_follow)
{
    assert_extended("{\"s\":[{\"name\":\"p\",\"v\":1},{\"name\":\"q\",\"v\":2}]}",
                    "{\"s\":[{\"name\":\"r\",\"v\":5},{\"name\":\"q\",\"w\":3}]}",
                    "{\"s\":[{\"name\":\"p\",\"v\":1},{\"name\":\"q\",\"v\":2,\"w\":3},"
                    "{\"name\":\"r\",\"v\":5}]}");
}

TEST(items_without_names_are_replaced)
{
    assert_extended("{\"s\":[{\"v\":1},{\"v\":2}]}", "{\"s\":[{\"v\":3}]}", "{\"s\":[{\"v\":3}]}");
    assert_extended("{\"s\":[]}", "{\"s\":[{\"name\":\"p\"}]}", "{\"s\":[{\"name\":\"p\"}]}");
    assert_extended("{\"s\":[{\"name\":\"p\"}]}", "{\"s\":[]}", "{\"s\":[]}");
}

TEST(the_base_of_a_document_is_a_text)
{
    struct diag diag = {0};
    assert_string_equal(document_base("{\"extends\":\"x\",\"a\":1}", check_arena(), &diag), "x");
    assert_null(document_base("{\"a\":{\"extends\":\"x\"}}", check_arena(), &diag));
    assert_null(document_base("[1]", check_arena(), &diag));
    assert_int_equal(diag.code, DIAG_OK);
    assert_null(document_base("{\"extends\":7}", check_arena(), &diag));
    assert_int_equal(diag.code, DIAG_CONFIG);
    assert_string_equal(diag.text, "extends: expected the name or the path of a document");
}

TEST(relative_paths_in_members_of_these_names_get_a_folder)
{
    static const char *const names[] = {"table", "curve", NULL};
    assert_string_equal(document_moved("{\"s\":[{\"table\":\"../a.csv\",\"name\":\"b\"},"
                                       "{\"curve\":\"/c.csv\",\"table\":null}]}",
                                       names, "d/", check_arena()),
                        "{\"s\":[{\"table\":\"d/../a.csv\",\"name\":\"b\"},"
                        "{\"curve\":\"/c.csv\",\"table\":null}]}");
}
