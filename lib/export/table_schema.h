/* Columns of the tables, for programs that read them.
 *
 * table_schema_write_json appends an object with a Frictionless Table Schema for each table: names,
 * types, units, what the columns mean, and which keys join rows. table_schema_write_sql appends a
 * table macro for each, by which DuckDB reads it with these types: FROM detections('FOLDER'). */
#ifndef TABLE_SCHEMA_H
#define TABLE_SCHEMA_H

#include "base/text.h"

void table_schema_write_json(struct text *text);
void table_schema_write_sql(struct text *text);

#endif
