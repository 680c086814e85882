// fur: renders animals with fur by shells and fins.
#include <fmt/format.h>

#include <algorithm>
#include <exception>

#include "commands.h"

namespace app {

int Fail(const fur::Error& error) {
  std::string line = error.message;
  std::replace(line.begin(), line.end(), '\n', ' ');
  fmt::print(stderr, "fur: error: {}\n", line);
  return int(error.code);
}

namespace {

int ParseFailure(const CLI::App& app, const CLI::ParseError& e) {
  if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
  return Fail({fur::ErrorCode::Usage, fmt::format("{}; see fur --help", e.what())});
}

int Main(int argc, char** argv) {
  CLI::App app{"Real-time fur by shells and fins, on Vulkan and on OpenGL"};
  app.name("fur");
  app.set_version_flag("--version", "fur " FUR_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Exit codes: 0 success, 1 internal error, 2 wrong flags, 3 missing input, 4 malformed input,\n"
      "5 output cannot be written, 6 no usable driver, 7 rendering failed, 8 a limit of compare is exceeded.");
  Command run;
  AddRenderCommand(app, &run);
  AddReferenceCommand(app, &run);
  AddCompareCommand(app, &run);
  AddBenchCommand(app, &run);
  AddBakeCommand(app, &run);
  AddInfoCommand(app, &run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return ParseFailure(app, e);
  }
  return run();
}

}  // namespace
}  // namespace app

int main(int argc, char** argv) {
  try {
    return app::Main(argc, argv);
  } catch (const std::bad_alloc&) {
    return app::Fail({fur::ErrorCode::Internal, "out of memory; try smaller pictures or a smaller --count"});
  } catch (const std::exception& e) {
    return app::Fail({fur::ErrorCode::Internal, e.what()});
  }
}
