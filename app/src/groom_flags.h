// The coat's parameters as flags, made from the table of fur/params.h.
#pragma once

#include <CLI/CLI.hpp>
#include <glm/glm.hpp>
#include <map>
#include <string>

#include "flag_checks.h"
#include "fur/result.h"

namespace app {

fur::Result<glm::dvec3> ParseVector(const std::string& text, const char* flag);

// One flag for each FurParams key, but --shells, which is not the coats' alone. What is given lands in `values` by key.
void AddGroomFlags(CLI::App*, std::map<std::string, std::string>* values);

// The given flags as the JSON that the loader applies last; empty for none. Usage for what is not of the key's type.
fur::Result<std::string> GroomOverrides(const std::map<std::string, std::string>& values);

}  // namespace app
