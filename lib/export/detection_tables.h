/* Frames as rows of tables that are joined by keys.
 *
 *     detections     a row for each target: its values, its label, the sensor's pose
 *     objects        a row for each object of each frame: truth
 *     scans          a row for each sensor that measured in a frame, without targets too
 *     contributors   a row for each echo in a target's label
 *     sightings      a row for each object that a sensor looked for, if the frames tell visibility
 *     lost           a row for each echo in no target, if the frames keep account
 *     frames         a row for each frame, with its numbers of rows in the other tables
 *
 * Members of the frame are columns of the same names (csv_columns.h). A column that ends in _key
 * numbers rows from first_key on: frame_key, scan_key, object_key and detection_key. A key is empty
 * where there is nothing to join, as clutter and false alarms are of no object. The label of a
 * detection is its contributor of the greatest weight. Numbers of a sighting are 0 where a line
 * lacks them.
 *
 * Keys stay below first_key + DETECTION_TABLES_KEYS. Nothing of a frame is kept. */
#pragma once

#include "base/text.h"
#include "export/npy_columns.h"
#include "frame/frame.h"

enum table {
    TABLE_DETECTIONS,
    TABLE_OBJECTS,
    TABLE_SCANS,
    TABLE_CONTRIBUTORS,
    TABLE_SIGHTINGS,
    TABLE_LOST,
    TABLE_FRAMES,
    TABLE_COUNT,
};

/* By enum table: names, and primary keys. Lost echoes have none, as two may be alike. */
extern const char *const detection_tables_names[];
extern const char *const detection_tables_primary[][2];

/* The rows that a part of a set has at most. */
#define DETECTION_TABLES_KEYS INT64_C(1000000000)

/* The structs, of which a row has the members, at most. */
enum { DETECTION_TABLES_STRUCTS = 5 };

struct detection_tables {
    struct text *rows[TABLE_COUNT];  /* receive the rows; NULL: the columns alone are asked for */
    struct npy_names *names;         /* for rows of npy_columns.h; NULL: rows of CSV */
    int64_t row_counts[TABLE_COUNT]; /* that have been written */
    int64_t frame_key, scan_key, object_key, detection_key; /* of the next row */
    int64_t end_key;
    struct csv_columns columns[TABLE_COUNT][DETECTION_TABLES_STRUCTS];
};

/* Sets the columns, which lie in the arena, and writes the heads of the tables whose rows are
 * set. */
void detection_tables_begin(struct detection_tables *tables, int64_t first_key,
                            struct arena *arena);

/* Appends the head of a table: the names of its columns, in an array of NumPy with the number of
 * rows that have been written. */
void detection_tables_write_head(const struct detection_tables *tables, enum table table,
                                 struct text *text);

/* Appends the rows of a frame in canonical order, which must have sensors and targets. Fails with
 * DIAG_DATA where there are no keys left. */
int detection_tables_add(struct detection_tables *tables, struct frame *frame, struct diag *diag);

/* Writes how many rows each table has, as lines. */
void detection_tables_write_counts(const struct detection_tables *tables, struct text *text);
