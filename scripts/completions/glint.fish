# Completions of glint's programs for fish: options from --help, names from `glint --list`.

function __glint_names --description 'what glint --list KIND has before two blanks'
    glint --list $argv[1] 2>/dev/null | string replace -r '  .*' ''
end

function __glint_options --description 'the options of the program of this line'
    set -l words (commandline -opc)
    $words[1] --help 2>/dev/null | string match -ra -- '--[a-z][a-z-]*=?' | sort -u
end

function __glint_listed --description 'names behind the commas of a list that is being written; - leaves one out'
    set -l before (commandline -ct | string match -r -- '^(?:--[a-z]+=)?((?:.*,)?-?)')[2]
    for name in $argv
        echo $before$name
    end
end

for program in glint (__glint_names programs)
    complete -c $program -n 'commandline -ct | string match -q -- "-*"' -f -a '(__glint_options)'
    complete -c $program -l sensors -x -a '(__glint_names sensors)'
    complete -c $program -l effects -x -a '(__glint_listed auto all none (__glint_names effects))'
    complete -c $program -l sections -x -a '(__glint_listed all none (__glint_names sections))'
    complete -c $program -l vehicles -x -a 'paper (glint --list vehicles | string replace -rf ".*--vehicles " "" | string split ", " | sort -u)'
end
complete -c glint -l datasheet -x -a '(__glint_names sensors)'
complete -c glint -l list -x -a 'programs effects sections sensors scenarios vehicles pipelines'
complete -c glint -a '(__glint_names pipelines)'
complete -c glint-traffic -a '(__glint_names scenarios)'
