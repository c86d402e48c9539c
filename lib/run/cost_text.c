#include "run/cost_text.h"

#include <inttypes.h>

#include "run/plan.h"

static void write_reference(const struct cost *cost, const char *mark, struct text *text)
{
    text_format(text,
                "%sErrors are from %s with other seeds, in %% of those of ideal echoes, with 95 %% "
                "intervals.\n",
                mark,
                cost->reference == COST_SIGNAL ? "the signal" : "all that the suite describes");
}

static void write_sample(const struct cost *cost, const char *mark, struct text *text)
{
    text_format(text,
                "%s%" PRId64 " of %" PRId64 " frames of %" PRId64 " scene%s in %" PRId64
                " block%s, seen by %s, with %d seeds.\n",
                mark, cost->frames, cost->seen_frames, cost->scenes, cost->scenes == 1 ? "" : "s",
                cost->blocks, cost->blocks == 1 ? "" : "s", cost->suite, LADDER_SEEDS);
}

/* In per cent with one digit behind the point, and no minus before a 0. */
static double percent(double share)
{
    return rint(1000 * share) / 10 + 0.0;
}

static void write_error(struct relative_error error, struct text *text)
{
    text_format(text, "%.1f %% (%.1f to %.1f)", percent(error.value), percent(error.low),
                percent(error.high));
}

static void write_chain(const struct ladder_chain *chain, int width, struct text *text)
{
    text_format(text, "%-*s %11.1f", width, chain->chain, chain->us_per_frame);
    if ((chain->present & LADDER_ERROR) != 0)
        text_format(text, " %7.1f %% %8.1f to %5.1f", percent(chain->error.value),
                    percent(chain->error.low), percent(chain->error.high));
    else
        text_format(text, " %9s %17s", (chain->present & LADDER_ENERGY) != 0 ? "-" : "reference",
                    "");
    text_format(text, " %8.2f\n", chain->targets_per_scan);
}

void cost_text_table(const struct cost *cost, struct text *text)
{
    const struct ladder_chain *ideal = &cost->chains.items[0];
    write_sample(cost, "", text);
    write_reference(cost, "", text);
    if ((ideal->present & LADDER_ERROR) == 0)
        text_format(text,
                    "There are none: ideal echoes are not told from the reference (D %.3g, %.3g to "
                    "%.3g).\n",
                    ideal->energy.value, ideal->energy.low, ideal->energy.high);
    int width = 28;
    for (size_t i = 0; i < cost->chains.count; i++)
        if ((int)strlen(cost->chains.items[i].chain) > width)
            width = (int)strlen(cost->chains.items[i].chain);
    text_format(text, "\n%-*s %11s %9s %17s %8s\n", width, "chain", "us a frame", "error",
                "interval", "targets");
    for (size_t i = 0; i < cost->chains.count; i++)
        write_chain(&cost->chains.items[i], width, text);
    if (cost->no_signal != NULL)
        text_format(text, "%-*s left out: %s\n", width, "signal", cost->no_signal);
}

/* The chain that leaves out this effect alone. */
static const struct ladder_chain *single(const struct cost *cost, uint64_t effect)
{
    for (size_t i = 0; i < cost->chains.count; i++)
        if (cost->chains.items[i].automatic && cost->chains.items[i].left_out == effect)
            return &cost->chains.items[i];
    return NULL;
}

static void write_left_out(const struct cost *cost, int effect, double whole_us, struct text *text)
{
    const struct ladder_chain *chain = single(cost, EFFECT_BIT(effect));
    if (chain == NULL)
        return;
    text_format(text, "# %-17s off: saves %.1f us, adds ", effects_names[effect],
                whole_us - chain->us_per_frame);
    write_error(cost_added(cost, chain), text);
    text_add_word(text, "\n");
}

void cost_text_pipeline(const struct cost *cost, const struct ladder_chain *chain,
                        struct text *text)
{
    write_sample(cost, "# ", text);
    write_reference(cost, "# ", text);
    const struct ladder_chain *whole = single(cost, 0);
    text_format(text, "# This takes %.1f us a frame instead of %.1f, with an error of ",
                chain->us_per_frame, whole->us_per_frame);
    if ((chain->present & LADDER_ERROR) != 0)
        write_error(chain->error, text);
    else
        text_add_word(text, "0 by definition");
    text_add_word(text, ".\n");
    for (int i = 0; i < EFFECT_COUNT; i++)
        if ((chain->left_out & EFFECT_BIT(i)) != 0)
            write_left_out(cost, i, whole->us_per_frame, text);
    plan_write_pipeline(cost->suite, chain->effects, chain->programs.items, chain->programs.count,
                        text);
}
