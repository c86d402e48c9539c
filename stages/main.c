/* The main of every executable: glint-NAME with -DSTAGE=stage_NAME or -DTOOL=tool_NAME, glint
 * itself without. */
#include "run/chain.h"
#include "run/fused.h"

#if defined STAGE

extern const struct stage STAGE;

int main(int count, char **words)
{
    return chain_main(&STAGE, count, words);
}

#elif defined TOOL

extern const struct tool TOOL;

int main(int count, char **words)
{
    return chain_main_tool(&TOOL, count, words);
}

#else

int main(int count, char **words)
{
    return fused_main(count, words);
}

#endif
