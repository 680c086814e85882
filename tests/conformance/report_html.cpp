#include "report.h"
namespace conformance {
std::string Html(const Run&) { return "<!doctype html>\n"; }
}  // namespace conformance
