# Completions of glint's programs for bash: options from --help, names from `glint --list`.

_glint_names() { # KIND: what `glint --list KIND` has before two blanks
    glint --list "$1" 2>/dev/null | sed 's/  .*//'
}

_glint_offer() { # BEFORE WORD: the names on standard input that begin with WORD, as a shell reads them; none is expanded
    local name quoted
    COMPREPLY=()
    while read -r name; do
        quoted=$(printf %q "$name")
        [[ -z $name || $name != "$2"* && $quoted != "$2"* ]] || COMPREPLY+=("$1$quoted")
    done
}

_glint_values() { # OPTION: the names that it takes, or nothing
    case $1 in
        --sensors | --datasheet) _glint_names sensors ;;
        --effects) printf "%s\n" auto all none; _glint_names effects ;;
        --sections) printf "%s\n" all none; _glint_names sections ;;
        --vehicles) echo paper; glint --list vehicles | sed -n 's/.*--vehicles //p' | tr -s ', ' '\n' | sort -u ;;
        --list) printf "%s\n" programs effects sections sensors scenarios vehicles pipelines ;;
    esac
}

_glint() {
    local word=$2 before=$3
    # bash takes = as a word of its own.
    [ "$before" != = ] || before=${COMP_WORDS[COMP_CWORD - 2]}
    [ "$word" != = ] || word=
    # The last name of a list, which - leaves out.
    local last=${word##*,} values
    last=${last#-}
    values=$(_glint_values "$before")
    if [ -n "$values" ]; then
        _glint_offer "${word%"$last"}" "$last" <<<"$values"
        return
    fi
    case $word in
        -*)
            # An option that takes a value is offered with its = alone.
            _glint_offer "" "$word" < <("$1" --help 2>/dev/null | grep -oE -e '--[a-z][a-z-]*=?' | sort -ru | awk -F= '!seen[$1]++')
            [[ ${COMPREPLY[*]-} != *= ]] || compopt -o nospace
            return
            ;;
    esac
    case ${1##*/} in
        glint) values=$(_glint_names pipelines) ;;
        glint-traffic) values=$(_glint_names scenarios) ;;
    esac
    compopt -o default
    _glint_offer "" "$word" <<<"$values"
}

complete -F _glint glint $(_glint_names programs)
