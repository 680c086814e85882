# One target carries the warning flags of all our own code.
add_library(fur_warnings INTERFACE)
target_compile_options(fur_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                       -Wno-missing-field-initializers)
# GCC 12 warns wrongly where "literal" + std::string is inlined (GCC bug 105651).
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  target_compile_options(fur_warnings INTERFACE -Wno-restrict)
endif()
if(FUR_WERROR)
  target_compile_options(fur_warnings INTERFACE -Werror)
endif()
# Explicit sums must stay explicit on the CPU too: no fused multiply-add behind our back.
target_compile_options(fur_warnings INTERFACE -ffp-contract=off)
