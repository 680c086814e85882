// Lists of strands as JSON and PLY.
#include <array>
#include <charconv>

#include "fur/bake_files.h"
#include "fur/file.h"

namespace fur {
namespace {

// Six digits, the same in every locale.
void AppendNumber(double x, std::string* text) {
  std::array<char, 64> digits;
  const auto [end, ok] = std::to_chars(digits.data(), digits.data() + digits.size(), x, std::chars_format::general, 6);
  text->append(digits.data(), end);
}

void AppendNumbers(std::initializer_list<double> numbers, const char* between, std::string* text) {
  const char* before = "";
  for (const double x : numbers) {
    *text += before;
    AppendNumber(x, text);
    before = between;
  }
}

const char* KindName(StrandKind kind) { return kind == StrandKind::Under ? "under" : "over"; }

glm::dvec3 Absolute(const Strand& strand, const StrandPoint& point, double tile) {
  return point.position + glm::dvec3(strand.root * tile, 0);
}

std::string StrandsJson(const BakedCoat& coat) {
  std::string text = "{\"tile\": ";
  AppendNumber(coat.params.tile, &text);
  text += ", \"strands\": [";
  const char* before = "\n";
  for (const Strand& strand : coat.strands) {
    text += std::string(before) + "{\"class\": \"" + KindName(strand.kind) + "\", \"tint\": [";
    AppendNumbers({strand.tint.r, strand.tint.g, strand.tint.b}, ", ", &text);
    text += "], \"points\": [";
    for (size_t i = 0; i < strand.points.size(); ++i) {
      const glm::dvec3 p = Absolute(strand, strand.points[i], coat.params.tile);
      text += i == 0 ? "[" : ", [";
      AppendNumbers({p.x, p.y, p.z, strand.points[i].radius}, ", ", &text);
      text += "]";
    }
    text += "]}";
    before = ",\n";
  }
  return text + "\n]}\n";
}

std::string StrandsPly(const BakedCoat& coat) {
  size_t vertices = 0;
  std::string points, edges;
  for (const Strand& strand : coat.strands) {
    for (size_t i = 0; i < strand.points.size(); ++i) {
      const glm::dvec3 p = Absolute(strand, strand.points[i], coat.params.tile);
      AppendNumbers({p.x, p.y, p.z, strand.points[i].radius, double(strand.kind)}, " ", &points);
      points += "\n";
      if (i > 0) edges += std::to_string(vertices + i - 1) + " " + std::to_string(vertices + i) + "\n";
    }
    vertices += strand.points.size();
  }
  return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertices) +
         "\nproperty float x\nproperty float y\nproperty float z\nproperty float radius\nproperty uchar class\n"
         "element edge " +
         std::to_string(vertices - coat.strands.size()) + "\nproperty int vertex1\nproperty int vertex2\nend_header\n" +
         points + edges;
}

}  // namespace

Result<Done> WriteStrands(const std::filesystem::path& file, const BakedCoat& coat) {
  if (file.extension() == ".ply") return WriteFile(file, StrandsPly(coat));
  if (file.extension() == ".json") return WriteFile(file, StrandsJson(coat));
  return Error{ErrorCode::Usage, file.string() + ": a list of strands is a .json or a .ply"};
}

}  // namespace fur
