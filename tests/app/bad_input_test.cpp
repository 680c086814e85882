// Models and fur files that are missing or broken: the right exit code, one line, no file.
#include "../fur/gltf_builder.h"
#include "program.h"

namespace app::test {
namespace {

using fur::test::Builder;
using fur::test::Square;

std::string Text(const fur::test::Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

// Writes `bytes` under a name and lets the program try it.
void ExpectRefused(const std::string& name, const std::string& bytes, ExitCode code,
                   const std::vector<std::string>& words = {}) {
  const Folder folder;
  std::vector<std::string> all = words;
  all.push_back(name);
  ExpectRenderFailure({folder.Write(name, bytes)}, code, all);
}

std::string RandomBytes(size_t count) {
  std::string bytes;
  uint32_t state = 12345;
  for (size_t i = 0; i < count; ++i) {
    state = state * 1664525u + 1013904223u;
    bytes += char(state >> 24);
  }
  return bytes;
}

std::string SmallPng() {
  const Folder folder;
  EXPECT_TRUE(fur::WritePng(folder / "p.png", 4, 4, std::vector<uint8_t>(64, 200)));
  std::ifstream in(folder / "p.png", std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// The square as it is must render, or the tests below prove nothing.
TEST(BadInput, SoundSquareIsRendered) {
  const Folder folder;
  for (const auto& [name, bytes] : {std::pair{"s.gltf", Square().Gltf()}, {"s.glb", Text(Square().Glb())}}) {
    const std::string picture = folder / (std::string(name) + ".png");
    const Outcome o = RunFur({"render", folder.Write(name, bytes), "--size", "64x48", "-o", picture});
    EXPECT_EQ(o.exitCode, 0) << o.err;
    EXPECT_TRUE(std::filesystem::exists(picture));
  }
}

TEST(BadInput, MissingFile) {
  ExpectRenderFailure({"no/such/model.gltf"}, kInputMissing, {"no/such/model.gltf"});
  ExpectRenderFailure({"no_such_model.glb"}, kInputMissing, {"no_such_model.glb"});
}

TEST(BadInput, FolderInsteadOfAFile) {
  const Folder folder;
  ExpectRenderFailure({folder / ""}, kInputMissing);
}

// Devices could block for ever, or never end.
TEST(BadInput, DevicesAreNotRead) {
  ExpectRenderFailure({"/dev/zero"}, kInputMissing, {"/dev/zero"});
  ExpectRenderFailure({"/dev/random"}, kInputMissing, {"/dev/random"});
}

TEST(BadInput, NotAGltf) {
  ExpectRefused("random.gltf", RandomBytes(5000), kInputMalformed);
  ExpectRefused("random.glb", RandomBytes(5000), kInputMalformed);
  ExpectRefused("empty.gltf", "", kInputMalformed, {"empty"});
  ExpectRefused("empty.glb", "", kInputMalformed);
  ExpectRefused("picture.glb", SmallPng(), kInputMalformed);
  ExpectRefused("picture.gltf", SmallPng(), kInputMalformed);
  ExpectRefused("words.gltf", "this is not a model\n", kInputMalformed);
  ExpectRefused("list.gltf", "[1, 2, 3]", kInputMalformed);
  ExpectRefused("object.gltf", "{}", kInputMalformed);
  ExpectRefused("version.gltf", R"({"asset": {"version": "1.0"}})", kInputMalformed);
  ExpectRefused("deep.gltf", std::string(100000, '['), kInputMalformed);
}

TEST(BadInput, GlbCutOffAnywhere) {
  const std::string glb = Text(Square().Glb());
  for (const size_t length :
       {size_t{1}, size_t{3}, size_t{4}, size_t{8}, size_t{11}, size_t{12}, size_t{19}, size_t{20}, size_t{40},
        glb.size() / 2, glb.size() - 100, glb.size() - 17, glb.size() - 4, glb.size() - 1})
    ExpectRefused("cut" + std::to_string(length) + ".glb", glb.substr(0, length), kInputMalformed);
}

TEST(BadInput, GlbThatLies) {
  std::string longer = Text(Square().Glb());
  longer[12] = longer[13] = char(0xff);  // the JSON chunk's length
  ExpectRefused("chunk.glb", longer, kInputMalformed);
  std::string version = Text(Square().Glb());
  version[4] = 9;
  ExpectRefused("version.glb", version, kInputMalformed, {"9"});
}

TEST(BadInput, IndexOutOfRange) {
  Builder b = Square();
  const int indices = b.Accessor(std::vector<uint16_t>{0, 1, 2, 0, 2, 4}, 5123, "SCALAR", 1);
  fur::test::Primitive0(b)["indices"] = indices;
  ExpectRefused("index.gltf", b.Gltf(), kInputMalformed, {"4"});
  ExpectRefused("index.glb", Text(b.Glb()), kInputMalformed, {"4"});
}

TEST(BadInput, ReferencesOutOfRange) {
  for (const int wrong : {7, -2}) {
    Builder accessor = Square();
    fur::test::Primitive0(accessor)["attributes"]["POSITION"] = wrong;
    ExpectRefused("accessor.gltf", accessor.Gltf(), kInputMalformed);
    Builder mesh = Square();
    mesh.json["nodes"][0]["mesh"] = wrong;
    ExpectRefused("mesh.gltf", mesh.Gltf(), kInputMalformed);
    Builder material = Square();
    fur::test::Primitive0(material)["material"] = wrong;
    ExpectRefused("material.gltf", material.Gltf(), kInputMalformed);
  }
  Builder view = Square();
  view.json["bufferViews"][0]["byteLength"] = 100000;
  ExpectRefused("view.gltf", view.Gltf(), kInputMalformed);
}

TEST(BadInput, NotANumberInThePositions) {
  Builder b = Square();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const int positions = b.Floats({0, 0, 0, 1, 0, 0, nan, 1, 0, 0, 1, 0}, "VEC3", 3);
  fur::test::Primitive0(b)["attributes"]["POSITION"] = positions;
  ExpectRefused("nan.gltf", b.Gltf(), kInputMalformed);
}

Builder Textured(const std::string& uri) {
  Builder b = Square();
  b.Push("images", {{"uri", uri}});
  b.Push("textures", {{"source", 0}});
  b.Push("materials", {{"name", "fur"}, {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  fur::test::Primitive0(b)["material"] = 0;
  return b;
}

TEST(BadInput, MissingImage) {
  const Folder folder;
  const std::string model = folder.Write("m.gltf", Textured("nowhere.png").Gltf());
  ExpectRenderFailure({model}, kInputMissing, {"nowhere.png"});
}

TEST(BadInput, BrokenImage) {
  const Folder folder;
  const std::string model = folder.Write("m.gltf", Textured("broken.png").Gltf());
  folder.Write("broken.png", RandomBytes(300));
  ExpectRenderFailure({model}, kInputMalformed, {"broken.png"});
  folder.Write("broken.png", SmallPng().substr(0, 40));
  ExpectRenderFailure({model}, kInputMalformed, {"broken.png"});
}

TEST(BadInput, MissingBuffer) {
  Builder b = Square();
  nlohmann::json json = b.json;
  json["buffers"] = {{{"byteLength", b.blob.size()}, {"uri", "nowhere.bin"}}};
  const Folder folder;
  ExpectRenderFailure({folder.Write("m.gltf", json.dump())}, kInputMissing, {"nowhere.bin"});
  folder.Write("nowhere.bin", "short");
  ExpectRenderFailure({folder / "m.gltf"}, kInputMalformed);
}

struct BadFur {
  const char* name;
  const char* text;
  ExitCode code;
  std::vector<std::string> words;
};
void PrintTo(const BadFur& f, std::ostream* out) { *out << f.name; }
class BadFurFile : public testing::TestWithParam<BadFur> {};

TEST_P(BadFurFile, IsRefusedByName) {
  const Folder folder;
  const std::string model = folder.Write("m.gltf", Square().Gltf());
  ExpectRenderFailure({model, "--fur", folder.Write("f.json", GetParam().text)}, GetParam().code, GetParam().words);
}

const BadFur kFurFiles[] = {
    {"UnknownKey", R"({"default": {"lenght_scale": 1}})", kInputMalformed, {"f.json", "lenght_scale", "length_scale"}},
    {"UnknownKeyOutside", R"({"length_scale": 1})", kInputMalformed, {"f.json", "length_scale"}},
    {"WrongType", R"({"default": {"length_scale": "long"}})", kInputMalformed, {"length_scale"}},
    {"OutOfRange", R"({"default": {"self_shadow": 1.5}})", kInputMalformed, {"self_shadow"}},
    {"NegativeLength", R"({"default": {"length_scale": -1}})", kInputMalformed, {"length_scale"}},
    {"ShellsFraction", R"({"default": {"shells": 1.5}})", kInputMalformed, {"shells"}},
    {"UnknownMaterial", R"({"materials": {"wool": {}}})", kInputMalformed, {"wool"}},
    {"NotJson", "{", kInputMalformed, {"f.json"}},
    {"Empty", "", kInputMalformed, {"f.json"}},
    {"List", "[]", kInputMalformed, {"f.json"}},
    {"MissingLengthMap", R"({"default": {"length_map": "no.png"}})", kInputMissing, {"no.png"}},
    {"MissingLayer", R"({"default": {"layers": ["no.png"]}})", kInputMissing, {"no.png"}},
};
std::string Name(const testing::TestParamInfo<BadFur>& fur) { return fur.param.name; }
INSTANTIATE_TEST_SUITE_P(Files, BadFurFile, testing::ValuesIn(kFurFiles), Name);

TEST(BadInput, MissingFurFile) {
  const Folder folder;
  ExpectRenderFailure({folder.Write("m.gltf", Square().Gltf()), "--fur", "no/such.json"}, kInputMissing,
                      {"no/such.json"});
}

TEST(BadInput, UnknownFurMaterial) {
  const Folder folder;
  Builder b = Square();
  b.Push("materials", {{"name", "fleece"}});
  fur::test::Primitive0(b)["material"] = 0;
  ExpectRenderFailure({folder.Write("m.gltf", b.Gltf()), "--fur-material", "wool"}, kUsage, {"wool", "fleece"});
}

}  // namespace
}  // namespace app::test
