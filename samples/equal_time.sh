#!/bin/sh
# What one option's values give in the same time: the error of each against a long reference.
#   sh samples/equal_time.sh SCENE SECONDS OPTION VALUE [VALUE ...]
#   sh samples/equal_time.sh lamps 20 --lights tree power uniform
# The values on and off stand for a flag that is given or left out. From the environment:
#   LICHT      the program                      (default: the release build's)
#   REFERENCE  an .exr to compare with          (default: rendered here, for 20 times as long as each picture)
#   SIZE       of the pictures                  (default: 320x180)
#   RUNS       seeds a value, the median counts (default: 3)
#   MORE       options for every picture, as in MORE='--triangles 10000 --bounces 4'
#   OUT        where the pictures stay          (default: out/equal_time)
set -eu
if [ $# -lt 4 ]; then
    sed -n '2,/^set/s/^# \{0,1\}//p' "$0" >&2
    exit 2
fi
root=$(dirname "$0")/..
. "$root/samples/setup.sh"
licht=${LICHT:-$root/$build/samples/licht/licht}
if [ ! -x "$licht" ]; then
    echo "$licht is not there: build it with samples/demo.sh, or name it with LICHT=PATH" >&2
    exit 2
fi
runs=${RUNS:-3}
out=${OUT:-out/equal_time}
scene=$1
seconds=$2
option=$3
shift 3
mkdir -p "$out"

# render FILE [OPTION...]
render() {
    file=$1
    shift
    # shellcheck disable=SC2086 # a list of words
    "$licht" render "$scene" --size "${SIZE:-320x180}" -o "$file" --aov variance ${MORE:-} "$@" </dev/null
}

reference=${REFERENCE:-}
if [ -z "$reference" ]; then
    reference=$out/reference.exr
    echo "reference:"
    # A seed that no run has.
    render "$reference" --seed 4294967295 --time "$(LC_ALL=C awk -v s="$seconds" 'BEGIN { print 20 * s }')"
fi

# Value after value in each run, so that a machine that becomes busy disturbs all alike.
run=1
while [ "$run" -le "$runs" ]; do
    number=1
    for value in "$@"; do
        echo "$option $value, run $run of $runs:"
        name=$option
        word=$value
        case $value in
        on) word= ;;
        off) name= word= ;;
        esac
        render "$out/$number-$run.exr" --seed "$run" --time "$seconds" ${name:+"$name"} ${word:+"$word"}
        number=$((number + 1))
    done
    run=$((run + 1))
done

# The pictures' names in the order of the values.
table=$out/equal_time.json
values=$*
number=$#
set --
while [ "$number" -ge 1 ]; do
    run=$runs
    while [ "$run" -ge 1 ]; do
        set -- "$out/$number-$run.exr" "$@"
        run=$((run - 1))
    done
    number=$((number - 1))
done
echo
"$licht" compare "$reference" "$@" --json "$table"
echo
LC_ALL=C awk -v runs="$runs" -v option="$option" -v values="$values" '
    function median(list, first, i, j, swap) {
        for (i = first + 1; i < first + runs; ++i)
            for (j = i; j > first && list[j - 1] > list[j]; --j) { swap = list[j]; list[j] = list[j - 1]; list[j - 1] = swap }
        return (list[first + int((runs - 1) / 2)] + list[first + int(runs / 2)]) / 2
    }
    function ratio(a, b) { return b ? sprintf("%.2f", a / b) : "-" }
    /"pictures"/ { listed = 1 }
    listed && /"(samples|rel_mse|trimmed_rel_mse)":/ {
        key = $1
        gsub(/[":]/, "", key)
        sub(/,$/, "", $2)
        if (key == "samples") { samples[count++] = $2 + 0 }
        if (key == "rel_mse") { error[count - 1] = $2 + 0 }
        if (key == "trimmed_rel_mse") { trimmed[count - 1] = $2 + 0 }
    }
    END {
        printf "medians of %d runs; a ratio is the first value'"'"'s error over this one'"'"'s\n", runs
        printf "%9s%11s%8s%11s%8s  %s\n", "samples", "relMSE", "ratio", "trimmed", "ratio", option
        named = split(values, name, " ")
        for (i = 0; i < named; ++i) {
            e = median(error, i * runs)
            t = median(trimmed, i * runs)
            if (i == 0) { first_e = e; first_t = t }
            printf "%9d%11.4g%8s%11.4g%8s  %s\n", median(samples, i * runs), e, ratio(first_e, e), t, ratio(first_t, t), name[i + 1]
        }
    }' "$table"
