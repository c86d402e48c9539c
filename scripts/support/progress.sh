# Rate and time left of a script's work, as lib/run/progress.h shows them. To be sourced by sh or bash where the work
# begins.
progress_begin_s=$(date +%s)

progress() { # DONE EXPECTED UNIT: on stderr, where it is a terminal and the work has lasted for a second
    [ -t 2 ] || return 0
    set -- "$@" $(($(date +%s) - progress_begin_s))
    [ "$1" -gt 0 ] && [ "$4" -ge 1 ] || return 0
    awk -v done="$1" -v expected="$2" -v unit="$3" -v elapsed="$4" 'BEGIN {
        share = done < expected ? done / expected : 1
        rate = done / elapsed
        left = int(elapsed / share - elapsed + 0.5)
        line = sprintf("[%-24s] %3d %%, %.*f %s/s, %d:%02d:%02d left", substr("########################", 1, 24 * share),
            100 * share, rate < 10, rate, unit, left / 3600, left / 60 % 60, left % 60)
        printf "\r%-72s", line }' >&2
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

# The time left of parts by what they cost. Standard input has a line for each: alone or beside, its seconds by a table,
# waits, runs or ended, the seconds for which it ran, and the share that it tells, or -. The pace of this machine is what
# parts took beside what they should have taken; 10 s of the table count as kept, so that a first short part says little.
# A part that runs for longer than it should counts, too, and is thought to last for a quarter of its time yet. A + behind
# the seconds marks a part that builds: if it is fast, that says nothing of the others.
progress_left() { # CORES TEXT
    awk -v cores="$1" -v text="$2" '
        {
            how[NR] = $1; cost[NR] = $2 + 0; builds[NR] = $2 ~ /\+$/; state[NR] = $3; ran[NR] = $4; share[NR] = $5 + 0
            spent += $1 == "alone" ? $4 : $4 / cores
            if (state[NR] == "ended")
                share[NR] = 1
            if (share[NR] > 0)
                count(share[NR] * cost[NR], ran[NR], builds[NR])
        }
        function count(seconds, took, building) {
            if (building && took < seconds)
                return
            due_s += seconds
            took_s += took
        }
        function pace() { return (10 + took_s) / (10 + due_s) }
        END {
            for (i = 1; i <= NR; i++)
                if (state[i] == "runs" && share[i] == 0 && ran[i] > pace() * cost[i])
                    count(cost[i], ran[i], 0)
            for (i = 1; i <= NR; i++) {
                if (state[i] == "ended")
                    continue
                rest = (1 - share[i]) * pace() * cost[i]
                if (share[i] == 0)
                    rest = rest - ran[i] > ran[i] / 4 ? rest - ran[i] : ran[i] / 4
                left[how[i]] += rest
                if (how[i] == "beside" && rest > longest)
                    longest = rest
            }
            beside = left["beside"] / cores > longest ? left["beside"] / cores : longest
            seconds = int(left["alone"] + beside + 0.5)
            done = spent / (spent + seconds + 1e-9)
            line = sprintf("[%-24s] %3d %%, %d:%02d:%02d left: %s", substr("########################", 1, 24 * done), 100 * done,
                seconds / 3600, seconds / 60 % 60, seconds % 60, text)
            printf "\r%-72s", substr(line, 1, 72)
        }' >&2
}

progress_end() { # takes the line away
    [ ! -t 2 ] || printf '\r%72s\r' '' >&2
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
