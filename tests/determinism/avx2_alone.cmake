# OBJECT, the one file that is compiled for AVX2, offers others nothing but what has its lanes in its name: a function that another
# file has, too, might be linked from here into both, and end the program on a machine without AVX2.
execute_process(COMMAND ${NM} -C --defined-only --extern-only ${OBJECT}
  OUTPUT_VARIABLE symbols ERROR_VARIABLE said RESULT_VARIABLE code)
if(NOT code EQUAL 0 OR NOT symbols MATCHES "pairsInEight")
  message(FATAL_ERROR "${NM} ${OBJECT} ended with ${code}\n${said}${symbols}")
endif()
string(REGEX REPLACE "[^\n]*Eight[^\n]*\n" "" others "${symbols}")
if(NOT others STREQUAL "")
  message(FATAL_ERROR "compiled for AVX2, and anyone's:\n${others}")
endif()
