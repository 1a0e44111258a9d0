#!/bin/sh
# Builds Licht and renders the demo scene: sh samples/demo.sh [options of `licht render`]
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh

# shellcheck disable=SC2086 # a list of words
install_missing $build_packages
if [ ! -e $build/build.ninja ]; then configure -DLICHT_BUILD_TESTS=OFF; fi
build_all licht

licht=$(find $build/samples -name licht -type f -perm -u+x)
report=out/gallery.json
mkdir -p out
# What was rendered by this very program need not be rendered again.
if [ $# -gt 0 ] || [ ! -e $report ] || [ ! -e out/gallery.png ] || [ ! -e out/gallery.exr ] || [ "$licht" -nt $report ]; then
    if [ $# = 0 ]; then set -- --size 640x360 --time 120 --denoise spatiotemporal --unfiltered out/gallery-unfiltered.png; fi
    "$licht" render gallery -o out/gallery.png -o out/gallery.exr --aov all --report $report "$@"
fi

# text KEY, number KEY FORMAT: the first value of that name in the report, which has one a line.
text() { sed -n "s/^ *\"$1\": \"\(.*\)\",\{0,1\}\$/\1/p" $report | head -n 1; }
number() {
    value=$(sed -n "s/^ *\"$1\": \([-+.0-9e]*\),\{0,1\}\$/\1/p" $report | head -n 1)
    if [ -z "$value" ]; then echo unknown; else LC_ALL=C awk -v value="$value" -v format="$2" 'BEGIN { printf format, value }'; fi
}
echo
echo "Pictures:  $PWD/out/gallery.png and $PWD/out/gallery.exr (linear, with layers)"
echo "Cost:      $(number spp '%d') samples per pixel in $(number render '%.1f') s on $(text device);" \
    "first picture $(number first_image '%.1f') s after the start"
echo "Error:     $(number relative_error '%.3f') (relative, estimated)"
if [ "$(number unfiltered_relative_error '%.3f')" != unknown ]; then
    echo "           $(number unfiltered_relative_error '%.3f') before the filter: $PWD/out/gallery-unfiltered.png"
fi
echo "Report:    $PWD/$report"

if [ -n "${DISPLAY:-}${WAYLAND_DISPLAY:-}" ]; then
    echo "Opening the viewer; Esc closes it."
    exec "$licht" view gallery
fi
