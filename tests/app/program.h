// Runs the program and looks at what it leaves behind.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "fur/image_io.h"

namespace app::test {

struct Outcome {
  int exitCode = -1;  // -1: ended by a signal, or by the time limit
  int signal = 0;     // what ended it, or 0
  bool timedOut = false;
  std::string out, err;
};

// Waits `seconds` at most, then kills it.
Outcome RunFur(const std::vector<std::string>& arguments, double seconds = 120);

// A new folder that lives as long as the test.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string Write(const std::string& name, const std::string& bytes) const;  // returns the file's path
  std::set<std::string> Content() const;                                       // all files and folders below

 private:
  std::filesystem::path path_;
};

enum ExitCode {
  kSuccess, kInternal, kUsage, kInputMissing, kInputMalformed, kOutputFailed, kNoDevice, kRenderFailed, kComparisonFailed
};

// Exactly one line on stderr, `fur: error: ...`, which names each of the words; no signal; nothing on stdout.
void ExpectFailure(const Outcome&, ExitCode, const std::vector<std::string>& words = {});

// Runs `fur render ARGUMENTS -o x.png` in a new folder: fails as above and leaves nothing there.
void ExpectRenderFailure(const std::vector<std::string>& arguments, ExitCode,
                         const std::vector<std::string>& words = {});

// Exit code 0 and nothing on stderr.
void ExpectSuccess(const Outcome&);

std::string ReadText(const std::filesystem::path& file);  // all of it; empty where there is none
size_t Count(const std::string& text, const std::string& word);  // how often it stands there

fur::Image Picture(const std::string& file);  // fails the test when it is not there
nlohmann::json ReadJson(const std::string& file);
uint64_t DifferingPixels(const fur::Image&, const fur::Image&);

// Not blank: at least `share` of the pixels differ from the top left one, in many colours.
void ExpectDrawn(const fur::Image&, double share = 0.05, size_t colors = 200);

std::string Asset(const std::string& name);  // "cat/cat.gltf" -> its path; FUR_ASSETS in the environment wins

}  // namespace app::test
