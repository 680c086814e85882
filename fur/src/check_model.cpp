// What a model must be before anyone indexes into it.
#include <cmath>

#include "finite.h"
#include "fur/model.h"

namespace fur {
namespace {

Error Malformed(const std::string& what) { return Error{ErrorCode::InputMalformed, what}; }

// nullptr: nothing.
const char* FaultOf(const Vertex& v) {
  if (!IsFinite(v.position)) return "the position";
  if (!IsFinite(v.normal)) return "the normal";
  if (!IsFinite(v.tangent)) return "the tangent";
  return IsFinite(v.uv) ? nullptr : "the texture coordinate";
}

Result<Done> CheckPrimitive(const Primitive& p, size_t materials) {
  const std::string where = "primitive '" + p.name + "'";
  if (p.material >= materials) return Malformed(where + ": there is no material " + std::to_string(p.material));
  if (p.indices.size() % 3 != 0) return Malformed(where + ": the indices are not three for each triangle");
  for (size_t i = 0; i < p.vertices.size(); ++i)
    if (const char* fault = FaultOf(p.vertices[i]))
      return Malformed(where + ", vertex " + std::to_string(i) + ": " + fault + " is not finite");
  for (size_t i = 0; i < p.indices.size(); ++i)
    if (p.indices[i] >= p.vertices.size())
      return Malformed(where + ": index " + std::to_string(i) + " is " + std::to_string(p.indices[i]) + ", of " +
                       std::to_string(p.vertices.size()) + " vertices");
  return Done{};
}

bool IsIndex(int64_t index, size_t count, bool optional) {
  return (optional && index == -1) || (index >= 0 && size_t(index) < count);
}

Result<Done> CheckFur(const MaterialFur& fur, const std::string& where, const Model& model) {
  if (Result<Done> ok = CheckFurParams(fur.params); !ok) return Malformed(where + ": " + ok.error().message);
  if (!IsIndex(fur.volume, model.volumes.size(), !fur.params.enabled))
    return Malformed(where + ": there is no fur volume " + std::to_string(fur.volume));
  for (const int32_t map : {fur.lengthMap, fur.directionMap})
    if (!IsIndex(map, model.images.size(), true)) return Malformed(where + ": there is no picture " + std::to_string(map));
  return Done{};
}

Result<Done> CheckMaterial(const Material& m, const Model& model) {
  const std::string where = "material '" + m.name + "'";
  const float numbers = m.normalScale + m.roughness + m.metallic;
  if (!IsFinite(m.baseColor) || !IsFinite(m.specularColor) || !std::isfinite(numbers))
    return Malformed(where + ": a number is not finite");
  for (const TextureRef* t : {&m.baseColorTexture, &m.normalTexture, &m.specularTexture})
    if (!IsIndex(t->image, model.images.size(), true))
      return Malformed(where + ": there is no picture " + std::to_string(t->image));
  return m.fur ? CheckFur(*m.fur, where, model) : Done{};
}

Result<Done> CheckPictures(const Model& model) {
  for (const Image& i : model.images)
    if (i.width == 0 || i.pixels.size() != size_t{i.width} * i.height * 4)
      return Malformed("picture '" + i.name + "' has not the bytes of its size");
  for (const FurVolume& v : model.volumes) {
    const size_t bytes = size_t{v.width} * v.height * v.layers * 4;
    if (bytes == 0 || v.pixels.size() != bytes || (!v.tint.empty() && v.tint.size() != bytes))
      return Malformed("fur volume '" + v.name + "' has not the bytes of its size");
  }
  return Done{};
}

}  // namespace

Result<Done> CheckModel(const Model& model) {
  if (Result<Done> ok = CheckPictures(model); !ok) return ok;
  for (const Material& m : model.materials)
    if (Result<Done> ok = CheckMaterial(m, model); !ok) return ok;
  for (const Primitive& p : model.primitives)
    if (Result<Done> ok = CheckPrimitive(p, model.materials.size()); !ok) return ok;
  for (size_t i = 0; i < model.parts.size(); ++i) {
    const std::string where = "part " + std::to_string(i);
    if (model.parts[i].primitive >= model.primitives.size()) return Malformed(where + ": there is no such primitive");
    if (!IsFinite(model.parts[i].transform)) return Malformed(where + ": the transform is not finite");
  }
  return Done{};
}

}  // namespace fur
