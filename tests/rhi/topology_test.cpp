// Every topology: which vertices make up each primitive, in which order, read by a geometry shader.
#include <algorithm>
#include <map>

#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

using Primitive = std::vector<uint32_t>;  // vertex numbers
using Primitives = std::vector<Primitive>;

// Triangle i of a strip with adjacency has the even vertices 2i, 2i + 2, 2i + 4, in an order that keeps the winding.
// Across its edges lie the vertex before, the one beyond, and at the side the odd one between its first and last.
Primitives StripAdj(uint32_t count) {
  Primitives all;
  const uint32_t n = count < 6 ? 0 : (count - 4) / 2;
  for (uint32_t i = 0; i < n; ++i) {
    const bool first = i == 0, last = i + 1 == n, odd = i % 2 == 1;
    const uint32_t before = first ? 1 : 2 * i - 2, beyond = last ? 2 * i + 5 : 2 * i + 6, side = 2 * i + 3;
    // vertex, neighbour across the edge to the next, and so on around
    all.push_back(odd ? Primitive{2 * i, side, 2 * i + 4, beyond, 2 * i + 2, before}
                      : Primitive{2 * i, before, 2 * i + 2, beyond, 2 * i + 4, side});
  }
  return all;
}

Primitives Assemble(PrimitiveTopology t, uint32_t count) {
  Primitives all;
  const auto lists = [&](uint32_t n) {
    for (uint32_t i = 0; i + n <= count; i += n) {
      Primitive p;
      for (uint32_t k = 0; k < n; ++k) p.push_back(i + k);
      all.push_back(p);
    }
  };
  const auto strips = [&](uint32_t n) {
    for (uint32_t i = 0; i + n <= count; ++i) {
      Primitive p;
      for (uint32_t k = 0; k < n; ++k) p.push_back(i + k);
      if (n == 3 && i % 2) std::swap(p[1], p[2]);  // keeps the winding
      all.push_back(p);
    }
  };
  switch (t) {
    case PrimitiveTopology::PointList: lists(1); break;
    case PrimitiveTopology::LineList: lists(2); break;
    case PrimitiveTopology::TriangleList: lists(3); break;
    case PrimitiveTopology::LineListAdj: lists(4); break;
    case PrimitiveTopology::TriangleListAdj: lists(6); break;
    case PrimitiveTopology::LineStrip: strips(2); break;
    case PrimitiveTopology::TriangleStrip: strips(3); break;
    case PrimitiveTopology::LineStripAdj: strips(4); break;
    case PrimitiveTopology::TriangleStripAdj: all = StripAdj(count); break;
  }
  return all;
}

const ShaderBlob& ReaderOf(PrimitiveTopology t) {
  switch (t) {
    case PrimitiveTopology::PointList: return test_shaders::prims_GSPrimitivePoint;
    case PrimitiveTopology::LineList:
    case PrimitiveTopology::LineStrip: return test_shaders::prims_GSPrimitiveLine;
    case PrimitiveTopology::LineListAdj:
    case PrimitiveTopology::LineStripAdj: return test_shaders::prims_GSPrimitiveLineAdj;
    case PrimitiveTopology::TriangleListAdj:
    case PrimitiveTopology::TriangleStripAdj: return test_shaders::prims_GSPrimitiveTriangleAdj;
    default: return test_shaders::prims_GSPrimitiveTriangle;
  }
}

// What these cases share; some have a parameter.
template <class Fixture>
class PrimitiveCase : public Fixture {
 protected:
  // The picture that prims.hlsl draws of these primitives. `ids` maps vertex numbers to what SV_VertexID was.
  static auto Picture(const Primitives& primitives, const std::vector<uint32_t>& ids) {
    return [=](uint32_t x, uint32_t y) {
      if (x >= primitives.size()) return Rgba8{0, 0, 0, 0};
      Rgba8 texel{0, 0, 0, uint8_t(y ? 255 : 0)};
      for (uint32_t i = y * 4; i < primitives[x].size() && i < y * 4 + 4; ++i)
        texel[i - y * 4] = uint8_t(ids[primitives[x][i]] + 1);
      return texel;
    };
  }
  static std::vector<uint32_t> Counting(uint32_t n) {
    std::vector<uint32_t> v(n);
    for (uint32_t i = 0; i < n; ++i) v[i] = i;
    return v;
  }
  void Prepare(PrimitiveTopology topology) {
    Gpu& g = this->gpu;
    target = g.MakeTarget({.width = 16, .height = 2});
    g.Clear(target, {0, 0, 0, 0});
    g.SetTarget(target);
    g.SetShaders(test_shaders::prims_VSPrimitive, test_shaders::prims_PSPrimitive);
    g.SetGeometryShader(ReaderOf(topology));
    g.context->IASetPrimitiveTopology(topology);
  }
  Target target;
};
using TopologyTest = PrimitiveCase<RhiTest>;
using TopologyEachTest = PrimitiveCase<RhiTestOf<PrimitiveTopology>>;
using GeometryInputTest = PrimitiveCase<RhiTest>;

constexpr PrimitiveTopology kAll[] = {
    PrimitiveTopology::PointList,    PrimitiveTopology::LineList,        PrimitiveTopology::LineStrip,
    PrimitiveTopology::TriangleList, PrimitiveTopology::TriangleStrip,   PrimitiveTopology::LineListAdj,
    PrimitiveTopology::LineStripAdj, PrimitiveTopology::TriangleListAdj, PrimitiveTopology::TriangleStripAdj};

// Also the orders within primitives with adjacency, and that incomplete ones are dropped: every count from 1 to 14.
TEST_P(TopologyEachTest, Each) {
  RHI_NEEDS_CAP(geometryShader);
  for (uint32_t count = 1; count <= 14; ++count) {
    Prepare(Parameter());
    context.Draw(count, 0);
    EXPECT_TRUE(Matches(gpu.Read(target), Picture(Assemble(Parameter(), count), Counting(count)))) << count;
  }
}

// The same vertices through indices of 16 and 32 bits.
TEST_P(TopologyEachTest, Indexed) {
  RHI_NEEDS_CAP(geometryShader);
  const std::vector<uint32_t> indices{7, 3, 9, 1, 20, 4, 4, 2, 100, 50, 25, 12, 6, 5};
  const Ref<IBuffer> wide = gpu.BufferOf(Bind::IndexBuffer, indices);
  const Ref<IBuffer> narrow = gpu.BufferOf(Bind::IndexBuffer, std::vector<uint16_t>(indices.begin(), indices.end()));
  for (const bool is16 : {false, true}) {
    Prepare(Parameter());
    context.IASetIndexBuffer(is16 ? narrow.get() : wide.get(), is16 ? Format::R16_UInt : Format::R32_UInt, 0);
    context.DrawIndexed(14, 0, 0);
    EXPECT_TRUE(Matches(gpu.Read(target), Picture(Assemble(Parameter(), 14), indices))) << is16;
  }
}

// Direct3D 10: neighbour of the first end, first end, second end, its neighbour.
TEST_P(GeometryInputTest, LineadjVertexOrder) {
  RHI_NEEDS_CAP(geometryShader);
  Prepare(PrimitiveTopology::LineListAdj);
  context.Draw(8, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), Picture({{0, 1, 2, 3}, {4, 5, 6, 7}}, Counting(8))));
}

TEST_P(GeometryInputTest, LineadjIndexed) {
  RHI_NEEDS_CAP(geometryShader);
  const std::vector<uint32_t> indices{30, 2, 100, 7, 7, 100, 2, 30};
  const Ref<IBuffer> b = gpu.BufferOf(Bind::IndexBuffer, indices);
  Prepare(PrimitiveTopology::LineListAdj);
  context.IASetIndexBuffer(b.get(), Format::R32_UInt, 0);
  context.DrawIndexed(8, 0, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), Picture({{0, 1, 2, 3}, {4, 5, 6, 7}}, indices)));
}

TEST_P(GeometryInputTest, LineadjIncompleteDropped) {
  RHI_NEEDS_CAP(geometryShader);
  const std::vector<uint32_t> indices{3, 2, 1, 0, 7, 6, 5, 4, 9, 9, 9};
  const Ref<IBuffer> b = gpu.BufferOf(Bind::IndexBuffer, indices);
  Prepare(PrimitiveTopology::LineListAdj);
  context.IASetIndexBuffer(b.get(), Format::R32_UInt, 0);
  context.DrawIndexed(11, 0, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), Picture({{0, 1, 2, 3}, {4, 5, 6, 7}}, indices)));
}

// SV_PrimitiveID counts from 0 in each draw and in each instance, wherever the draw starts.
TEST_P(GeometryInputTest, PrimitiveId) {
  RHI_NEEDS_CAP(geometryShader);
  Prepare(PrimitiveTopology::LineList);
  context.DrawInstanced(8, 3, 5, 2);
  const Primitives expected{{0, 1}, {2, 3}, {4, 5}, {6, 7}};
  EXPECT_TRUE(Matches(gpu.Read(target), Picture(expected, Counting(8))));
  gpu.Clear(target, {0, 0, 0, 0});
  context.Draw(4, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), Picture({{0, 1}, {2, 3}}, Counting(4)))) << "the second draw";
}

// A strip begins anew after the greatest index.
TEST_P(TopologyTest, StripCutIndex) {
  RHI_NEEDS_CAP(geometryShader);
  const std::vector<uint32_t> indices{10, 11, 12, 13, ~0u, 20, 21, 22, ~0u, ~0u, 30, 31, ~0u, 40, 41, 42};
  const Ref<IBuffer> wide = gpu.BufferOf(Bind::IndexBuffer, indices);
  std::vector<uint16_t> halves;
  for (const uint32_t i : indices) halves.push_back(uint16_t(i));
  const Ref<IBuffer> narrow = gpu.BufferOf(Bind::IndexBuffer, halves);
  const std::map<PrimitiveTopology, Primitives> expected{
      {PrimitiveTopology::TriangleStrip, {{0, 1, 2}, {1, 3, 2}, {5, 6, 7}, {13, 14, 15}}},
      {PrimitiveTopology::LineStrip, {{0, 1}, {1, 2}, {2, 3}, {5, 6}, {6, 7}, {10, 11}, {13, 14}, {14, 15}}},
      {PrimitiveTopology::LineStripAdj, {{0, 1, 2, 3}}}};
  for (const auto& [topology, primitives] : expected)
    for (const bool is16 : {false, true}) {
      Prepare(topology);
      context.IASetIndexBuffer(is16 ? narrow.get() : wide.get(), is16 ? Format::R16_UInt : Format::R32_UInt, 0);
      context.DrawIndexed(uint32_t(indices.size()), 0, 0);
      EXPECT_TRUE(Matches(gpu.Read(target), Picture(primitives, indices))) << ToString(topology) << is16;
    }
}

// Strips with adjacency are cut, too: each part is assembled by itself, and a part that is too short is dropped.
TEST_P(TopologyTest, StripsWithAdjacencyAreCut) {
  RHI_NEEDS_CAP(geometryShader);
  const std::vector<uint32_t> indices{10, 11, 12, 13, 14, 15, 16, 17, ~0u, 20, 21, 22, 23, 24, 25, ~0u, 30, 31, 32, 33};
  const Ref<IBuffer> wide = gpu.BufferOf(Bind::IndexBuffer, indices);
  std::vector<uint16_t> halves;
  for (const uint32_t i : indices) halves.push_back(uint16_t(i));
  const Ref<IBuffer> narrow = gpu.BufferOf(Bind::IndexBuffer, halves);
  for (const PrimitiveTopology topology : {PrimitiveTopology::TriangleStripAdj, PrimitiveTopology::LineStripAdj}) {
    Primitives expected;
    for (const auto& [first, count] : {std::pair{0u, 8u}, std::pair{9u, 6u}, std::pair{16u, 4u}})
      for (Primitive p : Assemble(topology, count)) {
        for (uint32_t& vertex : p) vertex += first;
        expected.push_back(p);
      }
    for (const bool is16 : {false, true}) {
      Prepare(topology);
      context.IASetIndexBuffer(is16 ? narrow.get() : wide.get(), is16 ? Format::R16_UInt : Format::R32_UInt, 0);
      context.DrawIndexed(uint32_t(indices.size()), 0, 0);
      EXPECT_TRUE(Matches(gpu.Read(target), Picture(expected, indices))) << ToString(topology) << is16;
    }
  }
}

// The cut is the index as it stands in the buffer, before the base vertex is added; instances begin anew.
TEST_P(TopologyTest, CutComesBeforeTheBaseVertex) {
  RHI_NEEDS_CAP(geometryShader);
  const Ref<IBuffer> b = gpu.BufferOf(Bind::IndexBuffer, std::vector<uint16_t>{11, 12, 13, 0xFFFF, 21, 22, 23, 24});
  const std::vector<uint32_t> seen{11, 12, 13, 0, 21, 22, 23, 24};  // SV_VertexID is without the base
  const Primitives expected{{0, 1, 2}, {4, 5, 6}, {5, 7, 6}};
  Prepare(PrimitiveTopology::TriangleStrip);
  context.IASetIndexBuffer(b.get(), Format::R16_UInt, 0);
  for (const int32_t base : {0, 5, -11, 70000}) {
    gpu.Clear(target, {0, 0, 0, 0});
    context.DrawIndexed(8, 0, base);
    EXPECT_TRUE(Matches(gpu.Read(target), Picture(expected, seen))) << base;
  }
}

// Lists are not cut: the greatest index is a vertex number there.
TEST_P(TopologyTest, ListsAreNotCut) {
  RHI_NEEDS_CAP(geometryShader);
  const Ref<IBuffer> b = gpu.BufferOf(Bind::IndexBuffer, std::vector<uint16_t>{1, 2, 0xFFFF, 3, 4, 5});
  Prepare(PrimitiveTopology::TriangleList);
  context.IASetIndexBuffer(b.get(), Format::R16_UInt, 0);
  context.DrawIndexed(6, 0, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), Picture({{0, 1, 2}, {3, 4, 5}}, {1, 2, 254, 3, 4, 5})))
      << "65536 is clamped to 255";
}

// 0xFFFF is an index like any other where indices have 32 bits.
TEST_P(TopologyTest, NoCutAt16BitsOf32BitIndices) {
  RHI_NEEDS_CAP(geometryShader);
  const Ref<IBuffer> b = gpu.BufferOf(Bind::IndexBuffer, std::vector<uint32_t>{1, 2, 0xFFFF, 3});
  Prepare(PrimitiveTopology::TriangleStrip);
  context.IASetIndexBuffer(b.get(), Format::R32_UInt, 0);
  context.DrawIndexed(4, 0, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), Picture({{0, 1, 2}, {1, 3, 2}}, {1, 2, 254, 3}))) << "65536 is clamped to 255";
}

// Without a geometry shader: one pixel for each point, lines along a row of pixel centres.
TEST_P(TopologyTest, PointsAndLinesAreDrawn) {
  struct Vertex {
    float position[3], color[4];
  };
  const Target row = gpu.MakeTarget({.width = 16, .height = 3});
  const auto at = [](int x, int y) {
    return Vertex{{(float(x) + 0.5f) / 8 - 1, 1 - (float(y) + 0.5f) / 1.5f, 0.5f}, {1, 1, 1, 1}};
  };
  const Ref<IBuffer> b = gpu.BufferOf(Bind::VertexBuffer, std::vector<Vertex>{at(1, 0), at(4, 1), at(9, 1), at(15, 2)});
  const InputElement layout[] = {{.semantic = "POSITION", .format = Format::RGB32_Float},
                                 {.semantic = "COLOR", .format = Format::RGBA32_Float, .offset = 12}};
  gpu.SetTarget(row);
  gpu.SetShaders(test_shaders::mesh_VSMesh, test_shaders::mesh_PSMesh);
  context.IASetInputLayout(gpu.Layout(layout, gpu.Shader(test_shaders::mesh_VSMesh).get()).get());
  gpu.SetVertices(b.get(), sizeof(Vertex));
  const Rgba8 white{255, 255, 255, 255}, black{0, 0, 0, 0};
  gpu.Clear(row, {0, 0, 0, 0});
  context.IASetPrimitiveTopology(PrimitiveTopology::PointList);
  context.Draw(4, 0);
  EXPECT_TRUE(Matches(gpu.Read(row), [&](uint32_t x, uint32_t y) {
    return (x == 1 && y == 0) || (x == 4 && y == 1) || (x == 9 && y == 1) || (x == 15 && y == 2) ? white : black;
  }));
  gpu.Clear(row, {0, 0, 0, 0});
  context.IASetPrimitiveTopology(PrimitiveTopology::LineList);
  context.Draw(2, 1);  // the last pixel of a line is not drawn
  EXPECT_TRUE(
      Matches(gpu.Read(row), [&](uint32_t x, uint32_t y) { return y == 1 && x >= 4 && x < 9 ? white : black; }));
}

std::string NameOf(PrimitiveTopology t) {
  static constexpr const char* kNames[] = {"point_list",     "line_list",         "line_strip",
                                           "triangle_list",  "triangle_strip",    "line_list_adj",
                                           "line_strip_adj", "triangle_list_adj", "triangle_strip_adj"};
  return kNames[std::find(std::begin(kAll), std::end(kAll), t) - kAll];
}

RHI_ON_EVERY_BACKEND(TopologyTest);
RHI_MATRIX(TopologyEachTest, kAll, [](PrimitiveTopology each) { return NameOf(each); });
RHI_ON_EVERY_BACKEND(GeometryInputTest);

}  // namespace
}  // namespace rhi_test
