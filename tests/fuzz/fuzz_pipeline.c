/* Pipelines, as the text of a script. */
#include "fuzz/fuzz.h"
#include "run/pipeline.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct arena arena = {0};
    struct pipeline pipeline = {0};
    struct diag diag = {0};
    bool taken = pipeline_parse((const char *)bytes, size, &pipeline, &arena, &diag) == 0;
    fuzz_must(taken == (diag.code == DIAG_OK), "a message and no refusal, or a refusal without");
    fuzz_must(!taken || pipeline.commands.count > 0, "a pipeline without a command");
    for (size_t i = 0; taken && i < pipeline.commands.count; i++)
        fuzz_must(pipeline.commands.items[i].words.count > 0, "a command without a word");
    const char *end = (const char *)bytes + size;
    fuzz_must(!taken || pipeline.input == NULL ||
                  pipeline.input_length <= (size_t)(end - pipeline.input),
              "a here-document beyond the text");
    arena_free(&arena);
    return 0;
}
