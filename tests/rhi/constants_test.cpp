// Constants: a slice of a ring for each update; they never end a pass.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

class ConstantsTest : public RhiTest {
 protected:
  Ref<IBuffer> Make(uint32_t bytes) {
    return gpu.Buffer({.byteWidth = bytes, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer, .name = "constants"});
  }
  void Bind4(const std::array<Ref<IBuffer>, 4>& buffers) {
    IBuffer* raw[4] = {buffers[0].get(), buffers[1].get(), buffers[2].get(), buffers[3].get()};
    context.SetConstantBuffers(0, 4, raw);
  }
};

// One pixel for each of 10,000 draws, each with constants of its own, in one pass.
TEST_P(ConstantsTest, Update10kNoPassBreak) {
  const Target target = gpu.MakeTarget({.width = 100, .height = 100, .format = Format::RGBA8_UNorm});
  gpu.Clear(target, {0, 0, 0, 0});
  gpu.SetTarget(target);
  gpu.SetShaders(test_shaders::rect_VSRect, test_shaders::rect_PSTint);
  context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  device.GetStats(true);
  for (uint32_t i = 0; i < 10000; ++i) {
    const float x = float(i % 100) / 50 - 1, y = 1 - float(i / 100) / 50;
    gpu.SetDraw(
        {.tint = {float(i % 100) / 255, float(i / 100) / 255, 1, 1}, .rectangle = {x, y, x + 0.02f, y - 0.02f}});
    context.Draw(4, 0);
  }
  const Stats stats = device.GetStats(false);
  EXPECT_EQ(stats.draws, 10000u);
  EXPECT_EQ(stats.passBreaks, 0u);
  EXPECT_LE(stats.passes, 1u);
  EXPECT_GE(stats.ringBytes, 10000u * sizeof(DrawConstants));
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t y) {
    return Rgba8{uint8_t(x), uint8_t(y), 255, 255};
  }));
}

// More than a page of the ring in each of six frames, so that every page comes round again while frames are in flight.
TEST_P(ConstantsTest, RingWrapThreeFrames) {
  std::vector<Target> targets;
  device.GetStats(true);
  for (uint32_t frame = 0; frame < 6; ++frame) {
    const Target& target = targets.emplace_back(gpu.MakeTarget({.width = 64, .height = 64}));
    gpu.SetTarget(target);
    gpu.SetShaders(test_shaders::rect_VSRect, test_shaders::rect_PSTint);
    context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
    for (uint32_t i = 0; i < 4096; ++i) {
      const float x = float(i % 64) / 32 - 1, y = 1 - float(i / 64) / 32;
      gpu.SetDraw({.tint = {float(i % 64) / 255, float(i / 64) / 255, float(frame + 1) / 255, 1},
                   .rectangle = {x, y, x + 0.03125f, y - 0.03125f}});
      context.Draw(4, 0);
    }
    context.EndFrame();
  }
  EXPECT_GE(device.GetStats(false).ringBytes, 6 * 4096 * sizeof(DrawConstants));
  for (uint8_t frame = 0; frame < 6; ++frame)
    EXPECT_TRUE(Matches(gpu.Read(targets[frame]),
                        [frame](uint32_t x, uint32_t y) {
                          return Rgba8{uint8_t(x), uint8_t(y), uint8_t(frame + 1), 255};
                        }))
        << "frame " << +frame;
}

TEST_P(ConstantsTest, FourSlotsAreSharedByTheStages) {
  const Target target = gpu.MakeTarget({.width = 4, .height = 4});
  std::array<Ref<IBuffer>, 4> buffers;
  for (uint32_t slot = 0; slot < 4; ++slot) {
    buffers[slot] = Make(48);
    const float value = float(10 * (slot + 1)) / 255;
    const std::array<float, 12> data{value, value, value, value};
    context.UpdateConstants(buffers[slot].get(), data.data(), sizeof data);
  }
  Bind4(buffers);
  gpu.SetTarget(target);
  gpu.SetShaders(test_shaders::buffers_VSConstants, test_shaders::buffers_PSConstants);
  context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  context.Draw(4, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t, uint32_t) { return Rgba8{10, 20, 30, 40}; }));
  gpu.SetShaders(test_shaders::buffers_VSConstants, test_shaders::rect_PSUv);
  context.Draw(4, 0);
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t, uint32_t) { return Rgba8{40, 20, 0, 255}; }));
}

TEST_P(ConstantsTest, UpdateNeedsNoNewBinding) {
  const Target target = gpu.MakeTarget({.width = 2, .height = 1});
  const Ref<IBuffer> b = Make(sizeof(DrawConstants));
  IBuffer* raw = b.get();
  context.SetConstantBuffers(3, 1, &raw);
  gpu.SetTarget(target);
  gpu.SetShaders(test_shaders::rect_VSRect, test_shaders::rect_PSTint);
  context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
  for (int half = 0; half < 2; ++half) {
    const DrawConstants c{.tint = {float(half), 1, 0, 1}, .rectangle = {float(half) - 1, 1, float(half), -1}};
    if (half == 0) {
      context.UpdateConstants(b.get(), &c, sizeof c);
    } else {
      Mapped m;
      ASSERT_EQ(context.Map(b.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
      std::memcpy(m.data, &c, sizeof c);
      context.Unmap(b.get(), 0);
    }
    context.Draw(4, 0);
  }
  EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t x, uint32_t) { return Rgba8{uint8_t(255 * x), 255, 0, 255}; }));
}

// Contents stay from frame to frame, and a buffer that was made with its data needs no update.
TEST_P(ConstantsTest, ContentsOutliveFrames) {
  const Target target = gpu.MakeTarget({.width = 2, .height = 1});
  const DrawConstants c{.tint = {0, 1, 0, 1}};
  for (const Usage usage : {Usage::Dynamic, Usage::Default, Usage::Immutable}) {
    const Ref<IBuffer> b = gpu.Buffer({.byteWidth = sizeof c, .usage = usage, .bind = Bind::ConstantBuffer}, &c);
    for (int frame = 0; frame < 5; ++frame) {
      gpu.Clear(target, {1, 0, 0, 1});
      IBuffer* raw = b.get();
      context.SetConstantBuffers(3, 1, &raw);
      gpu.SetTarget(target);
      gpu.SetShaders(test_shaders::rect_VSRect, test_shaders::rect_PSTint);
      context.IASetPrimitiveTopology(PrimitiveTopology::TriangleStrip);
      context.Draw(4, 0);
      context.EndFrame();
    }
    EXPECT_TRUE(Matches(gpu.Read(target), [](uint32_t, uint32_t) { return Rgba8{0, 255, 0, 255}; })) << int(usage);
  }
}

// How many references there are: the caller's one, and those of the context.
uint32_t References(IBuffer& buffer) {
  buffer.AddRef();
  return buffer.Release();
}

// A draw makes the backend look at the buffers; neither of them may be kept after it is unbound.
TEST_P(ConstantsTest, UnboundBuffersAreNotHeld) {
  const Target target = gpu.MakeTarget({});
  for (const bool clearState : {true, false}) {
    const Ref<IBuffer> dynamic = Make(64);
    const Ref<IBuffer> fixed = gpu.Buffer({.byteWidth = 64, .bind = Bind::ConstantBuffer, .name = "fixed"});
    gpu.SetTarget(target);
    Bind4({dynamic, fixed, dynamic, {}});
    gpu.DrawRect(test_shaders::rect_PSTint);
    if (clearState) {
      context.ClearState();
    } else {
      Bind4({});
    }
    EXPECT_EQ(References(*dynamic), 1u) << clearState;
    EXPECT_EQ(References(*fixed), 1u) << clearState;
  }
  gpu.SetTarget(target);
  gpu.DrawRect(test_shaders::rect_PSTint);  // what the backend remembered of the buffers is gone with them
}

TEST_P(ConstantsTest, UpdateOfTooMuchIsReported) {
  sink.Expect(MsgCode::OutOfBounds, "more bytes than the buffer has");
  const std::array<float, 16> data{};
  context.UpdateConstants(Make(32).get(), data.data(), sizeof data);
}

TEST_P(ConstantsTest, SixteenKilobytesAreTheLimit) {
  Make(kMaxConstantBufferBytes);
  sink.Expect(MsgCode::InvalidDesc, "more than a constant buffer may hold");
  Ref<IBuffer> none;
  const BufferDesc desc{
      .byteWidth = kMaxConstantBufferBytes + 16, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer};
  EXPECT_EQ(device.CreateBuffer(desc, nullptr, &none), Status::InvalidArg);
}

RHI_ON_EVERY_BACKEND(ConstantsTest);

}  // namespace
}  // namespace rhi_test
