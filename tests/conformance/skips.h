// Which cases may be skipped, and why: the file never_skip.txt.
#pragma once

#include <string>

namespace conformance {

// What is wrong with skipping this case on this driver for this reason; "" when nothing is.
std::string SkipProblem(const std::string& name, const std::string& driver, const std::string& reason);

}  // namespace conformance
