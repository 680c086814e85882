# One target carries the warning flags of all our own code.
add_library(fur_warnings INTERFACE)
target_compile_options(fur_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                       -Wno-missing-field-initializers)
if(FUR_WERROR)
  target_compile_options(fur_warnings INTERFACE -Werror)
endif()
# Explicit sums must stay explicit on the CPU too: no fused multiply-add behind our back.
target_compile_options(fur_warnings INTERFACE -ffp-contract=off)
