# cmake -DPROGRAM=doxygen -DFILE=Doxyfile -P RunDoxygen.cmake: makes the reference, and fails if doxygen warns of anything but
# fields without a comment: a field may speak for itself by its name, a type or a function may not.
execute_process(COMMAND "${PROGRAM}" "${FILE}" OUTPUT_QUIET ERROR_VARIABLE said RESULT_VARIABLE status)
string(REGEX REPLACE "[^\n]*warning: Member [^\n]* \\(variable\\) of [^\n]* is not documented\\.\n" "" said "${said}")
if(status OR NOT said STREQUAL "")
  message(FATAL_ERROR "doxygen (status ${status}):\n${said}")
endif()
