# SPDX-License-Identifier: BSD-3-Clause
# The objects of the compat world name no class of stock OctoMap that it has a class of its own for, or a program that
# holds both worlds would mix them silently. STOCK is an object of the stock world: the search must find it there.
set(classes "AbstractOcTree|AbstractOccupancyOcTree|ColorOcTree(Node)?|CountingOcTree(Node)?|MapCollection|MapNode|OcTree|\
OcTreeBase|OcTreeBaseImpl|OcTreeDataNode|OcTreeNode|OcTreeNodeStamped|OcTreeStamped|OccupancyOcTreeBase")

function(stock_symbols object result)
  execute_process(COMMAND ${NM} --demangle ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]*octomap::(${classes})[^A-Za-z\n][^\n]*" found "${symbols}")
  set(${result} "${found}" PARENT_SCOPE)
endfunction()

stock_symbols(${STOCK} found)
if(NOT found)
  message(FATAL_ERROR "found no tree in ${STOCK}, which has them")
endif()
foreach(object IN LISTS COMPAT)
  stock_symbols(${object} found)
  if(found)
    list(JOIN found "\n" found)
    message(FATAL_ERROR "${object} names classes of stock OctoMap:\n${found}")
  endif()
endforeach()
