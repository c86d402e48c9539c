#include "run/program.h"

#include "run/stage.h"
#include "run/tool.h"

struct program program_of_stage(const struct stage *stage)
{
    bool source = stage->next != NULL;
    return (struct program){
        .kind = source        ? PROGRAM_SOURCE
                : stage->sink ? PROGRAM_SINK
                              : PROGRAM_FILTER,
        .name = stage->name,
        .summary = stage->summary,
        .details = stage->details,
        .options = stage->options,
        .operand = stage->operand,
        .reads = stage->reads,
        .writes = stage->writes,
        .takes_files = !source,
    };
}

struct program program_of_tool(const struct tool *tool)
{
    return (struct program){
        .kind = PROGRAM_TOOL,
        .name = tool->name,
        .summary = tool->summary,
        .details = tool->details,
        .options = tool->options,
        .operand = tool->operand,
        .reads = tool->reads,
        .takes_files = tool->reads != 0,
        .into_folder = tool->into_folder,
    };
}
