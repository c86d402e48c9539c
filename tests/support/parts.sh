# Parts of a long test: run alone or beside each other, with the time left by what they cost, and with the reasons last
# if some fail. To be sourced by bash. A function names the parts in their order:
#
#     every_part() { needed "TITLE" COMMAND...; part "TITLE" COMMAND...; beside "TITLE" COMMAND...; together; }
#     run_parts every_part
#
# `part` waits for all before it and runs alone; `beside` runs beside others, one a core; `together` waits for all. A
# command may be a function; any command that fails ends it, and its log says which. A part prints into a log, which is
# shown when the part ends. After a failure the others run, too, but for `needed`: that part runs alone, and its failure
# ends the script. In a part `place` is a new folder, which is removed when all parts have ended.
#
# A line of PARTS_SECONDS (absent: tests/seconds) has the seconds and the title of a part, and + behind the seconds where
# most of them are for building, which is done once.
. scripts/support/progress.sh
parts_seconds=${PARTS_SECONDS:-tests/seconds}
parts_shown=''
[ ! -t 2 ] || parts_shown=yes
parts_titles=() parts_running=() parts_failed=() parts_begun=0
declare -A parts_how parts_state parts_begin parts_took parts_title parts_command parts_log parts_code

part() { parts_next alone "$@"; }
beside() { parts_next beside "$@"; }
needed() {
    part "$@"
    [ ${#parts_failed[@]} -eq 0 ] || parts_why
}
together() {
    [ -z "$parts_listed" ] || while [ ${#parts_running[@]} -gt 0 ]; do parts_collect; done
}

parts_next() { # HOW TITLE COMMAND...
    local most=1
    if [ -z "$parts_listed" ]; then
        parts_titles+=("$2")
        parts_how[$2]=$1 parts_state[$2]=waits
        return
    fi
    if [ "$1" = beside ]; then most=$(nproc); else together; fi
    while [ ${#parts_running[@]} -ge "$most" ]; do parts_collect; done
    parts_start "${@:2}"
    [ "$1" = beside ] || together
}

# Which command of a function failed; of one that is no function the summary says all.
parts_fault() { # CODE COMMAND
    # shellcheck disable=SC2016
    [ "$2" = '"$@"' ] || echo "this failed with exit status $1: $2" >&2
}

parts_start() { # TITLE COMMAND...
    local job title=$1 log=$parts_logs/$((parts_begun += 1))
    local place=$log.place
    mkdir "$place"
    shift
    set -m # a process group of its own, so that it can be ended with all that it has started
    (
        set -eE
        trap 'parts_fault $? "$BASH_COMMAND"' ERR
        [ -z "$parts_shown" ] || export GLINT_PROGRESS="$BASHPID $log.share"
        "$@"
    ) >"$log" 2>&1 </dev/null &
    job=$!
    set +m
    parts_running+=("$job")
    parts_title[$job]=$title parts_command[$job]=$* parts_log[$job]=$log parts_begin[$job]=$SECONDS parts_state[$title]=$job
    parts_show
}

# Waits until a part ends, or for a second, after which the line of progress is drawn again.
parts_collect() {
    local job still=() runs
    if [ -n "$parts_shown" ]; then
        sleep 1 &
    fi
    wait -n || true
    runs=" $(jobs -rp | tr '\n' ' ')"
    for job in "${parts_running[@]}"; do
        case $runs in
            *" $job "*) still+=("$job") ;;
            *) parts_end "$job" ;;
        esac
    done
    parts_running=("${still[@]}")
    parts_show
}

parts_end() { # JOB
    local title=${parts_title[$1]} code=0
    wait "$1" || code=$?
    parts_state[$title]=ended parts_took[$title]=$((SECONDS - parts_begin[$1])) parts_code[$1]=$code
    progress_end
    echo "== $title"
    cat "${parts_log[$1]}"
    if [ $code -ne 0 ]; then
        parts_failed+=("$1")
        echo "FAILED: $title" >&2
    fi
    echo "   (${parts_took[$title]} s)"
}

# Ends the script, with the reasons.
parts_why() {
    local job code
    for job in "${parts_failed[@]}"; do
        code=${parts_code[$job]}
        [ "$code" -le 128 ] && code="exit status $code" || code="ended by SIG$(kill -l "$code")"
        printf '\nFAILED: %s (%s): %s\n' "${parts_title[$job]}" "${parts_command[$job]}" "$code"
        [ -s "${parts_log[$job]}" ] || echo "    it printed nothing"
        tail -n 40 "${parts_log[$job]}" | sed 's/^/    /'
    done >&2
    exit 1
}

# What runs is ended, with all that it has started.
parts_leave() {
    local job
    progress_end
    for job in "${parts_running[@]}"; do
        kill -- "-$job" 2>/dev/null || true
        printf '%s was running; the last lines of its log:\n' "${parts_title[$job]}" >&2
        tail -n 5 "${parts_log[$job]}" | sed 's/^/    /' >&2
    done
    rm -rf "$parts_logs"
}

# A line for each part: how it runs, its seconds by the table, its state, how long it ran, the share that it tells.
parts_table() {
    local title state told
    for title in "${parts_titles[@]}"; do
        state=${parts_state[$title]} told=-
        case $state in
            waits) echo "${parts_how[$title]} ${parts_cost[$title]:-10} waits 0 -" ;;
            ended) echo "${parts_how[$title]} ${parts_cost[$title]:-10} ended ${parts_took[$title]} -" ;;
            *)
                # It may be empty while the part writes it anew.
                [ ! -e "${parts_log[$state]}.share" ] || read -r told <"${parts_log[$state]}.share" || told=-
                echo "${parts_how[$title]} ${parts_cost[$title]:-10} runs $((SECONDS - parts_begin[$state])) $told"
                ;;
        esac
    done
}

parts_show() {
    local job names=''
    [ -n "$parts_shown" ] && [ ${#parts_running[@]} -gt 0 ] || return 0
    for job in "${parts_running[@]}"; do names="$names, ${parts_title[$job]}"; done
    parts_table | parts_left "$(nproc)" "${names#, }"
}

# The time left of parts by what they cost. Standard input has a line for each: alone or beside, its seconds by a table,
# waits, runs or ended, the seconds for which it ran, and the share that it tells, or -. The pace of this machine is what
# parts took beside what they should have taken; 10 s of the table count as kept, so that a first short part says little.
# A part that runs for longer than it should counts, too, and is thought to last for a quarter of its time yet. A + behind
# the seconds marks a part that builds: if it is fast, that says nothing of the others.
parts_left() { # CORES TEXT
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

run_parts() { # FUNCTION [RENEW]
    local seconds title begin=$SECONDS
    declare -gA parts_cost
    while read -r seconds title; do parts_cost[$title]=$seconds; done < <(grep -v '^#' "$parts_seconds")
    parts_logs=$(mktemp -d)
    trap parts_leave EXIT
    trap 'exit 130' INT
    trap 'exit 143' TERM
    parts_listed='' && "$1"
    parts_listed=yes
    "$1"
    together
    progress_end
    [ ${#parts_failed[@]} -eq 0 ] || parts_why
    [ -z "${2:-}" ] || parts_renew
    echo "all tests passed in $((SECONDS - begin)) s"
}

# Parts that did not run keep their seconds.
parts_renew() {
    local title plus
    for title in "${parts_titles[@]}"; do
        case ${parts_cost[$title]:-} in *+) plus=+ ;; *) plus='' ;; esac
        parts_cost[$title]=${parts_took[$title]}$plus
    done
    { grep '^#' "$parts_seconds"; for title in "${!parts_cost[@]}"; do echo "${parts_cost[$title]} $title"; done | sort -k 2; } >"$parts_logs/seconds"
    cat "$parts_logs/seconds" >"$parts_seconds"
}
