#include "frame/effects.h"

#include "base/suggestion.h"

const char *const effects_names[] = {
#define EFFECT(id, name) #name,
#include "frame/effects.def"
    NULL,
};

#define EVERY_EFFECT (EFFECT_BIT(EFFECT_COUNT) - 1)

static int add_effect(const char *text, size_t length, struct selection *selection,
                      struct diag *diag)
{
    struct suggestion meant;
    bool remove = text[0] == '-';
    int effect = suggestion_find(effects_names, text + remove, length - remove, &meant);
    if (effect < 0)
        return diag_fail(diag, DIAG_CONFIG,
                         "effects: \"%.*s\" is no effect%s; expected auto, all, none or names from "
                         "glint --list effects",
                         (int)(length < 80 ? length : 80), text,
                         suggestion_question(&meant, remove ? "-" : ""));
    if (remove)
        selection->allowed &= ~EFFECT_BIT(effect);
    else
        selection->allowed |= EFFECT_BIT(effect);
    return 0;
}

int effects_read(const char *text, struct selection *selection, struct diag *diag)
{
    static const char *const first_words[] = {"auto", "all", "none", NULL};
    int word = suggestion_find(first_words, text, strcspn(text, ","), NULL);
    bool every = word == 0 || word == 1 || text[0] == '-';
    *selection =
        (struct selection){.allowed = every ? EVERY_EFFECT : 0, .automatic = every && word != 1};
    for (;; word = -1) {
        size_t length = strcspn(text, ",");
        if (word < 0 && add_effect(text, length, selection, diag) != 0)
            return -1;
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
