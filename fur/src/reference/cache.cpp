// Reference pictures by the hash of all that they depend on.
#include <array>
#include <cstring>
#include <type_traits>

#include "file_bytes.h"
#include "fur/file.h"
#include "fur/reference.h"

namespace fur {
namespace {

// Changes with anything that changes a picture.
constexpr uint32_t kVersion = 3;
constexpr std::array<char, 8> kMagic{'f', 'u', 'r', 'r', 'e', 'f', '0', '1'};
constexpr uint64_t kMostBytes = uint64_t{1} << 33;

// FNV-1a (Fowler, Noll, Vo) twice, from two offsets: 128 bits against chance, not against malice.
class Hash {
 public:
  void Bytes(const void* data, size_t size) {
    const auto* p = static_cast<const uint8_t*>(data);
    for (size_t i = 0; i < size; ++i) {
      a_ = (a_ ^ p[i]) * 0x100000001B3u;
      b_ = (b_ ^ p[i]) * 0x100000001B3u;
      b_ ^= b_ >> 29;
    }
  }
  template <class T>
    requires std::is_arithmetic_v<T>
  void Add(T value) {
    Bytes(&value, sizeof value);
  }
  template <int N, class T, glm::qualifier Q>
  void Add(const glm::vec<N, T, Q>& v) {
    for (int i = 0; i < N; ++i) Add(v[i]);
  }
  void Add(const glm::dmat4& m) {
    for (int i = 0; i < 4; ++i) Add(m[i]);
  }
  void Add(const std::vector<uint8_t>& bytes) {
    Add(bytes.size());
    Bytes(bytes.data(), bytes.size());
  }
  std::string Text() const {
    std::string text;
    for (const uint64_t half : {a_, b_})
      for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[half >> shift & 15];
    return text;
  }

 private:
  uint64_t a_ = 0xCBF29CE484222325u, b_ = 0x9E3779B97F4A7C15u;
};

void AddMaterial(const Material& m, Hash* hash) {
  hash->Add(m.baseColor);
  for (const TextureRef& t : {m.baseColorTexture, m.normalTexture, m.specularTexture}) {
    hash->Add(t.image);
    hash->Add(t.wrapU);
    hash->Add(t.wrapV);
  }
  hash->Add(m.normalScale);
  hash->Add(m.specularColor);
  hash->Add(m.roughness);
  hash->Add(m.doubleSided);
  const bool furred = m.fur && m.fur->params.enabled;
  hash->Add(furred);
  if (!furred) return;
  const FurParams& p = m.fur->params;
  for (const double v : {p.length, p.layerUvScale, p.selfShadow, p.specularPower, p.specularScale, p.heightFalloff, p.density,
                         p.thickness, p.combStrength, p.bend, p.gravity, p.colorFromBase, p.windStrength,
                         p.windFrequency, p.windLength, p.clumping, p.wetness, p.tint})
    hash->Add(v);
  for (const glm::dvec3& v : {p.comb, p.rootColor, p.tipColor, p.wind}) hash->Add(v);
  for (const int32_t v : {m.fur->volume, m.fur->lengthMap, m.fur->directionMap}) hash->Add(v);
}

void AddModel(const Model& model, Hash* hash) {
  for (const Primitive& p : model.primitives) {
    hash->Add(p.material);
    hash->Add(p.vertices.size());
    for (const Vertex& v : p.vertices) {
      hash->Add(v.position);
      hash->Add(v.normal);
      hash->Add(v.tangent);
      hash->Add(v.uv);
    }
    hash->Add(p.indices.size());
    for (const uint32_t i : p.indices) hash->Add(i);
  }
  for (const Part& p : model.parts) {
    hash->Add(p.primitive);
    hash->Add(p.transform);
  }
  for (const Material& m : model.materials) AddMaterial(m, hash);
  for (const Image& i : model.images) {
    hash->Add(i.width);
    hash->Add(i.pixels);
  }
  for (const FurVolume& v : model.volumes) {
    hash->Add(v.width);
    hash->Add(v.layers);
    hash->Add(v.pixels);
    hash->Add(v.tint);
  }
}

void AddSettings(const ReferenceSettings& s, Hash* hash) {
  for (const uint32_t v : {s.width, s.height, s.cropX, s.cropY, s.cropWidth, s.cropHeight, s.samplesPerPixel,
                           uint32_t(s.look), uint32_t(s.semantics)})
    hash->Add(v);
  for (const glm::dvec3& v : {s.background, s.light.direction, s.light.diffuse, s.light.ambient, s.light.specular,
                              s.comb.value_or(glm::dvec3(0)), s.furnace.value_or(glm::dvec3(-1))})
    hash->Add(v);
  for (const bool given : {s.comb.has_value(), s.bend.has_value()}) hash->Add(given);
  hash->Add(s.bend.value_or(0));
  hash->Add(s.time);
  hash->Add(s.seed);
  hash->Add(s.tolerance);
}

std::filesystem::path FileOf(const std::string& folder, const std::string& key) {
  return std::filesystem::path(folder) / (key + ".furref");
}

template <class T>
void Append(const std::vector<T>& values, std::vector<uint8_t>* out) {
  const auto* p = reinterpret_cast<const uint8_t*>(values.data());
  out->insert(out->end(), p, p + values.size() * sizeof(T));
}

template <class T>
const uint8_t* Take(const uint8_t* from, size_t count, std::vector<T>* values) {
  values->resize(count);
  std::memcpy(values->data(), from, count * sizeof(T));
  return from + count * sizeof(T);
}

constexpr size_t kHeader = kMagic.size() + 2 * sizeof(uint32_t);
constexpr size_t kPixel = sizeof(glm::vec4) + sizeof(float) + 1;

}  // namespace

std::string ReferenceKey(const Model& model, const Camera& c, std::span<const glm::dmat4> placements,
                         const ReferenceSettings& s) {
  Hash hash;
  hash.Add(kVersion);
  AddModel(model, &hash);
  for (const glm::dvec3& v : {c.eye, c.target, c.up, glm::dvec3(c.fovY, c.zNear, c.zFar)}) hash.Add(v);
  for (const glm::dmat4& m : placements) hash.Add(m);
  AddSettings(s, &hash);
  return hash.Text();
}

Result<ReferenceImage> LoadReference(const std::string& folder, const std::string& key) {
  const std::filesystem::path file = FileOf(folder, key);
  const Result<std::vector<uint8_t>> bytes = ReadFileBytes(file, kMostBytes);
  if (!bytes) return bytes.error();
  const Error damaged{ErrorCode::InputMalformed, file.string() + ": not a reference picture; remove it"};
  if (bytes->size() < kHeader || std::memcmp(bytes->data(), kMagic.data(), kMagic.size()) != 0) return damaged;
  ReferenceImage image;
  std::memcpy(&image.color.width, bytes->data() + kMagic.size(), 4);
  std::memcpy(&image.color.height, bytes->data() + kMagic.size() + 4, 4);
  const uint64_t pixels = uint64_t{image.color.width} * image.color.height;
  if ((bytes->size() - kHeader) / kPixel != pixels || (bytes->size() - kHeader) % kPixel != 0) return damaged;
  const uint8_t* at = Take(bytes->data() + kHeader, pixels, &image.color.pixels);
  Take(Take(at, pixels, &image.furOpacity), pixels, &image.skin);
  return image;
}

Result<Done> StoreReference(const std::string& folder, const std::string& key, const ReferenceImage& image) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Error{ErrorCode::OutputFailed, folder + ": cannot be made: " + failed.message()};
  std::vector<uint8_t> bytes(kMagic.begin(), kMagic.end());
  Append(std::vector<uint32_t>{image.color.width, image.color.height}, &bytes);
  Append(image.color.pixels, &bytes);
  Append(image.furOpacity, &bytes);
  Append(image.skin, &bytes);
  return WriteFile(FileOf(folder, key), bytes);
}

}  // namespace fur
