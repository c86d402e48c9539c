#define SCRATCH_FILE "suite.json"
#include "scratch.h"

#include "base/text.h"
#include "documents/suite_file.h"
#include "documents/vehicle.h"
#include "traffic/scenario.h"

/* Calls load with the name of every JSON file in data/KIND. */
static size_t load_all(const char *kind, void (*load)(const char *name, struct arena *arena))
{
    char folder[64];
    snprintf(folder, sizeof folder, "data/%s", kind);
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    size_t count = 0;
    for (struct dirent *entry = readdir(directory); entry != NULL; entry = readdir(directory)) {
        char name[300];
        snprintf(name, sizeof name, "%s", entry->d_name);
        char *suffix = strstr(name, ".json");
        if (suffix == NULL)
            continue;
        *suffix = '\0';
        load(name, check_arena());
        count++;
    }
    closedir(directory);
    return count;
}

static void load_vehicle(const char *name, struct arena *arena)
{
    struct diag diag = {0};
    const struct vehicle *vehicle = vehicle_load(name, NULL, arena, &diag);
    if (vehicle == NULL)
        fail_msg("%s", diag.text);
    assert_string_equal(vehicle->reflectors.model, name);
    assert_int_equal(vehicle->reflectors.objects.count, 0);
    assert_true(vehicle->reflectors.points.count + vehicle->reflectors.planes.count +
                    vehicle->reflectors.rows.count >
                0);
}

static struct scenario *scene_of(const char *name, struct arena *arena, struct diag *diag)
{
    struct scenario_document document;
    return scenario_read(name, &document, arena, diag) == 0
               ? scenario_draw(&document, (struct random_address){.seed = 1}, NULL, arena, diag)
               : NULL;
}

static void load_scenario(const char *name, struct arena *arena)
{
    struct diag diag = {0};
    const struct scenario *scenario = scene_of(name, arena, &diag);
    if (scenario == NULL)
        fail_msg("%s", diag.text);
    for (size_t i = 0; i < scenario->objects.count; i++)
        load_vehicle(scenario->objects.items[i].class, arena);
}

static void load_suite(const char *name, struct arena *arena)
{
    struct diag diag = {0};
    const struct suite *suite = suite_file_load(name, arena, &diag);
    if (suite == NULL)
        fail_msg("%s", diag.text);
    assert_string_equal(suite->name, name);
    assert_int_equal(strspn(suite->digest, "0123456789abcdef"), 16);
    for (size_t i = 0; i < suite->sensors.count; i++) {
        const struct sensor *sensor = &suite->sensors.items[i];
        assert_int_equal(sensor->antenna.row_count >= 2, sensor->antenna_table != NULL);
        /* Calibration: on boresight that ERCS at that range meets the threshold. */
        double amplitude =
            radar_reference_amplitude(&sensor->amplitude_law, sensor->calibration_range_m);
        assert_near(amplitude * sensor->calibration_ercs, sensor->threshold, 1e-12);
    }
}

FIXTURE(make_scratch, remove_scratch);

TEST(every_document_that_is_shipped_loads)
{
    assert_true(load_all("vehicles", load_vehicle) >= 10);
    assert_true(load_all("scenarios", load_scenario) >= 6);
    assert_true(load_all("sensors", load_suite) >= 3);
}

#define PLACE "\"mount_x_m\":2,\"mount_y_m\":0,\"mount_yaw_rad\":0,\"carrier_hz\":24e9,"
#define REST                                                                                       \
    "\"field_of_view_rad\":3,\"threshold_db\":6,\"cell_range_m\":0.3,\"cell_range_rate_mps\":0.5," \
    "\"phase_reference\":\"centre\",\"angle_estimator\":\"ratio\",\"pointer_sigma\":0.5,"          \
    "\"range_sigma_m\":0,\"range_rate_sigma_mps\":0,\"azimuth_sigma_rad\":0,"                      \
    "\"final_threshold\":true,\"list_order\":\"nearest\",\"list_limit\":0"
#define TABLES                                                                                     \
    "\"range_curve\":\"levels.csv\",\"antenna_pattern\":\"table\","                                \
    "\"antenna_table\":\"pattern.csv\","
#define SENSOR(name, range, more) "{\"name\":\"" name "\"," PLACE range more REST "}"
#define RANGES "\"range_min_m\":1,\"range_max_m\":30,"
#define SUITE(sensors) "{\"origin\":\"a test\",\"sensors\":[" sensors "]}"

/* Amplitudes of 8 and 2 of an ERCS of 1, 10 dBsm. */
static const char levels[] = "range_m,level_db\n10,8.061799739838872\n20,-3.979400086720376\n";
static const char pattern[] = "azimuth_rad,sum,delta\n-1,0.5,-1\n0,1,0\n1,0.5,1\n";

static const struct suite *suite_of(struct scratch *scratch, const char *document,
                                    const char *table, const char *rows, struct diag *diag)
{
    *diag = (struct diag){0};
    scratch_write(scratch->path, document);
    scratch_write(scratch_in(scratch, "levels.csv"), table);
    scratch_write(scratch_in(scratch, "pattern.csv"), rows);
    return suite_file_load(scratch->path, &scratch->arena, diag);
}

TEST_OF(scratch, tables_are_found_beside_the_document_and_read)
{
    struct diag diag;
    const struct suite *suite =
        suite_of(scratch, SUITE(SENSOR("a", RANGES, TABLES)), levels, pattern, &diag);
    if (suite == NULL)
        fail_msg("%s", diag.text);
    const struct sensor *sensor = suite_sensor(suite, "a");
    assert_null(suite_sensor(suite, "b"));
    assert_non_null(sensor->amplitude_law.rows);
    /* Straight in dB over the logarithm of range: at sqrt(10 20) m the amplitude is sqrt(8 2). */
    assert_near(radar_reference_amplitude(&sensor->amplitude_law, sqrt(200)), 4.0, 1e-12);
    assert_close(antenna_gain(&sensor->antenna, 0.5), 0.75, 1e-12);
    assert_near(sensor->threshold, 1.9952623149688795, 1e-14);
    assert_close(sensor->half_range_m, 0.15, 0);
    assert_close(sensor->half_range_rate_mps, 0.25, 0);
    suite = suite_of(scratch, SUITE(SENSOR("a", RANGES, TABLES "\"cell_extent\":\"half_width\",")),
                     levels, pattern, &diag);
    assert_close(suite->sensors.items[0].half_range_m, 0.3, 0);
}

TEST_OF(scratch, the_digest_covers_every_value_of_document_and_tables)
{
#define MORE TABLES "\"azimuth_curve\":\"levels.csv\","
#define CURVE "azimuth_rad,range_m,level_db\n-1.55,10,8\n1.55,20,2.5\n"
#define REVERSED                                                                                   \
    "{\n \"sensors\": [{" REST ", \"sources\": {\"name\": \"assumed\"},\n " MORE                   \
    "\"range_max_m\": 3e1, " PLACE "\"range_min_m\":1.0, \"exponent\": 2, \"name\": \"a\"}],\n "   \
    "\"origin\": \"another text\"}"
    static const struct {
        const char *document, *table, *rows;
        size_t same; /* the first variant with these values */
    } variants[] = {
        {SUITE(SENSOR("a", RANGES, MORE)), CURVE, pattern, 0},
        {SUITE(SENSOR("b", RANGES, MORE)), CURVE, pattern, 1},
        {REVERSED, CURVE, pattern, 0},
        {SUITE(SENSOR("a", RANGES, MORE "\"cell_extent\":\"half_width\",")), CURVE, pattern, 3},
        {SUITE(SENSOR("a", RANGES, MORE)),
         "azimuth_rad,range_m,level_db\n-1.55,11,8\n1.55,20,2.5\n", pattern, 4},
        {SUITE(SENSOR("a", RANGES, MORE)),
         "azimuth_rad,range_m,level_db\n-1.56,10,8\n1.55,20,2.5\n", pattern, 5},
        {SUITE(SENSOR("a", RANGES, MORE)), CURVE,
         "azimuth_rad,sum,delta\n-1,0.5,-1\n0,1,0\n1,0.5,2\n", 6},
        {SUITE(SENSOR("a", RANGES, MORE)),
         "range_m,level_db,azimuth_rad\r\n1e1,8.0,-1.55\r\n20,2.5,1.550\n",
         "azimuth_rad,sum,delta\n-1,0.50,-1\n0,1,0\n1e0,5e-1,1\n", 0},
        {SUITE(SENSOR("a", RANGES, TABLES "\"azimuth_curve\":\"./levels.csv\",")), CURVE, pattern,
         0},
        {SUITE(SENSOR("a", RANGES, TABLES "\"azimuth_floor_curve\":\"levels.csv\",")), CURVE,
         pattern, 9},
    };
    char digests[COUNT(variants)][17];
    for (size_t i = 0; i < COUNT(variants); i++) {
        struct diag diag;
        const struct suite *suite =
            suite_of(scratch, variants[i].document, variants[i].table, variants[i].rows, &diag);
        if (suite == NULL)
            fail_msg("%zu: %s", i, diag.text);
        memcpy(digests[i], suite->digest, sizeof digests[i]);
        for (size_t j = 0; j < i; j++)
            assert_int_equal(strcmp(digests[i], digests[j]) == 0,
                             variants[i].same == variants[j].same);
    }
}

TEST_OF(scratch, range_limits_are_straight_between_their_azimuths)
{
    struct diag diag;
#define LIMITS(from, to, far)                                                                      \
    "\"range_limits\":[{\"azimuth_rad\":" from ",\"range_max_m\":25},{\"azimuth_rad\":" to         \
    ",\"range_max_m\":" far "}],"
    const struct suite *suite = suite_of(
        scratch,
        SUITE(SENSOR("a", RANGES, TABLES LIMITS("0.5", "1", "10")) "," SENSOR("b", RANGES, TABLES)),
        levels, pattern, &diag);
    if (suite == NULL)
        fail_msg("%s", diag.text);
    static const double cases[][2] = {{0, 25},   {0.5, 25}, {-0.6, 22},
                                      {0.9, 13}, {-1, 10},  {1.4, 10}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        assert_close(suite_range_max_m(&suite->sensors.items[0], cases[i][0]), cases[i][1], 1e-13);
        assert_close(suite_range_max_m(&suite->sensors.items[1], cases[i][0]), 30, 0);
    }
}

TEST_OF(scratch, the_floor_of_azimuths_follows_its_curve_from_boresight)
{
    struct diag diag;
    static const char rows[] = "range_m,azimuth_rad,level_db\n1,-1,-30\n10,0,-40\n20,0.5,-20\n";
    const struct suite *suite =
        suite_of(scratch,
                 SUITE(SENSOR("a", RANGES,
                              TABLES "\"azimuth_floor_rad\":0.01,\"azimuth_floor_curve\":\"levels."
                                     "csv\",") "," SENSOR("b", RANGES,
                                                          TABLES "\"azimuth_floor_rad\":0.01,")),
                 rows, pattern, &diag);
    if (suite == NULL)
        fail_msg("%s", diag.text);
    static const double cases[][2] = {
        {0, 0.01}, {0.5, 0.1}, {0.25, 0.0316227766016838}, {1.2, 0.1}, {-1, 0.0316227766016838}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        const struct sensor *sensors = suite->sensors.items;
        assert_close(suite_azimuth_floor_rad(&sensors[0], cases[i][0]), cases[i][1], 1e-15);
        assert_close(suite_azimuth_floor_rad(&sensors[1], cases[i][0]), 0.01, 0);
    }
}

TEST_OF(scratch, suites_with_contradictory_members_are_refused)
{
#define POWER "\"calibration_ercs\":0.8,\"calibration_range_m\":30,"
#define PAIR "\"antenna_pattern\":\"dipole_pair\","
#define BEAM "\"elevation_curve\":\"levels.csv\","
#define LEVEL "elevation_rad,level_db\n-0.1,-3\n0.1,-3\n"
    static const struct {
        const char *document, *table, *rows, *message;
    } cases[] = {
        {SUITE(""), levels, pattern, "/suite.json: sensors: none; expected at least one"},
        {SUITE(SENSOR("a", RANGES, TABLES) "," SENSOR("a", RANGES, TABLES)), levels, pattern,
         "/suite.json: sensors[1].name: \"a\" stands twice"},
        {SUITE(SENSOR("a", "\"range_min_m\":5,\"range_max_m\":5,", TABLES)), levels, pattern,
         "/suite.json: sensors[0].range_max_m: 5 is not above range_min_m, 5 m"},
        {SUITE(SENSOR("a", RANGES, TABLES LIMITS("0", "1", "31"))), levels, pattern,
         "/suite.json: sensors[0].range_limits[1].range_max_m: 31; expected more than range_min_m, "
         "1 "
         "m, and at most the sensor's range_max_m, 30 m"},
        {SUITE(SENSOR("a", RANGES, TABLES LIMITS("0", "1", "1"))), levels, pattern,
         "/suite.json: sensors[0].range_limits[1].range_max_m: 1; expected more than range_min_m, "
         "1 "
         "m, and at most the sensor's range_max_m, 30 m"},
        {SUITE(SENSOR("a", RANGES, TABLES LIMITS("0.5", "0.5", "10"))), levels, pattern,
         "/suite.json: sensors[0].range_limits[1].azimuth_rad: 0.5 does not ascend from 0.5 rad"},
        {SUITE(SENSOR("a", RANGES, TABLES "\"unambiguous_middle_mps\":-3,")), levels, pattern,
         "/suite.json: sensors[0].unambiguous_middle_mps: -3; expected only with "
         "unambiguous_rate_mps, and without a waveform"},
        {SUITE(SENSOR("a", RANGES, TABLES POWER)), levels, pattern,
         "/suite.json: sensors[0].range_curve: \"levels.csv\"; expected none beside "
         "calibration_ercs 0.8, calibration_range_m 30 and exponent 2"},
        {SUITE(SENSOR("a", RANGES, TABLES "\"exponent\":1.2,")), levels, pattern,
         "/suite.json: sensors[0].range_curve: \"levels.csv\"; expected none beside "
         "calibration_ercs 0, calibration_range_m 0 and exponent 1.2"},
        {SUITE(SENSOR("a", RANGES, PAIR)), levels, pattern,
         "/suite.json: sensors[0].range_curve: expected either a curve or calibration_ercs "
         "and calibration_range_m"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR BEAM "\"elevation_half_width_rad\":0.1,")), LEVEL,
         pattern,
         "/suite.json: sensors[0].elevation_curve: \"levels.csv\"; expected none beside "
         "elevation_half_width_rad 0.1"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR BEAM)), LEVEL, pattern,
         "/suite.json: sensors[0].mount_z_m: missing; elevation_curve needs it"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR "\"elevation_view_rad\":0.3,")), levels, pattern,
         "/suite.json: sensors[0].mount_z_m: missing; elevation_view_rad needs it"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR "\"elevation_sigma_rad\":0.01,")), levels, pattern,
         "/suite.json: sensors[0].elevation_view_rad: missing; elevation_sigma_rad needs it"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR "\"elevation_floor_rad\":0.01,")), levels, pattern,
         "/suite.json: sensors[0].elevation_view_rad: missing; elevation_floor_rad needs it"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR "\"elevation_step_rad\":0.01,")), levels, pattern,
         "/suite.json: sensors[0].elevation_view_rad: missing; elevation_step_rad needs it"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR BEAM "\"mount_z_m\":1,")),
         "elevation_rad,level_db\n0.1,0\n0.2,-3\n", pattern,
         "/levels.csv: elevation_rad: from 0.1 to 0.2; expected at least from 0 to 0"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR "\"azimuth_curve\":\"levels.csv\",")),
         "azimuth_rad,level_db\n-1.5,0\n1.4,-3\n", pattern,
         "/levels.csv: azimuth_rad: from -1.5 to 1.4; expected at least from -1.5 to 1.5, the "
         "field of view"},
        {SUITE(SENSOR("a", RANGES, POWER "\"antenna_pattern\":\"table\",")), levels, pattern,
         "/suite.json: sensors[0].antenna_table: missing; antenna_pattern \"table\" needs it"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR "\"antenna_table\":\"pattern.csv\",")), levels,
         pattern,
         "/suite.json: sensors[0].antenna_table: \"pattern.csv\"; expected only with "
         "antenna_pattern \"table\""},
        {SUITE(SENSOR("a", RANGES, POWER PAIR "\"cycle_s\":0.0124,")), levels, pattern,
         "/suite.json: sensors[0].cell_range_rate_mps: dwell, wavelength/(2 cell_range_rate_mps), "
         "0.0124914 s; expected at most cycle_s, 0.0124 s"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR "\"cycle_s\":0.0125,") "," SENSOR(
             "b", RANGES,
             POWER PAIR
             "\"receiver_bandwidth_hz\":1e5,\"chirp_slope_hzps\":-1e12,\"chirp_s\":1e-4,")),
         levels, pattern,
         "/suite.json: sensors[1].range_max_m: beat, 2 range_max_m chirp_slope_hzps/c, 200138 Hz; "
         "expected at most receiver_bandwidth_hz, 100000 Hz"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR "\"false_alarms\":1,\"unambiguous_rate_mps\":60,")),
         levels, pattern,
         "/suite.json: sensors[0].false_alarm_range_rate_mps: false alarms to "
         "false_alarm_range_rate_mps, 70 m/s; expected at most unambiguous_rate_mps, 60 "
         "m/s"},
        {SUITE(SENSOR("a", RANGES, POWER PAIR "\"radome_bias_rad\":0.01,")), levels, pattern,
         "/suite.json: sensors[0].radome_period_rad: missing; radome_bias_rad needs it"},
        {SUITE(SENSOR("a", RANGES, TABLES)), "range_m,level_db\n10,8\n", pattern,
         "/levels.csv: rows: 1; expected at least 2"},
        {SUITE(SENSOR("a", RANGES, TABLES)), "range_m,level_db\n10,8\n10,2\n", pattern,
         "/levels.csv: row 3: range_m must ascend"},
        {SUITE(SENSOR("a", RANGES, TABLES)), "range_m,level_db\n10,8\n20,2000\n", pattern,
         "/levels.csv: row 3, column \"level_db\": 2000 is outside [-1000, 1000] dB"},
        {SUITE(SENSOR("a", RANGES, TABLES)), "range_m,gain\n10,8\n", pattern,
         "/levels.csv: column \"level_db\" is missing; the header is: range_m, gain"},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        struct diag diag;
        assert_null(suite_of(scratch, cases[i].document, cases[i].table, cases[i].rows, &diag));
        /* The message about a table follows the place that names it. */
        assert_memory_equal(diag.text, scratch->path, strlen(scratch->path));
        assert_string_equal(diag.text + strlen(diag.text) - strlen(cases[i].message),
                            cases[i].message);
        assert_int_equal(diag.code, DIAG_CONFIG);
    }
    static const char *const patterns[] = {
        "azimuth_rad,sum,delta\n0,1,0\n",         "azimuth_rad,sum,delta\n0,1,0\n0,1,1\n",
        "azimuth_rad,sum,delta\n0,1,1\n1,1,0\n",  "azimuth_rad,sum,delta\n0,1,0\n1,0,0\n",
        "azimuth_rad,sum,delta\n0,-1,0\n1,1,1\n", "azimuth_rad,sum\n0,1\n1,1\n"};
    for (size_t i = 0; i < COUNT(patterns); i++) {
        struct diag diag;
        assert_null(
            suite_of(scratch, SUITE(SENSOR("a", RANGES, TABLES)), levels, patterns[i], &diag));
        assert_non_null(strstr(diag.text, "/pattern.csv: "));
        assert_int_equal(diag.code, DIAG_CONFIG);
    }
}

TEST_OF(scratch, vehicles_with_contradictory_members_are_refused)
{
    static const char *const faults[] = {
        "\"points\":[{\"name\":\"p\",\"x\":0,\"y\":0,\"facing_rad\":0,\"full_rad\":1,"
        "\"zero_rad\":0.5,\"ercs\":1}]",
        "\"rows\":[{\"name\":\"r\",\"from_x\":0,\"from_y\":0,\"to_x\":0,\"to_y\":0,\"spacing_m\":1,"
        "\"facing_rad\":0,\"full_rad\":1,\"zero_rad\":0.5,\"ercs\":1}]"};
    for (size_t i = 0; i < COUNT(faults); i++) {
        struct text text = {0};
        struct diag diag = {0};
        text_format(&text,
                    "{\"origin\":\"a test\",\"length_m\":4,\"width_m\":2,\"height_m\":1,"
                    "\"reflectors\":{%s}}",
                    faults[i]);
        text_add(&text, "", 1);
        scratch_write(scratch->path, text.bytes);
        assert_null(vehicle_load("suite", scratch->directory, &scratch->arena, &diag));
        assert_non_null(strstr(diag.text, "[0].zero_rad: "));
        assert_int_equal(diag.code, DIAG_CONFIG);
        text_free(&text);
    }
}

TEST_OF(scratch, scenarios_are_checked_and_named)
{
    struct diag diag = {0};
    scratch_write(scratch->path, "{\"origin\":\"a test\",\"ego\":\"e\",\"rate_hz\":10,"
                                 "\"duration_s\":1,\"objects\":[]}");
    assert_null(scene_of(scratch->path, &scratch->arena, &diag));
    assert_memory_equal(diag.text, scratch->path, strlen(scratch->path));
    assert_int_equal(diag.code, DIAG_CONFIG);
    diag = (struct diag){0};
    assert_null(vehicle_load("no_such_class", NULL, &scratch->arena, &diag));
    assert_non_null(strstr(diag.text, "there is no vehicles/no_such_class.json"));
    assert_int_equal(diag.code, DIAG_CONFIG);
}
