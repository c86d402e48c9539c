# A bare Debian 12, as debootstrap makes it (minbase), in build-bare/, which is gone when the script ends. To be sourced by
# bash in the root of the tree.
#
# Packages come from the mirror that apt of this machine uses, by its settings. What is mounted is mounted in a namespace
# that ends with the last process in it. Needs root and debootstrap (scripts/deps --all). Where no root can be made, the
# script ends with 0 and a line that says what is skipped, $what, and why.
suite=bookworm
root=$PWD/build-bare log=build/bare.log

skip() {
    echo "skipped  $what on a bare Debian 12: $1"
    exit 0
}

# The mirror of this machine, or none, for which debootstrap has its own.
mirror() { apt-get indextargets --format '$(REPO_URI) $(RELEASE)' 'Created-By: Packages' | sed -n "s/ $suite\$//p" | head -n 1; }

[ "$(id -u)" = 0 ] || skip "only root may make one"
for program in debootstrap apt-get unshare; do
    command -v $program >/dev/null || skip "there is no $program; scripts/deps --all installs debootstrap"
done
within=(unshare --mount --pid --fork --kill-child)
"${within[@]}" true 2>/dev/null || skip "root may not make namespaces here"

trap 'rm -rf --one-file-system "$root"' EXIT
trap 'exit 130' INT TERM
rm -rf --one-file-system "$root"
mkdir -p "$root" build
eval "$(apt-config shell http_proxy Acquire::http::Proxy)"
[ -z "${http_proxy:-}" ] || export http_proxy
# shellcheck disable=SC2046  # one word or none
debootstrap --variant=minbase $suite "$root" $(mirror) >$log 2>&1 ||
    skip "debootstrap failed: $(tail -n 1 $log) ($log)"
apt-config dump | grep '^Acquire::' >"$root/etc/apt/apt.conf.d/99host"

# Runs commands of bash in it, as root. As a booted Debian has them: /proc, and /dev/pts where the container may mount it.
run_bare() { # COMMANDS
    "${within[@]}" --mount-proc="$root/proc" sh -c 'mount -t devpts -o newinstance,ptmxmode=666 devpts "$0/dev/pts" 2>/dev/null
        ln -sf pts/ptmx "$0/dev/ptmx"
        exec chroot "$0" env -i HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin bash -e -o pipefail -c "$1"' "$root" "$1"
}
