// Where and when something was measured.
#pragma once

#include <string>

namespace app {

struct Machine {
  std::string host, system, cpu, build, compiler, version, date, command;
  unsigned cores = 0;  // that this process may use
};
Machine DescribeMachine();

// Mean number of runnable threads over the last minute; -1 where the system does not say.
double LoadAverage();

// Others use a quarter of the cores or more.
bool IsBusy(const Machine&, double load);

}  // namespace app
