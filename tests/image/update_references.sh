#!/bin/sh
# Renders the stored pictures of screenshot_test again, with the program given: sh tests/image/update_references.sh build/release/samples/licht/licht
# Do this only when a picture has changed for a reason that another test proves right.
set -eu
licht=${1:?the program licht}
folder=$(dirname "$0")/references
mkdir -p "$folder"
render() { "$licht" render "$1" --size "$2" --spp "$3" --bounces "$4" --seed 1000 --aov variance -o "$folder/$1.exr"; }
render empty 32x32 2 8
render furnace 32x32 8 8
render cornell 80x80 2048 8
# Direct light alone: deeper, sunlight by way of the polished floor is so rare and so bright that hundreds of samples underestimate both
# mean and variance (measured: 2.5 % below the mean of 2048 samples at 256), and no z-test is valid.
render gallery 96x54 1024 1
