#!/bin/sh
# The README's two commands in a bare Debian of that release, as root:
#   sh tests/on_debian.sh CODENAME [options of ctest]
#   FOLDER=/var/tmp/debian DEMO='--size 64x36 --spp 4' sh tests/on_debian.sh trixie -R unit/
# From the environment:
#   FOLDER   keeps the release and the build for the next time    (default: a temporary folder that goes afterwards)
#   MIRROR   where packages come from                             (default: http://deb.debian.org/debian)
#   DEMO     options of the first command                         (default: none, as in the README)
set -eu
case ${1:--} in -*)
    sed -n '2,/^set/s/^# \{0,1\}//p' "$0" | sed '$d' >&2
    exit 2
    ;;
esac
codename=$1
shift
cd "$(dirname "$0")/.."
. samples/setup.sh
if [ "$(id -u)" != 0 ]; then
    echo "Another release is made and entered by root only: sudo sh $0 $codename" >&2
    exit 1
fi
install_missing debootstrap git

child=
folder=${FOLDER:-}
if [ -z "$folder" ]; then temporary=$(mktemp -d); folder=$temporary; else temporary=; fi
clean_up() {
    if [ -n "$child" ]; then kill -KILL "$child" 2>/dev/null || true; fi
    if [ -n "$temporary" ]; then rm -rf --one-file-system -- "$temporary"; fi
}
trap clean_up EXIT
trap 'exit 1' HUP INT TERM

# apart COMMAND...: with mounts and processes of its own, which end with it however it ends: nothing stays mounted in
# FOLDER. Not in the foreground, where the shell would wait for it before it hears a signal.
apart() {
    unshare --mount --pid --fork --kill-child "$@" &
    child=$!
    result=0
    wait "$child" || result=$?
    child=
    return $result
}

root=$folder/$codename
if [ ! -d "$root" ]; then
    mkdir -p "$folder"
    rm -rf --one-file-system -- "$root.part"
    apart --mount-proc debootstrap --variant=minbase "$codename" "$root.part" "${MIRROR:-http://deb.debian.org/debian}"
    mv "$root.part" "$root"
fi
cp /etc/resolv.conf "$root/etc/resolv.conf"

# What git knows, as it is now; the build of another time stays.
mkdir -p "$root/root/licht"
find "$root/root/licht" -mindepth 1 -maxdepth 1 ! -name build -exec rm -rf --one-file-system -- {} +
git ls-files -z | tar --create --null --files-from - | tar --extract --directory "$root/root/licht"

# inside SCRIPT [OPTION...]: says how it ends and how long it takes, and keeps the first failure.
failure=0
summary=
inside() {
    start=$(date +%s)
    code=0
    # Tests open terminals of their own, which take /dev/pts.
    apart --mount-proc="$root/proc" sh -c 'mount -t devpts -o newinstance,ptmxmode=0666 devpts "$0/dev/pts" && exec chroot "$0" "$@"' "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LANG=C.UTF-8 \
        ${http_proxy:+"http_proxy=$http_proxy"} ${https_proxy:+"https_proxy=$https_proxy"} \
        sh -c 'cd /root/licht && exec sh "$@"' sh "$@" || code=$?
    summary="$summary
$codename: sh $*: exit code $code after $(($(date +%s) - start)) s"
    if [ $failure = 0 ]; then failure=$code; fi
}
# shellcheck disable=SC2086 # a list of words
inside samples/demo.sh ${DEMO:-}
inside tests/run.sh "$@"
echo "$summary"
exit "$failure"
