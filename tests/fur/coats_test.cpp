// The coats in the program, and coat files.
#include "fur/coat_file.h"

#include <nlohmann/json.hpp>
#include <set>

#include "body.h"
#include "fur/builtin.h"
#include "fur/gltf.h"
#include "gltf_builder.h"

namespace fur::test {
namespace {

fur::Coat Parsed(const std::string& json) {
  Result<fur::Coat> coat = ParseCoat(json, "x.json");
  EXPECT_TRUE(coat) << (coat ? "" : coat.error().message);
  return coat ? *coat : fur::Coat{};
}

std::string Text(const std::vector<uint8_t>& bytes) { return {bytes.begin(), bytes.end()}; }

TEST(Coats, AreTheNineThatAreAskedFor) {
  std::set<std::string> names;
  for (const EmbeddedCoat& embedded : EmbeddedCoats()) names.insert(embedded.name);
  EXPECT_EQ(names, (std::set<std::string>{"bear", "fox", "house-cat", "husky", "panther", "plush", "sheep", "snow-leopard",
                                          "tiger"}));
}

// Hair ends below the last slice, and no coat has another's strands.
TEST(Coats, BakeWithAnEmptyTopSliceAndDiffer) {
  std::set<std::string> volumes;
  for (const EmbeddedCoat& embedded : EmbeddedCoats()) {
    Result<fur::Coat> coat = LoadCoat(embedded.name);
    ASSERT_TRUE(coat) << coat.error().message;
    EXPECT_FALSE(coat->title.empty()) << embedded.name;
    CoatParams strands = coat->strands;
    strands.size = 32;  // the same strands, coarser: faster
    ASSERT_TRUE(CheckCoat(coat->strands)) << embedded.name;
    const FurVolume volume = BakeVolume(strands, GrowStrandList(strands));
    const size_t slice = volume.pixels.size() / volume.layers;
    uint64_t top = 0, all = 0;
    for (size_t i = 3; i < volume.pixels.size(); i += 4) {
      all += volume.pixels[i];
      if (i >= volume.pixels.size() - slice) top += volume.pixels[i];
    }
    EXPECT_EQ(top, 0u) << embedded.name;
    EXPECT_GT(double(all) / 255 / double(volume.pixels.size() / 4), 0.05) << embedded.name << " is bald";
    EXPECT_TRUE(volumes.insert(Text(volume.pixels)).second) << embedded.name;
  }
}

TEST(Coats, MarkingsDiffer) {
  const Model animal = MakeBuiltinAnimal();
  const Body body(animal);
  std::set<std::string> pictures;
  for (const EmbeddedCoat& embedded : EmbeddedCoats()) {
    Result<fur::Coat> coat = LoadCoat(embedded.name);
    ASSERT_TRUE(coat && coat->markings) << embedded.name;
    coat->markings->size = 128;
    EXPECT_TRUE(pictures.insert(Text(PaintMarkings(animal, body, 0, *coat->markings).pixels)).second) << embedded.name;
  }
}

TEST(CoatFile, BadOnesAreRefusedByFileAndPath) {
  for (const auto& [json, words] : std::initializer_list<std::pair<const char*, std::vector<const char*>>>{
           {R"({"strand": {}})", {"x.json", "\"strand\"", "title, length, strands, groom, markings"}},
           {R"({"size": 64})", {"x.json", "\"size\"", "strands"}},
           {R"([1])", {"x.json", "object"}},
           {R"({"title": 1})", {"\"title\"", "number"}},
           {R"({"length": 0})", {"\"length\"", "above 0 to 0.5", "0"}},
           {R"({"length": "long"})", {"\"length\"", "string"}},
           {R"({"strands": {"over": {"lenght": 1}}})", {"x.json: strands", "over.lenght"}},
           {R"({"groom": {"wetness": 2}})", {"x.json: groom", "\"wetness\"", "0 to 1", "2"}},
           {R"({"groom": {"length_map": "a.png"}})", {"x.json: groom", "\"length_map\"", "model"}},
           {R"({"groom": 3})", {"groom", "object"}},
           {R"({"markings": 3})", {"x.json: markings", "object"}},
           {R"({"markings": {"bass": 1}})", {"\"bass\"", "base, over_base, size, layers"}},
           {R"({"markings": {"base": [1, 2, 0]}})", {"\"base[1]\"", "0 to 1", "2"}},
           {R"({"markings": {"over_base": -1}})", {"\"over_base\"", "0 to 1"}},
           {R"({"markings": {"size": 32.5}})", {"\"size\"", "whole"}},
           {R"({"markings": {"layers": [{}, {"patern": 1}]}})", {"\"layers[1].patern\"", "pattern, color"}},
           {R"({"markings": {"layers": [{"pattern": "dots"}]}})", {"\"layers[0].pattern\"", "stripes", "dots"}},
           {R"({"markings": {"layers": [{"scale": 0}]}})", {"\"layers[0].scale\"", "0.002 to 2"}},
           {R"({"markings": {"layers": [{"where": {"elbow": [0, 1]}}]}})", {"\"layers[0].where.elbow\"", "height"}},
           {R"({"markings": {"layers": [{"where": {"up": [1, 1]}}]}})", {"\"layers[0].where.up\"", "different"}},
           {R"({"markings": {"layers": [{"taper": {"up": 1}}]}})", {"\"layers[0].taper.up\"", "[from, to]"}},
           {R"({"title": )", {"x.json", "JSON"}}}) {
    const Result<fur::Coat> coat = ParseCoat(json, "x.json");
    ASSERT_FALSE(coat) << json;
    EXPECT_EQ(coat.error().code, ErrorCode::InputMalformed) << json;
    for (const char* word : words) EXPECT_NE(coat.error().message.find(word), std::string::npos) << coat.error().message;
  }
}

TEST(CoatFile, NamesAndFiles) {
  const Folder folder;
  const std::string file = folder.Write("mine.json", R"({"length": 0.125})").string();
  ASSERT_TRUE(LoadCoat(file));
  EXPECT_EQ(LoadCoat(file)->length, 0.125);
  const Result<fur::Coat> unknown = LoadCoat("zebra"), missing = LoadCoat((folder / "no.json").string());
  ASSERT_FALSE(unknown);
  EXPECT_EQ(unknown.error().code, ErrorCode::Usage);
  for (const char* word : {"zebra", "house-cat", "husky"})
    EXPECT_NE(unknown.error().message.find(word), std::string::npos) << unknown.error().message;
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::InputMissing);
}

// A coat is whole: what it does not say is the default, but where a model's fur is stays the model's.
TEST(CoatFile, IsWornWhole) {
  FurParams own;
  own.wetness = 0.5, own.shells = 7, own.layerUvScale = 3, own.heightFalloff = 1, own.layers = {"a.png"};
  own.lengthMap = "length.png", own.furlessMap = "bald.png", own.directionMap = "combed.png", own.enabled = false;
  const fur::Coat coat = Parsed(R"({"length": 0.1, "groom": {"clumping": 0.25}})");
  FurParams expected;
  expected.length = 3, expected.clumping = 0.25, expected.enabled = false;
  expected.lengthMap = "length.png", expected.furlessMap = "bald.png", expected.directionMap = "combed.png";
  EXPECT_EQ(Wear(coat, own, 30), expected);
}

// Its own tile decides how wide strands are: a tile twice as wide needs half as many.
TEST(CoatFile, TilesFollowTheCoat) {
  const auto tiles = [](const fur::Coat& coat) {
    Model model = MakeBuiltinAnimal();
    EXPECT_TRUE(GroomModel({.coat = &coat}, &model));
    return model.materials[0].fur->params.layerUvScale;
  };
  const std::string small = R"("size": 8, "layers": 2, "under": {"density": 1}, "over": {"density": 1})";
  const fur::Coat narrow = Parsed(R"({"length": 0.01, "strands": {"tile": 2, )" + small + "}}");
  const fur::Coat wide = Parsed(R"({"length": 0.01, "strands": {"tile": 8, )" + small + "}}");
  EXPECT_NEAR(tiles(narrow) / tiles(wide), 4, 0.2);
}

}  // namespace
}  // namespace fur::test
