// Debian ships volk as a header and a source file, without a library: its one copy is compiled here.
#define VOLK_IMPLEMENTATION
#include <volk.h>
