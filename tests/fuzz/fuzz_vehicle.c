/* Documents of vehicles and other things. One that is taken stands before a radar in three frames,
 * each with another extract. */
#include "documents/vehicle.h"
#include "fuzz/fuzz.h"

static void look(const char *class, int number)
{
    struct arena arena = {0};
    struct frame frame = {.arena = &arena};
    fuzz_scene(&frame, number, class);
    fuzz_chain(&frame, "corner77-every-frame");
    arena_free(&arena);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size)
{
    struct fuzz_file file;
    fuzz_open(&file, bytes, size);
    struct arena arena = {0};
    struct diag diag = {0};
    bool taken = vehicle_load(file.path, &arena, &diag) != NULL;
    fuzz_judge(&diag);
    for (int number = 0; taken && number < 3; number++)
        look(file.path, number);
    arena_free(&arena);
    fuzz_close(&file);
    return 0;
}
