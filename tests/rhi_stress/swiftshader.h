#pragma once

#include <string>

namespace rhi_stress {

std::string SwiftShaderIcd();  // the path of the driver's description; "" where there is none

}  // namespace rhi_stress
