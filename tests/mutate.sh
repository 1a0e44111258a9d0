#!/bin/sh
# Puts the faults of tests/mutants.txt into the code, one at a time, and says which test notices:
#   sh tests/mutate.sh            all of them (an hour or two)
#   sh tests/mutate.sh WORD...    those whose line has one of the words
# They go into a copy under build/mutants, which keeps its build. Exit code 1: a fault does not apply, build or come to an end, or less than 95 % were noticed.
set -eu
cd "$(dirname "$0")/.."
root=$PWD
work=${MUTANTS:-$root/build/mutants}
jobs=$(nproc)
limit=600 # seconds for one test program
late="not done after $limit s" # which a busy machine does as well: no fault that was noticed
mkdir -p "$work/source"

# The working tree as it is, only what changed, so that little is built anew.
git ls-files -co --exclude-standard | sort >"$work/files"
while IFS= read -r file; do
    [ -e "$file" ] || continue
    mkdir -p "$work/source/$(dirname "$file")"
    cmp -s "$file" "$work/source/$file" || cp -p "$file" "$work/source/$file"
done <"$work/files"
cd "$work/source"
find . -path ./build -prune -o -type f -print | sed 's|^\./||' | sort | comm -23 - "$work/files" | while IFS= read -r file; do rm "$file"; done
launcher=
if command -v ccache >/dev/null; then
    launcher="-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"
    export CCACHE_BASEDIR="$PWD" CCACHE_NOHASHDIR=1 # what another folder of the same tree has compiled is found
fi
# shellcheck disable=SC2086 # nothing or one word
cmake -S . -B build/release -G Ninja -DCMAKE_BUILD_TYPE=Release -DLICHT_BUILD_TESTS=ON $launcher >"$work/configure.log"

list=$work/list
grep -v '^#\|^$' tests/mutants.txt >"$work/all"
if [ $# -gt 0 ]; then
    pattern=$(printf '%s\n' "$@")
    grep -F -e "$pattern" "$work/all" >"$list" || { echo "no fault has such a word" >&2; exit 2; }
else
    cp "$work/all" "$list"
fi

field() { printf '%s\n' "$1" | awk -F ' \\|\\| ' -v n="$2" '{ print $n }'; }

# build TEST[:FILTER]...
build() {
    targets=
    for test in "$@"; do targets="$targets ${test%%:*}"; done
    # shellcheck disable=SC2086 # a list of words
    cmake --build build/release --parallel "$jobs" --target $targets >"$work/build.log" 2>&1
}

# killer TEST[:FILTER]...: prints the first test that fails; nothing when all pass.
killer() {
    for test in "$@"; do
        filter=*
        case $test in *:*) filter=${test#*:} ;; esac
        program=$(find build/release/tests -name "${test%%:*}" -type f -perm -u+x)
        rc=0
        (cd "$(dirname "$program")" && timeout $limit "./$(basename "$program")" --gtest_filter="$filter" --gtest_fail_fast) >"$work/test.log" 2>&1 || rc=$?
        [ $rc != 0 ] || continue
        if [ $rc = 124 ]; then echo "${test%%:*}: $late"; return; fi
        name=$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*/\1/p' "$work/test.log" | head -n 1)
        echo "${test%%:*}: ${name:-ended without a word}"
        return
    done
}

# Tests that fail by themselves say nothing of faults.
# shellcheck disable=SC2046 # a list of words
set -- $(awk -F ' \\|\\| ' '{ print $3 }' "$list" | tr ' ' '\n' | sort -u)
echo "building what $# tests need"
build "$@" || { tail -n 20 "$work/build.log"; exit 1; }
failing=$(killer "$@")
if [ -n "$failing" ]; then echo "fails without any fault: $failing" >&2; exit 1; fi

died=0; survived=0; broken=0
while IFS= read -r line; do
    file=$(field "$line" 1); edit=$(field "$line" 2); tests=$(field "$line" 3); words=$(field "$line" 4)
    cp "$file" "$work/whole"
    sed -E -i "$edit" "$file"
    changed=$(diff "$work/whole" "$file" | grep -c '^>' || true)
    start=$(date +%s)
    # shellcheck disable=SC2086 # a list of words
    if [ "$changed" != 1 ]; then
        broken=$((broken + 1)); says="BROKEN    changes $changed lines"
    elif ! build $tests; then
        broken=$((broken + 1)); says="BROKEN    does not build"
    else
        by=$(killer $tests)
        case $by in
            '') survived=$((survived + 1)); says="SURVIVED  $tests" ;;
            *"$late"*) broken=$((broken + 1)); says="BROKEN    $by" ;;
            *) died=$((died + 1)); says="died      $by" ;;
        esac
    fi
    cp "$work/whole" "$file"
    echo "$(($(date +%s) - start)) s  $file: $words: $says"
done <"$list"
echo "$died died, $survived survived, $broken broken"
[ $broken = 0 ] && [ $((100 * died)) -ge $((95 * (died + survived))) ]
