/* Documents of sensor suites, with the data sheet of those that are taken. */
#include "documents/suite_file.h"
#include "fuzz/fuzz.h"
#include "run/datasheet.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct fuzz_file file;
    fuzz_open(&file, bytes, size);
    struct arena arena = {0};
    struct diag diag = {0};
    struct text sheet = {0};
    const struct suite *suite = suite_file_load(file.path, &arena, &diag);
    if (suite != NULL)
        datasheet_add(suite, &sheet);
    fuzz_judge(&diag);
    text_free(&sheet);
    arena_free(&arena);
    fuzz_close(&file);
    return 0;
}
