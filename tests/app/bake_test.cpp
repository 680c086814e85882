// fur bake: flags, files, errors.
#include <fstream>

#include "program.h"

namespace app::test {
namespace {

std::vector<std::string> Small(const std::string& folder, std::vector<std::string> more = {}) {
  std::vector<std::string> all{"bake", "-o", folder, "--size", "32", "--layers", "4", "--tile", "1"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::string Bytes(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  EXPECT_TRUE(in) << file;
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(BakeCommand, SameSeedSameBytesAtAnyNumberOfThreads) {
  const Folder folder;
  for (const char* threads : {"1", "2", "3", "7"})
    ExpectSuccess(
        RunFur(Small(folder / threads, {"--threads", threads, "--strands", folder / threads + "/strands.ply"})));
  ExpectSuccess(RunFur(Small(folder / "other", {"--seed", "2"})));
  const std::vector<std::string> files{"00.png",  "02.png",    "tint/01.png", "mips/1/00.png",
                                       "fin.png", "coat.json", "fur.json",    "strands.ply"};
  for (const std::string& file : files)
    for (const char* threads : {"2", "3", "7"})
      EXPECT_EQ(Bytes(folder / threads + "/" + file), Bytes(folder / "1" + "/" + file)) << file;
  EXPECT_NE(Bytes(folder / "other" + "/00.png"), Bytes(folder / "1" + "/00.png"));
}

TEST(BakeCommand, CoatFileAndFlags) {
  const Folder folder;
  ExpectSuccess(
      RunFur(Small(folder / "a", {"--over-length", "0.5", "--under-curl-turns=3", "--over-bias-y", "-0.25"})));
  const nlohmann::json coat = ReadJson(folder / "a" + "/coat.json")["strands"];
  EXPECT_EQ(coat["size"], 32);
  EXPECT_EQ(coat["over"]["length"], 0.5);
  EXPECT_EQ(coat["under"]["curl_turns"], 3.0);
  EXPECT_EQ(coat["over"]["bias_y"], -0.25);
  ExpectSuccess(RunFur({"bake", "-o", folder / "b", "--coat", folder / "a" + "/coat.json"}));
  EXPECT_EQ(Bytes(folder / "b" + "/01.png"), Bytes(folder / "a" + "/01.png"));
  ExpectSuccess(RunFur({"bake", "-o", folder / "b", "--coat", folder / "a" + "/coat.json", "--over-length", "0.9"}));
  EXPECT_EQ(ReadJson(folder / "b" + "/coat.json")["strands"]["over"]["length"], 0.9);
}

TEST(BakeCommand, RenderWearsIt) {
  const Folder folder;
  ExpectSuccess(RunFur(Small(folder / "coat")));
  const std::vector<std::string> render{"render", Asset("torus/torus.gltf"), "--size", "96x64"};
  std::vector<std::string> plain = render, furred = render;
  plain.insert(plain.end(), {"-o", folder / "plain.png"});
  furred.insert(furred.end(), {"-o", folder / "furred.png", "--fur", folder / "coat" + "/fur.json"});
  ExpectSuccess(RunFur(plain));
  ExpectSuccess(RunFur(furred));
  EXPECT_GT(DifferingPixels(Picture(folder / "plain.png"), Picture(folder / "furred.png")), 500u);
}

TEST(BakeCommand, ProgressOnDemandOnly) {
  const Folder folder;
  ExpectSuccess(RunFur(Small(folder / "a")));
  const Outcome o = RunFur(Small(folder / "a", {"--progress"}));
  EXPECT_EQ(o.exitCode, 0);
  EXPECT_NE(o.err.find("100 %"), std::string::npos) << o.err;
  EXPECT_NE(o.err.find("baking"), std::string::npos);
  EXPECT_EQ(o.err.find('\n'), std::string::npos);
}

TEST(BakeCommand, ErrorsNameTheFlag) {
  const Folder folder;
  const auto fails = [&](std::vector<std::string> more, ExitCode code, const std::vector<std::string>& words) {
    ExpectFailure(RunFur(Small(folder / "coat", std::move(more))), code, words);
    EXPECT_EQ(folder.Content(), std::set<std::string>{});
  };
  fails({"--over-length", "3"}, kUsage, {"--over-length", "0.02 to 2", "3"});
  fails({"--over-length", "nan"}, kUsage, {"--over-length"});
  fails({"--under-density", "thick"}, kUsage, {"--under-density", "thick"});
  fails({"--seed", "-1"}, kUsage, {"--seed"});
  fails({"--seed", "1.5"}, kUsage, {"--seed", "whole"});
  fails({"--over-lenght", "1"}, kUsage, {"--over-lenght"});
  fails({"--threads", "-1"}, kUsage, {"--threads"});
  fails({"--strands", folder / "s.obj"}, kUsage, {"s.obj", ".ply"});
  ExpectFailure(RunFur({"bake", "-o", folder / "coat", "--tile", "64", "--over-density", "5000"}), kUsage, {"density"});
  fails({"--coat", folder / "no.json"}, kInputMissing, {"no.json"});
  ExpectFailure(RunFur({"bake"}), kUsage, {"--output"});
}

TEST(BakeCommand, BadCoatFilesAreRefusedByName) {
  const Folder folder;
  for (const auto& [text, word] : {std::pair{R"({"strands": {"over": {"lenght": 1}}})", "over.lenght"},
                                   {R"({"strands": {"over": {"length": 9}}})", "over.length"},
                                   {R"({"size": )", "JSON"}}) {
    const std::string file = folder.Write("coat.json", text);
    ExpectFailure(RunFur(Small(folder / "out", {"--coat", file})), kInputMalformed, {"coat.json", word});
  }
  EXPECT_EQ(folder.Content(), std::set<std::string>{"coat.json"});
}

TEST(BakeCommand, OutputsWholeOrNotAtAll) {
  const Folder folder;
  const std::string file = folder.Write("file", "kept"), photo = folder.Write("mine/photo.png", "kept");
  ExpectFailure(RunFur(Small(file)), kOutputFailed, {"file"});
  ExpectFailure(RunFur(Small(folder / "mine")), kOutputFailed, {"photo.png"});
  ExpectFailure(RunFur(Small(folder / "no/coat")), kOutputFailed, {"coat"});
  ExpectFailure(RunFur(Small("/proc/coat")), kOutputFailed, {"/proc/coat"});
  ExpectFailure(RunFur(Small(folder / "coat", {"--strands", folder / "no/s.ply"})), kOutputFailed, {"s.ply"});
  EXPECT_EQ(folder.Content(), (std::set<std::string>{"file", "mine", "mine/photo.png"}));
}

}  // namespace
}  // namespace app::test
