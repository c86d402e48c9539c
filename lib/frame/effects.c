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

/* What follows the first comma; NULL: there is none. */
static const char *after_comma(const char *text)
{
    const char *comma = strchr(text, ',');
    return comma != NULL ? comma + 1 : NULL;
}

int effects_read(const char *text, struct selection *selection, struct diag *diag)
{
    static const char *const first_words[] = {"auto", "all", "none", NULL};
    enum { AUTO, ALL };
    int word = suggestion_find(first_words, text, strcspn(text, ","), NULL);
    bool automatic = word == AUTO || text[0] == '-';
    uint64_t allowed = automatic || word == ALL ? EVERY_EFFECT : 0;
    *selection = (struct selection){.allowed = allowed, .automatic = automatic};
    const char *name = word < 0 ? text : after_comma(text);
    for (; name != NULL; name = after_comma(name))
        if (add_effect(name, strcspn(name, ","), selection, diag) != 0)
            return -1;
    return 0;
}

void effects_count_scan(const struct selection *selection)
{
    struct effect_log *log = selection->log;
    if (log == NULL)
        return;
    log->scans++;
    for (int i = 0; i < EFFECT_COUNT; i++) {
        if ((log->simulated & EFFECT_BIT(i)) != 0)
            log->scans_simulated[i]++;
        else if ((log->left_out & EFFECT_BIT(i)) != 0)
            log->scans_left_out[i]++;
    }
    log->simulated = 0;
    log->left_out = 0;
}
