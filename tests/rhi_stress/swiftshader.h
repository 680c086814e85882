#pragma once

#include <string>

namespace rhi_stress {

std::string SwiftShaderIcd();  // the path of the driver's description; "" where there is none
void UseOnlyDriver(const std::string& icd);  // for instances made from now on, and for children

}  // namespace rhi_stress
