#include "check.h"

#include <jansson.h>

#include "sample.h"
#include "text/json_scan.h"

/* True if the text is one value with nothing but white space around it. */
static bool is_json(const char *text, size_t length, struct json_string *bytes)
{
    struct diag diag = {0};
    struct json_scan scan = {text, text + length, check_arena(), &diag};
    bool good = json_scan_value(&scan, bytes) == 0;
    assert_int_equal(good, diag.code == DIAG_OK);
    json_scan_peek(&scan);
    good = good && scan.at == scan.end;
    return good;
}

TEST(every_form_of_value_is_taken_with_its_exact_bytes)
{
    static const char values[] =
        "null\ntrue\nfalse\n0\n-0\n7\n-12\n0.5\n-0.0\n1e5\n1E+5\n1e-05\n12.25e3\n1e-400\n"
        "123456789012345678901234567890\n\"\"\n\"a\"\n\"\\\"\\\\\\/\\b\\f\\n\\r\\t\"\n"
        "\"\\u0001\"\n\"\\u00e9\\u20AC\"\n\"\\ud83d\\ude00\"\n\"\\uD800\\uDC00\"\n"
        "\"\\uDBFF\\uDFFF\"\n\"\\uFFFF\"\n\"\x7f\"\n\"\xc2\x80\"\n\"\xdf\xbf\"\n"
        "\"\xe0\xa0\x80\"\n\"\xed\x9f\xbf\"\n\"\xee\x80\x80\"\n\"\xef\xbf\xbf\"\n"
        "\"\xf0\x90\x80\x80\"\n\"\xf4\x8f\xbf\xbf\"\n[]\n[ ]\n{}\n{\t}\n[1]\n[1,2]\n"
        "[ 1 , 2\r]\n[[],[[]],{}]\n{\"a\":1}\n{\"\":[]}\n"
        "{ \"a\" : { \"b\" : [ ] } , \"c\" : null }\n{\"a\":1,\"a\":2}\n[\"]\",\"}\",\",\"]\n";
    for (const char *value = values; *value != '\0'; value = strchr(value, '\n') + 1) {
        int length = (int)strcspn(value, "\n");
        char padded[128];
        int padded_length = snprintf(padded, sizeof padded, "\t %.*s \r", length, value);
        struct json_string bytes;
        if (!is_json(padded, (size_t)padded_length, &bytes))
            fail_msg("%.*s was refused", length, value);
        assert_true(bytes.text == padded + 2);
        assert_int_equal(bytes.length, length);
    }
}

/* The bytes of the array that is passed over; 0: none. */
static size_t flat_length(const char *text)
{
    struct diag diag = {0};
    struct json_scan scan = {text, text + strlen(text), check_arena(), &diag};
    bool passed = json_scan_skip_flat(&scan);
    assert_int_equal(passed, scan.at != text);
    return (size_t)(scan.at - text);
}

TEST(an_array_without_arrays_is_passed_over_where_its_end_is_sure)
{
    static const struct {
        const char *text;
        size_t length;
    } sure[] = {{"[]}", 2},
                {"[],\"k\":1}", 2},
                {"[{\"a\":\"},{\"},{}],\"k\":1}", 16},
                {"[ what lies in it ],\"k", 19}};
    static const char *const unsure[] = {"[",
                                         "[1",
                                         "[1]",
                                         "[1]} ",
                                         "[1],",
                                         "[1],\"",
                                         "[1] ,\"k\":1}",
                                         "[1], \"k\":1}",
                                         "[1],\"\":",
                                         "[1],\"K\":1",
                                         "[[1],2],\"k\"",
                                         "[\"a]\"],\"k\"",
                                         "[\"\\\"],\\\"k\"]}",
                                         "{},\"k\":",
                                         "7,\"k\":1}",
                                         "[\"[\"],\"k\"",
                                         ""};
    for (size_t i = 0; i < COUNT(sure); i++)
        assert_int_equal(flat_length(sure[i].text), sure[i].length);
    for (size_t i = 0; i < COUNT(unsure); i++)
        if (flat_length(unsure[i]) != 0)
            fail_msg("%s was passed over", unsure[i]);
}

TEST(text_that_is_not_json_is_refused)
{
    static const char texts[] =
        "\n \nnul\nnulll\nTrue\ntru\ntruefalse\nNaN\nInfinity\n-Infinity\ninf\n-\n+1\n--1\n"
        "-a\n01\n-01\n00\n1.\n.5\n-.5\n1.e5\n1e\n1e+\n1E-\n1e1.5\n0x10\n1_000\n1 2\n1e309\n"
        "-1e400\n'a'\na\n\"\n\"a\n\"\\\"\n\"\\\n\"\\x\"\n\"\\a\"\n\"\\'\"\n\"\\0\"\n"
        "\"\\U0041\"\n\"\\u\"\n\"\\u12\"\n\"\\u123\"\n\"\\u12g4\"\n\"\\u+123\"\n\"\\u0000\"\n"
        "\"\\ud800\"\n\"\\ud800a\"\n\"\\ud800\\n\"\n\"\\ud800\\ud800\"\n\"\\ud800\\u0041\"\n"
        "\"\\ud800\\udc0\"\n\"\\udc00\"\n\"\\udfff\\ud800\"\n\"\t\"\n\"\x1f\"\n\"\x80\"\n"
        "\"\xbf\"\n\"\xc0\x80\"\n\"\xc1\xbf\"\n\"\xc2\"\n\"\xc2\x41\"\n\"\xe0\x9f\xbf\"\n"
        "\"\xe2\x82\"\n\"\xe2\x82\x41\"\n\"\xed\xa0\x80\"\n\"\xed\xbf\xbf\"\n"
        "\"\xf0\x8f\xbf\xbf\"\n\"\xf0\x9f\x98\"\n\"\xf4\x90\x80\x80\"\n\"\xf5\x80\x80\x80\"\n"
        "\"\xf8\x88\x80\x80\x80\"\n\"\xff\"\n\xef\xbb\xbf[]\n[\n]\n[1\n[1,\n[1,]\n[,1]\n[,]\n"
        "[1,,2]\n[1 2]\n[1;2]\n[1}\n[1]]\n[]]\n[\"a\"1]\n[:]\n[\"a\":1]\n{\n}\n{]\n{,}\n"
        "{\"a\"}\n{\"a\":}\n{\"a\",1}\n{\"a\" 1}\n{\"a\"::1}\n{\"a\":1\n{\"a\":1,\n"
        "{\"a\":1,}\n{,\"a\":1}\n{\"a\":1,,\"b\":2}\n{\"a\":1 \"b\":2}\n{\"a\":1]\n{a:1}\n"
        "{'a':1}\n{1:1}\n{null:1}\n{[]:1}\n{\"a\":1}}\n{\"a\":1}#\n[1]//\n[/**/]\n[\v]\n"
        "[\f]\n[\xa0]\n[1]x\n[-]\n{\"a\":b}\n[a\n\\u0031\n[\"a\\\"]\n*\n<null>\n";
    struct json_string bytes;
    for (const char *text = texts; *text != '\0'; text = strchr(text, '\n') + 1)
        if (is_json(text, strcspn(text, "\n"), &bytes))
            fail_msg("%.*s was taken", (int)strcspn(text, "\n"), text);
    assert_false(is_json("[\n1]", 4, &bytes));
}

TEST(a_nul_byte_is_no_json_wherever_it_stands)
{
    static const char text[] = "{\"ab\": [12, true, \"c\\n\"], \"d\": {}}";
    for (size_t i = 0; i <= sizeof text - 1; i++) {
        char with[sizeof text + 1];
        memcpy(with, text, i);
        with[i] = '\0';
        memcpy(with + i + 1, text + i, sizeof text - i);
        struct json_string bytes;
        assert_false(is_json(with, sizeof text, &bytes));
    }
}

TEST(a_value_that_is_cut_short_is_refused)
{
    static const char text[] = "{\"a\":[1,{\"b\\u00e9\":null},\"\xe2\x82\xac\"],\"c\":false}";
    struct json_string bytes;
    assert_true(is_json(text, sizeof text - 1, &bytes));
    for (size_t length = 0; length < sizeof text - 1; length++) {
        /* Exactly this much memory, so that a sanitizer sees a step beyond the end. */
        char *cut = malloc(length + 1);
        char *place = cut + 1;
        memcpy(place, text, length);
        assert_false(is_json(place, length, &bytes));
        free(cut);
    }
}

TEST(values_nest_to_the_limit_and_no_deeper)
{
    char text[6 * (JSON_SCAN_DEPTH + 1) + 1];
    for (size_t depth = JSON_SCAN_DEPTH - 1; depth <= JSON_SCAN_DEPTH + 1; depth++) {
        struct json_string bytes;
        memset(text, '[', depth);
        memset(text + depth, ']', depth);
        assert_int_equal(is_json(text, 2 * depth, &bytes), depth <= JSON_SCAN_DEPTH);
        for (size_t i = 0; i < depth; i++) {
            memcpy(text + 5 * i, i + 1 < depth ? "{\"a\":" : "{    ", 5);
            text[5 * depth + i] = '}';
        }
        assert_int_equal(is_json(text, 6 * depth, &bytes), depth <= JSON_SCAN_DEPTH);
    }
    char deep[20000];
    memset(deep, '[', sizeof deep);
    struct json_string bytes;
    assert_false(is_json(deep, sizeof deep, &bytes));
}

TEST(strings_are_decoded)
{
    static const struct {
        const char *text, *meaning;
    } cases[] = {
        {"\"\"", ""},
        {"\"plain \xe2\x82\xac\"", "plain \xe2\x82\xac"},
        {"\"\\\"\\\\\\/\\b\\f\\n\\r\\t\"", "\"\\/\b\f\n\r\t"},
        {"\"\\u0041\\u007F\\u0080\\u07ff\\u0800\\uffff\"",
         "A\x7f\xc2\x80\xdf\xbf\xe0\xa0\x80\xef\xbf\xbf"},
        {"\"x\\ud800\\udc00y\\uDBFF\\udfffz\"", "x\xf0\x90\x80\x80y\xf4\x8f\xbf\xbfz"},
        {"\"\\u0001\\u001f\"", "\x01\x1f"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct diag diag = {0};
        size_t length = strlen(cases[i].text);
        struct json_scan scan = {cases[i].text, cases[i].text + length, check_arena(), &diag};
        struct json_string string;
        assert_int_equal(json_scan_string(&scan, &string), 0);
        assert_int_equal(string.length, strlen(cases[i].meaning));
        assert_memory_equal(string.text, cases[i].meaning, string.length);
        assert_true(scan.at == scan.end);
    }
}

TEST(every_code_point_survives_its_escapes)
{
    for (unsigned code = 1; code < 0x110000; code += code < 0x3000 ? 1 : 97) {
        if (code >= 0xd800 && code < 0xe000)
            continue;
        char text[24];
        unsigned high = 0xd800 + ((code - 0x10000) >> 10),
                 low = 0xdc00 + ((code - 0x10000) & 0x3ff);
        if (code < 0x10000)
            snprintf(text, sizeof text, "\"\\u%04X\"", code);
        else
            snprintf(text, sizeof text, "\"\\u%04x\\u%04x\"", high, low);
        json_t *expected = json_loads(text, JSON_DECODE_ANY, NULL);
        assert_non_null(expected);
        struct diag diag = {0};
        struct json_scan scan = {text, text + strlen(text), check_arena(), &diag};
        struct json_string string;
        assert_int_equal(json_scan_string(&scan, &string), 0);
        assert_int_equal(string.length, json_string_length(expected));
        assert_memory_equal(string.text, json_string_value(expected), string.length);
        json_decref(expected);
    }
}

TEST(messages_say_what_was_expected)
{
    static const struct {
        const char *text, *message;
    } cases[] = {
        {"", "the line ends where a value is expected"},
        {"[1,", "the line ends where a value is expected"},
        {"[1;", "';' where ',' or ']' is expected"},
        {"{\"a\":1;", "';' where ',' or '}' is expected"},
        {"{\"a\" 1}", "'1' where ':' is expected"},
        {"{1}", "'1' where a string is expected"},
        {"[\x01]", "byte 0x01 where a value is expected"},
        {"[\xc3\xa9]", "byte 0xc3 where a value is expected"},
        {"[01]", "'0' where a number is expected"},
        {"1e999", "1e999 is too large for a double"},
        {"\"a\tb\"", "control character 0x09 in a string"},
        {"\"\\q\"", "a bad escape in a string"},
        {"\"\xff\"", "byte 0xff in a string is not UTF-8"},
        {"\"ab", "the line ends inside a string"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct arena arena = {0};
        struct diag diag = {0};
        struct json_scan scan = {cases[i].text, cases[i].text + strlen(cases[i].text), &arena,
                                 &diag};
        struct json_string bytes;
        assert_int_equal(json_scan_value(&scan, &bytes), -1);
        assert_string_equal(diag.text, cases[i].message);
        assert_int_equal(diag.code, DIAG_DATA);
    }
}

static size_t mutate(char *text, size_t length, size_t room, uint64_t *random)
{
    static const char bytes[] =
        "{}[]:,\"\\ \t\r019-+.eEtfnu/bdD8cC\x80\xbf\xc2\xe2\xed\xf0\x9f\x01\x7f";
    for (uint64_t changes = 1 + sample_bits(random) % 4; changes > 0; changes--) {
        size_t at = sample_bits(random) % (length + 1);
        char byte = bytes[sample_bits(random) % (sizeof bytes - 1)];
        switch (sample_bits(random) % 4) {
        case 0:
            if (at < length)
                text[at] = byte;
            break;
        case 1:
            if (at < length)
                memmove(text + at, text + at + 1, --length - at);
            break;
        case 2:
            if (length < room) {
                memmove(text + at + 1, text + at, length++ - at);
                text[at] = byte;
            }
            break;
        default:
            if (at + 4 < length)
                memmove(text + at, text + sample_bits(random) % (length - 4), 4);
        }
    }
    return length;
}

/* jansson is given integers as reals: its own are 64 bits wide, JSON's are not. */
TEST(jansson_takes_and_refuses_the_same_mutated_lines)
{
    static const char *const seeds[] = {
        "{\"a\":[1,-2.5e3,{\"b\":null}],\"c\":\"x\\u00e9\\ud83d\\ude00\"}",
        "[true,false,null,0,-0,1e5,12345678901234567890123]",
        "{\"\":{},\"k\":[[],[[\"\xe2\x82\xac\"]]],\"k\":\"\\\\\\\"\\/\"}",
        "\"\xf0\x9f\x98\x80\xed\x9f\xbf\xc2\x80\"",
        "-12.75E-3",
        " [ 1 , \"two\" , { \"three\" : 3 } ] "};
    uint64_t random = 5;
    size_t taken = 0, wide = 0;
    for (int i = 0; i < 100000; i++) {
        char text[100];
        const char *seed = seeds[sample_bits(&random) % COUNT(seeds)];
        size_t length = strlen(seed);
        memcpy(text, seed, length);
        length = mutate(text, length, sizeof text, &random);
        struct json_string bytes;
        json_error_t error;
        bool ours = is_json(text, length, &bytes);
        json_t *tree = json_loadb(text, length, JSON_DECODE_ANY | JSON_DECODE_INT_AS_REAL, &error);
        if (ours != (tree != NULL))
            fail_msg("%.*s: jansson says %s", (int)length, text, tree ? "yes" : error.text);
        json_decref(tree);
        taken += ours;
        tree = json_loadb(text, length, JSON_DECODE_ANY, &error);
        wide += ours && tree == NULL;
        if (ours && tree == NULL)
            assert_non_null(strstr(error.text, "too big"));
        json_decref(tree);
    }
    /* Both verdicts, and the one known difference, did occur. */
    assert_in_range(taken, 10000, 90000);
    assert_true(wide > 100);
}
