# dustbench_add_method(ID [FOLDER folder] [LINK targets…] [TEST_LINK targets…])
#
# Builds a folder (default: the current one), laid out as in dustbench's own methods/, as the library ID.dustmethod.so:
#   *.cpp                          the method: `MethodInfo describe()` in namespace dustbench::ID; optional with parts
#   parts/KIND/NAME.cpp            parts of particle systems: `PartInfo describe()` in namespace dustbench::particles::parts::KIND::NAME
#   *_test.cpp                     tests, including those below parts/: one program `ID_tests`, run by ctest
#   *_bench.cpp                    benchmarks, likewise: one program `ID_bench`
#   *.vert *.frag *.comp *.glsl    shaders, as constants in "ID_shaders.h"
# dustbench finds the library in the folders of --method-path or DUSTBENCH_METHOD_PATH.
set(DUSTBENCH_PACKAGE_FOLDER ${CMAKE_CURRENT_LIST_DIR})

# Writes the source of the library's entry; PARTS_FOLDER contains KIND/NAME.cpp for each part.
function(dustbench_write_entry ID ENTRY HAS_METHOD PARTS_FOLDER)
  set(DECLARATIONS "")
  set(METHOD "")
  set(PARTS "")
  set(DESCRIBE nullptr)
  set(DESCRIBE_PARTS nullptr)
  if(HAS_METHOD)
    set(DECLARATIONS "namespace dustbench::${ID} {\nMethodInfo describe();\n}\n")
    set(METHOD "    *static_cast<dustbench::MethodInfo*>(info) = dustbench::${ID}::describe();\n")
    set(DESCRIBE describe)
  endif()
  foreach(FILE ${ARGN})
    file(RELATIVE_PATH FILE ${PARTS_FOLDER} ${FILE})
    if(NOT FILE MATCHES "^([a-z]+)/([a-z][a-z0-9_]*)\\.cpp$")
      message(FATAL_ERROR "parts/${FILE}: expected a file KIND/NAME.cpp, named with lower-case letters, digits and '_'")
    endif()
    set(SPACE dustbench::particles::parts::${CMAKE_MATCH_1}::${CMAKE_MATCH_2})
    string(APPEND DECLARATIONS "namespace ${SPACE} {\nPartInfo describe();\n}\n")
    string(APPEND PARTS "    add(PartKind::${CMAKE_MATCH_1}, \"${CMAKE_MATCH_2}\", ${SPACE}::describe());\n")
    set(DESCRIBE_PARTS describeParts)
  endforeach()
  configure_file(${DUSTBENCH_PACKAGE_FOLDER}/method_entry.cpp.in ${ENTRY} @ONLY)
endfunction()

function(dustbench_add_method ID)
  cmake_parse_arguments(ARG "" "FOLDER" "LINK;TEST_LINK" ${ARGN})
  if(NOT ID MATCHES "^[a-z][a-z0-9_]*$" OR ID MATCHES "_(test|bench)$")
    message(FATAL_ERROR "dustbench_add_method: got '${ID}', expected lower-case letters, digits and '_', not ending in '_test' or '_bench'")
  endif()
  if(NOT ARG_FOLDER)
    set(ARG_FOLDER .)
  endif()
  get_filename_component(FOLDER ${ARG_FOLDER} ABSOLUTE)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${FOLDER}/*.cpp)
  file(GLOB PARTS CONFIGURE_DEPENDS ${FOLDER}/parts/*.cpp ${FOLDER}/parts/*/*.cpp)
  file(GLOB SHADERS CONFIGURE_DEPENDS ${FOLDER}/*.vert ${FOLDER}/*.frag ${FOLDER}/*.comp ${FOLDER}/*.glsl)
  set(TESTS ${SOURCES} ${PARTS})
  list(FILTER TESTS INCLUDE REGEX "_test\\.cpp$")
  set(BENCHES ${SOURCES} ${PARTS})
  list(FILTER BENCHES INCLUDE REGEX "_bench\\.cpp$")
  list(FILTER SOURCES EXCLUDE REGEX "_(test|bench)\\.cpp$")
  list(FILTER PARTS EXCLUDE REGEX "_(test|bench)\\.cpp$")
  if(NOT SOURCES AND NOT PARTS)
    message(FATAL_ERROR "dustbench_add_method(${ID}): no sources in '${FOLDER}'")
  endif()
  set(HAS_METHOD OFF)
  if(SOURCES)
    set(HAS_METHOD ON)
  endif()

  # The entry is one of the objects, so that its fingerprint covers the flags of all.
  set(ENTRY ${CMAKE_CURRENT_BINARY_DIR}/${ID}/${ID}_entry.cpp)
  dustbench_write_entry(${ID} ${ENTRY} ${HAS_METHOD} ${FOLDER}/parts ${PARTS})
  set(OBJECTS ${ID}_objects)
  add_library(${OBJECTS} OBJECT ${SOURCES} ${PARTS} ${ENTRY})
  set_target_properties(${OBJECTS} PROPERTIES
    POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    CXX_STANDARD 20 CXX_EXTENSIONS OFF)
  target_include_directories(${OBJECTS} PUBLIC ${FOLDER})
  target_link_libraries(${OBJECTS} PUBLIC dustbench::kit ${ARG_LINK})
  if(PARTS) # as for dustbench's own parts; none of these flags changes a result
    set_source_files_properties(${PARTS} PROPERTIES
      COMPILE_OPTIONS "-fno-trapping-math;-mprefer-vector-width=512;-fno-tree-loop-distribute-patterns")
  endif()
  if(SHADERS)
    set(HEADER ${CMAKE_CURRENT_BINARY_DIR}/${ID}/${ID}_shaders.h)
    set(EMBED ${DUSTBENCH_PACKAGE_FOLDER}/embed_shaders.cmake)
    add_custom_command(OUTPUT ${HEADER}
      COMMAND ${CMAKE_COMMAND} -DMODULE=${ID} -DHEADER=${HEADER} "-DFILES=${SHADERS}" -P ${EMBED}
      DEPENDS ${SHADERS} ${EMBED} VERBATIM COMMENT "Embedding the shaders of ${ID}")
    target_sources(${OBJECTS} PRIVATE ${HEADER})
    target_include_directories(${OBJECTS} PUBLIC ${CMAKE_CURRENT_BINARY_DIR}/${ID})
  endif()

  set(LIBRARY ${ID}.dustmethod.so)
  add_library(${LIBRARY} MODULE)
  target_link_libraries(${LIBRARY} PRIVATE ${OBJECTS})
  target_link_options(${LIBRARY} PRIVATE -Wl,--no-undefined)
  set_target_properties(${LIBRARY} PROPERTIES PREFIX "" SUFFIX "" OUTPUT_NAME ${LIBRARY} LINKER_LANGUAGE CXX
    LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR})

  if(TESTS)
    find_package(GTest REQUIRED)
    include(GoogleTest)
    add_executable(${ID}_tests ${TESTS})
    set_target_properties(${ID}_tests PROPERTIES CXX_STANDARD 20 CXX_EXTENSIONS OFF)
    target_compile_options(${ID}_tests PRIVATE -fPIC) # otherwise it would contain copies of the kit's types
    target_link_libraries(${ID}_tests PRIVATE ${OBJECTS} ${ARG_TEST_LINK} GTest::gmock GTest::gtest_main)
    gtest_discover_tests(${ID}_tests TEST_PREFIX ${ID}. DISCOVERY_MODE PRE_TEST)
  endif()
  if(BENCHES)
    find_package(benchmark REQUIRED)
    add_executable(${ID}_bench ${BENCHES})
    set_target_properties(${ID}_bench PROPERTIES CXX_STANDARD 20 CXX_EXTENSIONS OFF)
    target_compile_options(${ID}_bench PRIVATE -fPIC)
    target_link_libraries(${ID}_bench PRIVATE ${OBJECTS} ${ARG_TEST_LINK} benchmark::benchmark_main)
  endif()
endfunction()
