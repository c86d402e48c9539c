#include "documents/vehicle_set.h"

#include <dirent.h>
#include <unistd.h>

#include "base/suggestion.h"
#include "text/data_folder.h"
#include "text/path.h"

#define PAPER "paper"

/* Does the folder of data have the set, with a document of the class (NULL: of any)? A link to the
 * folder itself, as an installation has one, is no set. */
static bool has_set(const char *data, const char *word, const char *class, struct arena *arena)
{
    const char *folder = arena_format(arena, "%s%s/vehicles", data, word);
    if (path_same_file(folder, arena_format(arena, "%svehicles", data)))
        return false;
    return class == NULL ? path_is_folder(folder)
                         : access(arena_format(arena, "%s/%s.json", folder, class), F_OK) == 0;
}

/* Adds the sets of a folder of data. */
static void list_sets_in(const char *data, const char *class, struct document_names *sets,
                         struct arena *arena)
{
    DIR *entries = opendir(data);
    if (entries == NULL)
        return;
    for (struct dirent *entry; (entry = readdir(entries)) != NULL;) {
        const char *word = entry->d_name;
        if (!document_is_path(word) && has_set(data, word, class, arena))
            *list_add(&sets->names, arena) = arena_text(arena, word, strlen(word));
    }
    closedir(entries);
}

int vehicle_set_list(const char *class, struct document_names *sets, struct arena *arena,
                     struct diag *diag)
{
    struct data_folders data;
    if (data_folder_list(NULL, ".", &data, arena, diag) != 0)
        return -1;
    *sets = (struct document_names){0};
    for (size_t i = 0; i < data.count; i++)
        list_sets_in(data.paths[i], class, sets, arena);
    document_names_order(sets, arena);
    return 0;
}

/* Names a similar set, all sets, and how a folder of that name is written. */
static int refuse_word(const char *named_by, const char *word, struct arena *arena,
                       struct diag *diag)
{
    struct document_names sets;
    if (vehicle_set_list(NULL, &sets, arena, diag) != 0)
        return -1;
    struct suggestion meant = suggestion_begin(word, strlen(word));
    suggestion_offer(&meant, PAPER);
    const char *known = PAPER ", ";
    for (size_t i = 0; i < sets.names.count; i++) {
        suggestion_offer(&meant, sets.names.items[i]);
        known = arena_format(arena, "%s%s, ", known, sets.names.items[i]);
    }
    return diag_fail(diag, DIAG_CONFIG,
                     "%s: \"%s\" is no set of vehicles%s; expected %sor the path of a folder: ./%s",
                     named_by, word, suggestion_question(&meant, ""), known, word);
}

int vehicle_set_folder(const char *named_by, const char *word, const char **folder,
                       struct arena *arena, struct diag *diag)
{
    *folder = NULL;
    if (word == NULL || strcmp(word, PAPER) == 0)
        return 0;
    if (document_is_path(word)) {
        *folder = word;
        return data_folder_check(named_by, word, diag);
    }
    struct data_folders places;
    const char *kind = arena_format(arena, "%s/vehicles", word);
    if (data_folder_list(NULL, kind, &places, arena, diag) != 0)
        return -1;
    for (size_t i = 0; i < places.count; i++) {
        *folder = arena_text(arena, places.paths[i], strlen(places.paths[i]) - 1);
        if (path_is_folder(*folder))
            return 0;
    }
    return refuse_word(named_by, word, arena, diag);
}

static bool has_digest(const struct vehicle *vehicle, const char *digest)
{
    return vehicle != NULL && strcmp(vehicle->digest, digest) == 0;
}

/* The document of the class with this digest, from the paper's set or else another one; NULL if no
 * set has it. Documents with faults are passed over. */
static const struct vehicle *find_digest(const char *class, const char *digest, struct arena *arena)
{
    struct diag unused = {0};
    struct document_names sets = {0};
    const struct vehicle *vehicle = vehicle_load(class, NULL, arena, &unused);
    vehicle_set_list(class, &sets, arena, &unused);
    for (size_t i = 0; i < sets.names.count && !has_digest(vehicle, digest); i++) {
        const char *folder;
        vehicle_set_folder("", sets.names.items[i], &folder, arena, &unused);
        vehicle = vehicle_load(class, folder, arena, &unused);
    }
    return has_digest(vehicle, digest) ? vehicle : NULL;
}

const struct vehicle *vehicle_set_load(const char *class, const char *digest, const char *folder,
                                       struct arena *arena, struct diag *diag)
{
    const struct vehicle *first = vehicle_load(class, folder, arena, diag);
    if (first == NULL || digest == NULL || has_digest(first, digest))
        return first;
    const struct vehicle *other = find_digest(class, digest, arena);
    return other != NULL ? other : first;
}
