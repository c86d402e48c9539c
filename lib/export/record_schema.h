/* JSON Schemas of records, and of the tables of detections.
 *
 * They are printed from the tables of fields that readers and writers use (JSON Schema 2020-12;
 * Frictionless Table Schema). */
#pragma once

#include "base/text.h"
#include "text/field.h"

/* Appends the schema of a record. If drawn is true, every value may be a distribution
 * (document_draw). */
void record_schema_add(const struct record *record, bool drawn, struct text *text);

/* Appends an object with the schema of each table of glint-tables: names, types, units and meanings
 * of the columns, the primary key, and the foreign keys. */
void record_schema_add_tables(struct text *text);
