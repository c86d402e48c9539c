/* The main of every executable: glint-NAME with -DSTAGE=stage_NAME, glint itself without. */
#include "run/chain.h"
#include "run/fused.h"

#ifdef STAGE

extern const struct stage STAGE;

int main(int count, char **words)
{
    return chain_main(&STAGE, count, words);
}

#else

int main(int count, char **words)
{
    return fused_main(count, words);
}

#endif
