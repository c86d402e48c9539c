#include "text/text_table.h"

#include "check.h"

static void assert_table(const char *lines, int *widths, const char *mark, const char *expected)
{
    struct text *rows = check_text(), *text = check_text();
    text_add_word(rows, lines);
    text_table_write(rows, widths, mark, text);
    text_add(text, "", 1);
    assert_string_equal(text->bytes, expected);
}

TEST(columns_are_as_wide_as_their_widest_cells)
{
    assert_table("name\tus\nideal\t1.5\nno\t100.25\n", (int[]){-1, 1, 0}, "",
                 "name       us\nideal     1.5\nno     100.25\n");
}

TEST(columns_have_at_least_their_widths)
{
    assert_table("a\tb\n", (int[]){-3, 4, 0}, "", "a       b\n");
}

TEST(further_columns_share_the_last_width)
{
    assert_table("a\tb\tc\n10\t20\t300\n", (int[]){1, 0}, "", "  a    b    c\n 10   20  300\n");
}

TEST(a_mark_stands_before_every_line_and_no_space_at_its_end)
{
    assert_table("a\t\nb\tcd\n", (int[]){-1, -1, 0}, "# ", "# a\n# b  cd\n");
}

TEST(no_rows_are_no_lines)
{
    assert_table("", (int[]){1, 0}, "# ", "");
}
