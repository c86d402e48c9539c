/* Values in CDR, the encoding of ROS 2's messages, little-endian.
 *
 * A message begins with four bytes that name its encoding. Every number stands at a multiple of its
 * size, counted from behind these. A sequence is the count of its items, an uint32, and then the
 * items. */
#pragma once

#include "base/text.h"

struct cdr {
    struct text *text;
    size_t begin; /* of what is counted */
};

/* Begins a message at the end of the text. */
struct cdr cdr_begin(struct text *text);

void cdr_add_uint8(struct cdr *cdr, uint8_t value); /* a bool, too */
void cdr_add_uint32(struct cdr *cdr, uint32_t value);
void cdr_add_int32(struct cdr *cdr, int32_t value);
void cdr_add_float32(struct cdr *cdr, float value);
void cdr_add_float64(struct cdr *cdr, double value);

/* A string with its NUL, of fewer than 2^32 bytes, behind their number. */
void cdr_add_string(struct cdr *cdr, const char *value);
