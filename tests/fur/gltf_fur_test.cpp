// Which materials grow fur, and where the parameters come from.
#include "gltf_builder.h"

namespace fur::test {
namespace {

// Three squares with the materials Body, Eye, Paw.
class GltfFur : public testing::Test {
 protected:
  void SetUp() override {
    b = Square();
    Primitive0(b)["attributes"]["TEXCOORD_0"] = b.Floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
    b.json["materials"] = Json::parse(R"([{"name": "Body"}, {"name": "Eye"}, {"name": "Paw"}])");
    const Json primitive = Primitive0(b);
    b.json["meshes"][0]["primitives"] = Json::array({primitive, primitive, primitive});
    for (int i = 0; i < 3; ++i) b.json["meshes"][0]["primitives"][i]["material"] = i;
  }
  LoadOptions File(const std::string& json) const {
    LoadOptions options;
    options.furFile = folder.Write("groom/fur.json", json);
    return options;
  }
  // Names of the furred materials, or the error.
  std::string Furred(const LoadOptions& options = {}) {
    const Result<Model> model = Load(folder, b, options);
    if (!model) return "error: " + model.error().message;
    ExpectSound(*model);
    std::string names;
    for (const Material& m : model->materials)
      if (m.fur) names += m.name + " ";
    return names;
  }
  FurParams Params(const LoadOptions& options, size_t material = 0) {
    const Result<Model> model = Load(folder, b, options);
    EXPECT_TRUE(model) << Message(model);
    if (!model || !model->materials[material].fur) return {};
    return model->materials[material].fur->params;
  }
  Json& Extras(int material) { return b.json["materials"][material]["extras"]["fur"]; }

  Folder folder;
  Builder b;
};

TEST_F(GltfFur, ChoosesMaterialsByTheFirstRuleThatFinds) {
  EXPECT_EQ(Furred(), "Body Eye Paw ");
  b.json["materials"][2]["name"] = "paw FURRY";
  EXPECT_EQ(Furred(), "paw FURRY ");
  Extras(1) = Json::object();
  EXPECT_EQ(Furred(), "Eye ");
  EXPECT_EQ(Furred(File(R"({"materials": {"Body": {}}})")), "Body Eye ");
  LoadOptions options = File("{}");
  options.furMaterial = "Body";
  EXPECT_EQ(Furred(options), "Body ");
  options.furMaterial = "Tail";
  ExpectError(Load(folder, b, options), ErrorCode::Usage, "\"Body\", \"Eye\", \"paw FURRY\"");
}

TEST_F(GltfFur, FalseAndDisabledMakeBald) {
  EXPECT_EQ(Furred(File(R"({"materials": {"Eye": false}})")), "Body Paw ");
  EXPECT_EQ(Furred(File(R"({"default": {"enabled": false}})")), "");
  EXPECT_EQ(Furred(File(R"({"default": {"enabled": false}, "materials": {"Paw": {"enabled": true}}})")), "Paw ");
  Extras(0) = {{"shells", 3}};
  EXPECT_EQ(Furred(File(R"({"materials": {"Body": false}})")), "Eye Paw ") << "no rule finds Body, all others remain";
}

TEST_F(GltfFur, LaterSourcesWin) {
  Extras(0) = Json::parse(R"({"shells": 1, "self_shadow": 0.1, "specular_scale": 0.1, "specular_power": 1})");
  LoadOptions options = File(R"({"default": {"self_shadow": 0.2, "specular_scale": 0.2, "specular_power": 2},
                                 "materials": {"Body": {"specular_scale": 0.3, "specular_power": 3}}})");
  options.furOverrides = R"({"specular_power": 4})";
  const FurParams params = Params(options);
  EXPECT_EQ(params.shells, 1u);
  EXPECT_EQ(params.selfShadow, 0.2);
  EXPECT_EQ(params.specularScale, 0.3);
  EXPECT_EQ(params.specularPower, 4);
}

// Every pair of the six sources, each with a wetness of its own; and each alone against the default.
TEST_F(GltfFur, OfTwoSourcesTheLaterOneWins) {
  const auto drawn = [&](uint32_t sources) {
    const auto wet = [](int source) { return nlohmann::json{{"wetness", 0.1 * source}}; };
    const auto has = [&](int source) { return (sources >> source & 1) != 0; };
    b.json["materials"][0].erase("extras");
    if (has(2)) Extras(0) = wet(2);
    nlohmann::json file = nlohmann::json::object();
    Coat coat;
    coat.strands.size = 8, coat.strands.layers = 2;  // what it grows does not matter here
    coat.groom.wetness = 0.1 * 3;
    if (has(4)) file["default"] = wet(4);
    if (has(5)) file["materials"]["Body"] = wet(5);
    LoadOptions options = File(file.dump());
    if (has(3)) options.coat = &coat;
    if (has(6)) options.furOverrides = wet(6).dump();
    return Params(options).wetness;
  };
  EXPECT_EQ(drawn(0), 0);
  for (int later = 2; later <= 6; ++later)
    for (int earlier = 1; earlier < later; ++earlier)
      EXPECT_EQ(drawn(1u << later | 1u << earlier), 0.1 * later) << earlier << " and " << later;
}

// A coat that a program gave its model counts as the earliest source.
TEST_F(GltfFur, GroomsACoatThatIsThere) {
  Model model;
  model.materials = {{.name = "Body"}, {.name = "Eye"}};
  model.volumes = {{"own", 1, 1, 1, {128, 128, 255, 9}}};
  model.materials[0].fur = MaterialFur{.volume = 0};
  model.materials[0].fur->params.wetness = 0.1;
  model.materials[0].fur->params.clumping = 0.4;
  LoadOptions options = File(R"({"default": {"wetness": 0.3}})");
  ASSERT_TRUE(GroomModel(options, &model));
  EXPECT_EQ(model.materials[0].fur->params.wetness, 0.3);
  EXPECT_EQ(model.materials[0].fur->params.clumping, 0.4);
  EXPECT_EQ(model.materials[0].fur->volume, 0);
  EXPECT_FALSE(model.materials[1].fur);
  options.furOverrides = R"({"wetness": 0.5})";
  ASSERT_TRUE(GroomModel(options, &model));
  EXPECT_EQ(model.materials[0].fur->params.wetness, 0.5);
  EXPECT_FALSE(GroomModel(File(R"({"default": {"wet": 1}})"), &model));
  ASSERT_TRUE(GroomModel(File(R"({"materials": {"Body": false, "Eye": {}}})"), &model));
  EXPECT_FALSE(model.materials[0].fur);
  EXPECT_TRUE(model.materials[1].fur);
}

// One furless map on two length maps makes two pictures, on one of them one.
TEST_F(GltfFur, FurlessMapMultipliesTheLength) {
  folder.WritePicture("spots.png", 2, 2, 40);
  folder.WritePicture("l.png", 1, 1, 200);
  Extras(0) = {{"furless_map", "spots.png"}};
  Extras(1) = {{"furless_map", "spots.png"}, {"length_map", "l.png"}};
  Extras(2) = Extras(1);
  const Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  EXPECT_EQ(model->images.size(), 4u);
  EXPECT_EQ(model->materials[1].fur->lengthMap, model->materials[2].fur->lengthMap);
  EXPECT_NE(model->materials[0].fur->lengthMap, model->materials[1].fur->lengthMap);
  EXPECT_EQ(model->images[size_t(model->materials[1].fur->lengthMap)].width, 2u);
  Extras(0) = {{"furless_map", "none.png"}};
  ExpectError(Load(folder, b), ErrorCode::InputMissing, "none.png");
}

TEST_F(GltfFur, RefusesBadFurFilesAndFlags) {
  const auto refused = [&](const std::string& json, const std::string& keyword) {
    ExpectError(Load(folder, b, File(json)), ErrorCode::InputMalformed, keyword);
    ExpectError(Load(folder, b, File(json)), ErrorCode::InputMalformed, "fur.json");
  };
  refused(R"({"shells": 3})", "\"shells\" is not known here");
  refused(R"({"materials": {"Tail": {}}})", "no material \"Tail\"");
  refused(R"({"materials": {"Body": true}})", "materials.Body");
  refused(R"({"materials": []})", "must be an object");
  refused(R"({"default": {"shell": 3}})", "\"shell\"");
  refused(R"({"materials": {"Body": {"shells": -3}}})", "materials.Body");
  refused("[", "not valid JSON");
  refused("[]", "must be a JSON object");
  LoadOptions options;
  options.furFile = folder / "none.json";
  ExpectError(Load(folder, b, options), ErrorCode::InputMissing, "none.json");
  options.furFile.clear();
  for (const char* flags : {"{", "[]", R"({"shells": "x"})", R"({"nothing": 1})"}) {
    options.furOverrides = flags;
    ExpectError(Load(folder, b, options), ErrorCode::Usage, "fur flags");
  }
}

TEST_F(GltfFur, FindsFilesBesideWhoNamesThemOrBesideTheModel) {
  folder.WritePicture("at_model.png", 1, 1, 1);
  folder.WritePicture("both.png", 1, 1, 2);
  folder.WritePicture("groom/both.png", 3, 1, 3);
  Extras(0) = {{"length_map", "both.png"}};
  const auto width = [&](const LoadOptions& options) {
    const Result<Model> model = Load(folder, b, options);
    EXPECT_TRUE(model) << Message(model);
    return model ? model->images[model->materials[0].fur->lengthMap].width : 0;
  };
  EXPECT_EQ(width({}), 1u) << "extras: beside the model";
  EXPECT_EQ(width(File(R"({"default": {"shells": 3}})")), 1u) << "another source's file does not move it";
  EXPECT_EQ(width(File(R"({"default": {"length_map": "both.png"}})")), 3u);
  EXPECT_EQ(width(File(R"({"default": {"length_map": "at_model.png"}})")), 1u);
  EXPECT_EQ(width(File(R"({"default": {"length_map": "../both.png"}})")), 1u);
  EXPECT_EQ(width(File(R"({"default": {"length_map": ")" + (folder / "both.png").string() + R"("}})")), 1u);
  ExpectError(Load(folder, b, File(R"({"default": {"direction_map": "no.png"}})")), ErrorCode::InputMissing, "no.png");
}

TEST_F(GltfFur, ReadsEachFileOnceAndSharesVolumes) {
  folder.WritePicture("l.png", 2, 2, 9);
  folder.WritePicture("0.png", 2, 2, 9);
  folder.WritePicture("1.png", 2, 2, 8);
  for (int i = 0; i < 2; ++i)
    Extras(i) = {{"length_map", "l.png"}, {"direction_map", "l.png"}, {"layers", {"0.png", "1.png"}}};
  Extras(2) = Json::object();
  const Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  EXPECT_EQ(model->images.size(), 1u);
  EXPECT_EQ(model->volumes.size(), 2u);
  EXPECT_EQ(model->materials[0].fur->volume, model->materials[1].fur->volume);
  EXPECT_EQ(model->volumes[model->materials[0].fur->volume].layers, 2u);
  folder.WritePicture("1.png", 4, 2, 8);
  ExpectError(Load(folder, b), ErrorCode::InputMalformed, "1.png");
}

TEST_F(GltfFur, WarnsOfALoneSolidLastLayerAndKeepsIt) {
  folder.WritePicture("0.png", 2, 2, 100);
  folder.WritePicture("1.png", 2, 2, 255);
  Extras(0) = {{"layers", {"0.png", "1.png"}}};
  Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  EXPECT_EQ(model->volumes[0].pixels[3], 100);
  EXPECT_EQ(model->volumes[0].pixels[19], 255);
  EXPECT_TRUE(HasWarning(*model, "last fur layer"));
  Extras(0) = {{"layers", {"1.png", "1.png"}}};  // no alpha at all: coverage 1 is meant
  model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  EXPECT_FALSE(HasWarning(*model, "last fur layer"));
}

TEST_F(GltfFur, DefaultLengthAndTilesFollowTheModelsSize) {
  const FurParams params = Params({});
  const double diameter = std::sqrt(2.0);
  EXPECT_NEAR(params.length, 0.025 * diameter, 1e-9);
  // The square's UVs cover it once: a UV unit is one long, a tile covers four lengths.
  EXPECT_EQ(params.layerUvScale, std::round(1 / (4 * 0.025 * diameter)));
  b.json["nodes"][0]["scale"] = {20, 20, 20};
  EXPECT_NEAR(Params({}).length, 0.025 * diameter, 1e-9) << "in the primitive's own units";
  EXPECT_EQ(Params({}).layerUvScale, params.layerUvScale);
  EXPECT_EQ(Params(File(R"({"default": {"length_scale": 100}})")).layerUvScale, 1);
  EXPECT_EQ(Params(File(R"({"default": {"layer_uv_scale": 7.5}})")).layerUvScale, 7.5);
}

TEST_F(GltfFur, GrowsOnTheDefaultMaterial) {
  b = Square();
  EXPECT_EQ(Furred(), "default ");
  LoadOptions options;
  options.furMaterial = "default";
  EXPECT_EQ(Furred(options), "default ");
}

}  // namespace
}  // namespace fur::test
