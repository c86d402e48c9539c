/* JSON documents for people: found, read and checked. jansson checks the syntax, and
 * record_read.h reads the values.
 *
 * A bare name (no slash, no dot) means <kind>/<name>.json in the data folders (data_folder.h);
 * anything else is a path. Every fault of a document is DIAG_CONFIG. */
#pragma once

#include "base/text.h"
#include "text/field.h"

enum { DOCUMENT_SIZE = 64 * 1024 * 1024 };

/* Gives jansson an allocator that ends the program rather than returning NULL. Called once, in
 * main. */
void document_guard_memory(void);

/* The path of a document by its name, in the arena; NULL after a message that lists the folders
 * searched and the names in them. own is a folder of the user that is searched first and holds
 * documents of this kind alone, or NULL. ending is ".json", ".csv" for a table, or ".sh" for a
 * pipeline; the folder of shipped pipelines lies beside data/, not in it. */
const char *document_find(const char *own, const char *kind, const char *name, const char *ending,
                          struct arena *arena, struct diag *diag);

/* The same for programs that read frames from standard input, and for names that frames give:
 * refuses "-", and a plain name whose file is neither a regular file nor a folder. */
const char *document_find_file(const char *own, const char *kind, const char *name,
                               const char *ending, struct arena *arena, struct diag *diag);

/* Is what names a document a path? */
static inline bool document_is_path(const char *name)
{
    return strpbrk(name, "/.") != NULL || strcmp(name, "-") == 0;
}

/* True for a name without a slash, except "." and "..". */
static inline bool document_is_plain(const char *name)
{
    if (name[0] == '.' && (name[1] == '\0' || (name[1] == '.' && name[2] == '\0')))
        return false;
    return strchr(name, '/') == NULL;
}

/* Refuses a name that is a path (DIAG_DATA), for names that may lead only into the folders of
 * documents. */
static inline int document_check_plain(const char *name, struct diag *diag)
{
    return document_is_plain(name)
               ? 0
               : diag_fail(diag, DIAG_DATA, "\"%s\" is a path; expected a plain name", name);
}

/* The names of the documents of a kind in all these folders, each once, in the order of bytes. */
struct document_names {
    LIST_OF(const char *) names;
};
int document_list(const char *kind, const char *ending, struct document_names *list,
                  struct arena *arena, struct diag *diag);

/* Puts names into the order of bytes, each once. */
void document_names_order(struct document_names *list, struct arena *arena);

/* The text of the member "origin" of a document; NULL if there is none. */
const char *document_origin(const char *path, struct arena *arena);

/* Reads the bytes of a document ("-": standard input). document_parse reads the values into the
 * struct of the record and into the arena. Messages are "PATH: objects[2].x_m: ...". */
int document_bytes(const char *path, struct text *bytes, struct diag *diag);
int document_parse(const char *path, const struct text *bytes, const struct record *record,
                   void *base, struct arena *arena, struct diag *diag);

/* The two halves of document_parse. document_line checks the syntax and returns the document as one
 * line in the arena. It returns NULL after a message with the line of the fault, or with the format
 * of the bytes if they are of another kind (file_format.h). document_take reads the values. */
const char *document_line(const char *path, const struct text *bytes, const char *kind,
                          struct arena *arena, struct diag *diag);
int document_take(const char *path, const char *line, const struct record *record, void *base,
                  struct arena *arena, struct diag *diag);

/* The name or path in the member "extends" of a document; NULL if there is none, or, after a
 * message (DIAG_CONFIG), if it is no text. */
const char *document_base(const char *line, struct arena *arena, struct diag *diag);

/* The line of a document that extends another one, without the member "extends". Members of both
 * are its own: objects are merged member by member, and lists of objects with names item by item; a
 * new name is a further item. null takes a member of the base away. */
const char *document_extended(const char *base, const char *own, struct arena *arena);

/* The line of a document whose paths begin with this folder: texts in members of these names, but
 * for absolute paths. folder is "" or ends with a slash; the names end with NULL. */
const char *document_moved(const char *line, const char *const *names, const char *folder,
                           struct arena *arena);
