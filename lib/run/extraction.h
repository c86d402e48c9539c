/* Sizes and reflectors for the objects of a frame (MODEL 2). Both come from the document of the
 * object's class. */
#pragma once

#include "documents/vehicle.h"
#include "run/stage.h"

/* Puts other reflectors in place of those of the vehicle's document, list by list; what it makes
 * lies in the arena. */
typedef void extraction_describe(const void *state, const struct vehicle *vehicle,
                                 struct reflector_set *set, struct arena *arena);

/* Sets the whole set of one object alone; false, and nothing is set, if all objects of the class
 * share theirs. */
typedef bool extraction_describe_body(void *state, const struct vehicle *vehicle,
                                      const struct frame *frame, const struct object *object,
                                      struct reflector_set *set);

/* A surface that was drawn, for the next frames of its scene. */
struct extraction_surface {
    const char *id;
    const struct vehicle *vehicle;
    struct vec2 size_m;
    double height_m;
    struct reflector_set set;
};

struct extraction_surfaces {
    struct random_address scene;
    LIST_OF(struct extraction_surface) bodies;
    size_t next; /* the one after that which was asked for last, as frames ask by ascending ids */
    struct arena arena;
};

/* First member of the state of every stage that extracts, and its row in the table of options. */
struct extraction {
    const char *vehicles; /* a set of documents, by its word or path; NULL: the paper's */
    const char *folder;   /* of the set, before all others; NULL: none */
    struct extraction_surfaces surfaces;
};
#define EXTRACTION_OPTIONS                                                                         \
    {                                                                                              \
        OPTIONAL_NAME(                                                                             \
            struct extraction, vehicles,                                                           \
            "set of vehicle documents, such as detailed, or path of your folder; absent: paper"),  \
            .word = "SET"                                                                          \
    }
extern const struct record extraction_record;

/* Gives the object a set of its own if its class has a contour whose scatterers differ (MODEL 2.7).
 * The surface has all members but the view. */
bool extraction_describe_surface(struct extraction *extraction, const struct surface *surface,
                                 const struct vehicle *vehicle, const struct frame *frame,
                                 const struct object *object, struct reflector_set *set);

/* Frees the surfaces; state begins with a struct extraction. */
void extraction_release(void *state);

/* For locate_fault: a contour may have a scatterer that is stronger than frames allow. */
int extraction_locate_fault(void *state, const struct frame *frame, struct runner *runner);

/* Finds the folder of the set, and refuses one that is not there; state begins with a struct
 * extraction. */
int extraction_start(void *state, struct runner *runner);

/* The whole step of a stage that extracts: completes the sizes of all objects, notes the documents
 * of their classes in the frame, and lists every object but the ego in its class's set of
 * reflectors. The sets are those of the documents (describe NULL), or as describe, called with the
 * extraction, makes them; an object may have a set of its own (describe_body, or NULL). Sizes come
 * from documents that were checked, so objects are not among what the stage writes. 0, or -1 after
 * a message. */
int extraction_step(struct extraction *extraction, struct frame *frame, struct runner *runner,
                    extraction_describe *describe, extraction_describe_body *describe_body);
