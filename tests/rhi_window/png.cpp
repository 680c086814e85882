#include "window.h"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#include <stb_image_write.h>
#pragma GCC diagnostic pop

namespace rhi_test {

void WritePng(const std::string& path, const Pixels& p) {
  stbi_write_png(path.c_str(), int(p.width), int(p.height), 3, p.rgb.data(), int(p.width) * 3);
}

}  // namespace rhi_test
