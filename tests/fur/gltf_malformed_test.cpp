// A good file with one thing wrong at a time: one error that names it, never a crash.
#include <random>

#include "gltf_builder.h"

namespace fur::test {
namespace {

// Uses every kind of reference.
Builder Everything() {
  Builder b = Square();
  auto& attributes = Primitive0(b)["attributes"];
  attributes["NORMAL"] = b.Floats({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3);                 // accessor 2
  attributes["TANGENT"] = b.Floats({1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, "VEC4", 4);    // 3
  attributes["TEXCOORD_0"] = b.Floats({0, 0, 1, 0, 1, 1, 0, 1}, "VEC2", 2);                         // 4
  attributes["JOINTS_0"] = b.Accessor(std::vector<uint8_t>(16, 0), 5121, "VEC4", 4);                // 5
  attributes["WEIGHTS_0"] = b.Floats({1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, "VEC4", 4);  // 6
  b.Floats({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4", 16);                           // 7
  const int index = b.View(std::vector<uint8_t>{1});                                                // view 8
  const int value = b.View(std::vector<float>{1, 0, 0});                                            // view 9
  b.json["accessors"][0]["sparse"] = {
      {"count", 1}, {"indices", {{"bufferView", index}, {"componentType", 5121}}}, {"values", {{"bufferView", value}}}};
  b.json["skins"] = Json::parse(R"([{"joints": [1], "inverseBindMatrices": 7, "skeleton": 1}])");
  b.json["nodes"] = Json::parse(R"([{"mesh": 0, "skin": 0, "scale": [1, 1, 1]}, {"name": "joint", "children": [2]},
                                    {"mesh": 0}])");
  b.json["scenes"] = Json::parse(R"([{"nodes": [0, 1]}])");
  b.json["images"] = Json::parse(R"([{"uri": "picture.png"}])");
  b.json["samplers"] = Json::parse(R"([{"wrapS": 10497}])");
  b.json["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}])");
  b.json["materials"] = Json::parse(R"([{"name": "m", "normalTexture": {"index": 0},
    "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1], "baseColorTexture": {"index": 0}},
    "extensions": {"KHR_materials_specular": {"specularColorTexture": {"index": 0}}},
    "extras": {"fur": {"enabled": false}}}])");  // growing a coat would take longer than all the rest
  Primitive0(b)["material"] = 0;
  return b;
}

struct Mutation {
  const char* pointer;
  const char* value;  // JSON; nullptr: remove
  const char* keyword;
};

void PrintTo(const Mutation& m, std::ostream* out) { *out << m.pointer << " = " << (m.value ? m.value : "(removed)"); }

class GltfMalformed : public testing::TestWithParam<Mutation> {
 protected:
  void SetUp() override { folder_.WritePicture("picture.png", 2, 2, 255); }
  Folder folder_;
};

TEST_P(GltfMalformed, IsRefusedByName) {
  const Mutation& m = GetParam();
  Builder b = Everything();
  const Json::json_pointer pointer(m.pointer);
  if (m.value != nullptr)
    b.json[pointer] = Json::parse(m.value);
  else
    b.json[pointer.parent_pointer()].erase(pointer.back());
  ExpectError(Load(folder_, b), ErrorCode::InputMalformed, m.keyword);
  const Result<Model> glb = LoadGltf(folder_.Write("model.glb", b.Glb()));
  ExpectError(glb, ErrorCode::InputMalformed, m.keyword);
}

TEST_F(GltfMalformed, TheUnchangedFileLoads) {
  const Result<Model> model = Load(folder_, Everything());
  ASSERT_TRUE(model) << Message(model);
  ExpectSound(*model);
}

#define PRIMITIVE "/meshes/0/primitives/0"
INSTANTIATE_TEST_SUITE_P(
    References, GltfMalformed,
    testing::Values(
        Mutation{"/scene", "1", "scene refers to scenes[1]"}, Mutation{"/scene", "-1", "scene must be"},
        Mutation{"/scenes/0/nodes/0", "3", "nodes[3]"}, Mutation{"/scenes/0/nodes", "[0, 0, 1]", "twice"},
        Mutation{"/scenes/0/nodes", "[0, 2]", "not a root"}, Mutation{"/scenes/0/nodes", "{}", "scenes[0].nodes"},
        Mutation{"/scenes/0/nodes", "[]", "no triangles"}, Mutation{"/nodes/0/mesh", "9", "nodes[0].mesh"},
        Mutation{"/nodes/0/skin", "9", "nodes[0].skin"}, Mutation{"/nodes/1/children/0", "9", "nodes[1].children[0]"},
        Mutation{"/nodes/1/children", "[1]", "cycle"}, Mutation{"/nodes/2/children", "[1]", "cycle"},
        Mutation{"/nodes/0/children", "[2]", "two parents"}, Mutation{"/nodes/1/children", "[2, 2]", "two parents"},
        Mutation{PRIMITIVE "/material", "1", "material"}, Mutation{PRIMITIVE "/indices", "99", "indices"},
        Mutation{PRIMITIVE "/attributes/POSITION", "99", "POSITION"},
        Mutation{PRIMITIVE "/attributes/NORMAL", "-1", "NORMAL"},
        Mutation{PRIMITIVE "/attributes/NORMAL", "4294967298", "NORMAL"},
        Mutation{PRIMITIVE "/targets", R"([{"POSITION": 99}])", "targets[0].POSITION"},
        Mutation{"/accessors/0/bufferView", "99", "accessors[0].bufferView"},
        Mutation{"/accessors/0/sparse/indices/bufferView", "99", "sparse.indices.bufferView"},
        Mutation{"/accessors/0/sparse/values/bufferView", "99", "sparse.values.bufferView"},
        Mutation{"/bufferViews/0/buffer", "1", "bufferViews[0].buffer"}, Mutation{"/textures/0/source", "5", "source"},
        Mutation{"/textures/0/sampler", "5", "sampler"}, Mutation{"/images/0", R"({"bufferView": 99})", "bufferView"},
        Mutation{"/materials/0/normalTexture/index", "5", "normalTexture.index"},
        Mutation{"/materials/0/normalTexture/index", nullptr, "normalTexture.index is missing"},
        Mutation{"/materials/0/pbrMetallicRoughness/baseColorTexture/index", "5", "baseColorTexture"},
        Mutation{"/materials/0/extensions/KHR_materials_specular/specularColorTexture/index", "5", "specularColor"},
        Mutation{"/materials/0/occlusionTexture", R"({"index": 7})", "occlusionTexture"},
        Mutation{"/skins/0/joints/0", "77", "joints[0]"}, Mutation{"/skins/0/inverseBindMatrices", "77", "inverseBind"},
        Mutation{"/skins/0/skeleton", "77", "skeleton"}));

INSTANTIATE_TEST_SUITE_P(Ranges, GltfMalformed,
                         testing::Values(Mutation{"/accessors/0/count", "5", "accessors[0] needs 60 bytes"},
                                         Mutation{"/accessors/0/count", "2147483647", "too many"},
                                         Mutation{"/accessors/0/count", "4294967297", "count"},
                                         Mutation{"/accessors/0/count", "-4", "count"},
                                         Mutation{"/accessors/0/count", "1.5", "count"},
                                         Mutation{"/accessors/0/byteOffset", "1", "accessors[0] needs 49"},
                                         Mutation{"/accessors/0/byteOffset", "18446744073709551615", "byteOffset"},
                                         Mutation{"/accessors/0/byteOffset", "2147483647", "accessors[0] needs"},
                                         Mutation{"/accessors/2/count", "3", "NORMAL has 3 elements"},
                                         Mutation{"/accessors/0/componentType", "5124", "5124"},
                                         Mutation{"/accessors/0/componentType", "5130", "5130"},
                                         Mutation{"/accessors/0/type", "\"VEC5\"", "type"},
                                         Mutation{"/accessors/0/type", "\"VEC2\"", "POSITION"},
                                         Mutation{"/accessors/4/type", "\"VEC3\"", "accessors[4]"},
                                         Mutation{"/accessors/0/type", "3", "accessors[0].type"},
                                         Mutation{"/accessors/0/sparse/count", "5", "sparse.count"},
                                         Mutation{"/accessors/0/sparse/count", "2", "sparse.indices needs"},
                                         Mutation{"/accessors/0/sparse/indices/componentType", "5126", "unsigned"},
                                         Mutation{"/accessors/0/sparse/indices/byteOffset", "1", "sparse.indices"},
                                         Mutation{"/accessors/0/sparse/values/byteOffset", "4", "sparse.values"},
                                         Mutation{"/accessors/0/sparse/values", nullptr, "sparse.values"},
                                         Mutation{"/accessors/0/sparse", "[]", "accessors[0].sparse must be an object"},
                                         Mutation{"/bufferViews/0/byteLength", "47", "accessors[0] needs 48"},
                                         Mutation{"/bufferViews/0/byteLength", "1000000", "bufferViews[0] ends"},
                                         Mutation{"/bufferViews/0/byteLength", "0", "byteLength is 0"},
                                         Mutation{"/bufferViews/0/byteLength", nullptr, "byteLength is missing"},
                                         Mutation{"/bufferViews/0/byteOffset", "1000000", "bufferViews[0] ends"},
                                         Mutation{"/bufferViews/0/byteOffset", "18446744073709551600", "byteOffset"},
                                         Mutation{"/bufferViews/0/byteStride", "8", "byteStride"},
                                         Mutation{"/bufferViews/0/byteStride", "13", "byteStride"},
                                         Mutation{"/bufferViews/0/byteStride", "256", "byteStride"},
                                         Mutation{"/bufferViews/0/byteStride", "16", "accessors[0] needs 60"},
                                         Mutation{"/accessors/1/count", "5", "multiple of 3"},
                                         Mutation{"/accessors/1/componentType", "5126", "accessors[1]"},
                                         Mutation{"/accessors/1/componentType", "5122", "component type 5122"},
                                         Mutation{"/accessors/1/normalized", "true", "plain scalars"},
                                         Mutation{"/accessors/6/componentType", "5121", "not normalized"},
                                         Mutation{"/accessors/5/componentType", "5120", "JOINTS_0"},
                                         Mutation{"/accessors/7/type", "\"VEC4\"", "4x4"}));

INSTANTIATE_TEST_SUITE_P(
    Types, GltfMalformed,
    testing::Values(
        Mutation{"/asset", nullptr, "asset is missing"}, Mutation{"/asset/version", "\"1.0\"", "version 1.0"},
        Mutation{"/asset/version", "2.0", "asset.version"}, Mutation{"/nodes", "{}", "nodes must be an array"},
        Mutation{"/nodes/0", "[]", "nodes[0] must be an object"},
        Mutation{"/nodes/0/matrix", "[1, 2, 3]", "16 numbers"}, Mutation{"/nodes/0/scale", "[1, 1]", "scale"},
        Mutation{"/nodes/0/scale", "[1, 1, \"1\"]", "scale[2]"},
        Mutation{"/nodes/0/scale", "[1, 1, 1e300]", "float's range"}, Mutation{"/nodes/0/name", "5", "nodes[0].name"},
        Mutation{"/meshes/0", "7", "meshes[0]"}, Mutation{"/meshes/0/primitives", nullptr, "primitives is missing"},
        Mutation{"/meshes/0/primitives", "[]", "no triangles"},
        Mutation{"/meshes/0/primitives/0", "7", "primitives[0]"}, Mutation{PRIMITIVE "/mode", "7", "mode"},
        Mutation{PRIMITIVE "/mode", "\"4\"", "mode"}, Mutation{PRIMITIVE "/mode", "0", "no triangles"},
        Mutation{PRIMITIVE "/attributes", nullptr, "attributes"},
        Mutation{PRIMITIVE "/attributes", "{}", "no POSITION"},
        Mutation{PRIMITIVE "/attributes/POSITION", nullptr, "POSITION"},
        Mutation{PRIMITIVE "/attributes/POSITION", "\"0\"", "POSITION"}, Mutation{"/images/0", "{}", "image[0]"},
        Mutation{"/images/0", R"({"uri": "a.png", "bufferView": 0})", "image[0]"},
        Mutation{"/images/0/uri", "3", "images[0].uri"}, Mutation{"/images/0/uri", "\"data:,hello\"", "data URI"},
        Mutation{"/samplers/0/wrapS", "10498", "wrap mode 10498"}, Mutation{"/materials", "5", "materials"},
        Mutation{"/materials/0/extensions", "[]", "extensions"},
        Mutation{"/materials/0/doubleSided", "1", "doubleSided"},
        Mutation{"/materials/0/pbrMetallicRoughness/baseColorFactor", "[1, 1, 1]", "baseColorFactor"},
        Mutation{"/materials/0/pbrMetallicRoughness/roughnessFactor", "\"x\"", "roughnessFactor"},
        Mutation{"/materials/0/extras", R"({"fur": {"lenght": 1}})", "materials[0].extras.fur"},
        Mutation{"/materials/0/extras", R"({"fur": 3})", "object of fur parameters"},
        Mutation{"/extensionsRequired", R"(["KHR_draco_mesh_compression"])", "KHR_draco_mesh_compression"},
        Mutation{"/extensionsRequired", R"(["KHR_texture_transform"])", "KHR_texture_transform"},
        Mutation{"/extensionsRequired", "[3]", "extensionsRequired[0]"},
        Mutation{"/skins/0/joints", nullptr, "joints"}));
#undef PRIMITIVE

class GltfData : public GltfMalformed {};

// Changes the buffer instead of the JSON: writes `value` at byte `offset` of bufferViews[view].
template <class T>
void Poke(Builder* b, int view, size_t offset, T value) {
  std::memcpy(b->blob.data() + b->json["bufferViews"][view]["byteOffset"].get<size_t>() + offset, &value, sizeof value);
}

TEST_F(GltfData, BadValuesAreRefused) {
  Builder b = Everything();
  Poke(&b, 1, 4, uint16_t{4});
  ExpectError(Load(folder_, b), ErrorCode::InputMalformed, "indices[2] is 4");
  Poke(&b, 1, 4, uint16_t{0xFFFF});
  ExpectError(Load(folder_, b), ErrorCode::InputMalformed, "primitive restart");
  b = Everything();
  Poke(&b, 0, 24, std::numeric_limits<float>::infinity());
  ExpectError(Load(folder_, b), ErrorCode::InputMalformed, "vertex 2 is not finite");
  b = Everything();
  Poke(&b, 8, 0, uint8_t{4});
  ExpectError(Load(folder_, b), ErrorCode::InputMalformed, "element 4 of 4");
  b = Everything();
  Poke(&b, 5, 0, uint8_t{1});
  ExpectError(Load(folder_, b), ErrorCode::InputMalformed, "joint 1 of 1");
  b = Everything();
  Poke(&b, 6, 0, std::nanf(""));
  ExpectError(Load(folder_, b), ErrorCode::InputMalformed, "joint weight");
  b = Everything();
  Poke(&b, 7, 0, 3e38f);
  Poke(&b, 0, 36, 3e38f);
  EXPECT_FALSE(Load(folder_, b));
}

TEST_F(GltfData, WrongBufferLengthsAreRefused) {
  Builder b = Everything();
  Json json = Json::parse(b.Gltf());
  json["buffers"][0]["byteLength"] = b.blob.size() + 1;
  ExpectError(LoadText(folder_, json.dump()), ErrorCode::InputMalformed, "byteLength");
  json["buffers"][0]["byteLength"] = 0;
  ExpectError(LoadText(folder_, json.dump()), ErrorCode::InputMalformed, "bufferViews[0] ends");
  json["buffers"][0].erase("byteLength");
  ExpectError(LoadText(folder_, json.dump()), ErrorCode::InputMalformed, "byteLength is missing");
  json["buffers"] = Json::array({{{"byteLength", b.blob.size()}}});
  ExpectError(LoadText(folder_, json.dump()), ErrorCode::InputMalformed, "uri");
  json["buffers"][0]["uri"] = "short.bin";
  folder_.Write("short.bin", Bytes(10));
  ExpectError(LoadText(folder_, json.dump()), ErrorCode::InputMalformed, "short.bin");
}

TEST_F(GltfData, TextThatIsNoGltf) {
  for (const char* text : {"", " ", "{", "[]", "3", "null", "{}", "hello", "\xFF\xFE\x00", "glTF", "{\"asset\":{}}",
                           "{\"asset\":{\"version\":\"2.0\"}}", "{\"a\":1e999}"}) {
    const Result<Model> result = LoadText(folder_, text);
    ASSERT_FALSE(result) << text;
    EXPECT_EQ(result.error().code, ErrorCode::InputMalformed);
  }
  const std::string deep = std::string(1000000, '[') + std::string(1000000, ']');
  ExpectError(LoadText(folder_, deep), ErrorCode::InputMalformed, "too deep");
  Builder b = Everything();
  std::string text = b.Gltf();
  text.replace(text.size() - 1, 1, ",\"extras\":" + deep + "}");
  ExpectError(LoadText(folder_, text), ErrorCode::InputMalformed, "too deep");
}

TEST_F(GltfData, NamesWithControlCharactersStayOnOneLine) {
  Builder b = Everything();
  b.json["asset"]["version"] = "1\n\x1b[31m";
  const Result<Model> result = Load(folder_, b);
  ASSERT_FALSE(result);
  for (const char c : result.error().message) EXPECT_GE(static_cast<unsigned char>(c), 0x20);
}

// Each prefix becomes a file of its own, read into an allocation of exactly its size.
TEST_F(GltfData, EveryTruncationOfAGlbIsRefused) {
  const Bytes glb = Everything().Glb();
  ASSERT_TRUE(LoadGltf(folder_.Write("whole.glb", glb)));
  for (size_t length = 0; length < glb.size(); ++length) {
    const Result<Model> result = LoadGltf(folder_.Write("part.glb", glb.data(), length));
    ASSERT_FALSE(result) << length;
    EXPECT_EQ(result.error().code, ErrorCode::InputMalformed) << result.error().message;
  }
}

// The same with a header that admits to the length, so that the inner checks are reached.
TEST_F(GltfData, EveryTruncationWithAnHonestHeaderIsRefused) {
  const Bytes glb = Everything().Glb();
  for (size_t length = 12; length < glb.size(); ++length) {
    Bytes part(glb.begin(), glb.begin() + static_cast<ptrdiff_t>(length));
    for (size_t i = 0; i < 4; ++i) part[8 + i] = static_cast<uint8_t>(length >> (8 * i));
    ASSERT_FALSE(LoadGltf(folder_.Write("part.glb", part))) << length;
  }
}

TEST_F(GltfData, BadGlbHeaders) {
  const Bytes good = Everything().Glb();
  const auto with = [&](size_t offset, uint8_t value) {
    Bytes glb = good;
    glb[offset] = value;
    return LoadGltf(folder_.Write("bad.glb", glb));
  };
  ExpectError(with(4, 1), ErrorCode::InputMalformed, "GLB version 1");
  ExpectError(with(15, 0x7F), ErrorCode::InputMalformed, "JSON chunk");
  ExpectError(with(16, 'X'), ErrorCode::InputMalformed, "JSON chunk");
  size_t json = 0;
  std::memcpy(&json, good.data() + 12, 4);
  ExpectError(with(20 + json + 3, 0x7F), ErrorCode::InputMalformed, "binary chunk");
  ExpectError(with(20 + json + 4, 'X'), ErrorCode::InputMalformed, "not binary");
  // Eight bytes more than there are, which tinygltf alone would read.
  ExpectError(with(20 + json, static_cast<uint8_t>(good[20 + json] + 8)), ErrorCode::InputMalformed, "binary chunk");
}

// Random bytes in random places: whatever comes back, it must be sound. The seed is fixed, the run can be repeated.
TEST_F(GltfData, RandomDamageNeverCrashes) {
  const Bytes good = Everything().Glb();
  std::mt19937 random(1);
  for (int round = 0; round < 3000; ++round) {
    Bytes glb = good;
    for (int i = 0; i < 1 + round % 4; ++i) glb[random() % glb.size()] = static_cast<uint8_t>(random());
    const Result<Model> result = LoadGltf(folder_.Write("damaged.glb", glb));
    if (result) ExpectSound(*result);
  }
}

}  // namespace
}  // namespace fur::test
