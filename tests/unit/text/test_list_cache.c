#include "check.h"

#include "frame/frame_text.h"
#include "text/list_cache.h"

static const char HEAD[] =
    "{\"version\":1,\"scene\":\"s\",\"frame\":0,\"time_s\":0,\"interval_s\":1,\"seed\":\"1\","
    "\"ego\":\"e\",\"objects\":[],\"reflectors\":[{\"model\":\"m\",\"objects\":[],\"points\":";

static const char *point_of(const char *name, double x)
{
    static char text[256];
    snprintf(text, sizeof text,
             "{\"name\":\"%s\",\"x\":%g,\"y\":0,\"facing_rad\":0,\"full_rad\":1,\"zero_rad\":2,"
             "\"shape\":\"hard\",\"ercs\":0.5}",
             name, x);
    return text;
}

static void line_of(struct text *line, const char *points)
{
    line->length = 0;
    text_format(line, "%s%s}]}", HEAD, points);
}

static int read_points(struct frame *frame, const char *points, struct diag *diag)
{
    struct text *line = check_text();
    line_of(line, points);
    int result = frame_text_read(line->bytes, line->length, frame, diag);
    return result;
}

/* A reader and a writer of frames with one cache. */
struct bench {
    struct arena arena;
    struct list_cache cache;
    struct frame frame;
    struct diag diag;
    struct text line;
};

static int make_bench(void **state)
{
    struct bench *bench = check_make(state, sizeof *bench);
    bench->frame = (struct frame){.arena = &bench->arena, .list_cache = &bench->cache};
    return 0;
}

static int remove_bench(void **state)
{
    struct bench *bench = *state;
    text_free(&bench->line);
    arena_free(&bench->cache.arena);
    arena_free(&bench->arena);
    free(bench);
    return 0;
}

#define CACHE_TEST(name) TEST_WITH(make_bench, remove_bench, struct bench *bench, name)

CACHE_TEST(the_same_text_is_the_same_list)
{
    char one[512], other[512];
    snprintf(one, sizeof one, "[%s]", point_of("a", 0.25));
    snprintf(other, sizeof other, "[%s ]", point_of("a", 0.5));
    for (int i = 0; i < 6; i++) {
        assert_int_equal(read_points(&bench->frame, i % 2 ? other : one, &bench->diag), 0);
        assert_int_equal(bench->frame.reflectors.items[0].points.count, 1);
        const struct point_reflector *point = &bench->frame.reflectors.items[0].points.items[0];
        assert_string_equal(point->name, "a");
        assert_close(point->x, i % 2 ? 0.5 : 0.25, 0);
    }
    assert_int_equal(bench->cache.kept.count, 2);
}

CACHE_TEST(a_faulty_list_is_refused_every_time)
{
    char wrong[512];
    snprintf(wrong, sizeof wrong, "[%s,%s]", point_of("a", 0.25), "{\"name\":\"\"}");
    for (int i = 0; i < 3; i++) {
        assert_refused(DIAG_DATA,
                       "reflectors[0].points[1].name: a name of 0 bytes; expected "
                       "1 to 1024",
                       read_points, &bench->frame, wrong);
    }
    assert_int_equal(bench->cache.kept.count, 0);
}

CACHE_TEST(lists_that_do_not_repeat_are_kept_up_to_a_limit)
{
    for (int i = 0; i < 3 * LIST_CACHE_MOST; i++) {
        char points[512];
        snprintf(points, sizeof points, "[%s]", point_of("a", i * 0.001));
        assert_int_equal(read_points(&bench->frame, points, &bench->diag), 0);
        assert_close(bench->frame.reflectors.items[0].points.items[0].x, i * 0.001, 1e-9);
    }
    assert_int_equal(bench->cache.kept.count, LIST_CACHE_MOST);
}

/* A stream's memory stays bounded whatever its lines hold. */
CACHE_TEST(long_lists_are_kept_up_to_a_limit_too)
{
    struct text *points = check_text();
    for (int i = 0; i < 40; i++) {
        points->length = 0;
        text_format(points, "[%s", point_of("a", i * 0.001));
        for (int j = 0; j < 1000; j++) {
            char name[16];
            snprintf(name, sizeof name, "b%d", j % 1000);
            text_format(points, ",%s", point_of(name, 0.25));
        }
        text_add(points, "]", 2);
        assert_int_equal(read_points(&bench->frame, points->bytes, &bench->diag), 0);
        assert_int_equal(bench->frame.reflectors.items[0].points.count, 1001);
    }
    assert_true(bench->cache.size >= LIST_CACHE_SIZE && bench->cache.size < 2 * LIST_CACHE_SIZE);
    assert_true(bench->cache.kept.count < 40);
}

CACHE_TEST(a_list_that_grows_leaves_the_kept_one_alone)
{
    char points[512];
    snprintf(points, sizeof points, "[%s]", point_of("a", 0.25));
    for (int i = 0; i < 3; i++) {
        assert_int_equal(read_points(&bench->frame, points, &bench->diag), 0);
        struct reflector_set *set = &bench->frame.reflectors.items[0];
        assert_int_equal(set->points.count, 1);
        if (i > 0)
            *list_add(&set->points, &bench->arena) = (struct point_reflector){.name = "b"};
    }
}

/* The line of a frame with this set's reflectors, with and without a cache. */
static void write_set(struct list_cache *cache, struct reflector_set *set, struct text *line)
{
    struct frame frame = {.scene = "s", .ego = "e", .present = PART_REFLECTORS};
    struct text *plain = check_text();
    frame.reflectors.items = set;
    frame.reflectors.count = 1;
    assert_done(frame_text_write, &frame, plain);
    frame.list_cache = cache;
    line->length = 0;
    assert_done(frame_text_write, &frame, line);
    assert_int_equal(line->length, plain->length);
    assert_memory_equal(line->bytes, plain->bytes, plain->length);
}

static struct reflector_set document_of(struct point_reflector *points, size_t count)
{
    struct reflector_set document = {.model = "m"};
    document.points.items = points;
    document.points.count = count;
    return document;
}

CACHE_TEST(the_text_of_a_documents_list_is_kept)
{
    struct point_reflector points[] = {{.name = "a", .x = 0.25}, {.name = "b", .x = 0.5}};
    struct reflector_set document = document_of(points, 2), set = document;
    set.document = &document;
    for (int i = 0; i < 3; i++) {
        write_set(&bench->cache, &set, &bench->line);
        assert_int_equal(bench->cache.kept.count, 1);
        assert_int_equal(bench->cache.size, bench->cache.kept.items[0].written.length);
    }
}

/* In the next frame the same address may hold another list. */
CACHE_TEST(a_frames_own_list_is_written_every_time)
{
    struct point_reflector own[] = {{.name = "a"}, {.name = "b"}}, read[] = {{.name = "a"}};
    struct reflector_set document = document_of(read, 1), set = document_of(own, 2);
    for (int i = 0; i < 6; i++) {
        own[1].x = 0.125 * i;
        set.points.count = 1 + (size_t)i % 2;
        set.document = i < 4 ? &document : NULL;
        write_set(&bench->cache, &set, &bench->line);
    }
    assert_int_equal(bench->cache.kept.count, 0);
}

CACHE_TEST(a_list_of_a_document_that_changed_is_written_anew)
{
    struct point_reflector points[] = {{.name = "a"}, {.name = "b"}}, other[] = {{.name = "c"}};
    struct reflector_set document = document_of(points, 2), set = document;
    set.document = &document;
    write_set(&bench->cache, &set, &bench->line);
    set.points.count = 1;
    write_set(&bench->cache, &set, &bench->line);
    set.points.items = other;
    write_set(&bench->cache, &set, &bench->line);
    assert_int_equal(bench->cache.kept.count, 1);
}

CACHE_TEST(a_list_that_was_read_is_written_in_canonical_form)
{
    char points[512], loose[512];
    snprintf(points, sizeof points, "[%s]", point_of("a", 0.25));
    snprintf(loose, sizeof loose, "[ %s ]", point_of("a", 25e-2));
    for (int i = 0; i < 4; i++) {
        assert_int_equal(read_points(&bench->frame, i % 2 ? points : loose, &bench->diag), 0);
        write_set(&bench->cache, &bench->frame.reflectors.items[0], &bench->line);
        bench->line.bytes[bench->line.length - 1] = '\0';
        assert_non_null(strstr(bench->line.bytes, points));
    }
    assert_int_equal(bench->cache.kept.count, 2);
}

/* A document's list that was written is known by its address alone. */
CACHE_TEST(a_list_that_was_only_written_is_found_in_no_line)
{
    struct point_reflector points[] = {{.name = "a", .x = 0.25}};
    struct reflector_set document = document_of(points, 1), set = document;
    char other[512];
    snprintf(other, sizeof other, "[%s]", point_of("b", 0.5));
    set.document = &document;
    write_set(&bench->cache, &set, &bench->line);
    assert_int_equal(read_points(&bench->frame, other, &bench->diag), 0);
    assert_int_equal(bench->frame.reflectors.items[0].points.count, 1);
    assert_string_equal(bench->frame.reflectors.items[0].points.items[0].name, "b");
}

CACHE_TEST(a_line_that_ends_within_a_kept_list_does_not_have_it)
{
    char points[512];
    snprintf(points, sizeof points, "[%s]", point_of("a", 0.25));
    assert_int_equal(read_points(&bench->frame, points, &bench->diag), 0);
    const struct record *record = bench->cache.kept.items[0].record;
    const char *end = points + strlen(points);
    assert_non_null(list_cache_find(&bench->cache, record, points, end));
    assert_null(list_cache_find(&bench->cache, record, points, end - 1));
}

CACHE_TEST(the_text_of_points_is_no_list_of_planes)
{
    char points[512], both[1100];
    snprintf(points, sizeof points, "[%s]", point_of("a", 0.25));
    snprintf(both, sizeof both, "%s,\"planes\":%s", points, points);
    assert_int_equal(read_points(&bench->frame, points, &bench->diag), 0);
    assert_int_equal(read_points(&bench->frame, both, &bench->diag), -1);
    static const char message[] = "reflectors[0].planes[0].x: unknown key";
    assert_memory_equal(bench->diag.text, message, sizeof message - 1);
}

/* The list's text in the line that was read has filled the memory already. */
CACHE_TEST(a_list_that_fills_the_memory_is_written_every_time)
{
    struct text *points = check_text();
    text_add(points, "[", 1);
    for (int i = 0; points->length < LIST_CACHE_SIZE; i++) {
        char name[16];
        snprintf(name, sizeof name, "b%d", i);
        text_format(points, "%s%s", i == 0 ? "" : ",", point_of(name, 0.25));
    }
    text_add(points, "]", 2);
    assert_int_equal(read_points(&bench->frame, points->bytes, &bench->diag), 0);
    size_t size = bench->cache.size;
    for (int i = 0; i < 2; i++)
        write_set(&bench->cache, &bench->frame.reflectors.items[0], &bench->line);
    assert_true(size >= LIST_CACHE_SIZE && bench->cache.size == size);
    assert_null(bench->cache.kept.items[0].written.bytes);
}

CACHE_TEST(text_that_was_written_is_kept_up_to_a_limit)
{
    enum { MANY = 1000, DOCUMENTS = 40 };
    static struct point_reflector points[DOCUMENTS][MANY];
    for (int i = 0; i < 2 * DOCUMENTS; i++) {
        for (int j = 0; j < MANY; j++)
            points[i % DOCUMENTS][j] = (struct point_reflector){.name = "a", .x = j * 0.001};
        struct reflector_set document = document_of(points[i % DOCUMENTS], MANY), set = document;
        set.document = &document;
        write_set(&bench->cache, &set, &bench->line);
    }
    assert_true(bench->cache.size >= LIST_CACHE_SIZE && bench->cache.size < 2 * LIST_CACHE_SIZE);
    assert_true(bench->cache.kept.count < DOCUMENTS);
}
