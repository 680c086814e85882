// The subcommands. Each adds itself to the command line and leaves in `run` what to do when it was chosen; `run` returns
// the exit code.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>

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

// Runs `work` on the flags as they are when the command is run.
template <class Flags>
Command Running(std::shared_ptr<Flags> flags, fur::Result<fur::Done> (*work)(const Flags&)) {
  return [flags, work] {
    fur::Result<fur::Done> done = work(*flags);
    return done ? 0 : Fail(done.error());
  };
}

}  // namespace app
