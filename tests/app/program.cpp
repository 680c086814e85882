#include "program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace app::test {
namespace {

namespace fs = std::filesystem;

// Polls, because a wait with a time limit would need a signal.
bool WaitFor(pid_t pid, double seconds, int* status) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (waitpid(pid, status, WNOHANG) == 0) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

// Output goes to files: a pipe that nobody empties would block the program.
pid_t Spawn(const std::vector<std::string>& arguments, const std::string& out, const std::string& err) {
  std::vector<char*> argv{const_cast<char*>(FUR_PROGRAM)};
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);
  pid_t pid = -1;
  EXPECT_EQ(posix_spawn(&pid, FUR_PROGRAM, &actions, nullptr, argv.data(), environ), 0) << FUR_PROGRAM;
  posix_spawn_file_actions_destroy(&actions);
  return pid;
}

std::string Shown(const Outcome& o) {
  return "exit " + std::to_string(o.exitCode) + ", signal " + std::to_string(o.signal) + "\nstdout: " + o.out +
         "\nstderr: " + o.err;
}

}  // namespace

std::string ReadText(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

size_t Count(const std::string& text, const std::string& word) {
  size_t count = 0;
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

Outcome RunFur(const std::vector<std::string>& arguments, double seconds) {
  const Folder logs;
  const pid_t pid = Spawn(arguments, logs / "out", logs / "err");
  Outcome outcome;
  if (pid <= 0) return outcome;
  int status = 0;
  outcome.timedOut = !WaitFor(pid, seconds, &status);
  if (outcome.timedOut) {
    kill(pid, SIGKILL);
    waitpid(pid, &status, 0);
  }
  if (WIFEXITED(status)) outcome.exitCode = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  outcome.out = ReadText(logs / "out");
  outcome.err = ReadText(logs / "err");
  return outcome;
}

Folder::Folder() {
  std::string name = (fs::temp_directory_path() / "fur_app_XXXXXX").string();
  const char* made = mkdtemp(name.data());
  EXPECT_NE(made, nullptr);
  path_ = name;
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Folder::Write(const std::string& name, const std::string& bytes) const {
  fs::create_directories((path_ / name).parent_path());
  std::ofstream out(path_ / name, std::ios::binary | std::ios::trunc);
  out << bytes;
  return (path_ / name).string();
}

std::set<std::string> Folder::Content() const {
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path_))
    names.insert(fs::relative(entry.path(), path_).string());
  return names;
}

void ExpectFailure(const Outcome& o, ExitCode code, const std::vector<std::string>& words) {
  SCOPED_TRACE(Shown(o));
  EXPECT_FALSE(o.timedOut);
  EXPECT_EQ(o.signal, 0);
  EXPECT_EQ(o.exitCode, code);
  EXPECT_EQ(o.err.rfind("fur: error: ", 0), 0u) << "how the line starts";
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << "one line";
  EXPECT_EQ(o.err.empty() ? ' ' : o.err.back(), '\n');
  for (const std::string& word : words) EXPECT_NE(o.err.find(word), std::string::npos) << "names '" << word << "'";
  EXPECT_EQ(o.out, "");
}

void ExpectRenderFailure(const std::vector<std::string>& arguments, ExitCode code,
                         const std::vector<std::string>& words) {
  const Folder folder;
  std::vector<std::string> all{"render"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  if (std::find(all.begin(), all.end(), "-o") == all.end()) all.insert(all.end(), {"-o", folder / "x.png"});
  std::string shown;
  for (const std::string& a : all) shown += " " + a;
  SCOPED_TRACE("fur" + shown);
  ExpectFailure(RunFur(all), code, words);
  EXPECT_EQ(folder.Content(), std::set<std::string>{}) << "left behind";
}

void ExpectSuccess(const Outcome& o) {
  SCOPED_TRACE(Shown(o));
  EXPECT_FALSE(o.timedOut);
  EXPECT_EQ(o.signal, 0);
  EXPECT_EQ(o.exitCode, 0);
  EXPECT_EQ(o.err, "");
}

fur::Image Picture(const std::string& file) {
  fur::Result<fur::Image> image = fur::ReadImage(file);
  if (image) return *image;
  ADD_FAILURE() << image.error().message;
  return {"missing", 1, 1, {0, 0, 0, 255}};
}

nlohmann::json ReadJson(const std::string& file) {
  nlohmann::json json = nlohmann::json::parse(ReadText(file), nullptr, false);
  EXPECT_FALSE(json.is_discarded()) << file << " is not JSON";
  return json;
}

uint64_t DifferingPixels(const fur::Image& a, const fur::Image& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  if (a.pixels.size() != b.pixels.size()) return a.pixels.size();
  uint64_t differing = 0;
  for (size_t i = 0; i < a.pixels.size(); i += 4)
    differing += !std::equal(&a.pixels[i], &a.pixels[i] + 4, &b.pixels[i]);
  return differing;
}

void ExpectDrawn(const fur::Image& image, double share, size_t colors) {
  std::set<std::vector<uint8_t>> seen;
  size_t drawn = 0;
  for (size_t i = 0; i < image.pixels.size(); i += 4) {
    drawn += !std::equal(&image.pixels[i], &image.pixels[i] + 3, &image.pixels[0]);
    seen.insert({&image.pixels[i], &image.pixels[i] + 3});
    if (image.pixels[i + 3] != 255) return ADD_FAILURE() << "alpha is not 255 at pixel " << i / 4, void();
  }
  EXPECT_GE(double(drawn), share * double(image.pixels.size() / 4)) << "hardly anything is drawn";
  EXPECT_GE(seen.size(), colors) << "hardly any colours";
}

std::string Asset(const std::string& name) {
  const char* folder = std::getenv("FUR_ASSETS");
  return (fs::path(folder != nullptr && *folder != 0 ? folder : FUR_ASSETS_DIR) / name).string();
}

}  // namespace app::test
