# Prints the comment at the head of the script, and ends it, if its first word is -h or --help. To be sourced by sh or
# bash before all else.
case ${1:-} in
    -h | --help)
        sed -n '1d; /^#/!q; s/^# \{0,1\}//p' "$0"
        exit 0
        ;;
esac
