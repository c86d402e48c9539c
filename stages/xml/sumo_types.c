#include "sumo_types.h"

#include "xml_rows.h"

/* A file whose vTypes are being read. */
struct types_file {
    struct xml_rows xml; /* first, as its functions take it */
    struct recorded_types *types;
    const char *path;
    struct arena *arena;
};

/* A size in metres; 0 where the type does not say it. */
static bool read_size(struct types_file *file, const char **attributes, const char *name,
                      double *size_m)
{
    const char *text = xml_rows_attribute(attributes, name);
    return text == NULL || xml_rows_number(&file->xml, name, text, 0, 1e6, size_m);
}

static void add_type(struct types_file *file, const char **attributes)
{
    struct xml_rows *xml = &file->xml;
    struct recorded_type type = {.file = file->path, .line = xml_rows_line(xml)};
    const char *id = xml_rows_attribute(attributes, "id");
    const char *class = xml_rows_attribute(attributes, "vClass");
    type.word.word = xml_rows_name(xml, "id", id, file->arena);
    type.word.class =
        xml_rows_name(xml, "vClass", class != NULL ? class : "passenger", file->arena);
    if (type.word.word != NULL && type.word.class != NULL &&
        read_size(file, attributes, "length", &type.word.length_m) &&
        read_size(file, attributes, "width", &type.word.width_m) &&
        read_size(file, attributes, "height", &type.word.height_m))
        *list_add(&file->types->list, file->arena) = type;
}

static void on_begin(void *context, const char *name, const char **attributes)
{
    struct types_file *file = context;
    if (!file->xml.in_root && strcmp(name, "routes") != 0 && strcmp(name, "additional") != 0)
        xml_rows_fail(&file->xml, "<routes>", NULL, "routes, or additional elements, of SUMO");
    file->xml.in_root = true;
    if (strcmp(name, "vType") == 0)
        add_type(file, attributes);
}

static void fail_at_end(struct xml_rows *xml)
{
    diag_fail(&xml->fault, DIAG_DATA, "line %zu: the file ends before </routes> or </additional>",
              xml_rows_line(xml));
}

int sumo_types_read(struct recorded_types *types, const char *path, struct arena *arena,
                    struct diag *diag)
{
    struct types_file file = {.types = types, .path = path, .arena = arena};
    struct input *input = input_open(path, diag);
    if (input == NULL)
        return diag_prefix(diag, "--types: %s: ", path);
    xml_rows_begin(&file.xml, "routes", input, &file);
    file.xml.fail_at_end = fail_at_end;
    XML_SetStartElementHandler(file.xml.parser, on_begin);
    struct recorded_row row; /* of which a file of types has none */
    int result = xml_rows_next(&file, &row, diag);
    xml_rows_close(&file);
    return result == RECORDED_END ? 0 : diag_prefix(diag, "--types: %s: ", path);
}
