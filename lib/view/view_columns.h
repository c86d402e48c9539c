/* Columns of numbers, packed for the page of glint-view. Real numbers are written in single
 * precision, whole numbers as narrowly as the largest of the column allows. view_data.h says what
 * the columns hold. */
#ifndef VIEW_COLUMNS_H
#define VIEW_COLUMNS_H

#include <stdint.h>

#include "base/text.h"
#include "text/field.h"

/* The name of each column in C and in the page; 'f' stands for real, 'u' for whole numbers. */
#define VIEW_COLUMNS(COLUMN)                                                                       \
    COLUMN(FRAME_TIME, "frame_time_s", 'f')                                                        \
    COLUMN(OBJECT_X, "object_x_m", 'f')                                                            \
    COLUMN(OBJECT_Y, "object_y_m", 'f')                                                            \
    COLUMN(OBJECT_YAW, "object_yaw_rad", 'f')                                                      \
    COLUMN(OBJECT_VX, "object_vx_mps", 'f')                                                        \
    COLUMN(OBJECT_VY, "object_vy_mps", 'f')                                                        \
    COLUMN(OBJECT_YAW_RATE, "object_yaw_rate_radps", 'f')                                          \
    COLUMN(OBJECT_LENGTH, "object_length_m", 'f')                                                  \
    COLUMN(OBJECT_WIDTH, "object_width_m", 'f')                                                    \
    COLUMN(SCAN_X, "scan_x_m", 'f')                                                                \
    COLUMN(SCAN_Y, "scan_y_m", 'f')                                                                \
    COLUMN(SCAN_YAW, "scan_yaw_rad", 'f')                                                          \
    COLUMN(SCAN_VX, "scan_vx_mps", 'f')                                                            \
    COLUMN(SCAN_VY, "scan_vy_mps", 'f')                                                            \
    COLUMN(SCAN_AGE, "scan_age_s", 'f')                                                            \
    COLUMN(TARGET_RANGE, "target_range_m", 'f')                                                    \
    COLUMN(TARGET_AZIMUTH, "target_azimuth_rad", 'f')                                              \
    COLUMN(TARGET_RATE, "target_range_rate_mps", 'f')                                              \
    COLUMN(TARGET_AMPLITUDE, "target_amplitude_db", 'f')                                           \
    COLUMN(TARGET_CELL_RANGE, "target_cell_range_m", 'f')                                          \
    COLUMN(TARGET_CELL_AZIMUTH, "target_cell_azimuth_rad", 'f')                                    \
    COLUMN(TARGET_CELL_RATE, "target_cell_range_rate_mps", 'f')                                    \
    COLUMN(TARGET_CELL_SUM, "target_cell_sum", 'f')                                                \
    COLUMN(CONTRIBUTOR_RANGE, "contributor_range_m", 'f')                                          \
    COLUMN(CONTRIBUTOR_AZIMUTH, "contributor_azimuth_rad", 'f')                                    \
    COLUMN(CONTRIBUTOR_RATE, "contributor_range_rate_mps", 'f')                                    \
    COLUMN(CONTRIBUTOR_ERCS, "contributor_ercs", 'f')                                              \
    COLUMN(CONTRIBUTOR_WEIGHT, "contributor_weight", 'f')                                          \
    COLUMN(DETAIL_SHORTFALL, "detail_shortfall_db", 'f')                                           \
    COLUMN(DETAIL_RANGE, "detail_range_m", 'f')                                                    \
    COLUMN(DETAIL_AZIMUTH, "detail_azimuth_rad", 'f')                                              \
    COLUMN(SPOT_X, "spot_x_m", 'f')                                                                \
    COLUMN(SPOT_Y, "spot_y_m", 'f')                                                                \
    COLUMN(FRAME_SCENE, "frame_scene", 'u')                                                        \
    COLUMN(FRAME_NUMBER, "frame_number", 'u')                                                      \
    COLUMN(FRAME_OBJECTS, "frame_objects", 'u')                                                    \
    COLUMN(FRAME_SCANS, "frame_scans", 'u')                                                        \
    COLUMN(OBJECT_ID, "object_id", 'u')                                                            \
    COLUMN(OBJECT_CLASS, "object_class", 'u')                                                      \
    COLUMN(SCAN_SENSOR, "scan_sensor", 'u')                                                        \
    COLUMN(SCAN_MEASURED, "scan_measured", 'u')                                                    \
    COLUMN(SCAN_TARGETS, "scan_targets", 'u')                                                      \
    COLUMN(SCAN_FATES, "scan_fates", 'u')                                                          \
    COLUMN(SCAN_DETAILS, "scan_details", 'u')                                                      \
    COLUMN(TARGET_UNDECIDED, "target_sign_undecided", 'u')                                         \
    COLUMN(TARGET_EFFECTS, "target_effects", 'u')                                                  \
    COLUMN(TARGET_CONTRIBUTORS, "target_contributors", 'u')                                        \
    COLUMN(CONTRIBUTOR_OBJECT, "contributor_object", 'u')                                          \
    COLUMN(CONTRIBUTOR_REFLECTOR, "contributor_reflector", 'u')                                    \
    COLUMN(CONTRIBUTOR_PATH, "contributor_path", 'u')                                              \
    COLUMN(CONTRIBUTOR_MIRROR, "contributor_mirror", 'u')                                          \
    COLUMN(CONTRIBUTOR_NUMBER, "contributor_number", 'u')                                          \
    COLUMN(FATE_OBJECT, "fate_object", 'u')                                                        \
    COLUMN(FATE_PATTERN, "fate_pattern", 'u')                                                      \
    COLUMN(DETAIL_OBJECT, "detail_object", 'u')                                                    \
    COLUMN(DETAIL_REFLECTOR, "detail_reflector", 'u')                                              \
    COLUMN(DETAIL_PATH, "detail_path", 'u')                                                        \
    COLUMN(DETAIL_MIRROR, "detail_mirror", 'u')                                                    \
    COLUMN(DETAIL_NUMBER, "detail_number", 'u')                                                    \
    COLUMN(DETAIL_BY, "detail_by", 'u')                                                            \
    COLUMN(SPOT_SCENE, "spot_scene", 'u')                                                          \
    COLUMN(SPOT_OBJECT, "spot_object", 'u')                                                        \
    COLUMN(SPOT_REFLECTOR, "spot_reflector", 'u')                                                  \
    COLUMN(PATTERN_ITEMS, "pattern_items", 'u')                                                    \
    COLUMN(ITEM_REFLECTOR, "item_reflector", 'u')                                                  \
    COLUMN(ITEM_PATH, "item_path", 'u')                                                            \
    COLUMN(ITEM_MIRROR, "item_mirror", 'u')                                                        \
    COLUMN(ITEM_NUMBER, "item_number", 'u')                                                        \
    COLUMN(ITEM_STAGE, "item_stage", 'u')                                                          \
    COLUMN(ITEM_REASON, "item_reason", 'u')                                                        \
    COLUMN(ITEM_EFFECT, "item_effect", 'u')                                                        \
    COLUMN(FRAME_COMPARED, "frame_compared", 'u')                                                  \
    COLUMN(SCAN_TRUTHS, "scan_truths", 'u')                                                        \
    COLUMN(TRUTH_RANGE, "truth_range_m", 'f')                                                      \
    COLUMN(TRUTH_AZIMUTH, "truth_azimuth_rad", 'f')                                                \
    COLUMN(TRUTH_RATE, "truth_range_rate_mps", 'f')                                                \
    COLUMN(TRUTH_AMPLITUDE, "truth_amplitude_db", 'f')                                             \
    COLUMN(TRUTH_OBJECT, "truth_object", 'u')                                                      \
    COLUMN(TRUTH_LISTED, "truth_listed", 'u')                                                      \
    COLUMN(FRAME_TRACKED, "frame_tracked", 'u')                                                    \
    COLUMN(FRAME_TRACKS, "frame_tracks", 'u')                                                      \
    COLUMN(TRACK_X, "track_x_m", 'f')                                                              \
    COLUMN(TRACK_Y, "track_y_m", 'f')                                                              \
    COLUMN(TRACK_VX, "track_vx_mps", 'f')                                                          \
    COLUMN(TRACK_VY, "track_vy_mps", 'f')                                                          \
    COLUMN(TRACK_APART, "track_apart_m", 'f')                                                      \
    COLUMN(TRACK_ID, "track_id", 'u')                                                              \
    COLUMN(TRACK_OBJECT, "track_object", 'u')                                                      \
    COLUMN(TRACK_BEFORE, "track_before", 'u')

#define VIEW_COLUMNS_ENUMERATOR(name, key, kind) COLUMN_##name,

enum view_column { VIEW_COLUMNS(VIEW_COLUMNS_ENUMERATOR) COLUMN_COUNT };

struct view_columns {
    LIST_OF(uint32_t) list[COLUMN_COUNT]; /* real numbers as their bits in single precision */
};

/* Appends a number to a column of its kind. */
void view_columns_add_real(struct view_columns *columns, enum view_column column, double value,
                           struct arena *arena);
void view_columns_add_count(struct view_columns *columns, enum view_column column, uint32_t value,
                            struct arena *arena);

/* The place of a column in the text of view_columns_write. */
struct view_column_place {
    const char *name;
    const char *type; /* "f4", "u1", "u2" or "u4": kind and bytes of its numbers */
    int64_t count;    /* how many numbers it has */
    int64_t begin;    /* index of its first character */
};

extern const struct record view_column_place_record;

/* Fills in the places of all COLUMN_COUNT columns. */
void view_columns_places(const struct view_columns *columns, struct view_column_place *places);

/* Writes all columns in base64, each beginning at a multiple of 16 characters. */
void view_columns_write(const struct view_columns *columns, struct text *text);

#endif
