// Baked coats on disk: whole or not at all, and the loader reads them.
#include "fur/bake_files.h"
#include "fur/coat_file.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "bake_helpers.h"
#include "fur/coat.h"
#include "fur/file.h"
#include "fur/image_io.h"

namespace fur::test {
namespace {

namespace fs = std::filesystem;

class BakeFiles : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "fur_bake_XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder_ = name;
    CoatParams params = SmallCoat();
    params.size = 16, params.layers = 3, params.over.density = 5, params.under.density = 8;
    coat_ = Bake(params);
  }
  void TearDown() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  std::set<std::string> Content() const {
    std::set<std::string> names;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder_))
      names.insert(entry.path().lexically_relative(folder_).string());
    return names;
  }
  static std::string Text(const fs::path& file) {
    std::ifstream in(file);
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
  }

  fs::path folder_;
  BakedCoat coat_;
};

TEST_F(BakeFiles, LoaderReadsTheVolumeAndItsTint) {
  ASSERT_TRUE(WriteCoat({.folder = folder_ / "coat"}, coat_));
  const nlohmann::json fur = nlohmann::json::parse(Text(folder_ / "coat/fur.json"));
  std::vector<fs::path> files;
  for (const auto& name : fur["default"]["layers"]) files.push_back(folder_ / "coat" / name.get<std::string>());
  const Result<FurVolume> volume = LoadFurLayers(files);
  ASSERT_TRUE(volume);
  EXPECT_EQ(volume->pixels, coat_.volume.pixels);
  EXPECT_EQ(volume->tint, coat_.volume.tint);
  const Result<Image> fin = ReadImage(folder_ / "coat/fin.png");
  ASSERT_TRUE(fin);
  EXPECT_EQ(fin->pixels, coat_.fin.pixels);
}

TEST_F(BakeFiles, LoaderDoesWithoutTintAndRefusesAnotherSize) {
  ASSERT_TRUE(WriteCoat({.folder = folder_ / "coat", .mips = false}, coat_));
  const std::vector<fs::path> files{folder_ / "coat/00.png", folder_ / "coat/01.png"};
  ASSERT_TRUE(WritePng(folder_ / "coat/tint/00.png", 8, 8, std::vector<uint8_t>(8 * 8 * 4)));
  ASSERT_TRUE(WritePng(folder_ / "coat/tint/01.png", 8, 8, std::vector<uint8_t>(8 * 8 * 4)));
  EXPECT_FALSE(LoadFurLayers(files));
  fs::remove(folder_ / "coat/tint/01.png");
  const Result<FurVolume> volume = LoadFurLayers(files);
  ASSERT_TRUE(volume);
  EXPECT_TRUE(volume->tint.empty());
}

TEST_F(BakeFiles, FolderHoldsWhatItShould) {
  ASSERT_TRUE(WriteCoat({.folder = folder_ / "coat/", .strands = folder_ / "coat/strands.ply"}, coat_));
  std::set<std::string> expected{"coat",           "coat/tint",     "coat/mips",       "coat/fin.png",
                                 "coat/coat.json", "coat/fur.json", "coat/strands.ply"};
  for (const std::string slice : {"00.png", "01.png", "02.png"}) {
    expected.insert({"coat/" + slice, "coat/tint/" + slice});
    for (const char* level : {"1", "2", "3", "4"})
      expected.insert({std::string("coat/mips/") + level, std::string("coat/mips/") + level + "/" + slice});
  }
  EXPECT_EQ(Content(), expected);
  const Result<Coat> coat = LoadCoat((folder_ / "coat/coat.json").string());
  ASSERT_TRUE(coat);
  EXPECT_EQ(Bake(coat->strands).volume.pixels, coat_.volume.pixels);
}

TEST_F(BakeFiles, AnOldCoatIsReplacedWhole) {
  ASSERT_TRUE(WriteCoat({.folder = folder_ / "coat", .strands = folder_ / "coat/strands.json"}, coat_));
  CoatParams params = coat_.params;
  params.layers = 2;
  ASSERT_TRUE(WriteCoat({.folder = folder_ / "coat", .mips = false}, Bake(params)));
  EXPECT_EQ(Content(), (std::set<std::string>{"coat", "coat/tint", "coat/fin.png", "coat/coat.json", "coat/fur.json",
                                              "coat/00.png", "coat/01.png", "coat/tint/00.png", "coat/tint/01.png"}));
}

// Nobody's other files are deleted.
TEST_F(BakeFiles, AFolderWithOtherThingsIsLeftAlone) {
  for (const char* name : {"coat/photo.png", "coat/tint/notes.txt", "coat/mips/1/x.png", "coat/00.png/deep"}) {
    fs::create_directories((folder_ / name).parent_path());
    ASSERT_TRUE(WriteFile(folder_ / name, "kept"));
    const std::set<std::string> before = Content();
    const Result<Done> result = WriteCoat({.folder = folder_ / "coat"}, coat_);
    ASSERT_FALSE(result) << name;
    EXPECT_EQ(result.error().code, ErrorCode::OutputFailed);
    EXPECT_EQ(Content(), before);
    fs::remove_all(folder_ / "coat");
  }
}

TEST_F(BakeFiles, FailuresLeaveNothingBehind) {
  ASSERT_TRUE(WriteFile(folder_ / "file", "kept"));
  const std::set<std::string> before = Content();
  for (const fs::path& bad : {folder_ / "file", folder_ / "no/such/coat", fs::path("/proc/coat"), fs::path("/"),
                              fs::path("."), fs::path(".."), fs::path(), folder_ / ".."}) {
    const Result<Done> result = WriteCoat({.folder = bad}, coat_);
    ASSERT_FALSE(result) << bad;
    EXPECT_EQ(result.error().code, ErrorCode::OutputFailed) << bad;
  }
  for (const fs::path& bad : {folder_ / "strands.obj", folder_ / "coat/mine.ply", folder_ / "no/strands.ply"})
    EXPECT_FALSE(WriteCoat({.folder = folder_ / "coat", .strands = bad}, coat_)) << bad;
  EXPECT_EQ(Content(), before);
}

TEST_F(BakeFiles, JsonListsTheStrands) {
  ASSERT_TRUE(WriteStrands(folder_ / "s.json", coat_));
  const nlohmann::json json = nlohmann::json::parse(Text(folder_ / "s.json"));
  EXPECT_EQ(json["tile"], coat_.params.tile);
  ASSERT_EQ(json["strands"].size(), coat_.strands.size());
  const Strand& strand = coat_.strands.back();
  const nlohmann::json& last = json["strands"].back();
  EXPECT_EQ(last["class"], "under");
  ASSERT_EQ(last["points"].size(), strand.points.size());
  EXPECT_NEAR(last["points"][0][0].get<double>(), strand.root.x * coat_.params.tile, 1e-5);
  EXPECT_NEAR(last["points"].back()[2].get<double>(), strand.points.back().position.z, 1e-5);
  EXPECT_NEAR(last["points"][0][3].get<double>(), strand.points[0].radius, 1e-6);
}

TEST_F(BakeFiles, PlyListsVerticesAndEdges) {
  ASSERT_TRUE(WriteStrands(folder_ / "s.ply", coat_));
  std::istringstream text(Text(folder_ / "s.ply"));
  size_t vertices = 0, edges = 0;
  for (std::string line; std::getline(text, line) && line != "end_header";) {
    std::sscanf(line.c_str(), "element vertex %zu", &vertices);
    std::sscanf(line.c_str(), "element edge %zu", &edges);
  }
  size_t points = 0;
  for (const Strand& s : coat_.strands) points += s.points.size();
  EXPECT_EQ(vertices, points);
  EXPECT_EQ(edges, points - coat_.strands.size());
  double x = 0, y = 0, z = 0, radius = 0;
  int kind = 0;
  for (size_t i = 0; i < vertices; ++i) ASSERT_TRUE(text >> x >> y >> z >> radius >> kind);
  EXPECT_EQ(kind, 0);
  EXPECT_NEAR(z, coat_.strands.back().points.back().position.z, 1e-5);
  for (size_t i = 0, a = 0, b = 0; i < edges; ++i) {
    ASSERT_TRUE(text >> a >> b);
    ASSERT_TRUE(b == a + 1 && b < vertices);
  }
}

}  // namespace
}  // namespace fur::test
