# Writes commit.c, which holds the name of the commit that is built. Run with every build by bench/CMakeLists.txt:
#   cmake -D source=FOLDER -D output=FILE -P commit.cmake
# Results of benchmarks are not what is measured: changes to them do not count as changes.
find_package(Git QUIET)
set(commit "unknown")
if(GIT_EXECUTABLE)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${source} rev-parse --short=12 HEAD
    OUTPUT_VARIABLE hash OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed ERROR_QUIET)
  if(NOT failed)
    set(commit ${hash})
    execute_process(COMMAND ${GIT_EXECUTABLE} -C ${source} diff --quiet HEAD -- . ":(exclude)bench/results"
      RESULT_VARIABLE changed ERROR_QUIET)
    if(changed)
      string(APPEND commit "+changes")
    endif()
  endif()
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/commit.c.in ${output} @ONLY)
