#!/bin/sh
# Do two builds draw the same pictures, bit for bit? Renders what is built in, and every model of a folder, with both.
#   sh tests/same_bits/same_bits.sh OLD_LICHT NEW_LICHT [FOLDER_OF_GLTF_MODELS]
# From the environment: SAME_BITS (the comparing program, default: the release build's), OUT (default: out/same_bits),
# ONLY (a pattern of names), ZTEST=1: the pictures need only be of the same mean, by the z-test of `licht compare`; then SPP (default: 64).
# Ends with 1 where a picture differs.
set -u
if [ $# -lt 2 ]; then
    sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
old=$1
new=$2
models=${3:-}
root=$(dirname "$0")/../..
same=${SAME_BITS:-$root/build/release/tests/same_bits/same_bits}
out=${OUT:-out/same_bits}
mkdir -p "$out"
pictures=0
different=0

# judge NAME: of the two files of that name.
judge() {
    if [ "${ZTEST:-0}" = 0 ]; then
        "$same" "$out/old.exr" "$out/new.exr"
    else
        "$new" compare "$out/old.exr" "$out/new.exr" --json "$out/z.json" >"$out/z.txt" && ! grep -q differs "$out/z.txt"
    fi
}

# compare NAME SCENE OPTION...
compare() {
    name=$1
    scene=$2
    shift 2
    case $name in
    ${ONLY:-*}) ;;
    *) return ;;
    esac
    pictures=$((pictures + 1))
    seed=1
    for which in old new; do
        program=$old
        if [ $which = new ]; then program=$new; fi
        # Another seed, or else pictures would be compared that share their noise.
        if [ "${ZTEST:-0}" != 0 ] && [ $which = new ]; then seed=2; fi
        if ! "$program" render "$scene" --quiet --seed $seed --aov all -o "$out/$which.exr" --size 160x96 "$@" </dev/null >"$out/$which.txt" 2>&1; then
            echo "$name: $which: $(tail -n 1 "$out/$which.txt")"
            if [ $which = old ]; then return; fi
            different=$((different + 1))
            return
        fi
    done
    if ! verdict=$(judge); then
        different=$((different + 1))
        echo "$name: differs: $verdict"
        mkdir -p "$out/differ"
        cp "$out/old.exr" "$out/differ/$name.old.exr"
        cp "$out/new.exr" "$out/differ/$name.new.exr"
    fi
}

spp=${SPP:-4}
if [ "${ZTEST:-0}" != 0 ]; then spp=${SPP:-64}; fi
for scene in gallery cornell furnace terrain spheres meadow lamps empty; do
    compare "$scene" $scene --spp "$spp"
    compare "$scene-queues" $scene --spp "$spp" --queues=on
done
for option in "--direct area" "--direct hemisphere" "--mis balance" "--lights power" "--lights uniform" "--sampler blue" "--sampler random" \
    "--environment-sampling alias" "--environment-sampling rejection" "--clamp 20" "--regularise" "--adaptive" "--all-effects" "--roulette 1" "--sun-angle 3"; do
    for scene in gallery lamps; do
        # shellcheck disable=SC2086 # an option and its value
        compare "$scene$(echo "$option" | tr ' ' '=')" $scene --spp "$spp" $option
    done
done
compare meadow-flat meadow --spp "$spp" --flatten-instances
if [ -n "$models" ]; then
    for file in $(find "$models" \( -name '*.gltf' -o -name '*.glb' \) | sort); do
        compare "$(basename "$file")" "$file" --spp "$spp"
        compare "$(basename "$file")-queues" "$file" --spp "$spp" --queues=on
    done
fi
echo "$pictures pictures, $different differ"
[ $different = 0 ]
