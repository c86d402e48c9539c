# Rate and time left of a script's work, as lib/run/progress.h shows them. To be sourced by sh or bash where the work
# begins.
progress_begin_s=$(date +%s)
progress_width() { stty size <&2 2>/dev/null | awk '{ all = $2 } END { print (all > 0 && all <= 72 ? all - 1 : 72) }'; } # columns

progress() { # DONE EXPECTED UNIT: on stderr, where it is a terminal and the work has lasted for a second
    [ -t 2 ] || return 0
    set -- "$@" $(($(date +%s) - progress_begin_s))
    [ "$1" -gt 0 ] && [ "$4" -ge 1 ] || return 0
    awk -v width="$(progress_width)" -v done="$1" -v expected="$2" -v unit="$3" -v elapsed="$4" 'BEGIN {
        share = done < expected ? done / expected : 1
        rate = done / elapsed
        left = int(elapsed / share - elapsed + 0.5)
        line = sprintf("[%-24s] %3d %%, %.*f %s/s, %d:%02d:%02d left", substr("########################", 1, 24 * share),
            100 * share, rate < 10, rate, unit, left / 3600, left / 60 % 60, left % 60)
        printf "\r%-*.*s", width, width, line }' >&2
}

# A part of a longer test (parts.sh) tells its share: GLINT_PROGRESS has the number of the process whose part it is, and
# a file. What that process starts in its turn tells nothing.
progress_tell() { # DONE EXPECTED
    case ${GLINT_PROGRESS:-} in
        "$$ "* | "$PPID "* | "${BASHPID:-} "*)
            awk -v done="$1" -v expected="$2" 'BEGIN { printf "%.4f\n", done < expected ? done / expected : 1 }' >"${GLINT_PROGRESS#* }"
            ;;
    esac
}

progress_end() { # takes the line away
    [ ! -t 2 ] || printf '\r%*s\r' "$(progress_width)" '' >&2
}

# Waits for a command in the background and tells how many of the files that it makes are there. Its exit status.
progress_wait() { # PID EXPECTED UNIT FOLDER SUFFIX
    if [ ! -t 2 ] && [ -z "${GLINT_PROGRESS:-}" ]; then
        wait "$1"
        return
    fi
    progress_mark=$(mktemp)
    while sleep 0.2 && kill -0 "$1" 2>/dev/null; do
        # The folder may not be there yet, and files go while find looks: no failure under pipefail.
        progress_done=$(find "$4" -name "*$5" -size +0 -newer "$progress_mark" 2>/dev/null | wc -l) || true
        progress "$progress_done" "$2" "$3"
        progress_tell "$progress_done" "$2"
    done
    rm "$progress_mark"
    progress_end
    wait "$1"
}
