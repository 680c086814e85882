// docs/drivers.md, from the JSON reports of runs on several drivers (tools/drivers.sh).
#pragma once

#include <string>
#include <vector>

namespace conformance {

// Markdown. Throws std::runtime_error for a file that is no report.
std::string DriverTable(const std::vector<std::string>& jsonFiles);

}  // namespace conformance
