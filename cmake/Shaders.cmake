# fur_add_shaders(TARGET <name> NAMESPACE <ns> HEADER <path in #include> SHADERS <spec>... [DEFINES <def>...] [INCLUDES <dir>...])
#
# A static library of compiled shaders, linked to rhi. Each spec is one entry point, compiled by fur_shaderc in a process
# of its own and again only when the file or one that it includes changes:
#
#   file.hlsl:Entry:vs|gs|ps|cs                        symbol <ns>::file_Entry
#   file.hlsl:Entry:ps:Suffix:DEF1,DEF2=3              symbol <ns>::file_EntrySuffix, with DEF1=1 and DEF2=3 defined
#
# The header declares every symbol: #include "fur_shaders/base.h", then shaders::base_VSMain (a const rhi::ShaderBlob).
# Files are relative to the current source directory; DEFINES hold for every shader of the library.
function(fur_add_shaders)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "TARGET;NAMESPACE;HEADER" "SHADERS;DEFINES;INCLUDES")
  if(NOT ARG_TARGET OR NOT ARG_NAMESPACE OR NOT ARG_HEADER OR NOT ARG_SHADERS OR ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "usage: fur_add_shaders(TARGET name NAMESPACE ns HEADER dir/file.h SHADERS spec... [DEFINES ...] [INCLUDES ...])")
  endif()
  set(root "${CMAKE_CURRENT_BINARY_DIR}/${ARG_TARGET}_generated")
  set(sources "")
  set(symbols "")
  foreach(spec IN LISTS ARG_SHADERS)
    _fur_add_shader("${spec}" "${root}" source symbol)
    if(symbol IN_LIST symbols)
      message(FATAL_ERROR "fur_add_shaders: two shaders are called ${symbol}; give one of them a suffix")
    endif()
    list(APPEND sources "${source}")
    list(APPEND symbols "${symbol}")
  endforeach()
  _fur_shader_header("${root}/${ARG_HEADER}" "${symbols}")
  add_library(${ARG_TARGET} STATIC ${sources})
  target_include_directories(${ARG_TARGET} PUBLIC "${root}")
  target_link_libraries(${ARG_TARGET} PUBLIC rhi)
endfunction()

# One custom command. Reads the ARG_ variables of its caller.
function(_fur_add_shader spec root out_source out_symbol)
  if(NOT spec MATCHES "^([^:]+):([A-Za-z_][A-Za-z0-9_]*):(vs|gs|ps|cs)(:([A-Za-z0-9_]*)(:([^:]*))?)?$")
    message(FATAL_ERROR "fur_add_shaders: '${spec}' is not file.hlsl:Entry:vs|gs|ps|cs[:Suffix[:DEF,DEF=value]]")
  endif()
  set(file "${CMAKE_MATCH_1}")
  set(entry "${CMAKE_MATCH_2}")
  set(stage "${CMAKE_MATCH_3}")
  set(suffix "${CMAKE_MATCH_5}")
  string(REPLACE "," ";" own_defines "${CMAKE_MATCH_7}")
  get_filename_component(stem "${file}" NAME_WE)
  get_filename_component(input "${file}" ABSOLUTE)
  set(symbol "${stem}_${entry}${suffix}")
  set(output "${root}/${symbol}.cpp")
  set(options "")
  foreach(define IN LISTS ARG_DEFINES own_defines)
    list(APPEND options -D "${define}")
  endforeach()
  foreach(dir IN LISTS ARG_INCLUDES)
    get_filename_component(dir "${dir}" ABSOLUTE)
    list(APPEND options -I "${dir}")
  endforeach()
  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" -E make_directory "${root}"
    COMMAND fur_shaderc --stage ${stage} --entry ${entry} --name "${file}:${entry}${suffix}" --symbol ${symbol}
            --namespace ${ARG_NAMESPACE} ${options} --depfile "${output}.d" -o "${output}" "${input}"
    DEPENDS fur_shaderc "${input}"
    DEPFILE "${output}.d"
    COMMENT "Compiling shader ${file}:${entry}${suffix}"
    VERBATIM)
  set(${out_source} "${output}" PARENT_SCOPE)
  set(${out_symbol} "${symbol}" PARENT_SCOPE)
endfunction()

function(_fur_shader_header path symbols)
  set(text "// Made by fur_add_shaders. Do not edit.\n#pragma once\n\n#include \"rhi/shader.h\"\n\nnamespace ${ARG_NAMESPACE} {\n")
  foreach(symbol IN LISTS symbols)
    string(APPEND text "extern const rhi::ShaderBlob ${symbol};\n")
  endforeach()
  string(APPEND text "}  // namespace ${ARG_NAMESPACE}\n")
  # Written only when it differs, lest every configure rebuilds the users.
  file(CONFIGURE OUTPUT "${path}" CONTENT "${text}" @ONLY)
endfunction()
