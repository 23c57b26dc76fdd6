# Included by ctest: the suites of PROGRAM, each one test. To start a program takes longer than most of its tests (it
# loads the 300 libraries that MRPT needs), so tests are not started one by one.
# Expects: PROGRAM, a program of GoogleTest; LIST, the file that keeps what it lists; TIMEOUT (s).
if(NOT EXISTS "${PROGRAM}")
  get_filename_component(name "${PROGRAM}" NAME)
  add_test(${name}_NOT_BUILT ${name}_NOT_BUILT)
  return()
endif()
if("${PROGRAM}" IS_NEWER_THAN "${LIST}")
  execute_process(COMMAND "${PROGRAM}" --gtest_list_tests OUTPUT_FILE "${LIST}.part" TIMEOUT 60 RESULT_VARIABLE failed)
  if(failed)
    message(FATAL_ERROR "${PROGRAM} does not list its tests: ${failed}")
  endif()
  file(RENAME "${LIST}.part" "${LIST}")
endif()
file(STRINGS "${LIST}" lines REGEX "^[^ ]+\\.|^  ")
set(suites)
foreach(line IN LISTS lines)
  if(line MATCHES "^  ")
    math(EXPR tests_${suite} "${tests_${suite}} + 1")
  else()
    string(REGEX REPLACE "\\..*" "" suite "${line}")
    list(APPEND suites ${suite})
    set(tests_${suite} 0)
  endif()
endforeach()
foreach(suite IN LISTS suites)
  add_test(${suite} "${PROGRAM}" --gtest_filter=${suite}.*)
  # Those with the most tests start first. A suite counts as skipped if a test was skipped and none failed: failures
  # would be listed last.
  set_tests_properties(${suite} PROPERTIES TIMEOUT ${TIMEOUT} COST ${tests_${suite}}
    SKIP_REGULAR_EXPRESSION "\n\\[  SKIPPED \\] [^ \n]+\n*$" FAIL_REGULAR_EXPRESSION "\\[==========\\] Running 0 tests")
endforeach()
