// The models that SOURCE.md files describe: counts and facts as stated there.

#include "assets.h"
#include "gltf_builder.h"

namespace fur::test {
namespace {

class GltfAssets : public testing::Test {
 protected:
  void SetUp() override {
    std::error_code failed;
    if (!std::filesystem::exists(AssetsDir() / "cat", failed))
      GTEST_SKIP() << "no test models in '" << AssetsDir().string() << "'; set FUR_ASSETS";
  }
  Result<Model> LoadAsset(const std::string& name) { return LoadGltf(AssetsDir() / name); }
};

size_t Triangles(const Primitive& p) { return p.indices.size() / 3; }

std::string FurredNames(const Model& model) {
  std::string names;
  for (const Material& m : model.materials)
    if (m.fur) names += m.name + ";";
  return names;
}

TEST_F(GltfAssets, Cat) {
  const Result<Model> model = LoadAsset("cat/cat.gltf");
  ASSERT_TRUE(model) << Message(model);
  ExpectSound(*model);
  ASSERT_EQ(model->primitives.size(), 2u);
  EXPECT_EQ(model->primitives[0].vertices.size(), 888u);
  EXPECT_EQ(Triangles(model->primitives[0]), 998u);
  EXPECT_EQ(model->primitives[1].vertices.size(), 2290u);
  EXPECT_EQ(Triangles(model->primitives[1]), 2956u);
  EXPECT_EQ(FurredNames(*model), "fur;");
  const MaterialFur& fur = *model->materials[1].fur;
  EXPECT_EQ(fur.params.length, 0.03);
  EXPECT_EQ(fur.params.layerUvScale, 50);
  EXPECT_EQ(fur.params.specularPower, 30);
  EXPECT_EQ(fur.params.specularScale, 0.35);
  EXPECT_EQ(fur.directionMap, -1);
  ASSERT_GE(fur.lengthMap, 0);
  EXPECT_EQ(model->images[fur.lengthMap].height, 1024u);
  const FurVolume& volume = model->volumes[fur.volume];
  EXPECT_EQ(volume.width, 128u);
  EXPECT_EQ(volume.layers, 16u);
  EXPECT_EQ(model->images.size(), 4u);
  int mirrored = 0;
  for (const Vertex& v : model->primitives[1].vertices) mirrored += v.tangent.w < 0 ? 1 : 0;
  EXPECT_EQ(mirrored, 43);
  const Bounds bounds = ComputeBounds(*model);
  EXPECT_NEAR(bounds.min.z, -1.269, 1e-3);
  EXPECT_NEAR(bounds.max.y, 1.829, 1e-3);
}

// The cat carries tangents made elsewhere: ours must agree wherever no mirrored triangle meets an unmirrored one.
TEST_F(GltfAssets, MadeTangentsAgreeWithTheCats) {
  const Result<Model> given = LoadAsset("cat/cat.gltf");
  ASSERT_TRUE(given) << Message(given);
  std::ifstream in(AssetsDir() / "cat/cat.gltf");
  Json json = Json::parse(in);
  for (Json& primitive : json["meshes"][0]["primitives"]) primitive["attributes"].erase("TANGENT");
  json["buffers"][0]["uri"] = std::filesystem::absolute(AssetsDir() / "cat/cat.bin").string();
  json.erase("materials");
  for (Json& primitive : json["meshes"][0]["primitives"]) primitive.erase("material");
  const Folder folder;
  const Result<Model> made = LoadText(folder, json.dump());
  ASSERT_TRUE(made) << Message(made);
  for (size_t p = 0; p < 2; ++p) {
    const auto &a = given->primitives[p].vertices, &b = made->primitives[p].vertices;
    ASSERT_EQ(a.size(), b.size());
    size_t sameSide = 0, sameDirection = 0;
    for (size_t i = 0; i < a.size(); ++i) {
      sameSide += a[i].tangent.w == b[i].tangent.w ? 1 : 0;
      sameDirection += glm::dot(glm::vec3(a[i].tangent), glm::vec3(b[i].tangent)) > 0.9f ? 1 : 0;
    }
    const double all = static_cast<double>(a.size());
    EXPECT_GT(static_cast<double>(sameSide) / all, p == 0 ? 0.7 : 0.97) << p;
    EXPECT_GT(static_cast<double>(sameDirection) / all, p == 0 ? 0.7 : 0.9) << p;
  }
}

TEST_F(GltfAssets, FoxGetsSmoothNormals) {
  const Result<Model> model = LoadAsset("fox/fox.glb");
  ASSERT_TRUE(model) << Message(model);
  ExpectSound(*model);
  ASSERT_EQ(model->primitives.size(), 1u);
  const Primitive& p = model->primitives[0];
  EXPECT_EQ(p.vertices.size(), 1728u);
  EXPECT_EQ(Triangles(p), 576u);
  ASSERT_EQ(model->images.size(), 1u);
  EXPECT_EQ(model->images[0].width, 1024u);
  size_t smooth = 0;
  for (size_t i = 0; i < p.vertices.size(); i += 3) smooth += p.vertices[i].normal != p.vertices[i + 1].normal ? 1 : 0;
  EXPECT_GT(smooth, 500u) << "flat normals would be the same on all three corners";
  const double diameter = ComputeBounds(*model).Diameter();
  EXPECT_GT(diameter, 100);
  EXPECT_LT(diameter, 250);
}

TEST_F(GltfAssets, HuskyGetsTextureCoordinates) {
  const Result<Model> model = LoadAsset("husky/husky.glb");
  ASSERT_TRUE(model) << Message(model);
  ExpectSound(*model);
  ASSERT_EQ(model->primitives.size(), 5u);
  size_t triangles = 0;
  for (const Primitive& p : model->primitives) triangles += Triangles(p);
  EXPECT_EQ(triangles, 1920u);
  EXPECT_TRUE(HasWarning(*model, "box projection"));
  for (const Primitive& p : model->primitives)
    for (const Vertex& v : p.vertices) EXPECT_LE(glm::length(v.uv), 2);
  const double diameter = ComputeBounds(*model).Diameter();
  EXPECT_GT(diameter, 1) << "the skin scales the mesh by 100";
  EXPECT_LT(diameter, 10);
}

TEST_F(GltfAssets, PlushyToyGrowsFurOnItsBodyOnly) {
  const Result<Model> model = LoadAsset("plushy_toy/plushy_toy.gltf");
  ASSERT_TRUE(model) << Message(model);
  ExpectSound(*model);
  ASSERT_EQ(model->primitives.size(), 4u);
  size_t triangles = 0, vertices = 0;
  for (const Primitive& p : model->primitives) triangles += Triangles(p), vertices += p.vertices.size();
  EXPECT_EQ(triangles, 15928u);
  EXPECT_EQ(vertices, 9711u);
  EXPECT_EQ(FurredNames(*model), "Fur Body;");
  const double diameter = ComputeBounds(*model).Diameter();
  EXPECT_NEAR(model->materials[3].fur->params.length * 30.48, 0.025 * diameter, 1e-6);
}

TEST_F(GltfAssets, SpotSuzanneAndTorus) {
  const struct {
    const char* file;
    size_t vertices, triangles;
    const char* furred;
  } cases[] = {{"spot/spot.glb", 3225, 5856, "spot;"},
               {"suzanne/suzanne.glb", 7872, 3936, "default;"},
               {"torus/torus.gltf", 1666, 3072, "default;"}};
  for (const auto& c : cases) {
    const Result<Model> model = LoadAsset(c.file);
    ASSERT_TRUE(model) << Message(model);
    ExpectSound(*model);
    ASSERT_EQ(model->primitives.size(), 1u);
    EXPECT_EQ(model->primitives[0].vertices.size(), c.vertices) << c.file;
    EXPECT_EQ(Triangles(model->primitives[0]), c.triangles) << c.file;
    EXPECT_EQ(FurredNames(*model), c.furred);
  }
}

}  // namespace
}  // namespace fur::test
