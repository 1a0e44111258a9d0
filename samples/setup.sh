# Read by demo.sh and tests/run.sh with `.`, from the project's root. Debian 12, Ubuntu 24.04 and newer.
build_packages="g++ cmake ninja-build pkg-config glslang-tools libvulkan-dev mesa-vulkan-drivers libspirv-cross-c-shared-dev
    libglm-dev libfmt-dev libtinygltf-dev libmeshoptimizer-dev libstb-dev nlohmann-json3-dev libopenexr-dev libglfw3-dev libcli11-dev libtbb-dev"
test_packages="libgtest-dev vulkan-validationlayers libembree-dev"
build=build/release

# install_missing PACKAGE...: installs what dpkg does not have, and says what.
install_missing() {
    if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
        echo "No apt on this machine: what is needed is expected to be there: $*"
        return
    fi
    present=$(dpkg-query -W -f '${Package} ${db:Status-Status}\n' "$@" 2>/dev/null || true)
    missing=
    for package in "$@"; do
        case "
$present
" in
        *"
$package installed
"*) ;;
        *) missing="$missing $package" ;;
        esac
    done
    if [ -z "$missing" ]; then return; fi
    echo "Installing:$missing"
    if [ "$(id -u)" = 0 ]; then
        as_root=
    elif command -v sudo >/dev/null; then
        as_root=sudo
    else
        echo "Neither root nor sudo: please install these packages as root and run this again." >&2
        exit 1
    fi
    $as_root apt-get update -q
    # shellcheck disable=SC2086 # a list of words
    $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends $missing
}

# configure [OPTION...]: the release build with these options; with none, only when there is no build yet.
configure() {
    if [ -e $build/build.ninja ] && [ $# = 0 ]; then return; fi
    if [ -e $build/build.ninja ]; then
        cmake "$@" $build >$build/configure.log || { cat $build/configure.log; return 1; }
        return
    fi
    # Warnings are errors with the compiler that the project is kept clean with; a newer one may know new warnings.
    case $(c++ -dumpversion) in
    12 | 12.*) strict=ON ;;
    *) strict=OFF ;;
    esac
    set -- "$@" -DLICHT_WARNINGS_AS_ERRORS=$strict
    if command -v ccache >/dev/null; then set -- "$@" -DCMAKE_C_COMPILER_LAUNCHER=ccache -DCMAKE_CXX_COMPILER_LAUNCHER=ccache; fi
    cmake --preset release "$@"
}

# build_all [TARGET...]
build_all() {
    for target in "$@"; do set -- "$@" --target "$target"; shift; done
    cmake --build $build --parallel "$(nproc)" "$@"
}
