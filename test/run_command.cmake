# SPDX-License-Identifier: BSD-3-Clause
# run(<command> <argument>...): runs it; if that fails, it ends the script with the command and all that it printed.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT status EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nfailed (${status}):\n${text}")
  endif()
endfunction()
