# A method folder added to methods/ is listed and runs in a suite without any other edit, and so is the file of a particle
# part. Deleting them leaves no trace. The same holds for one of our methods, WITHOUT: everything else builds, lists and runs.
#
# The folder, the suite and the part are the examples of methods/README.md, which are thereby tested. The test works in a copy
# of the tree below WORK and keeps it for the next run, which compiles only changed files; the first run uses the compiler
# cache.
#
#   cmake -DSOURCE=tree -DWORK=folder [-DWITHOUT=grid_fluid] [-DDUSTBENCH_WERROR=ON …] -P add_a_method.cmake
cmake_minimum_required(VERSION 3.25)

if(NOT WITHOUT)
  set(WITHOUT grid_fluid)
endif()
if(NOT EXISTS ${SOURCE}/methods/${WITHOUT} OR WITHOUT MATCHES "^(contract|kit|null_method|README.md)$")
  message(FATAL_ERROR "WITHOUT: got '${WITHOUT}', expected a method's folder in methods/ other than null_method")
endif()

# The options of the build that runs this test: with others, the compiler cache would know none of the copy's files.
set(OPTIONS "")
foreach(OPTION DUSTBENCH_ARCH DUSTBENCH_WERROR CMAKE_CXX_COMPILER CMAKE_C_COMPILER)
  if(DEFINED ${OPTION})
    list(APPEND OPTIONS -D${OPTION}=${${OPTION}})
  endif()
endforeach()

set(TREE ${WORK}/tree)
set(BUILD ${TREE}/build/release) # at the same depth as the real build folder, so that the compiler cache finds the files
set(PROGRAM ${BUILD}/dustbench)
set(ENV{CCACHE_BASEDIR} ${TREE})
set(ENV{DUSTBENCH_DATA} "") # the copy's own data folder

function(must_run RESULT)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE STATUS OUTPUT_VARIABLE OUT ERROR_VARIABLE ERROR)
  if(NOT STATUS EQUAL 0)
    list(JOIN ARGN " " COMMAND_LINE)
    message(FATAL_ERROR "${COMMAND_LINE}\nended with ${STATUS}\n${OUT}\n${ERROR}")
  endif()
  set(${RESULT} "${OUT}" PARENT_SCOPE)
endfunction()

# Writes the fenced block of methods/README.md that follows the line beginning with `FILE` to that file of the copy.
function(write_from_page FILE)
  file(READ ${SOURCE}/methods/README.md PAGE)
  string(FIND "${PAGE}" "\n`${FILE}`" START)
  if(START EQUAL -1)
    message(FATAL_ERROR "methods/README.md: no line begins with `${FILE}`")
  endif()
  string(SUBSTRING "${PAGE}" ${START} -1 PAGE)
  string(FIND "${PAGE}" "\n```" START)
  math(EXPR START "${START} + 4")
  string(SUBSTRING "${PAGE}" ${START} -1 PAGE)
  string(FIND "${PAGE}" "\n" START)
  math(EXPR START "${START} + 1")
  string(FIND "${PAGE}" "\n```" END)
  math(EXPR LENGTH "${END} - ${START} + 1")
  string(SUBSTRING "${PAGE}" ${START} ${LENGTH} TEXT)
  file(WRITE ${TREE}/${FILE} "${TEXT}")
endfunction()

function(ids_of WHAT RESULT)
  must_run(JSON ${PROGRAM} list ${WHAT} --json)
  string(JSON COUNT LENGTH "${JSON}")
  set(IDS "")
  if(COUNT GREATER 0)
    math(EXPR LAST "${COUNT} - 1")
    foreach(I RANGE ${LAST})
      string(JSON ID GET "${JSON}" ${I} id)
      list(APPEND IDS ${ID})
    endforeach()
  endif()
  set(${RESULT} "${IDS}" PARENT_SCOPE)
endfunction()

function(build_copy)
  must_run(IGNORED ${CMAKE_COMMAND} --build ${BUILD} --target dustbench)
endfunction()

# A fresh copy of the sources with their modification times. Keeps the build folder in it.
set(PARTS CMakeLists.txt CMakePresets.json methods bench data reports tests)
foreach(PART ${PARTS})
  file(REMOVE_RECURSE ${TREE}/${PART})
endforeach()
foreach(PART ${PARTS})
  file(COPY ${SOURCE}/${PART} DESTINATION ${TREE} REGEX "/reports/out(/|$)" EXCLUDE)
endforeach()
if(EXISTS ${TREE}/methods/dots)
  message(FATAL_ERROR "methods/dots already exists: the example of methods/README.md needs a new name")
endif()

write_from_page(methods/dots/dots.cpp)
write_from_page(data/suites/dots.toml)
write_from_page(methods/kit/particles/parts/force/updraught.cpp)
must_run(IGNORED ${CMAKE_COMMAND} -S ${TREE} --preset release ${OPTIONS})
build_copy()

ids_of(methods WITH)
if(NOT "dots" IN_LIST WITH)
  message(FATAL_ERROR "'dots' is not among the listed methods: ${WITH}")
endif()
ids_of(parts PARTS_WITH)
if(NOT "force/updraught" IN_LIST PARTS_WITH)
  message(FATAL_ERROR "'force/updraught' is not among the listed parts: ${PARTS_WITH}")
endif()

file(REMOVE_RECURSE ${WORK}/results ${WORK}/left)
must_run(IGNORED ${PROGRAM} suite dots --out ${WORK}/results)
file(STRINGS ${WORK}/results/summary.csv ROWS)
list(LENGTH ROWS COUNT)
list(GET ROWS -1 ROW)
if(NOT COUNT EQUAL 3 OR NOT ROW MATCHES ",done,.*dots,")
  list(JOIN ROWS "\n" ROWS)
  message(FATAL_ERROR "expected two finished runs of 'dots' in the suite, got:\n${ROWS}")
endif()

file(REMOVE_RECURSE ${TREE}/methods/dots ${TREE}/methods/${WITHOUT})
file(REMOVE ${TREE}/data/suites/dots.toml ${TREE}/methods/kit/particles/parts/force/updraught.cpp)
build_copy()
ids_of(parts PARTS_LEFT)
list(REMOVE_ITEM PARTS_WITH force/updraught)
if(NOT "${PARTS_LEFT}" STREQUAL "${PARTS_WITH}")
  message(FATAL_ERROR "after deleting the file, expected the parts '${PARTS_WITH}', got '${PARTS_LEFT}'")
endif()
ids_of(methods METHODS_LEFT)
list(REMOVE_ITEM WITH dots ${WITHOUT})
if(NOT "${METHODS_LEFT}" STREQUAL "${WITH}")
  message(FATAL_ERROR "after deleting the folders, expected the methods '${WITH}', got '${METHODS_LEFT}'")
endif()
must_run(IGNORED ${PROGRAM} list)
must_run(IGNORED ${PROGRAM} run --method null_method --frames 2 --size 64x48 -P preroll=0 --out ${WORK}/left)
execute_process(COMMAND ${PROGRAM} run --method dots --frames 1 --out ${WORK}/gone
  RESULT_VARIABLE STATUS OUTPUT_QUIET ERROR_QUIET)
if(NOT STATUS EQUAL 3)
  message(FATAL_ERROR "expected exit code 3 (bad input) for a deleted method, got ${STATUS}")
endif()
