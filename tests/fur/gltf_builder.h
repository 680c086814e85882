// Makes small glTF files for the loader's tests.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fur/gltf.h"
#include "fur/image_io.h"

namespace fur::test {

using Json = nlohmann::json;
using Bytes = std::vector<uint8_t>;

// A folder that lives as long as the test.
class Folder {
 public:
  Folder() {
    static int counter = 0;
    path_ = std::filesystem::temp_directory_path() /
            ("fur_test_" + std::to_string(::getpid()) + "_" + std::to_string(counter++));
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  const std::filesystem::path& Path() const { return path_; }

  std::filesystem::path Write(const std::string& name, const void* data, size_t size) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream out(path_ / name, std::ios::binary | std::ios::trunc);
    out.write(static_cast<const char*>(data), static_cast<std::streamsize>(size));
    return path_ / name;
  }
  std::filesystem::path Write(const std::string& name, const std::string& text) const {
    return Write(name, text.data(), text.size());
  }
  std::filesystem::path Write(const std::string& name, const Bytes& bytes) const {
    return Write(name, bytes.data(), bytes.size());
  }
  std::filesystem::path WritePicture(const std::string& name, uint32_t width, uint32_t height, uint8_t value) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    EXPECT_TRUE(WritePng(path_ / name, width, height, Bytes(size_t{4} * width * height, value)));
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::string Base64(const Bytes& bytes) {
  const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = uint32_t{bytes[i]} << 16;
    if (i + 1 < bytes.size()) group |= uint32_t{bytes[i + 1]} << 8;
    if (i + 2 < bytes.size()) group |= bytes[i + 2];
    out += digits[group >> 18];
    out += digits[group >> 12 & 63];
    out += i + 1 < bytes.size() ? digits[group >> 6 & 63] : '=';
    out += i + 2 < bytes.size() ? digits[group & 63] : '=';
  }
  return out;
}

// A document and its one buffer. Every Add... returns the new element's index.
struct Builder {
  Json json = {{"asset", {{"version", "2.0"}}}};
  Bytes blob;

  template <class T>
  int View(const std::vector<T>& values) {
    while (blob.size() % 4 != 0) blob.push_back(0);
    const size_t offset = blob.size(), size = values.size() * sizeof(T);
    blob.resize(offset + size);
    if (size != 0) std::memcpy(blob.data() + offset, values.data(), size);
    return Push("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", size}});
  }
  template <class T>
  int Accessor(const std::vector<T>& values, int componentType, const std::string& type, size_t components) {
    const int view = View(values);
    return Push("accessors", {{"bufferView", view},
                              {"componentType", componentType},
                              {"count", values.size() / components},
                              {"type", type}});
  }
  int Floats(const std::vector<float>& values, const std::string& type, size_t components) {
    return Accessor(values, 5126, type, components);
  }
  int Push(const std::string& array, Json element) {
    json[array].push_back(std::move(element));
    return static_cast<int>(json[array].size()) - 1;
  }

  std::string Gltf() const {
    Json out = json;
    out["buffers"] =
        Json::array({{{"byteLength", blob.size()}, {"uri", "data:application/octet-stream;base64," + Base64(blob)}}});
    return out.dump();
  }
  Bytes Glb() const {
    Json out = json;
    out["buffers"] = Json::array({{{"byteLength", blob.size()}}});
    std::string text = out.dump();
    Bytes binary = blob;
    while (text.size() % 4 != 0) text += ' ';
    while (binary.size() % 4 != 0) binary.push_back(0);
    Bytes glb;
    const auto put = [&](uint32_t v) {
      for (int shift = 0; shift < 32; shift += 8) glb.push_back(static_cast<uint8_t>(v >> shift));
    };
    put(0x46546C67), put(2), put(static_cast<uint32_t>(12 + 8 + text.size() + 8 + binary.size()));
    put(static_cast<uint32_t>(text.size())), put(0x4E4F534A);
    glb.insert(glb.end(), text.begin(), text.end());
    put(static_cast<uint32_t>(binary.size())), put(0x004E4942);
    glb.insert(glb.end(), binary.begin(), binary.end());
    return glb;
  }
};

// A unit square in the xy plane, positions only: 4 vertices, 2 triangles, one node.
inline Builder Square() {
  Builder b;
  const int positions = b.Floats({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, "VEC3", 3);
  const int indices = b.Accessor(std::vector<uint16_t>{0, 1, 2, 0, 2, 3}, 5123, "SCALAR", 1);
  b.Push("meshes", {{"primitives", Json::array({{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}})}});
  b.Push("nodes", {{"mesh", 0}});
  b.Push("scenes", {{"nodes", {0}}});
  b.json["scene"] = 0;
  return b;
}

inline Json& Primitive0(Builder& b) { return b.json["meshes"][0]["primitives"][0]; }

inline Result<Model> LoadText(const Folder& folder, const std::string& gltf, const LoadOptions& options = {}) {
  return LoadGltf(folder.Write("model.gltf", gltf), options);
}
inline Result<Model> Load(const Folder& folder, const Builder& b, const LoadOptions& options = {}) {
  return LoadText(folder, b.Gltf(), options);
}

inline std::string Message(const Result<Model>& result) { return result ? "no error" : result.error().message; }

// One line, of the expected kind, that names what is wrong.
inline void ExpectError(const Result<Model>& result, ErrorCode code, const std::string& keyword) {
  ASSERT_FALSE(result) << "loaded, expected an error about " << keyword;
  EXPECT_EQ(result.error().code, code) << result.error().message;
  EXPECT_NE(result.error().message.find(keyword), std::string::npos)
      << "expected '" << keyword << "' in: " << result.error().message;
  EXPECT_EQ(result.error().message.find('\n'), std::string::npos) << result.error().message;
  EXPECT_FALSE(result.error().message.empty());
}

inline bool HasWarning(const Model& model, const std::string& keyword) {
  for (const std::string& warning : model.warnings)
    if (warning.find(keyword) != std::string::npos) return true;
  return false;
}

// What every consumer may rely on.
inline void ExpectSound(const Model& model) {
  ASSERT_FALSE(model.parts.empty());
  ASSERT_FALSE(model.materials.empty());
  for (const Part& part : model.parts) ASSERT_LT(part.primitive, model.primitives.size());
  for (const Primitive& p : model.primitives) {
    ASSERT_LT(p.material, model.materials.size());
    ASSERT_FALSE(p.indices.empty());
    ASSERT_EQ(p.indices.size() % 3, 0u);
    for (const uint32_t index : p.indices) ASSERT_LT(index, p.vertices.size());
    for (const Vertex& v : p.vertices) {
      const glm::vec3 t(v.tangent);
      ASSERT_NEAR(glm::length(v.normal), 1, 1e-5) << p.name;
      ASSERT_NEAR(glm::length(t), 1, 1e-5) << p.name;
      ASSERT_NEAR(glm::dot(v.normal, t), 0, 1e-5) << p.name;
      ASSERT_EQ(std::abs(v.tangent.w), 1.0f);
    }
  }
  const auto texture = [&](const TextureRef& ref) { EXPECT_LT(ref.image, static_cast<int32_t>(model.images.size())); };
  for (const Material& m : model.materials) {
    texture(m.baseColorTexture), texture(m.normalTexture), texture(m.specularTexture);
    if (!m.fur) continue;
    ASSERT_GE(m.fur->volume, 0);
    ASSERT_LT(m.fur->volume, static_cast<int32_t>(model.volumes.size()));
    EXPECT_GT(m.fur->params.length, 0);
    EXPECT_GE(m.fur->params.layerUvScale, 1);
  }
  for (const Image& image : model.images) EXPECT_EQ(image.pixels.size(), size_t{4} * image.width * image.height);
}

}  // namespace fur::test
