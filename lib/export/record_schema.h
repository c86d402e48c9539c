/* JSON Schemas of records, and of the tables of detections.
 *
 * They are printed from the tables of fields that readers and writers use (JSON Schema 2020-12;
 * Frictionless Table Schema). */
#pragma once

#include "base/text.h"
#include "text/field.h"

/* Appends the schema of a record's values. drawn: any of them may be a distribution
 * (document_draw). */
void record_schema_add(const struct record *record, bool drawn, struct text *text);

/* Appends an object with the schema of each table of glint-tables: names, types, units and meanings
 * of the columns, the keys that tell its rows apart, and those that join other tables. */
void record_schema_add_tables(struct text *text);
