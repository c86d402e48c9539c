# Completions of glint's programs for bash: options from --help, names from `glint --list`.

_glint_names() { # KIND: the first words of `glint --list KIND`
    glint --list "$1" 2>/dev/null | cut -d ' ' -f 1
}

_glint_values() { # OPTION: the names that it takes, or nothing
    case $1 in
        --sensors | --datasheet) _glint_names sensors ;;
        --effects) echo auto all none; _glint_names effects ;;
        --sections) echo all none; _glint_names sections ;;
        --vehicles) echo paper; glint --list vehicles | sed -n 's/.*--vehicles //p' | tr -d , | sort -u ;;
        --list) echo programs effects sections sensors scenarios vehicles pipelines ;;
    esac
}

_glint() {
    local word=$2 before=$3 option
    # bash takes = as a word of its own.
    [ "$before" != = ] || before=${COMP_WORDS[COMP_CWORD - 2]}
    [ "$word" != = ] || word=
    # The last name of a list, which - leaves out.
    local last=${word##*,} values
    last=${last#-}
    values=$(_glint_values "$before")
    if [ -n "$values" ]; then
        mapfile -t COMPREPLY < <(compgen -P "${word%"$last"}" -W "$values" -- "$last")
        return
    fi
    case $word in
        -*)
            option=$("$1" --help 2>/dev/null | grep -oE -e '--[a-z][a-z-]*=?' | sort -u)
            mapfile -t COMPREPLY < <(compgen -W "$option" -- "$word")
            [[ ${COMPREPLY[*]-} != *= ]] || compopt -o nospace
            return
            ;;
    esac
    case ${1##*/} in
        glint) values=$(_glint_names pipelines) ;;
        glint-traffic) values=$(_glint_names scenarios) ;;
    esac
    compopt -o default
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$word")
}

complete -F _glint glint $(glint --list programs 2>/dev/null | cut -d ' ' -f 1)
