// The input assembler: vertex formats, ids that count from 0, base vertex, step rates.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

struct IdVertex {
  float position[2];
  uint8_t data[4];
};
constexpr InputElement kIdLayout[] = {
    {.semantic = "POSITION", .format = Format::RG32_Float},
    {.semantic = "COLOR", .semanticIndex = 1, .format = Format::RGBA8_UNorm, .offset = 8}};

class InputTest : public RhiTest {
 protected:
  // A target of 16 x 4 pixels; triangle i of the buffer covers pixel (i, 0), and instance n moves n pixels down.
  void Prepare() {
    target = gpu.MakeTarget({.width = 16, .height = 4});
    std::vector<IdVertex> v;
    for (uint32_t i = 0; i < 16; ++i)
      for (uint32_t corner = 0; corner < 3; ++corner) {
        const float x = (float(i) + (corner == 1 ? 1.9f : 0.1f)) / 8 - 1, y = 1 - (corner == 2 ? 1.9f : 0.1f) / 2;
        v.push_back({{x, y}, {uint8_t(100 + i), 0, 0, 0}});
      }
    vertices = gpu.BufferOf(Bind::VertexBuffer, v);
    gpu.Clear(target, {0, 0, 0, 0});
    gpu.SetTarget(target);
    gpu.SetShaders(test_shaders::ids_VSIds, test_shaders::ids_PSIds);
    context.IASetInputLayout(gpu.Layout(kIdLayout, gpu.Shader(test_shaders::ids_VSIds).get()).get());
    gpu.SetVertices(vertices.get(), sizeof(IdVertex));
    gpu.SetDraw({.extra = {0, 0, -0.5f, 0}});  // one row down for each instance
    std::vector<uint32_t> indices(48);
    for (uint32_t i = 0; i < 48; ++i) indices[i] = i;
    indexBuffer = gpu.BufferOf(Bind::IndexBuffer, indices);
    context.IASetIndexBuffer(indexBuffer.get(), Format::R32_UInt, 0);
  }
  // `shown` is the oracle's x position of a draw of `count` triangles.
  void ExpectIds(uint32_t firstColumn, uint32_t count, uint32_t instances, uint32_t firstId, const char* what) {
    EXPECT_TRUE(Matches(gpu.Read(target), [=](uint32_t x, uint32_t y) {
      if (x < firstColumn || x >= firstColumn + count || y >= instances) return Rgba8{0, 0, 0, 0};
      return Rgba8{uint8_t(firstId + 3 * (x - firstColumn)), uint8_t(y), uint8_t(100 + x), 255};
    })) << what;
    gpu.Clear(target, {0, 0, 0, 0});
  }
  Target target;
  Ref<IBuffer> vertices, indexBuffer;
};

TEST_P(InputTest, SvVertexidExcludesBase) {
  Prepare();
  context.Draw(12, 0);
  ExpectIds(0, 4, 1, 0, "from 0");
  context.Draw(12, 6);
  ExpectIds(2, 4, 1, 0, "from 6");
}

// Direct3D: SV_VertexID of an indexed draw is the index, without the base vertex.
TEST_P(InputTest, BaseVertex) {
  Prepare();
  context.DrawIndexed(12, 0, 0);
  ExpectIds(0, 4, 1, 0, "plain");
  context.DrawIndexed(12, 3, 0);
  ExpectIds(1, 4, 1, 3, "first index 3");
  context.DrawIndexed(12, 0, 9);
  ExpectIds(3, 4, 1, 0, "base vertex 9");
  context.DrawIndexed(6, 12, -6);
  ExpectIds(2, 2, 1, 12, "base vertex -6");
}

TEST_P(InputTest, SvInstanceidExcludesBase) {
  Prepare();
  context.DrawInstanced(6, 3, 3, 0);
  ExpectIds(1, 2, 3, 0, "start 0");
  context.DrawInstanced(6, 3, 3, 7);
  ExpectIds(1, 2, 3, 0, "start 7");
  context.DrawIndexedInstanced(6, 3, 3, 3, 5);
  ExpectIds(2, 2, 3, 3, "indexed, start 5");
}

TEST_P(InputTest, SvIdsExcludeBaseIndirect) {
  RHI_NEEDS_CAP(drawIndirect);
  Prepare();
  const DrawArgs direct{6, 3, 3, 7};
  const DrawIndexedArgs indexed{6, 3, 3, 3, 5};
  std::vector<uint32_t> words(16);
  std::memcpy(&words[1], &direct, sizeof direct);
  std::memcpy(&words[8], &indexed, sizeof indexed);
  const Ref<IBuffer> args = gpu.BufferOf(Bind::IndirectArgs, words);
  context.DrawInstancedIndirect(args.get(), 4);
  ExpectIds(1, 2, 3, 0, "direct");
  context.DrawIndexedInstancedIndirect(args.get(), 32);
  ExpectIds(2, 2, 3, 3, "indexed");
}

TEST_P(InputTest, SixteenBitIndicesAndOffsets) {
  Prepare();
  std::vector<uint16_t> indices;
  for (uint16_t i = 0; i < 24; ++i) indices.push_back(uint16_t(i < 6 ? 0 : i - 6));
  const Ref<IBuffer> b = gpu.BufferOf(Bind::IndexBuffer, indices);
  context.IASetIndexBuffer(b.get(), Format::R16_UInt, 12);
  context.DrawIndexed(6, 0, 0);
  ExpectIds(0, 2, 1, 0, "16 bits from byte 12");
  context.IASetIndexBuffer(indexBuffer.get(), Format::R32_UInt, 12);
  context.DrawIndexed(6, 0, 0);
  ExpectIds(1, 2, 1, 3, "32 bits from byte 12");
  gpu.SetVertices(vertices.get(), sizeof(IdVertex), 6 * sizeof(IdVertex));
  context.Draw(6, 0);
  ExpectIds(2, 2, 1, 0, "vertex buffer offset");
}

TEST_P(InputTest, VertexFormats) {
  struct Vertex {
    float position[3];
    uint8_t color[4], bytes[4];
    uint16_t halves[2];
  };
  const uint16_t half0 = 0x3400, half1 = 0x3A00;  // 0.25, 0.75
  const auto at = [&](float x, float y) {
    return Vertex{{x, y, 0.5f}, {51, 0, 0, 255}, {1, 102, 3, 4}, {half0, half1}};
  };
  const Ref<IBuffer> b = gpu.BufferOf(Bind::VertexBuffer, std::vector<Vertex>{at(-1, 1), at(3, 1), at(-1, -3)});
  const InputElement layout[] = {
      {.semantic = "POSITION", .format = Format::RGB32_Float},
      {.semantic = "COLOR", .format = Format::RGBA8_UNorm, .offset = 12},
      {.semantic = "BLENDINDICES", .format = Format::RGBA8_UInt, .offset = 16},
      {.semantic = "TEXCOORD", .semanticIndex = 3, .format = Format::RG16_Float, .offset = 20}};
  const Target one = gpu.MakeTarget({});
  gpu.SetTarget(one);
  gpu.SetShaders(test_shaders::ids_VSFormats, test_shaders::ids_PSIds);
  context.IASetInputLayout(gpu.Layout(layout, gpu.Shader(test_shaders::ids_VSFormats).get()).get());
  gpu.SetVertices(b.get(), sizeof(Vertex));
  context.Draw(3, 0);
  EXPECT_TRUE(Matches(gpu.Read(one), [](auto, auto) { return Rgba8{51, 102, 191, 255}; }));
}

// Attributes for each instance, from slots of their own, stepping every instance and every second one; the start
// counts.
TEST_P(InputTest, InstanceStepRate) {
  RHI_NEEDS_CAP(instanceStepRate);
  const Target row = gpu.MakeTarget({.width = 16, .height = 1});
  const std::vector<std::array<float, 2>> corners{{-1, 1}, {-0.875f, 1}, {-1, -1}, {-0.875f, -1}};
  std::vector<std::array<float, 2>> offsets;
  std::vector<Rgba8> colors;
  for (uint32_t i = 0; i < 16; ++i) {
    offsets.push_back({float(i) / 8, 0});
    colors.push_back({uint8_t(i + 1), 0, 0, 255});
  }
  const InputElement layout[] = {{.semantic = "POSITION", .format = Format::RG32_Float},
                                 {.semantic = "COLOR",
                                  .format = Format::RGBA8_UNorm,
                                  .slot = 1,
                                  .inputClass = InputClass::PerInstance,
                                  .stepRate = 2},
                                 {.semantic = "TEXCOORD",
                                  .semanticIndex = 2,
                                  .format = Format::RG32_Float,
                                  .slot = 5,
                                  .inputClass = InputClass::PerInstance,
                                  .stepRate = 1}};
  const Ref<IBuffer> a = gpu.BufferOf(Bind::VertexBuffer, corners), b = gpu.BufferOf(Bind::VertexBuffer, colors),
                     c = gpu.BufferOf(Bind::VertexBuffer, offsets);
  gpu.Clear(row, {0, 0, 0, 0});
  gpu.SetTarget(row);
  gpu.SetShaders(test_shaders::mesh_VSInstanced, test_shaders::mesh_PSMesh);
  context.IASetInputLayout(gpu.Layout(layout, gpu.Shader(test_shaders::mesh_VSInstanced).get()).get());
  context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  gpu.SetVertices(a.get(), 8, 0, 0);
  gpu.SetVertices(b.get(), 4, 0, 1);
  gpu.SetVertices(c.get(), 8, 0, 5);
  context.DrawInstanced(4, 6, 0, 0);
  EXPECT_TRUE(Matches(gpu.Read(row), [](uint32_t x, auto) {
    return x < 6 ? Rgba8{uint8_t(x / 2 + 1), 0, 0, 255} : Rgba8{0, 0, 0, 0};
  }));
  gpu.Clear(row, {0, 0, 0, 0});
  context.DrawInstanced(4, 4, 0, 3);  // instances 3..6: the element is start + index / step
  EXPECT_TRUE(Matches(gpu.Read(row), [](uint32_t x, auto) {
    return x >= 3 && x < 7 ? Rgba8{uint8_t(3 + (x - 3) / 2 + 1), 0, 0, 255} : Rgba8{0, 0, 0, 0};
  }));
}

TEST_P(InputTest, MissingElementOfTheLayoutIsRefused) {
  sink.Expect(MsgCode::LayoutMismatch, "the shader reads COLOR1");
  Ref<IInputLayout> none;
  EXPECT_EQ(device.CreateInputLayout(kIdLayout, 1, gpu.Shader(test_shaders::ids_VSIds).get(), &none),
            Status::InvalidArg);
  EXPECT_FALSE(none);
}

// A vertex buffer that is not bound reads 0, as in Direct3D 10: all vertices at one point, so nothing is drawn.
TEST_P(InputTest, UnboundVertexBufferReadsZero) {
  Prepare();
  sink.Allow(MsgCode::NothingBound, "no vertex buffer");
  gpu.SetVertices(nullptr, 0);
  context.Draw(12, 0);
  ExpectIds(0, 0, 0, 0, "nothing");
}

// Vertices beyond the end of their buffer read 0: here those of a second buffer that is too short.
TEST_P(InputTest, VerticesBeyondTheBufferReadZero) {
  Prepare();
  const InputElement two[] = {{.semantic = "POSITION", .format = Format::RG32_Float},
                              {.semantic = "COLOR", .semanticIndex = 1, .format = Format::RGBA8_UNorm, .slot = 3}};
  const Ref<IBuffer> colors = gpu.BufferOf(Bind::VertexBuffer, std::vector<Rgba8>(6, Rgba8{77, 0, 0, 0}));
  context.IASetInputLayout(gpu.Layout(two, gpu.Shader(test_shaders::ids_VSIds).get()).get());
  gpu.SetVertices(colors.get(), 4, 0, 3);
  for (const bool indexed : {false, true}) {
    gpu.Clear(target, {0, 0, 0, 0});
    if (indexed)
      context.DrawIndexed(12, 0, 0);
    else
      context.Draw(12, 0);
    EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t y) {
      if (x >= 4 || y > 0) return Rgba8{0, 0, 0, 0};
      return Rgba8{uint8_t(3 * x), 0, uint8_t(x < 2 ? 77 : 0), 255};
    })) << indexed;
  }
}

// Indices beyond the end of their buffer are 0.
TEST_P(InputTest, IndicesBeyondTheBufferReadZero) {
  sink.Allow(MsgCode::ApiValidation, "07825: the layer asks for robustBufferAccess2, which some drivers lack");
  Prepare();
  const Ref<IBuffer> few = gpu.BufferOf(Bind::IndexBuffer, std::vector<uint32_t>{3, 4, 5, 9, 10, 11});
  context.IASetIndexBuffer(few.get(), Format::R32_UInt, 0);
  context.DrawIndexed(12, 0, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t y) {
    const bool drawn = (x == 1 || x == 3) && y == 0;  // vertex 0 three times covers nothing
    return drawn ? Rgba8{uint8_t(3 * x), 0, uint8_t(100 + x), 255} : Rgba8{0, 0, 0, 0};
  }));
}

RHI_ON_EVERY_BACKEND(InputTest);

}  // namespace
}  // namespace rhi_test
