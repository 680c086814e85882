// What a run leaves behind: JUnit XML, JSON and one page.
#pragma once

#include <string>

#include "run.h"

namespace conformance {

std::string JUnitXml(const Run&);
std::string Json(const Run&);
std::string Html(const Run&);

}  // namespace conformance
