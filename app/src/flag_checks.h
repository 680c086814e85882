// Checks of flags that CLI11 lacks.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

namespace app {

// CLI11's ranges let NaN through.
inline const CLI::Validator kFinite(
    [](std::string& text) {
      char* end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      const bool isNumber = std::isfinite(value) && end != text.c_str() && *end == 0;
      return isNumber ? std::string() : "must be a finite number, not " + text;
    },
    "");

}  // namespace app
