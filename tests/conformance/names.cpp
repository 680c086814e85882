#include "names.h"

#include <cctype>

namespace conformance {
namespace {

bool Upper(char c) { return std::isupper(static_cast<unsigned char>(c)); }
bool Lower(char c) { return std::islower(static_cast<unsigned char>(c)); }
bool Digit(char c) { return std::isdigit(static_cast<unsigned char>(c)); }

// The first word of a suite's name: BlendFactorTest is about blend.
std::string AreaOf(const std::string& suite) {
  std::string name = suite.substr(suite.rfind('/') + 1);
  size_t end = 1;
  while (end < name.size() && !Upper(name[end])) ++end;
  return SnakeCase(name.substr(0, end));
}

bool EndsWithWord(const std::string& text, const std::string& word) {
  if (text == word) return true;
  return text.size() > word.size() + 1 && text.ends_with("_" + word);
}

bool MatchesOne(const char* pattern, const char* end, const char* text) {
  if (pattern == end) return *text == 0;
  if (*pattern == '*') return MatchesOne(pattern + 1, end, text) || (*text && MatchesOne(pattern, end, text + 1));
  return *text && (*pattern == '?' || *pattern == *text) && MatchesOne(pattern + 1, end, text + 1);
}

}  // namespace

std::string SnakeCase(const std::string& camel) {
  std::string snake;
  for (size_t i = 0; i < camel.size(); ++i) {
    const char c = camel[i], before = i ? camel[i - 1] : '_', after = i + 1 < camel.size() ? camel[i + 1] : '_';
    const bool word = (Upper(c) && (Lower(before) || Digit(before) || (Upper(before) && Lower(after)))) ||
                      (Digit(c) && Lower(before));
    if (word) snake += '_';
    snake += char(std::tolower(static_cast<unsigned char>(c)));
  }
  return snake;
}

CaseName MakeCaseName(const std::string& suite, const std::string& test) {
  CaseName name{.area = AreaOf(suite), .backend = "cpu", .gtest = suite + "." + test};
  const size_t slash = test.find('/');
  name.test = SnakeCase(test.substr(0, slash));
  if (slash == std::string::npos) return name;
  name.parameter = test.substr(slash + 1);
  for (const char* backend : {"vulkan", "gl", "both", "cpu"}) {
    if (!EndsWithWord(name.parameter, backend)) continue;
    name.backend = backend;
    const size_t rest = name.parameter.size() - name.backend.size();
    name.parameter.resize(rest ? rest - 1 : 0);
    break;
  }
  return name;
}

CaseName NameOf(const testing::TestInfo& info) { return MakeCaseName(info.test_suite_name(), info.name()); }

std::vector<CaseName> RegisteredCases() {
  std::vector<CaseName> all;
  const testing::UnitTest& unit = *testing::UnitTest::GetInstance();
  for (int s = 0; s < unit.total_test_suite_count(); ++s) {
    const testing::TestSuite& suite = *unit.GetTestSuite(s);
    for (int t = 0; t < suite.total_test_count(); ++t) all.push_back(NameOf(*suite.GetTestInfo(t)));
  }
  return all;
}

bool MatchesGlob(const std::string& patterns, const std::string& text) {
  for (size_t at = 0; at <= patterns.size();) {
    const size_t comma = std::min(patterns.find(',', at), patterns.size());
    if (MatchesOne(patterns.data() + at, patterns.data() + comma, text.c_str())) return true;
    at = comma + 1;
  }
  return false;
}

}  // namespace conformance
