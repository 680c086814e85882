// The way from a file to a Model: each step is in a file of its own.
#include "fur/gltf.h"

#include <cmath>
#include <limits>
#include <new>
#include <tuple>

#include "gltf_internal.h"

namespace fur {
namespace gltf {
namespace {

// Many nodes and primitives may share one accessor, so that a small file can ask for any amount of geometry.
constexpr size_t kMaxTotalIndices = size_t{1} << 27;
constexpr size_t kMaxParts = size_t{1} << 20;

struct Geometry {
  std::vector<Draft> drafts;
  std::vector<Part> parts;
};

// How many model units one unit of a primitive becomes: the mean over the three axes.
double UnitScaleOf(const glm::dmat4& transform) {
  const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(transform))));
  return scale > 0 && std::isfinite(scale) ? scale : 1;
}

class GeometryReader {
 public:
  explicit GeometryReader(Document& doc) : doc_(doc), hierarchy_(ReadHierarchy(doc)) {}

  Geometry Read() {
    for (const Placement& placement : hierarchy_.placements) {
      const size_t count = doc_.model.meshes[placement.mesh].primitives.size();
      for (size_t i = 0; i < count; ++i) Place(placement, i);
    }
    if (out_.parts.empty()) doc_.Malformed("has no triangles in its scene");
    return std::move(out_);
  }

 private:
  static constexpr size_t kNoTriangles = std::numeric_limits<size_t>::max();

  Document& doc_;
  Hierarchy hierarchy_;
  Geometry out_;
  // Nodes share a primitive, unless they bend it by different skins.
  std::map<std::tuple<size_t, size_t, int>, size_t> known_;
  size_t totalIndices_ = 0;

  void Place(const Placement& placement, size_t primitive) {
    const bool hasSkin = placement.skin >= 0 && IsSkinnable(placement, primitive);
    const int skin = hasSkin ? placement.skin : -1;
    const auto [it, isNew] = known_.try_emplace({placement.mesh, primitive, skin}, kNoTriangles);
    // A skin places its vertices in the scene; glTF says to ignore the node's own transform.
    const glm::dmat4 transform = hasSkin ? glm::dmat4(1) : placement.transform;
    if (isNew) it->second = AddDraft(placement.mesh, primitive, skin, UnitScaleOf(transform));
    if (it->second == kNoTriangles) return;
    if (out_.parts.size() == kMaxParts) doc_.Malformed("places more than ", kMaxParts, " primitives");
    out_.parts.push_back({static_cast<uint32_t>(it->second), transform});
  }

  bool IsSkinnable(const Placement& placement, size_t primitive) {
    if (doc_.model.meshes[placement.mesh].primitives[primitive].attributes.count("JOINTS_0") != 0) return true;
    doc_.Warn("nodes[", placement.node, "] has a skin, but its mesh has no joints; the skin is ignored");
    return false;
  }

  size_t AddDraft(size_t mesh, size_t primitive, int skin, double unitScale) {
    Draft draft = ReadPrimitive(doc_, mesh, primitive);
    if (draft.primitive.indices.empty()) return kNoTriangles;
    totalIndices_ += draft.primitive.indices.size() + draft.primitive.vertices.size();
    if (totalIndices_ > kMaxTotalIndices) doc_.Malformed("has more geometry than this program accepts");
    if (skin >= 0) ApplySkin(doc_, hierarchy_, skin, &draft);
    draft.joints.clear();
    draft.weights.clear();
    draft.unitScale = unitScale;
    out_.drafts.push_back(std::move(draft));
    return out_.drafts.size() - 1;
  }
};

Model Load(const std::filesystem::path& file, const LoadOptions& options) {
  Document doc = OpenDocument(file);
  Geometry geometry = GeometryReader(doc).Read();
  Model model;
  model.name = OneLine(file.stem().string());
  model.parts = std::move(geometry.parts);
  // The model's size is needed before the primitives are complete, and does not change when vertices are split.
  for (Draft& draft : geometry.drafts) model.primitives.push_back(std::move(draft.primitive));
  const double diameter = ComputeBounds(model).Diameter();
  if (!std::isfinite(diameter)) doc.Malformed("has vertices too far out for its size to be computed");
  std::vector<double> unitScale;
  for (size_t i = 0; i < model.primitives.size(); ++i) {
    Draft& draft = geometry.drafts[i];
    draft.primitive = std::move(model.primitives[i]);
    CompleteAttributes(doc, diameter > 0 ? diameter : 1, &draft);
    model.primitives[i] = std::move(draft.primitive);
    unitScale.push_back(draft.unitScale);
  }
  ReadMaterials(doc, &model);
  ResolveFur(doc, options, unitScale, &model);
  model.warnings = std::move(doc.warnings);
  return model;
}

}  // namespace
}  // namespace gltf

namespace {

// What the reader throws, as an Error.
template <class F>
auto Guarded(const std::string& file, F work) -> Result<decltype(work())> {
  try {
    return work();
  } catch (const gltf::LoadFailure& failure) {
    return Error{failure.code, gltf::OneLine(failure.what())};
  } catch (const std::bad_alloc&) {
    return Error{ErrorCode::InputMalformed, file + ": needs more memory than there is"};
  } catch (const std::exception& e) {  // from tinygltf or the JSON library
    return Error{ErrorCode::InputMalformed, gltf::OneLine(file + ": cannot be read as glTF: " + e.what())};
  }
}

}  // namespace

Result<Model> LoadGltf(const std::filesystem::path& file, const LoadOptions& options) {
  return Guarded(file.string(), [&] { return gltf::Load(file, options); });
}

Result<Done> GroomModel(const LoadOptions& options, Model* model) {
  return Guarded(options.furFile.string(), [&] {
    gltf::Document none;
    gltf::ResolveFur(none, options, std::vector<double>(model->primitives.size(), 1), model);
    model->warnings.insert(model->warnings.end(), none.warnings.begin(), none.warnings.end());
    return Done{};
  });
}

}  // namespace fur
