// Shared by the files of the glTF reader. Inside the reader a failure is an exception, because tinygltf and the JSON
// library throw anyway; LoadGltf turns every one into an Error.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "fur/gltf.h"
#include "fur/model.h"

namespace fur::gltf {

using Json = nlohmann::json;

struct LoadFailure : std::runtime_error {
  LoadFailure(ErrorCode c, const std::string& message) : std::runtime_error(message), code(c) {}
  ErrorCode code;
};

// Joins its arguments as operator<< writes them.
template <class... Args>
std::string Text(const Args&... args) {
  std::ostringstream out;
  (out << ... << args);
  return out.str();
}

// One line of at most a few hundred characters: control characters, which a file may put into a name, become '?'.
std::string OneLine(std::string text);

// A file that passed CheckSchema, as tinygltf sees it and as JSON (for extras).
struct Document {
  std::filesystem::path file;
  Json json;
  tinygltf::Model model;
  std::vector<std::string> warnings;

  template <class... Args>
  [[noreturn]] void Malformed(const Args&... what) const {
    throw LoadFailure(ErrorCode::InputMalformed, Text(file.string(), ": ", what...));
  }
  template <class... Args>
  void Warn(const Args&... what) {
    AddWarning(OneLine(Text(what...)));
  }
  void AddWarning(std::string line);
};

// gltf_file.cpp: reads the file, its buffers and the bytes of its images.
Document OpenDocument(const std::filesystem::path& file);

// Parses JSON text, refusing what is nested deeper than any honest file (recursive readers would overflow the stack).
Json ParseJson(std::span<const uint8_t> text, const std::string& where);

// gltf_schema.cpp: types, ranges and references of everything that is read later. `where` starts messages.
void CheckSchema(const Json& json, const std::string& where);

// gltf_accessor.cpp
struct Numbers {
  size_t count = 0;         // elements
  unsigned components = 1;  // numbers for each element
  int componentType = 0;    // as in the file
  bool normalized = false;
  std::vector<double> values;  // count * components; exact for every type glTF has
};
// Checks the byte ranges of an accessor, with 64-bit arithmetic that cannot overflow: all inputs are below 2^31.
void CheckAccessor(const Document& doc, int accessor);
// Elements with sparse replacements applied and normalized integers scaled to [-1, 1] or [0, 1].
Numbers ReadAccessor(const Document& doc, int accessor);

// gltf_geometry.cpp: one primitive as the file has it.
struct Draft {
  Primitive primitive;
  bool hasNormals = false, hasTangents = false, hasUvs = false;
  std::vector<std::vector<double>> joints, weights;  // one for each JOINTS_n, WEIGHTS_n: 4 numbers a vertex
  double unitScale = 1;                              // model units for one unit of the primitive
};
// The draft has no indices when the primitive has no triangles.
Draft ReadPrimitive(Document& doc, size_t mesh, size_t primitive);

// gltf_nodes.cpp
struct Placement {
  size_t node = 0, mesh = 0;
  int skin = -1;
  glm::dmat4 transform{1};
};
struct Hierarchy {
  std::vector<glm::dmat4> global;     // of every node
  std::vector<Placement> placements;  // nodes with a mesh in the scene, in depth-first order
};
Hierarchy ReadHierarchy(Document& doc);
// Moves the vertices to scene space by the joints' rest pose.
void ApplySkin(Document& doc, const Hierarchy& hierarchy, int skin, Draft* draft);

// gltf_repair.cpp: makes what the file lacks. `diameter` is the model's, in model units.
void CompleteAttributes(Document& doc, double diameter, Draft* draft);

// gltf_materials.cpp: the materials, and the pictures they use.
void ReadMaterials(Document& doc, Model* model);

// gltf_fur.cpp: what grows on which material. `unitScale` has one entry for each primitive of the model.
void ResolveFur(Document& doc, const LoadOptions& options, std::span<const double> unitScale, Model* model);

}  // namespace fur::gltf
