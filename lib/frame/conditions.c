#include "frame/conditions.h"

static const char *const roads[] = {
    [ROAD_UNKNOWN] = "unknown", [ROAD_ASPHALT] = "asphalt", [ROAD_CONCRETE] = "concrete", NULL};

static const struct field interferer_fields[] = {
    {FIELD_NAME_OF(struct interferer, object, "id of the object that carries it")},
    {FIELD_REAL_IN(struct interferer, eirp_dbm, -100, 100, "what it radiates towards us")},
    {FIELD_REAL_IN(struct interferer, slope_hzps, -1e15, 1e15, "of its chirps, falling negative")},
    {FIELD_REAL_IN(struct interferer, hit_share, 0, 1, "part of our chirps that it crosses")},
    {0},
};

static const struct record interferer_record = {FIELD_TABLE(
    struct interferer, interferer_fields, "interferer", "An object with a radar of its own.")};

#define NUMBER(member, most, help) {OPTIONAL_REAL(struct conditions, member, 0, most, help)},
#define CHOICE(type, member, choices, help)                                                        \
    {OPTIONAL_CHOICE(struct conditions, member, choices, help)},
#define LIST(type, member, record, help) {OPTIONAL_LIST(struct conditions, member, record, help)},
static const struct field condition_fields[] = {
#include "frame/conditions.def"
    {0},
};

#define UNSAID (-1)
#define NUMBER(member, most, help)                                                                 \
    {OPTIONAL_REAL(struct conditions, member, 0, most, help), .absent = UNSAID},
#define CHOICE(type, member, choices, help)                                                        \
    {OPTIONAL_CHOICE(struct conditions, member, choices, help), .absent = UNSAID},
#define LIST(...)
static const struct field change_fields[] = {
#include "frame/conditions.def"
    {0},
};

const struct record conditions_record = {
    FIELD_TABLE(struct conditions, condition_fields, "conditions",
                "Road and weather; what is not said is not there.")};

const struct record conditions_changes_record = {
    FIELD_TABLE(struct conditions, change_fields, "changes of conditions",
                "Road and weather; what is not said stays.")};

void conditions_change(struct conditions *conditions, const struct conditions *changes)
{
    for (const struct field *field = change_fields; field->name != NULL; field++) {
        size_t size = field->kind == FIELD_REAL ? sizeof(double) : sizeof(enum road);
        if (field_present(&conditions_changes_record, field, changes))
            memcpy((char *)conditions + field->offset, (const char *)changes + field->offset, size);
    }
}
