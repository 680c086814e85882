// The subcommands. Each adds itself to the command line and leaves in `run` what to do when it was chosen; `run` returns
// the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "fur/result.h"

namespace app {

using Command = std::function<int()>;

void AddRenderCommand(CLI::App& app, Command* run);
void AddReferenceCommand(CLI::App& app, Command* run);
void AddCompareCommand(CLI::App& app, Command* run);
void AddBenchCommand(CLI::App& app, Command* run);
void AddBakeCommand(CLI::App& app, Command* run);
void AddInfoCommand(CLI::App& app, Command* run);

// Prints "fur: error: ..." as one line on stderr; returns the error's exit code.
int Fail(const fur::Error& error);

}  // namespace app
