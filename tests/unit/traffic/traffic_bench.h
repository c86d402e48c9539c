/* Scenes of random traffic with the shipped vehicles, for the tests of a file. */
#pragma once

#include "documents/suite.h"
#include "traffic_models.h"

struct bench {
    struct arena documents, scratch;
    struct random_traffic scene;
    const struct suite *suite; /* of adversarial traffic */
    struct frame frame;
};

static inline int make_bench(void **state)
{
    struct bench *bench = check_make(state, sizeof *bench);
    bench->frame.arena = &bench->scratch;
    load_traffic_models(bench->scene.models, &bench->documents);
    return 0;
}

static inline int remove_bench(void **state)
{
    struct bench *bench = *state;
    arena_free(&bench->documents);
    arena_free(&bench->scratch);
    free(bench);
    return 0;
}
