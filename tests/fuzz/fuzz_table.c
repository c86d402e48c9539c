/* Antenna and amplitude tables of a sensor: a table whose first row names a range is of amplitudes.
 */
#include <string.h>

#include "documents/suite_file.h"
#include "fuzz/fuzz.h"

static const char sensor[] =
    "{\"origin\":\"Fuzzed.\",\"sensors\":[{\"name\":\"front\",\"mount_x_m\":2,\"mount_y_m\":0,"
    "\"mount_yaw_rad\":0,\"carrier_hz\":24e9,\"range_min_m\":0.2,\"range_max_m\":50,"
    "\"field_of_view_rad\":3,\"threshold_db\":6,\"cell_range_m\":0.3,\"cell_range_rate_mps\":0.5,"
    "\"phase_reference\":\"centre\",\"angle_estimator\":\"magnitude\",\"pointer_sigma\":0.5,"
    "\"range_sigma_m\":0.02,\"range_rate_sigma_mps\":0.05,\"azimuth_sigma_rad\":0.04,"
    "\"final_threshold\":true,\"list_order\":\"strongest\",\"list_limit\":10,";
static const char with_antenna[] =
    "\"calibration_ercs\":0.8,\"calibration_range_m\":50,\"antenna_pattern\":\"table\","
    "\"antenna_table\":\"%s\"}]}";
static const char with_amplitudes[] =
    "\"antenna_pattern\":\"dipole_pair\",\"amplitude_table\":\"%s\"}]}";

static void look(const char *suite)
{
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    fuzz_scene(&frame, 0, "car");
    fuzz_chain(&frame, suite);
    arena_free(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    bool amplitudes = size > 5 && memcmp(bytes, "range", 5) == 0;
    struct fuzz_file table, suite;
    struct text text = {0};
    fuzz_open(&table, bytes, size);
    text_add_word(&text, sensor);
    if (amplitudes)
        text_format(&text, with_amplitudes, table.path);
    else
        text_format(&text, with_antenna, table.path);
    fuzz_open(&suite, text.bytes, text.length);
    struct arena arena = {0};
    struct diag diag = {0};
    bool taken = suite_file_load(suite.path, &arena, &diag) != NULL;
    fuzz_judge(&diag);
    if (taken)
        look(suite.path);
    arena_free(&arena);
    text_free(&text);
    fuzz_close(&suite);
    fuzz_close(&table);
    return 0;
}
