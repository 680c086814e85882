// What fur compare prints.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fur/compare.h"

namespace app {

struct ComparedFiles {
  std::string reference, test;
  bool referenceEncoded = false, testEncoded = false;  // from the file; else linear, and encoded here
  double pixelsPerDegree = 67;
};

// docs/accuracy.md lists the fields. null: there is no such value; psnr: equal pictures.
nlohmann::ordered_json ComparisonJson(const fur::Comparison&, const ComparedFiles&);
std::string ComparisonText(const fur::Comparison&, const ComparedFiles&);  // several lines

}  // namespace app
