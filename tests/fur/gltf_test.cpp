// What a sound file becomes: geometry, hierarchy, skins, attributes that are made.
#include "fur/gltf.h"

#include "gltf_builder.h"

namespace fur::test {
namespace {

TEST(Gltf, ReadsTheSquareAsTextAndAsGlb) {
  const Folder folder;
  const Builder b = Square();
  const Result<Model> text = Load(folder, b);
  const Result<Model> glb = LoadGltf(folder.Write("square.bin_in_disguise", b.Glb()));
  for (const Result<Model>* result : {&text, &glb}) {
    ASSERT_TRUE(*result) << Message(*result);
    const Model& model = **result;
    ExpectSound(model);
    ASSERT_EQ(model.primitives.size(), 1u);
    EXPECT_EQ(model.primitives[0].vertices.size(), 4u);
    EXPECT_EQ(model.primitives[0].indices, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_NEAR(ComputeBounds(model).Diameter(), std::sqrt(2.0), 1e-6);
    EXPECT_EQ(model.primitives[0].vertices[0].normal, glm::vec3(0, 0, 1));
    EXPECT_TRUE(HasWarning(model, "box projection"));
  }
}

TEST(Gltf, ReadsExternalBufferWithEscapedName) {
  const Folder folder;
  Builder b = Square();
  Json json = b.json;
  json["buffers"] = Json::array({{{"byteLength", b.blob.size()}, {"uri", "sub%20folder/../sub%20folder/a.bin"}}});
  folder.Write("sub folder/a.bin", b.blob);
  const Result<Model> model = LoadText(folder, json.dump());
  ASSERT_TRUE(model) << Message(model);
  std::filesystem::remove(folder / "sub folder/a.bin");
  ExpectError(LoadText(folder, json.dump()), ErrorCode::InputMissing, "a.bin");
}

TEST(Gltf, DoesNotLookForBuffersInTheCurrentFolder) {
  const Folder folder;
  Builder b = Square();
  b.json["buffers"] = Json::array({{{"byteLength", b.blob.size()}, {"uri", "only_here.bin"}}});
  folder.Write("only_here.bin", b.blob);
  const std::filesystem::path model = folder.Write("sub/model.gltf", b.json.dump());
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.Path());
  const Result<Model> result = LoadGltf(model);
  std::filesystem::current_path(before);
  ExpectError(result, ErrorCode::InputMissing, "only_here.bin");
}

TEST(Gltf, MissingFileAndFolder) {
  const Folder folder;
  ExpectError(LoadGltf(folder / "none.gltf"), ErrorCode::InputMissing, "none.gltf");
  ExpectError(LoadGltf(folder.Path()), ErrorCode::InputMissing, "regular file");
}

TEST(Gltf, TurnsStripsAndFansIntoTriangles) {
  const Folder folder;
  Builder b = Square();
  b.json["accessors"][1]["count"] = 4;  // indices 0 1 2 0
  Primitive0(b)["mode"] = 5;
  Result<Model> strip = Load(folder, b);
  ASSERT_TRUE(strip) << Message(strip);
  Primitive0(b).erase("indices");
  strip = Load(folder, b);
  ASSERT_TRUE(strip) << Message(strip);
  EXPECT_EQ(strip->primitives[0].indices.size(), 6u);
  Primitive0(b)["mode"] = 6;
  const Result<Model> fan = Load(folder, b);
  ASSERT_TRUE(fan) << Message(fan);
  for (const Vertex& v : fan->primitives[0].vertices) EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
}

TEST(Gltf, StripKeepsItsWinding) {
  const Folder folder;
  Builder b;
  const int positions = b.Floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0}, "VEC3", 3);
  b.Push("meshes", {{"primitives", Json::array({{{"attributes", {{"POSITION", positions}}}, {"mode", 5}}})}});
  b.Push("nodes", {{"mesh", 0}});
  const Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  const Primitive& p = model->primitives[0];
  ASSERT_EQ(p.indices.size(), 9u);
  for (size_t i = 0; i < 9; i += 3) {
    const glm::vec3 a = p.vertices[p.indices[i]].position;
    EXPECT_GT(glm::cross(p.vertices[p.indices[i + 1]].position - a, p.vertices[p.indices[i + 2]].position - a).z, 0);
  }
}

TEST(Gltf, ReadsIndicesOfAllWidths) {
  const Folder folder;
  Builder b = Square();
  Primitive0(b)["indices"] = b.Accessor(std::vector<uint8_t>{0, 1, 2, 0, 2, 3}, 5121, "SCALAR", 1);
  ASSERT_TRUE(Load(folder, b));
  Primitive0(b)["indices"] = b.Accessor(std::vector<uint32_t>{0, 1, 2, 0, 2, 3}, 5125, "SCALAR", 1);
  const Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  EXPECT_EQ(model->primitives[0].indices, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3}));
}

TEST(Gltf, AppliesSparseAccessors) {
  const Folder folder;
  Builder b = Square();
  const int indices = b.View(std::vector<uint8_t>{1, 3});
  const int values = b.View(std::vector<float>{5, 0, 0, 0, 7, 0});
  b.json["accessors"][0]["sparse"] = {{"count", 2},
                                      {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                                      {"values", {{"bufferView", values}}}};
  Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  EXPECT_NEAR(ComputeBounds(*model).max.x, 5, 1e-6);
  EXPECT_NEAR(ComputeBounds(*model).max.y, 7, 1e-6);
  b.json["accessors"][0].erase("bufferView");  // the rest is zero
  model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  EXPECT_NEAR(ComputeBounds(*model).max.x, 5, 1e-6);
}

TEST(Gltf, ReadsNormalizedIntegersAndStrides) {
  const Folder folder;
  Builder b = Square();
  // Normals as bytes and UVs as shorts, interleaved: 4 + 4 bytes a vertex.
  std::vector<int16_t> mixed;
  for (int i = 0; i < 4; ++i) mixed.insert(mixed.end(), {0x7F00 - 0x7F00, 0x007F, int16_t(-1), 0x7FFF});
  const int view = b.View(mixed);
  b.json["bufferViews"][view]["byteStride"] = 8;
  Primitive0(b)["attributes"]["NORMAL"] =
      b.Push("accessors",
             {{"bufferView", view}, {"componentType", 5120}, {"normalized", true}, {"count", 4}, {"type", "VEC3"}});
  Primitive0(b)["attributes"]["TEXCOORD_0"] = b.Push("accessors", {{"bufferView", view},
                                                                   {"byteOffset", 4},
                                                                   {"componentType", 5123},
                                                                   {"normalized", true},
                                                                   {"count", 4},
                                                                   {"type", "VEC2"}});
  const Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  const Vertex& v = model->primitives[0].vertices[3];
  EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
  EXPECT_FLOAT_EQ(v.uv.x, 1.0f);
  EXPECT_NEAR(v.uv.y, 0x7FFF / 65535.0, 1e-6);
}

TEST(Gltf, ComposesTheHierarchyAndSharesPrimitives) {
  const Folder folder;
  Builder b = Square();
  b.json["nodes"] = Json::parse(R"([
    {"children": [1, 2], "translation": [10, 0, 0]},
    {"mesh": 0, "scale": [2, 2, 2], "rotation": [0, 0, 0.70710678118654752, 0.70710678118654752]},
    {"mesh": 0, "matrix": [1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,5,1]}, {"mesh": 0}])");
  const Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  EXPECT_EQ(model->primitives.size(), 1u);
  ASSERT_EQ(model->parts.size(), 2u);  // node 3 is not in the scene
  const glm::dvec4 p = model->parts[0].transform * glm::dvec4(1, 0, 0, 1);
  EXPECT_NEAR(p.x, 10, 1e-9);
  EXPECT_NEAR(p.y, 2, 1e-9);
  EXPECT_NEAR((model->parts[1].transform * glm::dvec4(0, 0, 0, 1)).z, 5, 1e-9);
  Builder all = b;
  all.json.erase("scene");
  all.json.erase("scenes");
  const Result<Model> roots = Load(folder, all);
  ASSERT_TRUE(roots) << Message(roots);
  EXPECT_EQ(roots->parts.size(), 3u);
}

TEST(Gltf, ReadsAVeryDeepHierarchy) {
  const Folder folder;
  Builder b = Square();
  constexpr int kDepth = 100000;
  b.json["nodes"] = Json::array();
  for (int i = 0; i < kDepth; ++i) b.Push("nodes", {{"children", {i + 1}}});
  b.Push("nodes", {{"mesh", 0}});
  EXPECT_TRUE(Load(folder, b));
}

Builder SkinnedSquare() {
  Builder b = Square();
  b.json["nodes"] = Json::parse(R"([{"mesh": 0, "skin": 0, "translation": [100, 0, 0]},
                                    {"translation": [0, 0, 3]}, {"translation": [0, 4, 0]}])");
  b.json["scenes"][0]["nodes"] = {0, 1, 2};
  std::vector<float> inverse(32, 0.0f);
  for (size_t i = 0; i < 16; i += 5) inverse[i] = inverse[16 + i] = 1;
  inverse[14] = -1;  // joint 0: one back along z
  const int matrices = b.Floats(inverse, "MAT4", 16);
  b.Push("skins", {{"joints", {1, 2}}, {"inverseBindMatrices", matrices}});
  auto& attributes = Primitive0(b)["attributes"];
  attributes["JOINTS_0"] =
      b.Accessor(std::vector<uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0}, 5121, "VEC4", 4);
  attributes["WEIGHTS_0"] = b.Floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0, 0.25, 0.25, 0, 0}, "VEC4", 4);
  return b;
}

TEST(Gltf, AppliesSkinsAtRest) {
  const Folder folder;
  const Result<Model> model = Load(folder, SkinnedSquare());
  ASSERT_TRUE(model) << Message(model);
  ExpectSound(*model);
  EXPECT_EQ(model->parts[0].transform, glm::dmat4(1));
  // Box projection may renumber vertices; the corners are looked up by position.
  const auto has = [&](const glm::vec3& p) {
    for (const Vertex& v : model->primitives[0].vertices)
      if (glm::distance(v.position, p) < 1e-5f) return true;
    return false;
  };
  EXPECT_TRUE(has({0, 0, 2}));  // joint 0: 3 - 1 along z
  EXPECT_TRUE(has({1, 4, 0}));  // joint 1
  EXPECT_TRUE(has({1, 3, 1}));  // half of each
  EXPECT_TRUE(has({0, 3, 1}));  // weights that sum to a half are made whole
}

TEST(Gltf, RefusesBrokenSkins) {
  const Folder folder;
  Builder b = SkinnedSquare();
  b.json["skins"][0]["joints"] = {1};
  ExpectError(Load(folder, b), ErrorCode::InputMalformed, "joint 1 of 1");
  b = SkinnedSquare();
  b.json["accessors"][2]["count"] = 1;
  ExpectError(Load(folder, b), ErrorCode::InputMalformed, "inverse bind");
  b = SkinnedSquare();
  b.json["skins"][0]["joints"] = Json::array();
  ExpectError(Load(folder, b), ErrorCode::InputMalformed, "no joints");
  b = SkinnedSquare();
  Primitive0(b)["attributes"].erase("WEIGHTS_0");
  ExpectError(Load(folder, b), ErrorCode::InputMalformed, "WEIGHTS_0");
  b = SkinnedSquare();
  b.json["skins"][0]["inverseBindMatrices"] = 0;
  ExpectError(Load(folder, b), ErrorCode::InputMalformed, "4x4");
}

TEST(Gltf, RepairsNormalsAndTangents) {
  const Folder folder;
  Builder b = Square();
  const float nan = std::nanf("");
  auto& attributes = Primitive0(b)["attributes"];
  attributes["NORMAL"] = b.Floats({0, 0, 0, nan, 0, 0, 0, 0, 3, 0, 0, 1}, "VEC3", 3);
  attributes["TANGENT"] = b.Floats({0, 0, 0, 1, 1, 0, 0, -1, 0, 0, 1, 1, nan, 0, 0, 1}, "VEC4", 4);
  attributes["TEXCOORD_0"] = b.Floats({0, 0, 1, 0, 1, 1, nan, 1}, "VEC2", 2);
  const Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  ExpectSound(*model);
  for (const Vertex& v : model->primitives[0].vertices) EXPECT_EQ(v.normal, glm::vec3(0, 0, 1));
  EXPECT_EQ(model->primitives[0].vertices[1].tangent, glm::vec4(1, 0, 0, -1));  // taken as it is
  EXPECT_EQ(model->primitives[0].vertices[3].uv, glm::vec2(0));
  EXPECT_TRUE(HasWarning(*model, "2 of 4 normals"));
  EXPECT_TRUE(HasWarning(*model, "3 of 4 tangents"));
  EXPECT_TRUE(HasWarning(*model, "1 texture coordinates"));
}

TEST(Gltf, MakesTangentsWithHandedness) {
  const Folder folder;
  Builder b = Square();
  // A picture's top is v = 0, so that v = 1 - y lies the right way round.
  Primitive0(b)["attributes"]["TEXCOORD_0"] = b.Floats({0, 1, 1, 1, 1, 0, 0, 0}, "VEC2", 2);
  Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  for (const Vertex& v : model->primitives[0].vertices) EXPECT_EQ(v.tangent, glm::vec4(1, 0, 0, 1));
  Primitive0(b)["attributes"]["TEXCOORD_0"] = b.Floats({1, 1, 0, 1, 0, 0, 1, 0}, "VEC2", 2);  // mirrored
  model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  for (const Vertex& v : model->primitives[0].vertices) EXPECT_EQ(v.tangent, glm::vec4(-1, 0, 0, -1));
  Primitive0(b)["attributes"]["TEXCOORD_0"] = b.Floats({1, 1, 1, 1, 1, 1, 1, 1}, "VEC2", 2);  // one point
  model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  ExpectSound(*model);
}

TEST(Gltf, BoxProjectionSplitsAndDoesNotStretch) {
  const Folder folder;
  Builder b;
  // A cube's corner: three faces that share their vertices, seen from outside.
  const int positions = b.Floats({0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2}, "VEC3", 3);
  const int indices =
      b.Accessor(std::vector<uint8_t>{0, 2, 1, 0, 3, 2, 0, 1, 3, 1, 2, 3}, 5121, "SCALAR", 1);  // a closed tetrahedron
  b.Push("meshes", {{"primitives", Json::array({{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}})}});
  b.Push("nodes", {{"mesh", 0}, {"scale", {3, 3, 3}}});
  const Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  ExpectSound(*model);
  const Primitive& p = model->primitives[0];
  EXPECT_GT(p.vertices.size(), 4u);
  const double diameter = 2 * std::sqrt(3.0);  // the scale cancels out
  for (size_t i = 0; i < p.indices.size(); i += 3) {
    const Vertex &v0 = p.vertices[p.indices[i]], &v1 = p.vertices[p.indices[i + 1]], &v2 = p.vertices[p.indices[i + 2]];
    const double area = glm::length(glm::cross(v1.position - v0.position, v2.position - v0.position));
    const glm::vec2 e1 = v1.uv - v0.uv, e2 = v2.uv - v0.uv;
    const double uvArea = e1.x * e2.y - e1.y * e2.x;
    EXPECT_LT(uvArea, 0) << "v grows downwards, so that an unmirrored triangle turns the other way in UV space";
    const double ratio = std::abs(uvArea) * diameter * diameter / area;
    EXPECT_LE(ratio, 1.0001);
    EXPECT_GE(ratio, 0.577);
  }
  for (const Vertex& v : p.vertices) EXPECT_EQ(v.tangent.w, 1.0f);
}

TEST(Gltf, LeavesOutPointsLinesAndEmptyPrimitives) {
  const Folder folder;
  Builder b = Square();
  Json lines = Primitive0(b), empty = Primitive0(b);
  lines["mode"] = 1;
  empty["indices"] =
      b.Push("accessors", {{"bufferView", 1}, {"componentType", 5123}, {"count", 0}, {"type", "SCALAR"}});
  b.json["meshes"][0]["primitives"].push_back(lines);
  b.json["meshes"][0]["primitives"].push_back(empty);
  const Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  EXPECT_EQ(model->parts.size(), 1u);
  EXPECT_TRUE(HasWarning(*model, "points or lines"));
  EXPECT_TRUE(HasWarning(*model, "no triangles"));
  b.json["meshes"][0]["primitives"].erase(0);
  ExpectError(Load(folder, b), ErrorCode::InputMalformed, "no triangles");
}

TEST(Gltf, ReadsMaterials) {
  const Folder folder;
  Builder b = Square();
  folder.WritePicture("a b.png", 3, 2, 200);
  b.json["images"] = Json::parse(R"([{"uri": "a%20b.png"}, {"uri": "unused_and_missing.png"}])");
  b.json["samplers"] = Json::parse(R"([{"wrapS": 33071, "wrapT": 33648}])");
  b.json["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}, {"source": 0}])");
  b.json["materials"] = Json::parse(R"([{"name": "m", "doubleSided": true,
    "pbrMetallicRoughness": {"baseColorFactor": [0.1, 0.2, 0.3, 0.4], "metallicFactor": 0.5, "roughnessFactor": 0.25,
      "baseColorTexture": {"index": 0, "texCoord": 1}},
    "normalTexture": {"index": 1, "scale": 0.5},
    "extensions": {"KHR_materials_specular": {"specularColorFactor": [0.5, 0.6, 0.7],
                                              "specularColorTexture": {"index": 1}}}}])");
  Primitive0(b)["material"] = 0;
  const Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  ExpectSound(*model);
  const Material& m = model->materials[0];
  EXPECT_EQ(m.name, "m");
  EXPECT_EQ(m.baseColor, glm::vec4(0.1f, 0.2f, 0.3f, 0.4f));
  EXPECT_EQ(m.specularColor, glm::vec3(0.5f, 0.6f, 0.7f));
  EXPECT_EQ(m.roughness, 0.25f);
  EXPECT_EQ(m.metallic, 0.5f);
  EXPECT_EQ(m.normalScale, 0.5f);
  EXPECT_TRUE(m.doubleSided);
  EXPECT_FALSE(m.baseColorTexture.wrapU);
  EXPECT_TRUE(m.baseColorTexture.wrapV && m.normalTexture.wrapU);
  ASSERT_EQ(model->images.size(), 1u);  // read once
  EXPECT_EQ(m.specularTexture.image, 0);
  EXPECT_EQ(model->images[0].width, 3u);
  EXPECT_TRUE(HasWarning(*model, "TEXCOORD_1"));
  EXPECT_TRUE(HasWarning(*model, "mirrored"));
}

TEST(Gltf, NamesMissingAndBrokenImages) {
  const Folder folder;
  Builder b = Square();
  b.json["images"] = Json::parse(R"([{"uri": "skin.png"}])");
  b.json["textures"] = Json::parse(R"([{"source": 0}])");
  b.json["materials"] = Json::parse(R"([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
  ExpectError(Load(folder, b), ErrorCode::InputMissing, "skin.png");
  folder.Write("skin.png", std::string("this is no picture"));
  ExpectError(Load(folder, b), ErrorCode::InputMalformed, "skin.png");
  folder.Write("skin.png", std::string());
  EXPECT_FALSE(Load(folder, b));
  b.json["images"][0] = {{"uri", "data:image/png;base64,AAAA"}};
  ExpectError(Load(folder, b), ErrorCode::InputMalformed, "images[0]");
  b.json["images"][0] = {{"uri", "data:image/png;base64,"}};
  EXPECT_FALSE(Load(folder, b));
  b.json["images"][0] = {{"bufferView", 0}, {"mimeType", "image/png"}};
  ExpectError(Load(folder, b), ErrorCode::InputMalformed, "images[0]");
  folder.WritePicture("good.png", 2, 2, 9);
  std::ifstream in(folder / "good.png", std::ios::binary);
  const Bytes png((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  b.json["images"][0]["bufferView"] = b.View(png);
  Result<Model> model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  b.json["images"][0] = {{"uri", "data:image/png;base64," + Base64(png)}};
  model = Load(folder, b);
  ASSERT_TRUE(model) << Message(model);
  EXPECT_EQ(model->images[0].pixels, Bytes(16, 9));
}

}  // namespace
}  // namespace fur::test
