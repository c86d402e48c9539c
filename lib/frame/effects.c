#include "frame/effects.h"

#include "base/suggestion.h"

const char *const effects_names[] = {
#define EFFECT(id, name) #name,
#include "frame/effects.def"
    NULL,
};

#define EVERY_EFFECT (EFFECT_BIT(EFFECT_COUNT) - 1)

/* Do the length bytes at text spell the word? */
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
    struct suggestion meant = suggestion_begin(name, length - remove);
    for (int i = 0; i < EFFECT_COUNT; i++)
        suggestion_offer(&meant, effects_names[i]);
    return diag_fail(diag, DIAG_CONFIG,
                     "\"%.*s\" is no effect%s; expected auto, all, none or names from "
                     "glint --list effects",
                     (int)(length < 80 ? length : 80), text,
                     suggestion_question(&meant, remove ? "-" : ""));
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
