// Buffers: data at creation, maps, updates, copies, read back.
#include <numeric>

#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

std::vector<uint32_t> Ramp(uint32_t count, uint32_t first = 0) {
  std::vector<uint32_t> v(count);
  std::iota(v.begin(), v.end(), first);
  return v;
}

class BufferTest : public RhiTest {
 protected:
  Ref<IBuffer> Make(Usage usage, Bind bind, const std::vector<uint32_t>& data) {
    return gpu.Buffer({.byteWidth = uint32_t(data.size() * 4), .usage = usage, .bind = bind, .name = "test buffer"},
                      data.data());
  }
  std::vector<uint32_t> Words(const Ref<IBuffer>& b, uint32_t first, uint32_t count) {
    return gpu.ReadAs<uint32_t>(b.get(), first * 4, count);
  }
};

TEST_P(BufferTest, InitReadback) {
  const std::vector<uint32_t> data = Ramp(300);
  EXPECT_EQ(Words(Make(Usage::Default, Bind::VertexBuffer, data), 0, 300), data);
  EXPECT_EQ(Words(Make(Usage::Immutable, Bind::IndexBuffer, data), 0, 300), data);
  EXPECT_EQ(Words(Make(Usage::Dynamic, Bind::VertexBuffer, data), 0, 300), data);
  EXPECT_EQ(Words(Make(Usage::Staging, Bind::None, data), 0, 300), data);
  EXPECT_EQ(Words(Make(Usage::Default, Bind::VertexBuffer, data), 17, 3), (std::vector<uint32_t>{17, 18, 19}));
}

TEST_P(BufferTest, DescIsKept) {
  const Ref<IBuffer> b =
      gpu.Buffer({.byteWidth = 64, .usage = Usage::Dynamic, .bind = Bind::ShaderResource, .structureStride = 16});
  EXPECT_EQ(b->Desc().byteWidth, 64u);
  EXPECT_EQ(b->Desc().structureStride, 16u);
  EXPECT_EQ(b->GetUsage(), Usage::Dynamic);
}

TEST_P(BufferTest, UpdateSubresourceOfABox) {
  const Ref<IBuffer> b = Make(Usage::Default, Bind::VertexBuffer, Ramp(16));
  const std::vector<uint32_t> part = {100, 101, 102};
  const Box box{8, 0, 0, 20, 1, 1};
  context.UpdateSubresource(b.get(), 0, &box, part.data(), 0, 0);
  EXPECT_EQ(Words(b, 1, 6), (std::vector<uint32_t>{1, 100, 101, 102, 5, 6}));
  const std::vector<uint32_t> all = Ramp(16, 50);
  context.UpdateSubresource(b.get(), 0, nullptr, all.data(), 0, 0);
  EXPECT_EQ(Words(b, 0, 16), all);
}

TEST_P(BufferTest, CopyRegion) {
  const Ref<IBuffer> a = Make(Usage::Default, Bind::VertexBuffer, Ramp(16)),
                     b = Make(Usage::Default, Bind::IndexBuffer, Ramp(16, 100));
  const Box box{4, 0, 0, 16, 1, 1};
  context.CopySubresourceRegion(b.get(), 0, 20, 0, 0, a.get(), 0, &box);
  EXPECT_EQ(Words(b, 4, 5), (std::vector<uint32_t>{104, 1, 2, 3, 108}));
  context.CopyResource(b.get(), a.get());
  EXPECT_EQ(Words(b, 0, 16), Ramp(16));
}

TEST_P(BufferTest, StagingIsMappedForReadAndWrite) {
  const Ref<IBuffer> upload = Make(Usage::Staging, Bind::None, Ramp(8)),
                     b = Make(Usage::Default, Bind::VertexBuffer, Ramp(8)),
                     download = Make(Usage::Staging, Bind::None, Ramp(8));
  Mapped m;
  ASSERT_EQ(context.Map(upload.get(), 0, MapMode::Write, &m), Status::Ok);
  const std::vector<uint32_t> data = Ramp(8, 40);
  std::memcpy(m.data, data.data(), 32);
  context.Unmap(upload.get(), 0);
  context.CopyResource(b.get(), upload.get());
  context.CopyResource(download.get(), b.get());
  ASSERT_EQ(context.Map(download.get(), 0, MapMode::Read, &m), Status::Ok);
  EXPECT_EQ(std::memcmp(m.data, data.data(), 32), 0);
  context.Unmap(download.get(), 0);
}

// Two draws of one buffer with other contents in one pass: each must see its own.
TEST_P(BufferTest, MapDiscardTwoDrawsSameBuffer) {
  struct Vertex {
    float position[3], color[4];
  };
  const Target target = gpu.MakeTarget({});
  const Ref<IBuffer> b =
      gpu.Buffer({.byteWidth = 4 * sizeof(Vertex), .usage = Usage::Dynamic, .bind = Bind::VertexBuffer});
  const InputElement layout[] = {{.semantic = "POSITION", .format = Format::RGB32_Float},
                                 {.semantic = "COLOR", .format = Format::RGBA32_Float, .offset = 12}};
  gpu.SetShaders(test_shaders::mesh_VSMesh, test_shaders::mesh_PSMesh);
  context.IASetInputLayout(gpu.Layout(layout, gpu.Shader(test_shaders::mesh_VSMesh).get()).get());
  context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  gpu.SetVertices(b.get(), sizeof(Vertex));
  gpu.Clear(target, {0, 0, 0, 0});
  gpu.SetTarget(target);
  device.GetStats(true);
  for (int half = 0; half < 2; ++half) {
    const float left = float(half) - 1, right = float(half), green = float(half);
    const Vertex v[4] = {{{left, 1, 0}, {1, green, 0, 1}},
                         {{right, 1, 0}, {1, green, 0, 1}},
                         {{left, -1, 0}, {1, green, 0, 1}},
                         {{right, -1, 0}, {1, green, 0, 1}}};
    Mapped m;
    ASSERT_EQ(context.Map(b.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
    std::memcpy(m.data, v, sizeof v);
    context.Unmap(b.get(), 0);
    context.Draw(4, 0);
  }
  EXPECT_EQ(device.GetStats(false).passBreaks, 0u);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t) {
    return Rgba8{255, uint8_t(x < 8 ? 0 : 255), 0, 255};
  }));
}

TEST_P(BufferTest, NoOverwriteAppend) {
  const Target target = gpu.MakeTarget({.width = 8, .height = 1});
  const Ref<IBuffer> b =
      gpu.Buffer({.byteWidth = 8 * 16, .usage = Usage::Dynamic, .bind = Bind::ShaderResource, .structureStride = 16});
  gpu.SetTarget(target);
  gpu.SetTexture(Stage::Pixel, 0, b.get());
  for (uint32_t i = 0; i < 8; ++i) {
    Mapped m;
    ASSERT_EQ(context.Map(b.get(), 0, i == 0 ? MapMode::WriteDiscard : MapMode::WriteNoOverwrite, &m), Status::Ok);
    const Rgba32F value{float(i + 1) / 255, 0, 0, 1};
    std::memcpy(static_cast<uint8_t*>(m.data) + i * 16, &value, sizeof value);
    context.Unmap(b.get(), 0);
    const float left = float(i) / 4 - 1;
    gpu.DrawRect(test_shaders::buffers_PSItem, {.rectangle = {left, 1, left + 0.25f, -1}});
  }
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t) { return Rgba8{uint8_t(x + 1), 0, 0, 255}; }));
}

TEST_P(BufferTest, ImmutableWriteRejected) {
  sink.Expect(MsgCode::ImmutableWrite, "every way of writing an immutable buffer");
  const Ref<IBuffer> fixed = Make(Usage::Immutable, Bind::VertexBuffer, Ramp(8)),
                     other = Make(Usage::Default, Bind::VertexBuffer, Ramp(8, 9));
  const std::vector<uint32_t> data = Ramp(8, 70);
  context.UpdateSubresource(fixed.get(), 0, nullptr, data.data(), 0, 0);
  context.CopyResource(fixed.get(), other.get());
  context.CopySubresourceRegion(fixed.get(), 0, 0, 0, 0, other.get(), 0, nullptr);
  EXPECT_EQ(sink.Count(MsgCode::ImmutableWrite), 3) << sink.Dump();
  EXPECT_EQ(Words(fixed, 0, 8), Ramp(8));
}

TEST_P(BufferTest, WrongMapsAreRejected) {
  sink.Expect(MsgCode::MapMode, "maps that the usage does not allow");
  const Ref<IBuffer> normal = Make(Usage::Default, Bind::VertexBuffer, Ramp(8)),
                     dynamic = Make(Usage::Dynamic, Bind::VertexBuffer, Ramp(8)),
                     staging = Make(Usage::Staging, Bind::None, Ramp(8));
  Mapped m;
  EXPECT_EQ(context.Map(normal.get(), 0, MapMode::WriteDiscard, &m), Status::InvalidArg);
  EXPECT_EQ(context.Map(normal.get(), 0, MapMode::Read, &m), Status::InvalidArg);
  EXPECT_EQ(context.Map(dynamic.get(), 0, MapMode::Read, &m), Status::InvalidArg);
  EXPECT_EQ(context.Map(dynamic.get(), 0, MapMode::Write, &m), Status::InvalidArg);
  EXPECT_EQ(context.Map(staging.get(), 0, MapMode::WriteDiscard, &m), Status::InvalidArg);
}

TEST_P(BufferTest, MappingTwiceIsRejected) {
  sink.Expect(MsgCode::MapTwice, "second map without unmap");
  const Ref<IBuffer> b = Make(Usage::Dynamic, Bind::VertexBuffer, Ramp(8));
  Mapped m;
  ASSERT_EQ(context.Map(b.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
  EXPECT_EQ(context.Map(b.get(), 0, MapMode::WriteDiscard, &m), Status::InvalidArg);
  context.Unmap(b.get(), 0);
}

TEST_P(BufferTest, OutOfBoundsIsRejected) {
  sink.Expect(MsgCode::OutOfBounds, "copies, updates and reads beyond the end");
  const Ref<IBuffer> a = Make(Usage::Default, Bind::VertexBuffer, Ramp(8)),
                     b = Make(Usage::Default, Bind::VertexBuffer, Ramp(8));
  const std::vector<uint32_t> data = Ramp(16, 70);
  const Box beyond{16, 0, 0, 36, 1, 1};
  context.UpdateSubresource(a.get(), 0, &beyond, data.data(), 0, 0);
  context.CopySubresourceRegion(a.get(), 0, 0, 0, 0, b.get(), 0, &beyond);
  context.CopySubresourceRegion(a.get(), 0, 4, 0, 0, b.get(), 0, nullptr);
  uint32_t out[16];
  EXPECT_EQ(device.ReadBack(a.get(), 4, 32, out), Status::InvalidArg);
  EXPECT_GE(sink.Count(MsgCode::OutOfBounds), 4) << sink.Dump();
  EXPECT_EQ(Words(a, 0, 8), Ramp(8));
}

RHI_ON_EVERY_BACKEND(BufferTest);

}  // namespace
}  // namespace rhi_test
