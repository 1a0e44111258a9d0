# One library per engine folder. Each library sees only the headers of the libraries it links, because every folder is
# exposed through an include root of its own: an include that points up or sideways does not compile.

add_library(licht_warnings INTERFACE)
target_compile_options(licht_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -Wold-style-cast -Wnon-virtual-dtor
  -Woverloaded-virtual -Wnull-dereference -Wdouble-promotion -Wformat=2 -Wimplicit-fallthrough
  $<$<BOOL:${LICHT_WARNINGS_AS_ERRORS}>:-Werror>)
if(LICHT_SANITIZE)
  add_compile_options(-fsanitize=${LICHT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
  add_link_options(-fsanitize=${LICHT_SANITIZE})
endif()

# Half of what the compiler reads is the standard library, glm and fmt again and again: read once, they are shared by all floors. A
# compiler cache keeps no such files apart and does more, so with one (and with the tests, where each file has to stand on its own
# includes) they are left out.
set(LICHT_PRECOMPILED_DEFAULT ON)
if(CMAKE_CXX_COMPILER_LAUNCHER OR LICHT_BUILD_TESTS)
  set(LICHT_PRECOMPILED_DEFAULT OFF)
endif()
option(LICHT_PRECOMPILED_HEADERS "Read the standard library, glm and fmt once" ${LICHT_PRECOMPILED_DEFAULT})
add_compile_options(-pthread) # for all or for none: OpenEXR asks for it, and a precompiled header is read under its own options only

# licht_include_root(TARGET SCOPE NAME FOLDER): FOLDER's headers become <NAME/...> for TARGET and its users. The library's names are
# licht/FOLDER, which are those of engine/ (and of shaders/shared); the samples' are samples/FOLDER, as they lie there.
function(licht_include_root target scope name folder)
  set(root ${PROJECT_BINARY_DIR}/floors/${name})
  get_filename_component(parent ${root}/${name} DIRECTORY)
  file(MAKE_DIRECTORY ${parent})
  file(CREATE_LINK ${folder} ${root}/${name} SYMBOLIC)
  target_include_directories(${target} ${scope} $<BUILD_INTERFACE:${root}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
endfunction()

# licht_precompiled(TARGET): TARGET reads the shared headers from what licht_core, the lowest floor, has precompiled.
function(licht_precompiled target)
  if(NOT LICHT_PRECOMPILED_HEADERS)
    return()
  endif()
  if(target STREQUAL "licht_core")
    target_precompile_headers(licht_core PRIVATE
      <algorithm> <array> <bit> <cmath> <cstdint> <filesystem> <functional> <limits> <map> <memory> <numeric> <optional> <span> <string>
      <string_view> <utility> <vector> <fmt/format.h> <licht/core/math.h>)
  else()
    target_precompile_headers(${target} REUSE_FROM licht_core)
  endif()
endfunction()

# licht_floor(NAME LINKS ... PRIVATE_LINKS ... WITHOUT ...): every .cpp of this folder, but those after WITHOUT, becomes the library
# licht_NAME, alias licht::NAME.
function(licht_floor name)
  cmake_parse_arguments(arg "" "" "LINKS;PRIVATE_LINKS;WITHOUT" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  foreach(file IN LISTS arg_WITHOUT)
    list(REMOVE_ITEM sources ${CMAKE_CURRENT_SOURCE_DIR}/${file})
  endforeach()
  add_library(licht_${name} STATIC ${sources})
  add_library(licht::${name} ALIAS licht_${name})
  set_target_properties(licht_${name} PROPERTIES EXPORT_NAME ${name})
  licht_include_root(licht_${name} PUBLIC licht/${name} ${CMAKE_CURRENT_SOURCE_DIR})
  target_compile_features(licht_${name} PUBLIC cxx_std_20)
  target_link_libraries(licht_${name} PUBLIC ${arg_LINKS} PRIVATE ${arg_PRIVATE_LINKS} $<BUILD_INTERFACE:licht_warnings>)
  licht_precompiled(licht_${name})
  set_property(GLOBAL APPEND PROPERTY LICHT_FLOORS licht_${name})
  set_property(GLOBAL APPEND PROPERTY LICHT_FLOOR_FOLDERS ${CMAKE_CURRENT_SOURCE_DIR})
endfunction()
