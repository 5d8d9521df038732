# Files for `cmake --install` and `cpack`: the program and its libraries, the data and templates that it reads, the headers
# of contract and kit, the manual page and the shell completions.
set_target_properties(dustbench PROPERTIES INSTALL_RPATH "$ORIGIN/../lib/dustbench/kit")
install(TARGETS dustbench RUNTIME DESTINATION bin)
install(TARGETS dustbench_kit dustbench_openimageio dustbench_openvdb dustbench_vdb_reader
  RUNTIME DESTINATION lib/dustbench/kit LIBRARY DESTINATION lib/dustbench/kit)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/data/ DESTINATION share/dustbench)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/reports/page DESTINATION share/dustbench/reports)
install(FILES ${CMAKE_SOURCE_DIR}/reports/METRICS.md ${CMAKE_SOURCE_DIR}/reports/SCHEMA.md
  DESTINATION share/dustbench/reports)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/methods/contract ${CMAKE_SOURCE_DIR}/methods/kit
  DESTINATION include/dustbench/methods FILES_MATCHING PATTERN "*.h" PATTERN package EXCLUDE)
include(CMakePackageConfigHelpers)
set(PACKAGE ${CMAKE_SOURCE_DIR}/methods/kit/library/package)
set(DUSTBENCH_PACKAGE_DEFINITIONS "")
if(CMAKE_BUILD_TYPE MATCHES "Rel") # Release, RelWithDebInfo, MinSizeRel
  list(APPEND DUSTBENCH_PACKAGE_DEFINITIONS NDEBUG)
endif()
if(DUSTBENCH_CHECKED)
  list(APPEND DUSTBENCH_PACKAGE_DEFINITIONS DUSTBENCH_CHECKED)
endif()
configure_package_config_file(${PACKAGE}/dustbenchConfig.cmake.in ${CMAKE_BINARY_DIR}/package/dustbenchConfig.cmake
  INSTALL_DESTINATION lib/cmake/dustbench)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/dustbenchConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/package/dustbenchConfig.cmake ${CMAKE_BINARY_DIR}/package/dustbenchConfigVersion.cmake
  ${PACKAGE}/dustbench_add_method.cmake ${PACKAGE}/method_entry.cpp.in ${CMAKE_SOURCE_DIR}/methods/kit/gpu/embed_shaders.cmake
  DESTINATION lib/cmake/dustbench)
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION share/doc/dustbench RENAME copyright)
install(FILES ${CMAKE_SOURCE_DIR}/CITATION.cff ${CMAKE_SOURCE_DIR}/CHANGELOG.md ${CMAKE_SOURCE_DIR}/README.md
  DESTINATION share/doc/dustbench)
install(FILES ${CMAKE_SOURCE_DIR}/methods/README.md DESTINATION share/doc/dustbench/methods)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/reports/guide ${CMAKE_SOURCE_DIR}/reports/decisions
  DESTINATION share/doc/dustbench/reports)
install(CODE "set(PROGRAM \"$<TARGET_FILE:dustbench>\")")
install(SCRIPT ${CMAKE_CURRENT_LIST_DIR}/install_manual.cmake)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_VENDOR "The dustbench maintainers")
set(CPACK_PACKAGE_CONTACT "The dustbench maintainers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "compares and benchmarks methods for real-time volumetric effects")
set(CPACK_PACKAGE_DESCRIPTION "Measures methods for real-time dust, smoke, fire and other volumes in the same scene: frame times,
memory and image errors under one protocol. Includes reports, exported volumes and the experiments of papers.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_RUNTIME_OUTPUT_DIRECTORY})
# Libraries loaded and programs started at run time; ImGui's loader opens libGL.so.1.
set(CPACK_DEBIAN_PACKAGE_DEPENDS
  "libegl1, libegl-mesa0, libgl1, libgl1-mesa-dri, libopengl0, fonts-dejavu-core, libjs-vega, librsvg2-bin, nodejs")
# The packages from g++ on are for methods built outside this tree.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "ffmpeg, slurm-wlm, g++, cmake, libglm-dev, libfmt-dev, libtbb-dev, librandom123-dev")
include(CPack)
