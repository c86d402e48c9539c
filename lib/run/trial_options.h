/* Options of the tools that try chains. */
#pragma once

#include "run/suite_choice.h"

struct trial_options {
    struct suite_choice choice;
    const char *vehicles; /* for glint-extract; NULL: as the suite says */
};
#define TRIAL_OPTIONS                                                                              \
    SUITE_CHOICE_OF_IDEAL,                                                                         \
    {                                                                                              \
        OPTIONAL_NAME(struct trial_options, vehicles,                                              \
                      "set of vehicle documents for glint-extract; absent: that of the suite, or " \
                      "paper"),                                                                    \
            .word = "SET"                                                                          \
    }
