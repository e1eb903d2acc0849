# SPDX-License-Identifier: BSD-3-Clause
# rhmap_embed(<target> <namespace> <name> <file>...): each file becomes part of the target, and its bytes the value of
# std::string_view <namespace>::<name>(), declared in embedded.hpp. Names and files come in pairs.
function(rhmap_embed target namespace)
  set(dir ${CMAKE_CURRENT_BINARY_DIR}/embedded)
  set(declarations "")
  set(definitions "")
  set(files "")
  set(pairs ${ARGN})
  while(pairs)
    list(POP_FRONT pairs name file)
    set(symbol ${target}_embedded_${name})
    string(APPEND declarations "std::string_view ${name}();\n")
    # The assembler copies the bytes: quick for megabytes, where a table of numbers would take the compiler long.
    string(APPEND definitions "
__asm__(
    \".section .rodata\\n\"
    \".global ${symbol}\\n.hidden ${symbol}\\n\"
    \".global ${symbol}_end\\n.hidden ${symbol}_end\\n\"
    \"${symbol}: .incbin \\\"${file}\\\"\\n\"
    \"${symbol}_end: .byte 0\\n\"
    \".previous\\n\");
extern \"C\" __attribute__((visibility(\"hidden\"))) const char ${symbol}[];
extern \"C\" __attribute__((visibility(\"hidden\"))) const char ${symbol}_end[];
namespace ${namespace} {
std::string_view ${name}() { return {${symbol}, static_cast<std::size_t>(${symbol}_end - ${symbol})}; }
}  // namespace ${namespace}
")
    list(APPEND files ${file})
  endwhile()
  file(CONFIGURE OUTPUT ${dir}/embedded.hpp @ONLY CONTENT
       "#pragma once\n#include <string_view>\nnamespace ${namespace} {\n${declarations}}  // namespace ${namespace}\n")
  file(CONFIGURE OUTPUT ${dir}/embedded.cpp @ONLY CONTENT
       "#include \"embedded.hpp\"\n#include <cstddef>\n${definitions}")
  set_source_files_properties(${dir}/embedded.cpp PROPERTIES OBJECT_DEPENDS "${files}")
  target_sources(${target} PRIVATE ${dir}/embedded.cpp)
  target_include_directories(${target} PRIVATE ${dir})
endfunction()
