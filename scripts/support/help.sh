# Prints the comment at the head of the script, and ends it, if its first word is -h or --help. An installed script,
# glint-NAME, has its own name there. To be sourced by sh or bash before all else.
case ${1:-} in
    -h | --help)
        case ${0##*/} in
            glint-*) installed="s:scripts/${0##*/glint-}:${0##*/}:" ;;
        esac
        sed -n "1d; /^#/!q; ${installed:-}; s/^# \{0,1\}//p" "$0"
        exit 0
        ;;
esac
