#include "run/pipeline.h"

#include "base/text.h"

struct parser {
    const char *at, *end;
    size_t line;
    struct arena *arena;
    struct diag *diag;
    struct pipeline *pipeline;
    const char *input_end; /* the line that ends the here-document; NULL: there is none */
};

static int refuse(const struct parser *parser, const char *what)
{
    return diag_fail(parser->diag, DIAG_USAGE, "%zu: %s; run it with bash", parser->line, what);
}

static char peek(const struct parser *parser)
{
    if (parser->at == parser->end)
        return '\0';
    return *parser->at;
}

static char take(struct parser *parser)
{
    char character = *parser->at++;
    if (character == '\n')
        parser->line++;
    return character;
}

/* The text from here to the line that ends it is the here-document. */
static void take_input(struct parser *parser)
{
    struct pipeline *pipeline = parser->pipeline;
    pipeline->input = parser->at;
    while (parser->at < parser->end) {
        const char *line = parser->at;
        const char *newline = memchr(line, '\n', (size_t)(parser->end - line));
        size_t length = (size_t)((newline != NULL ? newline : parser->end) - line);
        if (text_is(line, length, parser->input_end)) {
            parser->at += length;
            return;
        }
        parser->at += length + (newline != NULL);
        parser->line++;
        pipeline->input_length = (size_t)(parser->at - pipeline->input);
    }
}

/* Skips blanks, comments and continued lines, and newlines where a pipeline may go on after them.
 */
static void skip(struct parser *parser, bool newlines)
{
    while (parser->at < parser->end) {
        char character = *parser->at;
        bool continued = character == '\\' && parser->at + 1 < parser->end && parser->at[1] == '\n';
        if (continued) {
            take(parser);
            take(parser);
        } else if (character == ' ' || character == '\t' || (newlines && character == '\n')) {
            take(parser);
            if (character == '\n' && parser->input_end != NULL && parser->pipeline->input == NULL)
                take_input(parser);
        } else if (character == '#') {
            while (parser->at < parser->end && *parser->at != '\n')
                parser->at++;
        } else {
            return;
        }
    }
}

static int read_single_quotes(struct parser *parser, struct text *word)
{
    while (parser->at < parser->end) {
        char character = take(parser);
        if (character == '\'')
            return 0;
        text_add(word, &character, 1);
    }
    return refuse(parser, "a quote is not closed");
}

static int read_double_quotes(struct parser *parser, struct text *word)
{
    while (parser->at < parser->end) {
        char character = take(parser);
        if (character == '"')
            return 0;
        if (character == '$' || character == '`')
            return refuse(parser, "variables and substitutions are not understood here");
        if (character == '\\' && parser->at < parser->end && strchr("\\\"$`\n", peek(parser))) {
            character = take(parser);
            if (character == '\n')
                continue;
        }
        text_add(word, &character, 1);
    }
    return refuse(parser, "a quote is not closed");
}

static int read_piece(struct parser *parser, struct text *word)
{
    char character = take(parser);
    if (character == '\'')
        return read_single_quotes(parser, word);
    if (character == '"')
        return read_double_quotes(parser, word);
    if (character == '\\' && parser->at < parser->end) {
        character = take(parser);
        if (character != '\n')
            text_add(word, &character, 1);
        return 0;
    }
    if (strchr("$`", character) != NULL)
        return refuse(parser, "variables and substitutions are not understood here");
    bool home = character == '~' &&
                (word->length == 0 || strchr("=:", word->bytes[word->length - 1]) != NULL);
    if (strchr("*?[", character) != NULL || home)
        return refuse(parser, "file name patterns are not understood here");
    if (strchr("<>", character) != NULL)
        return refuse(parser, "redirections are not understood here (use -o FILE)");
    if (strchr(";&(){}!", character) != NULL)
        return refuse(parser, "only one pipeline of words and | is understood here");
    text_add(word, &character, 1);
    return 0;
}

static bool ends_word(char character)
{
    return character == '\0' || strchr(" \t\n|", character) != NULL;
}

static int read_word(struct parser *parser, const char **word)
{
    struct text text = {0};
    int result = 0;
    while (result == 0 && !ends_word(peek(parser)))
        result = read_piece(parser, &text);
    *word = arena_text(parser->arena, text.bytes, text.length);
    text_free(&text);
    return result;
}

/* Takes <<'WORD' behind the words of the first command; false: something else stands there. */
static bool take_input_end(struct parser *parser)
{
    const char *word = parser->at + 3;
    if (parser->end - parser->at < 4 || memcmp(parser->at, "<<'", 3) != 0 ||
        parser->pipeline->commands.count > 0 || parser->input_end != NULL)
        return false;
    const char *quote = memchr(word, '\'', (size_t)(parser->end - word));
    if (quote == NULL || quote == word || memchr(word, '\n', (size_t)(quote - word)) != NULL ||
        (quote + 1 < parser->end && !ends_word(quote[1])))
        return false;
    parser->input_end = arena_text(parser->arena, word, (size_t)(quote - word));
    parser->at = quote + 1;
    return true;
}

/* Reads words up to a newline, a bar or the end of the text. */
static int read_command(struct parser *parser, struct command *command)
{
    command->line = parser->line;
    for (;;) {
        skip(parser, false);
        if (ends_word(peek(parser)))
            return 0;
        if (command->words.count > 0 && take_input_end(parser))
            continue;
        const char *word;
        if (read_word(parser, &word) != 0)
            return -1;
        if (command->words.count == 0 && strchr(word, '=') != NULL)
            return refuse(parser, "variables are not understood here");
        *list_add(&command->words, parser->arena) = word;
    }
}

static bool is_pipefail(const struct command *command)
{
    static const char *const line[] = {"set", "-o", "pipefail"};
    if (command->words.count != 3)
        return false;
    for (size_t i = 0; i < 3; i++)
        if (strcmp(command->words.items[i], line[i]) != 0)
            return false;
    return true;
}

/* A NUL would end the text for every function that reads strings. */
static int refuse_nul(struct parser *parser)
{
    const char *nul = memchr(parser->at, '\0', (size_t)(parser->end - parser->at));
    if (nul == NULL)
        return 0;
    while (parser->at < nul)
        take(parser);
    return refuse(parser, "a NUL byte");
}

/* Adds the command, which a bar or a newline follows, unless it is the line that sets pipefail. */
static int add_command(struct pipeline *pipeline, const struct command *command, bool piped,
                       const struct parser *parser)
{
    if (command->words.count == 0)
        return refuse(parser, "a command is missing before |");
    bool is_plain = !piped && parser->input_end == NULL;
    if (pipeline->commands.count == 0 && is_plain && is_pipefail(command))
        return 0;
    if (strcmp(command->words.items[0], "set") == 0)
        return diag_fail(parser->diag, DIAG_USAGE,
                         "%zu: of set, only `set -o pipefail` is understood here; run it with bash",
                         command->line);
    *list_add(&pipeline->commands, parser->arena) = *command;
    return 0;
}

int pipeline_parse(const char *text, size_t length, struct pipeline *pipeline, struct arena *arena,
                   struct diag *diag)
{
    struct parser parser = {text, text + length, 1, arena, diag, pipeline, NULL};
    *pipeline = (struct pipeline){0};
    if (refuse_nul(&parser) != 0)
        return -1;
    bool piped = false; /* a bar stands before the next command */
    for (;;) {
        skip(&parser, true);
        bool more = piped || pipeline->commands.count == 0; /* commands may follow */
        if (parser.at == parser.end && more)
            return refuse(&parser, "a command is missing");
        if (parser.at == parser.end) {
            if (parser.input_end != NULL && pipeline->input == NULL)
                pipeline->input = parser.end;
            return 0;
        }
        if (!more)
            return refuse(&parser, "a second pipeline");
        struct command command = {0};
        if (read_command(&parser, &command) != 0)
            return -1;
        piped = peek(&parser) == '|';
        if (add_command(pipeline, &command, piped, &parser) != 0)
            return -1;
        if (piped)
            take(&parser);
        if (peek(&parser) == '|')
            return refuse(&parser, "only one pipeline of words and | is understood here");
    }
}
