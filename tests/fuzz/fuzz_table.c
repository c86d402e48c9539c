/* Antenna tables and receiver curves of a sensor, told apart by the names of their columns. */
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
#define CALIBRATED "\"calibration_ercs\":0.8,\"calibration_range_m\":50,"
static const char with_antenna[] = CALIBRATED "\"antenna_pattern\":\"table\","
                                              "\"antenna_table\":\"";
static const struct {
    const char *header, *members;
} curves[] = {
    {"range_m,", "\"antenna_pattern\":\"dipole_pair\",\"range_curve\":\""},
    {"azimuth_rad,level", CALIBRATED "\"antenna_pattern\":\"dipole_pair\",\"azimuth_curve\":\""},
    {"elevation_rad,",
     CALIBRATED "\"mount_z_m\":0.5,\"antenna_pattern\":\"dipole_pair\",\"elevation_curve\":\""},
};

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
    const char *members = with_antenna;
    for (size_t i = 0; i < sizeof curves / sizeof curves[0]; i++) {
        size_t length = strlen(curves[i].header);
        if (size > length && memcmp(bytes, curves[i].header, length) == 0)
            members = curves[i].members;
    }
    struct fuzz_file table, suite;
    struct text text = {0};
    fuzz_open(&table, bytes, size);
    text_add_word(&text, sensor);
    text_add_word(&text, members);
    text_add_word(&text, table.path);
    text_add_word(&text, "\"}]}");
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
