# fur_check_includes(<target> FORBID <word>...)
#
# Makes building <target> fail when a source file below the current folder includes a header whose first path component
# is one of the words: "rhi_vulkan/device.h", <vulkan/vulkan.h>, <volk.h>. The folders are the architecture
# (docs/architecture.md); this keeps them so. Runs before the target is compiled, and again only when a file changes.
set(FUR_CHECK_INCLUDES_SCRIPT "${CMAKE_CURRENT_LIST_DIR}/../tools/check_includes.sh")

function(fur_check_includes target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "" "FORBID")
  if(NOT ARG_FORBID OR ARG_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "usage: fur_check_includes(<target> FORBID <word>...)")
  endif()
  # The patterns are those of check_includes.sh.
  file(GLOB_RECURSE files CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/*.h" "${CMAKE_CURRENT_SOURCE_DIR}/*.hpp"
       "${CMAKE_CURRENT_SOURCE_DIR}/*.inl" "${CMAKE_CURRENT_SOURCE_DIR}/*.c" "${CMAKE_CURRENT_SOURCE_DIR}/*.cpp")
  set(stamp "${CMAKE_CURRENT_BINARY_DIR}/${target}_includes.stamp")
  # The list is a dependency too: a file that is new here may be older than the stamp.
  set(list "${CMAKE_CURRENT_BINARY_DIR}/${target}_includes.txt")
  list(JOIN files "\n" content)
  file(CONFIGURE OUTPUT "${list}" CONTENT "${content}\n" @ONLY)
  add_custom_command(
    OUTPUT "${stamp}"
    COMMAND sh "${FUR_CHECK_INCLUDES_SCRIPT}" "${target}" "${CMAKE_CURRENT_SOURCE_DIR}" ${ARG_FORBID}
    COMMAND "${CMAKE_COMMAND}" -E touch "${stamp}"
    DEPENDS ${files} "${list}" "${FUR_CHECK_INCLUDES_SCRIPT}"
    COMMENT "Checking the include directions of ${target}"
    VERBATIM)
  add_custom_target(${target}_includes DEPENDS "${stamp}")
  add_dependencies(${target} ${target}_includes)
endfunction()
