/* JSON Schemas of records, and of the tables of detections.
 *
 * They are printed from the tables of fields that readers and writers use (JSON Schema 2020-12;
 * Frictionless Table Schema). */
#pragma once

#include "base/text.h"
#include "text/field.h"

/* A document as it is; one whose values may be distributions (variation_draw); and one that extends
 * another (document_extended): it needs no member but "extends", and null takes one away. */
enum record_schema_kind { SCHEMA_PLAIN, SCHEMA_DRAWN, SCHEMA_EXTENDING };

/* Appends the schema of a record. */
void record_schema_add(const struct record *record, enum record_schema_kind kind,
                       struct text *text);

/* Appends an object with the schema of each table of glint-tables: names, types, units and meanings
 * of the columns, the primary key, and the foreign keys. */
void record_schema_add_tables(struct text *text);
