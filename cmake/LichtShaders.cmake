# Shaders are compiled by glslang while building and embedded as arrays of words.

find_program(LICHT_GLSLANG NAMES glslangValidator glslang REQUIRED)

# licht_shaders(TARGET FILE...): compiles each FILE of this folder (its ending names the stage) and gives TARGET the header
# "licht/spirv/<file with dots as underscores>.h", which holds `const uint32_t <same name>[]`.
function(licht_shaders target)
  set(root ${CMAKE_CURRENT_BINARY_DIR}/spirv_${target})
  set(folder ${root}/licht/spirv)
  file(MAKE_DIRECTORY ${folder})
  set(headers)
  foreach(source IN LISTS ARGN)
    get_filename_component(file ${source} NAME)
    string(REPLACE "." "_" symbol ${file})
    set(header ${folder}/${symbol}.h)
    add_custom_command(
      OUTPUT ${header}
      COMMAND ${LICHT_GLSLANG} --quiet -V --target-env vulkan1.3 -I${PROJECT_SOURCE_DIR}/shaders
              --depfile ${header}.d --vn ${symbol} -o ${header} ${CMAKE_CURRENT_SOURCE_DIR}/${source}
      DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${source}
      DEPFILE ${header}.d
      COMMENT "Compiling ${source}"
      VERBATIM)
    list(APPEND headers ${header})
  endforeach()
  add_custom_target(${target}_spirv DEPENDS ${headers})
  add_dependencies(${target} ${target}_spirv)
  target_include_directories(${target} PRIVATE ${root})
endfunction()
