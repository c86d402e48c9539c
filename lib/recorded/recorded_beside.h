/* Frame rate and classes from the files beside a table.
 *
 * NN_tracks.csv has NN_tracksMeta.csv beside it, with a row for each track, and
 * NN_recordingMeta.csv with a single row. Each may be gzip, under its name or with ".gz" behind it.
 */
#pragma once

#include "base/intern.h"
#include "text/csv_table.h"

/* Names of the columns of tracksMeta; the rate is always "frameRate", the class "class". */
struct recorded_beside_columns {
    const char *id;
    const char *direction; /* 1 is against x, 2 along it; NULL: there is none */
};

struct recorded_track {
    const char *class;
    double direction_rad; /* of travel; NAN: not said */
};

struct recorded_beside {
    double rate_hz;
    struct intern ids;
    LIST_OF(struct recorded_track) tracks; /* by the number of the id */
};

/* Reads both files beside this table. All of it lies in the arena; -1 after a message that names
 * the file. */
int recorded_beside_read(struct recorded_beside *beside,
                         const struct recorded_beside_columns *columns, const char *table_path,
                         struct arena *arena, struct diag *diag);
