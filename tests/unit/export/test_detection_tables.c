#include "check.h"

#include "accounted_frame.h"
#include "export/detection_tables.h"
#include "frame/frame_order.h"

struct sheet {
    struct arena arena;
    struct detection_tables tables;
    struct text rows[TABLE_COUNT];
    struct diag diag;
};

static int begin(void **state)
{
    struct sheet *sheet = memory_get(sizeof *sheet);
    *sheet = (struct sheet){0};
    for (int i = 0; i < TABLE_COUNT; i++)
        sheet->tables.rows[i] = &sheet->rows[i];
    *state = sheet;
    return 0;
}

static int end(void **state)
{
    struct sheet *sheet = *state;
    for (int i = 0; i < TABLE_COUNT; i++)
        text_free(&sheet->rows[i]);
    arena_free(&sheet->arena);
    free(sheet);
    return 0;
}

/* The frame of accounted_frame.h, in canonical order: sensors left and right. */
static struct frame ordered_frame(struct sheet *sheet)
{
    struct frame frame = accounted_frame(&sheet->arena);
    for (size_t i = 0; i < frame.sensors.list.count; i++)
        frame.sensors.list.items[i].measured = true;
    frame_order(&frame);
    return frame;
}

/* The first cells of all rows below the header, up to the given number of commas. */
static void check_begins(const struct text *rows, const char *const *expected)
{
    const char *at = memchr(rows->bytes, '\n', rows->length);
    for (; *expected != NULL; expected++) {
        at++;
        assert_memory_equal(at, *expected, strlen(*expected));
        at = strchr(at, '\n');
    }
    assert_ptr_equal(at + 1, rows->bytes + rows->length);
}

#define TABLE_TEST(name) TEST_WITH(begin, end, struct sheet *sheet, name)

TABLE_TEST(keys_count_on_from_frame_to_frame_and_join_rows)
{
    struct frame frame = ordered_frame(sheet);
    detection_tables_begin(&sheet->tables, 1000, &sheet->arena);
    for (int i = 0; i < 2; i++)
        assert_int_equal(detection_tables_add(&sheet->tables, &frame, &sheet->diag), 0);
    check_begins(&sheet->rows[TABLE_FRAMES], (const char *const[]){"1000,s,", "1001,s,", NULL});
    check_begins(&sheet->rows[TABLE_OBJECTS],
                 (const char *const[]){"1000,1000,s,", "1001,1000,s,", "1002,1000,s,",
                                       "1003,1001,s,", "1004,1001,s,", "1005,1001,s,", NULL});
    check_begins(&sheet->rows[TABLE_SCANS],
                 (const char *const[]){"1000,1000,s,", "1001,1000,s,", "1002,1001,s,",
                                       "1003,1001,s,", NULL});
    check_begins(&sheet->rows[TABLE_DETECTIONS],
                 (const char *const[]){"1000,1000,1000,0,", "1001,1001,1000,0,",
                                       "1002,1002,1001,0,", "1003,1003,1001,0,", NULL});
    /* The objects are e, b and a: the leader of each target is of b, and the loss of a. */
    check_begins(&sheet->rows[TABLE_CONTRIBUTORS],
                 (const char *const[]){"1000,0,1001,b,", "1000,1,1002,a,", "1001,0,1001,b,",
                                       "1001,1,1002,a,", "1002,0,1004,b,", "1002,1,1005,a,",
                                       "1003,0,1004,b,", "1003,1,1005,a,", NULL});
    check_begins(&sheet->rows[TABLE_LOST],
                 (const char *const[]){"1000,1002,left,", "1001,1002,right,", "1002,1005,left,",
                                       "1003,1005,right,", NULL});
}

TABLE_TEST(a_sighting_joins_its_scan_and_its_object_and_its_counts_are_never_empty)
{
    struct frame frame = ordered_frame(sheet);
    *list_add(&frame.visibility, frame.arena) =
        (struct sighting){.sensor = "left", .object = "a", .visibility = 4};
    *list_add(&frame.visibility, frame.arena) =
        (struct sighting){"left", "b", 4, 3, 2, 1, 0.5, 1, 2, 1, 0, 0, 0};
    *list_add(&frame.visibility, frame.arena) =
        (struct sighting){.sensor = "right", .object = "gone", .visibility = 4};
    detection_tables_begin(&sheet->tables, 0, &sheet->arena);
    assert_int_equal(detection_tables_add(&sheet->tables, &frame, &sheet->diag), 0);
    check_begins(&sheet->rows[TABLE_SIGHTINGS],
                 (const char *const[]){"0,2,left,a,0,0,0,0,,0,0,0\n",
                                       "0,1,left,b,4,3,2,0.5,v40-60,2,1,0\n",
                                       "1,,right,gone,0,0,0,0,,0,0,0\n", NULL});
}

TABLE_TEST(what_is_of_no_object_has_no_key_of_one)
{
    struct frame frame = ordered_frame(sheet);
    frame.targets.count = 1;
    frame.targets.items[0].contributors.items[0].id.object = "ground";
    detection_tables_begin(&sheet->tables, 0, &sheet->arena);
    assert_int_equal(detection_tables_add(&sheet->tables, &frame, &sheet->diag), 0);
    check_begins(&sheet->rows[TABLE_CONTRIBUTORS],
                 (const char *const[]){"0,0,,ground,", "0,1,2,a,", NULL});
}

TABLE_TEST(a_sensor_that_did_not_measure_has_no_scan)
{
    struct frame frame = ordered_frame(sheet);
    frame.sensors.list.items[0].measured = false;
    memmove(frame.targets.items, frame.targets.items + 1, sizeof *frame.targets.items);
    frame.targets.count = 1;
    detection_tables_begin(&sheet->tables, 0, &sheet->arena);
    assert_int_equal(detection_tables_add(&sheet->tables, &frame, &sheet->diag), 0);
    check_begins(&sheet->rows[TABLE_SCANS], (const char *const[]){"0,0,s,", NULL});
    check_begins(&sheet->rows[TABLE_DETECTIONS], (const char *const[]){"0,0,0,0,", NULL});
    check_begins(&sheet->rows[TABLE_LOST], (const char *const[]){",2,left,", "0,2,right,", NULL});
}

TABLE_TEST(a_part_that_runs_out_of_keys_is_refused)
{
    struct frame frame = ordered_frame(sheet);
    detection_tables_begin(&sheet->tables, 0, &sheet->arena);
    sheet->tables.detection_key = DETECTION_TABLES_KEYS - 2;
    assert_int_equal(detection_tables_add(&sheet->tables, &frame, &sheet->diag), 0);
    assert_int_equal(detection_tables_add(&sheet->tables, &frame, &sheet->diag), -1);
    assert_int_equal(sheet->diag.code, DIAG_DATA);
    assert_string_equal(sheet->diag.text,
                        "a table has more than 1000000000 rows; expected parts of fewer");
}
