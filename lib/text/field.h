/* Tables of a struct's members: for text, options, schemas, checks.
 *
 * A struct record lists the members of a C struct: the name (one spelling for C member, JSON key,
 * option and schema property, with the unit at its end), kind, bounds and help. The text of frames
 * in both directions, documents, command-line options, --help, the schemas and the check that
 * nothing out of bounds leaves a stage (record_write.h) all follow from it. Functions that fail
 * leave a message that starts with the member's name, so that callers can put the path in front of
 * it. */
#pragma once

#include <stdbool.h>
#include <stdint.h>

#include "base/arena.h"
#include "base/diag.h"

enum field_kind {
    FIELD_REAL,    /* double: finite, in [low, high] */
    FIELD_INTEGER, /* int64_t: in [low, high], at most 2^53 in size */
    FIELD_FLAG,    /* bool; where optional, absent means false */
    FIELD_NAME,    /* const char *: 1 to FIELD_NAME_SIZE bytes of UTF-8, NULL where absent. With
                    * choices they are well-known values among words of a to z and _ */
    FIELD_CHOICE,  /* an enum: the index of one of choices */
    FIELD_SEED, /* uint64_t, in text a string of decimal digits: JSON readers lose 64-bit numbers */
    FIELD_SET, /* uint64_t: bit i stands for choices[i], of at most 64; in text an array of names */
    FIELD_NAMES,  /* LIST_OF(const char *) */
    FIELD_RECORD, /* an embedded struct. An optional one is absent while all its members are; all or
                   * none of its members are then in groups */
    FIELD_LIST,   /* LIST_OF(a struct) */
    FIELD_RAW,    /* const char *: any JSON value, byte for byte, at most FIELD_RAW_SIZE */
    FIELD_NOTES,  /* no member: an object of strings, for people; documents only */
};

enum { FIELD_NAME_SIZE = 1024, FIELD_RAW_SIZE = 64 * 1024, FIELD_KEY_SIZE = 32 };

/* A piece of text, which somebody else keeps; bytes NULL: none. */
struct field_text {
    const char *bytes;
    size_t length;
};

/* The line that a struct was read from. Members whose group is in `same` still have the value that
 * the line has, and are written word for word as there; FIELD_UNGROUPED stands for all members
 * without a group. Stages that change a member take its group out. */
struct field_line {
    struct field_text *texts; /* by the fields of the record; NULL: there is no line */
    unsigned same;
    unsigned unread; /* groups of lists that are there as texts alone, not parsed yet */
};

/* The members that are in no group, in a set of groups. */
#define FIELD_UNGROUPED (1U << 31)

struct record;

struct field {
    const char *name;
    char key[FIELD_KEY_SIZE]; /* ,"range_m": as in a line, behind another member */
    unsigned char key_length;
    bool optional;  /* may be absent; it is not written if it has the value of an absent one */
    bool steady;    /* a list that frames repeat (list_cache.h) */
    bool or_number; /* a name that may be a whole number in text: its digits are the name */
    enum field_kind kind;
    size_t offset;
    double low, high; /* of a name: high is the most bytes, 0 for FIELD_NAME_SIZE */
    double absent;    /* number or choice that an absent member has */
    const struct record *record;
    const char *const *choices; /* NULL-terminated */
    unsigned group;             /* its bit in `present`, or 0 */
    const char *help;
    const char *word;   /* name of the value in --help, if not NUMBER, NAME, ... */
    const char *beyond; /* what to do with a number above high; NULL: nothing is said */
};

/* A member that a record had once, and what to write instead. */
struct field_gone {
    const char *name, *instead;
};

/* Tables end with a field without a name. Members that are present or absent together are a group.
 * A record with groups has their bits in an unsigned member at present_offset: the members of a
 * group are absent unless its bit is set. A member for which 0 is a value like any other needs a
 * group. A record with steady lists has, at document_offset, a pointer to the struct of the
 * document that it was copied from, or NULL. An inherited name is absent in text where the item
 * before in the list has the same; a struct always has it. A record that keeps its line
 * has a struct field_line at line_offset. */
struct record {
    const char *name;
    const char *help;
    size_t size;
    const struct field *fields;
    size_t present_offset;
    size_t document_offset;
    const struct field *inherited; /* the first of fields; NULL: none */
    size_t line_offset;            /* 0: it keeps no line */
    const struct field_gone *gone; /* ends without a name; NULL: none */
};

/* The most members of a record: readers note which ones they have seen. A longer table does not
 * compile. */
enum { FIELD_MOST = 127 };

#define FIELD_TABLE(owner, fields_, name_, help_)                                                  \
    .name = (name_), .help = (help_), .size = sizeof(owner),                                       \
    .fields = (fields_) +                                                                          \
              0 * sizeof(char[sizeof(fields_) / sizeof *(fields_) <= FIELD_MOST + 1 ? 1 : -1])

/* The table of a record without members. */
extern const struct field field_none[];

#define FIELD_NAMED(member)                                                                        \
    .name = #member, .key = ",\"" #member "\":", .key_length = sizeof ",\"" #member "\":" - 1

/* A member of any type, and a member of this type: one of another type does not compile. */
#define FIELD_OF(kind_, owner, member, help_)                                                      \
    FIELD_NAMED(member), .kind = (kind_), .offset = offsetof(owner, member), .help = (help_)
#define FIELD_TYPED(kind_, type, owner, member, help_)                                             \
    FIELD_NAMED(member),                                                                           \
        .kind = (kind_), .help = (help_),                                                          \
        .offset = offsetof(owner, member) + 0 * sizeof((type *[]){&((owner *)0)->member})

#define FIELD_REAL_IN(owner, member, low_, high_, help_)                                           \
    FIELD_TYPED(FIELD_REAL, double, owner, member, help_), .low = (low_), .high = (high_)
#define FIELD_INTEGER_IN(owner, member, low_, high_, help_)                                        \
    FIELD_TYPED(FIELD_INTEGER, int64_t, owner, member, help_), .low = (low_), .high = (high_)
#define FIELD_FLAG_OF(owner, member, help_) FIELD_TYPED(FIELD_FLAG, bool, owner, member, help_)
#define FIELD_NAME_OF(owner, member, help_)                                                        \
    FIELD_TYPED(FIELD_NAME, const char *, owner, member, help_)
#define FIELD_CHOICE_OF(owner, member, choices_, help_)                                            \
    FIELD_OF(FIELD_CHOICE, owner, member, help_), .choices = (choices_)
#define FIELD_SEED_OF(owner, member, help_) FIELD_TYPED(FIELD_SEED, uint64_t, owner, member, help_)
#define FIELD_SET_OF(owner, member, choices_, help_)                                               \
    FIELD_TYPED(FIELD_SET, uint64_t, owner, member, help_), .choices = (choices_)
#define FIELD_NAMES_OF(owner, member, help_) FIELD_OF(FIELD_NAMES, owner, member, help_)
#define FIELD_RECORD_OF(owner, member, record_, help_)                                             \
    FIELD_OF(FIELD_RECORD, owner, member, help_), .record = (record_)
#define FIELD_LIST_OF(owner, member, record_, help_)                                               \
    FIELD_OF(FIELD_LIST, owner, member, help_), .record = (record_)
#define FIELD_RAW_OF(owner, member, help_)                                                         \
    FIELD_TYPED(FIELD_RAW, const char *, owner, member, help_), FIELD_OPTIONAL
#define FIELD_OPTIONAL .optional = true
#define OPTIONAL_REAL(owner, member, low, high, help)                                              \
    FIELD_REAL_IN(owner, member, low, high, help), FIELD_OPTIONAL
#define OPTIONAL_INTEGER(owner, member, low, high, help)                                           \
    FIELD_INTEGER_IN(owner, member, low, high, help), FIELD_OPTIONAL
#define OPTIONAL_FLAG(owner, member, help) FIELD_FLAG_OF(owner, member, help), FIELD_OPTIONAL
#define OPTIONAL_NAME(owner, member, help) FIELD_NAME_OF(owner, member, help), FIELD_OPTIONAL
#define OPTIONAL_CHOICE(owner, member, choices, help)                                              \
    FIELD_CHOICE_OF(owner, member, choices, help), FIELD_OPTIONAL
#define OPTIONAL_RECORD(owner, member, record, help)                                               \
    FIELD_RECORD_OF(owner, member, record, help), FIELD_OPTIONAL
#define OPTIONAL_LIST(owner, member, record, help)                                                 \
    FIELD_LIST_OF(owner, member, record, help), FIELD_OPTIONAL
#define FIELD_STEADY .steady = true

/* The member of the struct at base, and a new value for it. By memcpy, because a table does not
 * know the member's C type. */
#define FIELD_LOAD(type, field, base)                                                              \
    (*(type *)memcpy(&(type){0}, (const char *)(base) + (field)->offset, sizeof(type)))
#define FIELD_STORE(type, field, base, value)                                                      \
    memcpy((char *)(base) + (field)->offset, &(type){(value)}, sizeof(type))

/* The groups that are present in the struct at base. */
static inline unsigned field_groups(const struct record *record, const void *base)
{
    unsigned present;
    memcpy(&present, (const char *)base + record->present_offset, sizeof present);
    return present;
}

/* The line of the struct at base; none unless the record keeps it. */
static inline struct field_line field_line(const struct record *record, const void *base)
{
    struct field_line line = {0};
    if (record->line_offset != 0)
        memcpy(&line, (const char *)base + record->line_offset, sizeof line);
    return line;
}

/* The unit that a name ends with, for messages and help: "m" for range_m, "" if the number has
 * none. */
const char *field_unit(const char *name);

/* The record's member of that name, or NULL. */
const struct field *field_find(const struct record *record, const char *name, size_t length);

/* The record's former member of that name, or NULL. */
const struct field_gone *field_find_gone(const struct record *record, const char *name,
                                         size_t length);

/* Sets every member to its value when absent. */
void field_clear(const struct record *record, void *base);

/* True if an absent member may have another value than zeros, which most have. */
static inline bool field_absent_differs(const struct field *field)
{
    return field->absent != 0 || field->kind == FIELD_RECORD;
}

/* Sets one member of a zeroed struct to its value when absent. */
void field_set_absent(const struct field *field, void *base);

/* The number that a member keeps: -0 is 0 where bounds begin at 0, as x / -0 is below 0. */
static inline double field_kept(const struct field *field, double number)
{
    return number == field->low ? field->low : number;
}

/* Sets the member of the struct at base, or refuses the value with "name: value is outside [..]
 * unit", "name: unknown choice ..." and the like. Text is copied into the arena. */
int field_set_number(const struct field *field, void *base, double value, struct diag *diag);
int field_set_text(const struct field *field, void *base, const char *text, size_t length,
                   struct arena *arena, struct diag *diag);

/* Adds one name to a set. Refuses an unknown name and one that is in the set already. */
int field_add_to_set(const struct field *field, void *base, const char *text, size_t length,
                     struct diag *diag);

/* Reads the whole of text as a finite decimal number ("1e3", ".5"), no words; -1 if it is not
 * one. */
int field_read_number(const char *text, size_t length, double *value);

/* True if a member without a group differs from its value when absent. */
bool field_differs(const struct field *field, const void *base);

/* True if the member is required, or differs from its value when absent. */
static inline bool field_present(const struct record *record, const struct field *field,
                                 const void *base)
{
    if (field->group != 0)
        return (field_groups(record, base) & field->group) != 0;
    return !field->optional || field_differs(field, base);
}

/* True if both structs have the same text (record_write.h). */
bool field_same(const struct record *record, const void *one, const void *other);

void field_mark_present(const struct record *record, const struct field *field, void *base);

/* The values that the field takes, for messages: "a number in [0, 1e+06] m", "one of a, b, c",
 * ... */
void field_expectation(const struct field *field, char *text, size_t size);

/* Refuses the value of a member with "name: FOUND; expected a number in ...", where found is the
 * JSON kind that was found, or "missing". */
int field_refuse(const struct field *field, const char *found, struct diag *diag);

/* Refuses a key that no member has: says what to write instead, or names the members. */
int field_unknown(const struct record *record, const char *name, size_t length, struct diag *diag);
int field_twice(const struct field *field, struct diag *diag);
int field_out_of_bounds(const struct field *field, double value, struct diag *diag);

/* Refuses text that is no name: "name: a name of 0 bytes; expected ...", "name: control character
 * ...". */
int field_require_name(const struct field *field, const char *text, size_t length,
                       struct diag *diag);

/* The value of a number, choice or flag; 0 for every other kind. */
double field_number(const struct field *field, const void *base);

/* The layout of every LIST_OF, whatever the type of its items. */
struct field_list {
    void *items;
    size_t count, room;
};

static inline struct field_list field_list(const struct field *field, const void *base)
{
    return FIELD_LOAD(struct field_list, field, base);
}

/* True if this steady list is still the list of the document, which does not change. */
static inline bool field_unchanged(const struct record *record, const struct field *field,
                                   const void *base)
{
    const void *document;
    memcpy(&document, (const char *)base + record->document_offset, sizeof document);
    if (document == NULL)
        return false;
    struct field_list list = field_list(field, base), read = field_list(field, document);
    return list.items == read.items && list.count == read.count;
}

/* Appends one zeroed item to the list member and returns its address. For FIELD_NAMES the item is a
 * const char *. */
void *field_list_add(const struct field *field, void *base, struct arena *arena);
