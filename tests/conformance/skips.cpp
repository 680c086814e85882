#include "skips.h"

#include <sstream>
#include <vector>

#include "names.h"

namespace conformance {
namespace {

struct Rule {
  std::string drivers, cases;
};

// The lines of never_skip.txt, which the build put into never_skip.inc: `DRIVERS CASES`, globs; # starts a comment.
const std::vector<Rule>& Rules() {
  static const std::vector<Rule> rules = [] {
    std::vector<Rule> all;
    std::istringstream lines(
#include "conformance/never_skip.inc"
    );
    for (std::string line; std::getline(lines, line);) {
      std::istringstream words(line.substr(0, line.find('#')));
      Rule r;
      if (words >> r.drivers >> r.cases) all.push_back(r);
    }
    return all;
  }();
  return rules;
}

}  // namespace

std::string SkipProblem(const std::string& name, const std::string& driver, const std::string& reason) {
  if (reason.find("Caps::") == std::string::npos && reason.find("no assets") == std::string::npos)
    return "skipped without a reason from the caps: '" + reason + "'";
  if (reason.find("no assets") != std::string::npos) return "";
  for (const Rule& r : Rules())
    if (MatchesGlob(r.drivers, driver) && MatchesGlob(r.cases, name))
      return "may not be skipped on " + driver + " (tests/conformance/never_skip.txt), but was: " + reason;
  return "";
}

}  // namespace conformance
