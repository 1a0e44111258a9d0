# cmake --install: the program, the floors as licht::<name> with their headers, and a package for find_package(licht).
include(CMakePackageConfigHelpers)

# licht::licht: everything that renders, without the window.
get_property(floors GLOBAL PROPERTY LICHT_FLOORS)
set(offscreen ${floors})
list(REMOVE_ITEM offscreen licht_window)
add_library(licht_all INTERFACE)
add_library(licht::licht ALIAS licht_all)
set_target_properties(licht_all PROPERTIES EXPORT_NAME licht)
target_link_libraries(licht_all INTERFACE ${offscreen})

install(TARGETS ${floors} licht_all EXPORT licht ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
get_property(folders GLOBAL PROPERTY LICHT_FLOOR_FOLDERS)
foreach(folder IN LISTS folders ITEMS ${PROJECT_SOURCE_DIR}/shaders/shared)
  get_filename_component(name ${folder} NAME)
  install(DIRECTORY ${folder}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/licht/${name} FILES_MATCHING PATTERN "*.h")
endforeach()
if(TARGET licht)
  install(TARGETS licht RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/licht)
install(EXPORT licht NAMESPACE licht:: FILE lichtTargets.cmake DESTINATION ${package})
set(LICHT_OPTIONAL)
if(OpenImageDenoise_FOUND)
  set(LICHT_OPTIONAL OpenImageDenoise)
endif()
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/lichtConfig.cmake.in ${PROJECT_BINARY_DIR}/lichtConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lichtConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lichtConfig.cmake ${PROJECT_BINARY_DIR}/lichtConfigVersion.cmake DESTINATION ${package})
