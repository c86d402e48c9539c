#include "frame/effects.h"

#include <string.h>

const char *const effects_names[] = {
    [EFFECT_LATENCY] = "latency",
    [EFFECT_VISIBILITY] = "visibility",
    [EFFECT_PLANE_REFLECTION] = "plane_reflection",
    [EFFECT_CURVATURE] = "curvature",
    [EFFECT_ROWS] = "rows",
    [EFFECT_ELEVATION] = "elevation",
    [EFFECT_OCCLUSION] = "occlusion",
    [EFFECT_HEIGHT] = "height",
    [EFFECT_DIFFRACTION] = "diffraction",
    [EFFECT_GHOSTS] = "ghosts",
    [EFFECT_WHEELS] = "wheels",
    [EFFECT_LIMBS] = "limbs",
    [EFFECT_CLUTTER] = "clutter",
    [EFFECT_TWO_RAY] = "two_ray",
    [EFFECT_FLUCTUATION] = "fluctuation",
    [EFFECT_RAIN] = "rain",
    [EFFECT_FOG] = "fog",
    [EFFECT_AMBIGUITY] = "ambiguity",
    [EFFECT_INTERFERENCE] = "interference",
    [EFFECT_COHERENCE] = "coherence",
    [EFFECT_MERGING] = "merging",
    [EFFECT_SUPERPOSITION] = "superposition",
    [EFFECT_THRESHOLD] = "threshold",
    [EFFECT_ANGLE_NOISE] = "angle_noise",
    [EFFECT_RANGE_NOISE] = "range_noise",
    [EFFECT_ACCURACY] = "accuracy",
    [EFFECT_MISALIGNMENT] = "misalignment",
    [EFFECT_FINAL_THRESHOLD] = "final_threshold",
    [EFFECT_FALSE_ALARMS] = "false_alarms",
    [EFFECT_LIST_LIMIT] = "list_limit",
    [EFFECT_QUANTISATION] = "quantisation",
    [EFFECT_COUNT] = NULL,
};

const struct effect_entry effects_table[EFFECT_COUNT] = {
    [EFFECT_LATENCY] = {"the scan shows the world as it was a moment ago", "ideal",
                        "latency_s of a sensor", "there is no latency", "a step back per object"},
    [EFFECT_VISIBILITY] = {"a reflector is seen from a range of angles around its facing", "ideal",
                           "full_rad, zero_rad of a point or row", "no object has points or rows",
                           "an arctangent per reflector"},
    [EFFECT_PLANE_REFLECTION] = {"a flat side mirrors the radar from the foot of the perpendicular",
                                 "ideal", "planes of a vehicle", "no object has planes",
                                 "a foot per plane"},
    [EFFECT_CURVATURE] = {"a curved side reflects more from farther away", "ideal",
                          "curved_sides of a sensor, profile_radius_m of a plane",
                          "no plane has a radius", "a square root per plane"},
    [EFFECT_ROWS] = {"posts along a line, made only within range", "ideal", "rows of a vehicle",
                     "no object has rows", "the posts in range"},
    [EFFECT_ELEVATION] = {"what is higher or lower than the sensor is farther, slower, weaker and "
                          "nearer to boresight",
                          "ideal", "mount_z_m of a sensor, z of a reflector",
                          "for every reflector at the sensor's height",
                          "two square roots and an angle per reflector"},
    [EFFECT_OCCLUSION] = {"an object hides what lies behind it", "ideal", "blocks of a vehicle",
                          "no object stands in another one's sector",
                          "a sight line per reflector and object in the way"},
    [EFFECT_HEIGHT] = {"of what occlusion hides, what is seen over a lower object appears", "ideal",
                       "mount_z_m of a sensor", "where occlusion is left out",
                       "a line's height per object in the way"},
    [EFFECT_DIFFRACTION] = {"the shadows of occlusion have soft edges", "ideal",
                            "diffraction of a sensor",
                            "for every object whose edges stay a Fresnel "
                            "radius clear of the sector",
                            "four edges per sight line and object near it"},
    [EFFECT_GHOSTS] = {"walls, guardrails and flat sides mirror what stands before them", "ideal",
                       "bounces of a sensor, mirrors of a vehicle",
                       "for every object and mirror that cannot face it and the sensor",
                       "a mirror image per reflector and mirror in reach"},
    [EFFECT_WHEELS] = {"wheels that roll echo at other rates than their vehicle", "sensor",
                       "micro_motion of a sensor, moving_part of a point",
                       "no wheel in sight rolls along the sight line",
                       "a draw per wheel and point"},
    [EFFECT_LIMBS] = {"arms and legs echo at other rates than the person", "sensor",
                      "micro_motion of a sensor, moving_part of a point",
                      "nobody in sight walks along the sight line", "a draw per person and limb"},
    [EFFECT_CLUTTER] = {"the ground and what stands on it echo", "sensor",
                        "clutter_per_m2, clutter_ercs of the conditions", "one of both is 0",
                        "a draw per point of clutter"},
    [EFFECT_TWO_RAY] = {"the road mirrors, so that echoes fade and rise with range", "sensor",
                        "road of the conditions, mount_z_m of a sensor, z of a reflector",
                        "one of them is missing", "a Fresnel coefficient per echo"},
    [EFFECT_FLUCTUATION] = {"echoes vary in strength from scan to scan", "sensor",
                            "fluctuation of a sensor", "never: any draw may matter",
                            "a draw per echo"},
    [EFFECT_RAIN] = {"rain attenuates", "sensor", "rain_mmph of the conditions", "there is none",
                     "an exponential per echo"},
    [EFFECT_FOG] = {"fog attenuates", "sensor", "fog_gpm3 of the conditions", "there is none",
                    "an exponential per echo"},
    [EFFECT_AMBIGUITY] = {"ranges and range rates beyond what the waveform tells apart fold back",
                          "sensor", "unambiguous_range_m, unambiguous_rate_mps of a sensor",
                          "never: it costs as little", "two remainders per echo"},
    [EFFECT_INTERFERENCE] = {"other radars raise the noise", "sensor",
                             "interferers of the conditions, receiver_bandwidth_hz of a sensor",
                             "no interferer is described", "a power per interferer"},
    [EFFECT_COHERENCE] = {"echoes of one cell add with their phases and fade", "sensor",
                          "cell_phase of a sensor", "cell_phase is in_phase",
                          "a sine and cosine per echo"},
    [EFFECT_MERGING] = {"echoes closer than the resolution share one cell", "sensor",
                        "cell_range_m, cell_range_rate_mps of a sensor",
                        "no two echoes are that close", "a test per pair of echoes"},
    [EFFECT_SUPERPOSITION] = {"the angle of a cell is that of its added sum and delta pointers",
                              "sensor", "antenna_pattern of a sensor", "every cell has one member",
                              "two pointers per member"},
    [EFFECT_THRESHOLD] = {"cells whose summed amplitude is too weak are not detected", "sensor",
                          "threshold_db of a sensor", "never: it costs nothing",
                          "a comparison per cell"},
    [EFFECT_ANGLE_NOISE] = {"noise on both channels disturbs angle and amplitude", "noise",
                            "pointer_sigma of a sensor", "pointer_sigma is 0",
                            "four draws and an angle per cell"},
    [EFFECT_RANGE_NOISE] = {"noise on range and range rate", "noise",
                            "range_sigma_m, range_rate_sigma_mps of a sensor",
                            "both are 0 and sigma_law is not by_snr", "two draws per cell"},
    [EFFECT_ACCURACY] = {"stronger cells are measured better", "noise", "sigma_law of a sensor",
                         "sigma_law is fixed", "a division per cell"},
    [EFFECT_MISALIGNMENT] = {"the sensor looks aside of where it believes, through a bumper that "
                             "bends the beam",
                             "noise", "misalignment_rad, radome_bias_rad of a sensor", "both are 0",
                             "a sine per cell"},
    [EFFECT_FINAL_THRESHOLD] = {"the noisy amplitude must pass the threshold once more", "noise",
                                "final_threshold of a sensor", "there is none",
                                "a comparison per cell"},
    [EFFECT_FALSE_ALARMS] = {"noise alone passes the threshold where there is nothing", "noise",
                             "false_alarms of a sensor", "false_alarms is 0",
                             "four draws per false alarm"},
    [EFFECT_LIST_LIMIT] = {"the sensor reports no more targets than its list holds", "noise",
                           "list_limit of a sensor", "the list is shorter", "nothing"},
    [EFFECT_QUANTISATION] = {"reported values are multiples of a step", "noise",
                             "range_step_m, range_rate_step_mps, azimuth_step_rad of a sensor",
                             "all steps are 0", "three roundings per target"},
};

#define EVERY_EFFECT (EFFECT_BIT(EFFECT_COUNT) - 1)

/* The word at text, up to a comma. */
static bool is_word(const char *text, size_t length, const char *word)
{
    return strlen(word) == length && memcmp(text, word, length) == 0;
}

static int add_effect(const char *text, size_t length, struct selection *selection,
                      struct diag *diag)
{
    bool remove = length > 0 && text[0] == '-';
    const char *name = text + remove;
    for (int i = 0; i < EFFECT_COUNT; i++)
        if (is_word(name, length - remove, effects_names[i])) {
            if (remove)
                selection->allowed &= ~EFFECT_BIT(i);
            else
                selection->allowed |= EFFECT_BIT(i);
            return 0;
        }
    return diag_fail(diag, DIAG_CONFIG,
                     "\"%.*s\" is no effect; expected auto, all, none or names from "
                     "glint --list effects",
                     (int)(length < 80 ? length : 80), text);
}

int effects_read(const char *text, struct selection *selection, struct diag *diag)
{
    *selection = (struct selection){0};
    for (bool first = true;; first = false) {
        size_t length = strcspn(text, ",");
        bool automatic = is_word(text, length, "auto"), all = is_word(text, length, "all");
        if (first && (automatic || all || text[0] == '-')) {
            selection->allowed = EVERY_EFFECT;
            selection->automatic = !all;
        }
        bool word = first && (automatic || all || is_word(text, length, "none"));
        if (!word && add_effect(text, length, selection, diag) != 0)
            return diag_prefix(diag, "effects: ");
        if (text[length] == '\0')
            return 0;
        text += length + 1;
    }
}

void effects_count_scan(const struct selection *selection)
{
    struct effect_log *log = selection->log;
    if (log == NULL)
        return;
    log->scans++;
    for (int i = 0; i < EFFECT_COUNT; i++) {
        bool simulated = (log->simulated & EFFECT_BIT(i)) != 0;
        log->scans_simulated[i] += simulated;
        log->scans_left_out[i] += !simulated && (log->left_out & EFFECT_BIT(i)) != 0;
    }
    log->simulated = log->left_out = 0;
}
