# fur_embed_coats(OUT <variable> FILES <file.json>...)
#
# The source file that defines fur::EmbeddedCoats(): each file's name without .json, and its text. Made again when a file
# changes. Files are relative to the current source directory.
function(fur_embed_coats)
  cmake_parse_arguments(PARSE_ARGV 0 ARG "" "OUT" "FILES")
  set(output "${CMAKE_CURRENT_BINARY_DIR}/embedded_coats.cpp")
  list(TRANSFORM ARG_FILES PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/" OUTPUT_VARIABLE files)
  list(JOIN files "|" joined)
  add_custom_command(
    OUTPUT "${output}"
    COMMAND "${CMAKE_COMMAND}" "-DFILES=${joined}" "-DOUTPUT=${output}" -P "${CMAKE_SOURCE_DIR}/cmake/EmbedCoats.cmake"
    DEPENDS ${files} "${CMAKE_SOURCE_DIR}/cmake/EmbedCoats.cmake"
    COMMENT "Embedding coats"
    VERBATIM)
  set(${ARG_OUT} "${output}" PARENT_SCOPE)
endfunction()

# Run as a script: cmake -DFILES=a|b -DOUTPUT=file -P EmbedCoats.cmake
if(CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE AND DEFINED OUTPUT)
  string(REPLACE "|" ";" files "${FILES}")
  set(text "// Made by cmake/EmbedCoats.cmake. Do not edit.\n#include \"fur/coat_file.h\"\n\nnamespace fur {\n\n")
  string(APPEND text "std::span<const EmbeddedCoat> EmbeddedCoats() {\n  static constexpr EmbeddedCoat coats[] = {\n")
  foreach(file IN LISTS files)
    get_filename_component(name "${file}" NAME_WE)
    file(READ "${file}" json)
    string(APPEND text "{\"${name}\", R\"coat(${json})coat\"},\n")
  endforeach()
  string(APPEND text "  };\n  return coats;\n}\n\n}  // namespace fur\n")
  file(WRITE "${OUTPUT}" "${text}")
endif()
