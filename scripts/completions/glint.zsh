#compdef -P glint(-*)#
# Completions of glint's programs for zsh: options from --help, names from `glint --list`.

_glint_names() { # KIND: what `glint --list KIND` has before two blanks
    print -l ${${(f)"$(glint --list $1 2>/dev/null)"}%%  *}
}

_glint_values() { # OPTION: the names that it takes, or nothing
    case $1 in
        --sensors|--datasheet) _glint_names sensors ;;
        --effects) print -l auto all none; _glint_names effects ;;
        --sections) print -l all none; _glint_names sections ;;
        --vehicles) print -l paper ${(u)${(s:, :)${(j:, :)${(M)${(f)"$(glint --list vehicles)"}:#*--vehicles*}##*--vehicles }}} ;;
        --list) print -l programs effects sections sensors scenarios vehicles pipelines ;;
    esac
}

local program=$words[1] word=$words[CURRENT] before=$words[CURRENT-1]
local -a values
if [[ $word == --*=* ]]; then
    before=${word%%=*}
    compset -P '--*='
fi
values=(${(f)"$(_glint_values $before)"})
if (( $#values )); then
    # The last name of a list, which - leaves out.
    compset -P '*,'
    compset -P -
    compadd -S '' -- $values
elif [[ $word == -* ]]; then
    values=(${(uf)"$($program --help 2>/dev/null | grep -oE -e '--[a-z][a-z-]*=?')"})
    compadd -S '' -- ${(M)values:#*=}
    compadd -- ${values:#*=}
else
    case ${program:t} in
        glint) compadd -- ${(f)"$(_glint_names pipelines)"} ;;
        glint-traffic) compadd -- ${(f)"$(_glint_names scenarios)"} ;;
    esac
    _files
fi
