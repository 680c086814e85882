// JUnit XML as CI systems read it: a testsuite for each area.
#include <fmt/format.h>

#include <map>

#include "../../app/src/html_text.h"
#include "report.h"

namespace conformance {
namespace {

using app::Escaped;

// XML 1.0 has no way to write most control characters.
std::string Printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 32 && c != '\n' && c != '\t') c = '?';
  return Escaped(text);
}

std::string TestCase(const CaseResult& c) {
  std::string xml = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", Escaped(c.name.area),
                                Escaped(c.name.Full()), c.seconds);
  if (c.result == Result::Passed) return xml + "/>\n";
  xml += ">\n";
  if (c.result == Result::Skipped) xml += fmt::format("      <skipped message=\"{}\"/>\n", Printable(c.skip));
  if (c.result == Result::Failed) {
    const std::string first = c.failures.empty() ? "" : c.failures[0];
    xml += fmt::format("      <failure message=\"{}\">", Printable(first.substr(0, first.find('\n'))));
    for (const std::string& f : c.failures) xml += Printable(f) + "\n";
    xml += "</failure>\n";
  }
  return xml + "    </testcase>\n";
}

struct Suite {
  uint64_t tests = 0, failures = 0, skipped = 0;
  double seconds = 0;
  std::string cases;
};

}  // namespace

std::string JUnitXml(const Run& run) {
  std::map<std::string, Suite> suites;
  for (const CaseResult& c : run.cases) {
    Suite& s = suites[c.name.area];
    ++s.tests;
    s.failures += c.result == Result::Failed;
    s.skipped += c.result == Result::Skipped;
    s.seconds += c.seconds;
    s.cases += TestCase(c);
  }
  Suite& whole = suites["run"];  // what is wrong with the run as a whole fails, too
  whole.tests = 1;
  whole.failures = run.problems.empty() ? 0 : 1;
  CaseResult all{.name = {.area = "run", .test = "as_a_whole", .backend = "cpu"}, .failures = run.problems};
  all.result = run.problems.empty() ? Result::Passed : Result::Failed;
  whole.cases = TestCase(all);
  std::string xml = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"fur_conformance\" tests=\"{}\" failures=\"{}\" "
      "skipped=\"{}\" time=\"{:.3f}\" timestamp=\"{}\">\n",
      run.cases.size() + 1, run.Count(Result::Failed) + whole.failures, run.Count(Result::Skipped), run.seconds,
      run.date);
  for (const auto& [area, s] : suites)
    xml += fmt::format(
        "  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\" skipped=\"{}\" time=\"{:.3f}\">\n{}  </testsuite>\n",
        Escaped(area), s.tests, s.failures, s.skipped, s.seconds, s.cases);
  return xml + "</testsuites>\n";
}

}  // namespace conformance
