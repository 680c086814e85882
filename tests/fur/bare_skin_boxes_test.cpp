// Where bare skin is drawn apart (fur/src/skin_pass.h).
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "fur/model.h"
#include "models.h"
#include "skin_pass.h"

namespace fur::test {
namespace {

constexpr uint32_t kWidth = 640, kHeight = 360;
const glm::dmat4 kView = glm::perspective(0.7, double(kWidth) / kHeight, 0.1, 100.0) *
                         glm::lookAt(glm::dvec3(0, 0, 6), glm::dvec3(0), glm::dvec3(0, 1, 0));

// Small boxes anywhere, as a model of one bare part.
GpuModel Pieces(uint32_t count, uint32_t triangles, uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> anywhere(-4, 4), size(0.01, 0.3);
  GpuModel model;
  model.materials.resize(1);
  model.parts.resize(1);
  GpuGeometry& g = model.geometry.emplace_back();
  g.indexCount = 3 * triangles;
  for (uint32_t i = 0; i < count; ++i) {
    const glm::dvec3 low(anywhere(random), anywhere(random), anywhere(random));
    g.pieces.push_back({low, low + glm::dvec3(size(random), size(random), size(random))});
  }
  return model;
}

std::vector<PixelBox> Boxes(const GpuModel& model, const glm::dmat4& view = kView) {
  const std::vector<glm::dmat4> placements{glm::dmat4(1)};
  return BoxesOfBarePieces(model, {.worldToClip = view, .placements = placements}, kWidth, kHeight);
}

// Blended twice, an edge would be twice as dense; left out, it would be rough.
TEST(BareSkinBoxes, HoldEachPixelOfAPieceOnce) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> within(0, 1);
  uint32_t seen = 0;
  for (uint32_t seed = 0; seed < 20; ++seed) {
    const GpuModel model = Pieces(30, 10, seed);
    const std::vector<PixelBox> boxes = Boxes(model);
    for (const PixelBox& b : boxes)
      EXPECT_TRUE(b.left >= 0 && b.top >= 0 && b.right <= int32_t(kWidth) && b.bottom <= int32_t(kHeight) && !b.Empty());
    for (size_t i = 0; i < boxes.size(); ++i)
      for (size_t j = 0; j < i; ++j) EXPECT_FALSE(boxes[i].Overlaps(boxes[j]));
    for (const Bounds& piece : model.geometry[0].pieces)
      for (int k = 0; k < 50; ++k) {
        const glm::dvec3 p = piece.min + (piece.max - piece.min) * glm::dvec3(within(random), within(random), within(random));
        const glm::dvec4 c = kView * glm::dvec4(p, 1);
        const glm::dvec2 pixel = glm::dvec2(0.5 + 0.5 * c.x / c.w, 0.5 - 0.5 * c.y / c.w) * glm::dvec2(kWidth, kHeight);
        if (c.w < 0.1 || pixel.x < 0 || pixel.y < 0 || pixel.x >= kWidth || pixel.y >= kHeight) continue;
        const auto holds = [&](const PixelBox& b) {
          return pixel.x >= b.left && pixel.x < b.right && pixel.y >= b.top && pixel.y < b.bottom;
        };
        EXPECT_EQ(std::count_if(boxes.begin(), boxes.end(), holds), 1);
        ++seen;
      }
  }
  EXPECT_GT(seen, 5000u);
}

// Each box draws all skin again: many triangles want few boxes.
TEST(BareSkinBoxes, AreFewWhereDrawingIsDear) {
  EXPECT_GT(Boxes(Pieces(30, 10, 3)).size(), 4u);
  EXPECT_EQ(Boxes(Pieces(30, 100000, 3)).size(), 1u);
  EXPECT_EQ(Boxes(Pieces(0, 10, 3)).size(), 0u);
}

TEST(BareSkinBoxes, AreTheFrameWhereAPieceIsBesideTheEye) {
  const glm::dmat4 among = glm::perspective(0.7, double(kWidth) / kHeight, 0.1, 100.0);
  GpuModel model = Pieces(1, 10, 5);
  model.geometry[0].pieces = {{glm::dvec3(-1), glm::dvec3(1)}};
  const std::vector<PixelBox> boxes = Boxes(model, among);
  ASSERT_EQ(boxes.size(), 1u);
  EXPECT_EQ(boxes[0].Area(), double(kWidth) * kHeight);
  model.geometry[0].pieces = {{glm::dvec3(2000, 0, -3), glm::dvec3(2001, 1, -2)}};
  EXPECT_TRUE(Boxes(model, among).empty()) << "beside the frame";
}

// What hangs together by position is one piece, whatever the indices.
TEST(PieceBounds, AreOfWhatHangsTogether) {
  Primitive p = Square(1);
  const auto count = uint32_t(p.vertices.size());
  const std::vector<uint32_t> indices = p.indices;
  for (const double x : {2.0, 7.0}) {  // one that shares an edge by position, one on its own
    const auto first = uint32_t(p.vertices.size());
    for (uint32_t i = 0; i < count; ++i) {
      p.vertices.push_back(p.vertices[i]);
      p.vertices.back().position.x += float(x);
    }
    for (const uint32_t i : indices) p.indices.push_back(i + first);
  }
  std::vector<Bounds> pieces = PieceBounds(p);
  std::sort(pieces.begin(), pieces.end(), [](const Bounds& a, const Bounds& b) { return a.min.x < b.min.x; });
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_EQ(pieces[0].min, glm::dvec3(-1, -1, 0));
  EXPECT_EQ(pieces[0].max, glm::dvec3(3, 1, 0));
  EXPECT_EQ(pieces[1].min.x, 6);
}

}  // namespace
}  // namespace fur::test
