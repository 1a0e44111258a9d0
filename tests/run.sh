#!/bin/sh
# Builds everything and runs all tests: sh tests/run.sh [options of ctest]
set -eu
cd "$(dirname "$0")/.."
. samples/setup.sh

# shellcheck disable=SC2086 # lists of words
install_missing $build_packages $test_packages
configure -DLICHT_BUILD_TESTS=ON
build_all
exec ctest --preset release --output-on-failure -j2 "$@"
