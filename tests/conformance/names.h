// The names of cases: area.case/parameter.backend, made from GoogleTest's names by rule (docs/conformance.md).
#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace conformance {

struct CaseName {
  std::string area, test, parameter;  // "blend", "source_factor", "src_alpha" or ""
  std::string backend;                // "vulkan", "gl", "both" (a comparison of the two), "cpu" (needs no driver)
  std::string gtest;                  // "Rhi/BlendFactorTest.SourceFactor/src_alpha_vulkan"
  std::string Base() const { return area + "." + test + (parameter.empty() ? "" : "/" + parameter); }
  std::string Full() const { return Base() + "." + backend; }
};

// "Rhi/BlendFactorTest", "SourceFactor/src_alpha_vulkan".
CaseName MakeCaseName(const std::string& suite, const std::string& test);
CaseName NameOf(const testing::TestInfo&);
std::vector<CaseName> RegisteredCases();  // in the order in which they run

std::string SnakeCase(const std::string& camel);

// * any characters, ? one character; several patterns with commas between.
bool MatchesGlob(const std::string& patterns, const std::string& text);

}  // namespace conformance
