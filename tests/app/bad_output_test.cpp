// Outputs that cannot be written: exit code 5, one line, nothing half-written.
#include "program.h"

namespace app::test {
namespace {

const std::vector<std::string> kSmall{"--size", "32x24"};

std::vector<std::string> Small(std::vector<std::string> more) {
  std::vector<std::string> all = kSmall;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(BadOutput, FolderIsMissing) {
  ExpectRenderFailure(Small({"-o", "/tmp/fur_no_such_folder/x.png"}), kOutputFailed, {"/tmp/fur_no_such_folder"});
}

TEST(BadOutput, TargetIsAFolder) {
  const Folder folder;
  ExpectRenderFailure(Small({"-o", folder / ""}), kOutputFailed);
  EXPECT_TRUE(folder.Content().empty());
}

TEST(BadOutput, PathLeadsThroughAFile) {
  const Folder folder;
  const std::string file = folder.Write("file", "kept");
  ExpectRenderFailure(Small({"-o", file + "/x.png"}), kOutputFailed, {"file"});
  EXPECT_EQ(folder.Content(), std::set<std::string>{"file"});
}

// Found out only when the file is created: root may write everywhere but here.
TEST(BadOutput, FolderRefusesFiles) {
  ExpectRenderFailure(Small({"-o", "/proc/fur_test.png"}), kOutputFailed, {"/proc/fur_test.png"});
  ExpectRenderFailure(Small({"-o", "/proc/fur_test.png", "--backend", "both"}), kOutputFailed, {"/proc/fur_test"});
}

TEST(BadOutput, NameIsTooLong) {
  ExpectRenderFailure(Small({"-o", "/tmp/" + std::string(300, 'x') + ".png"}), kOutputFailed);
}

TEST(BadOutput, NameIsEmpty) {
  const Folder folder;
  const Outcome o = RunFur({"render", "--size", "32x24", "-o", ""});
  EXPECT_NE(o.exitCode, 0);
  EXPECT_EQ(o.signal, 0);
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
}

// No picture either: one command is one result.
TEST(BadOutput, StatsCannotBeWritten) {
  const Folder folder;
  const std::string file = folder.Write("file", "kept");
  ExpectRenderFailure(Small({"--stats", "/tmp/fur_no_such_folder/s.json"}), kOutputFailed, {"/tmp/fur_no_such_folder"});
  ExpectRenderFailure(Small({"--stats", folder / ""}), kOutputFailed);
  ExpectRenderFailure(Small({"--stats", file + "/s.json"}), kOutputFailed, {"file"});
  EXPECT_EQ(folder.Content(), std::set<std::string>{"file"});
}

TEST(BadOutput, StatsFolderRefusesFiles) {
  ExpectRenderFailure(Small({"--stats", "/proc/fur_test.json"}), kOutputFailed, {"/proc/fur_test.json"});
}

// A failure leaves the picture of an earlier run alone.
TEST(BadOutput, FailureKeepsTheOldPicture) {
  const Folder folder;
  const std::string old = folder.Write("x.png", "old");
  ExpectFailure(RunFur({"render", "no_such.gltf", "-o", old}), kInputMissing);
  ExpectFailure(RunFur({"render", "--size", "32x24", "-o", old, "--stats", "/tmp/fur_no_such_folder/s.json"}),
                kOutputFailed);
  EXPECT_EQ(folder.Content(), std::set<std::string>{"x.png"});
  EXPECT_EQ(std::filesystem::file_size(old), 3u);
}

TEST(BadOutput, SuccessReplacesTheOldPicture) {
  const Folder folder;
  const std::string old = folder.Write("x.png", "old");
  ExpectSuccess(RunFur({"render", "--size", "32x24", "-o", old}));
  EXPECT_EQ(Picture(old).width, 32u);
  EXPECT_EQ(folder.Content(), std::set<std::string>{"x.png"});
}

}  // namespace
}  // namespace app::test
