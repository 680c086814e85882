// The null device itself: what is written can be read, descriptors are checked, rules of binding hold.
#include <array>
#include <cstring>
#include <numeric>

#include "fixture.h"

namespace validation_test {
namespace {

using namespace rhi;

class NullTest : public testing::Test {
 protected:
  NullTest() {
    DeviceDesc desc;
    desc.sink = &sink;
    EXPECT_EQ(CreateNullDevice(desc, &device), Status::Ok);
    context = device->ImmediateContext();
  }
  void TearDown() override { EXPECT_TRUE(sink.entries.empty()) << sink.Dump(); }
  void Gives(MsgCode code) {
    ASSERT_EQ(sink.entries.size(), 1u) << sink.Dump();
    EXPECT_EQ(sink.entries[0].code, code) << sink.Dump();
    sink.entries.clear();
  }
  static std::vector<uint8_t> Counting(size_t size) {
    std::vector<uint8_t> v(size);
    std::iota(v.begin(), v.end(), uint8_t(0));
    return v;
  }
  Ref<IBuffer> Buffer(const BufferDesc& desc, const void* init = nullptr) {
    Ref<IBuffer> b;
    EXPECT_EQ(device->CreateBuffer(desc, init, &b), Status::Ok) << sink.Dump();
    return b;
  }
  Ref<ITexture> Texture(const TextureDesc& desc, const SubresourceData* init = nullptr) {
    Ref<ITexture> t;
    EXPECT_EQ(device->CreateTexture(desc, init, &t), Status::Ok) << sink.Dump();
    return t;
  }
  std::vector<uint8_t> Read(ITexture* t, uint32_t subresource, size_t size) {
    std::vector<uint8_t> bytes(size);
    EXPECT_EQ(device->ReadBack(t, subresource, bytes.data(), size), Status::Ok) << sink.Dump();
    return bytes;
  }
  std::vector<uint8_t> Read(IBuffer* b) {
    std::vector<uint8_t> bytes(b->Desc().byteWidth);
    EXPECT_EQ(device->ReadBack(b, 0, b->Desc().byteWidth, bytes.data()), Status::Ok) << sink.Dump();
    return bytes;
  }
  template <class T, size_t N>
  std::array<T, N> Cleared(Format format, const std::array<float, 4>& rgba) {
    const Ref<ITexture> t = Texture({.width = 3, .height = 2, .format = format, .bind = Bind::RenderTarget});
    Ref<IRenderTargetView> view;
    EXPECT_EQ(device->CreateRenderTargetView(t.get(), nullptr, &view), Status::Ok);
    context->ClearRenderTargetView(view.get(), rgba.data());
    const std::vector<uint8_t> bytes = Read(t.get(), 0, 6 * sizeof(T) * N);
    std::array<T, N> last;
    std::memcpy(last.data(), bytes.data() + 5 * sizeof last, sizeof last);
    return last;
  }

  KeepingSink sink;
  Ref<IDevice> device;
  IContext* context = nullptr;
};

TEST_F(NullTest, BuffersHoldTheirData) {
  const auto data = Counting(64);
  const Ref<IBuffer> fixed =
      Buffer({.byteWidth = 64, .usage = Usage::Immutable, .bind = Bind::VertexBuffer}, data.data());
  EXPECT_EQ(Read(fixed.get()), data);
  const Ref<IBuffer> plain = Buffer({.byteWidth = 64, .bind = Bind::VertexBuffer});
  EXPECT_EQ(Read(plain.get()), std::vector<uint8_t>(64));
  const Box box{8, 0, 0, 12, 1, 1};
  context->UpdateSubresource(plain.get(), 0, &box, data.data() + 1, 0, 0);
  context->CopySubresourceRegion(plain.get(), 0, 32, 0, 0, fixed.get(), 0, &box);
  auto expected = std::vector<uint8_t>(64);
  std::copy_n(data.begin() + 1, 4, expected.begin() + 8);
  std::copy_n(data.begin() + 8, 4, expected.begin() + 32);
  EXPECT_EQ(Read(plain.get()), expected);
  context->CopyResource(plain.get(), fixed.get());
  EXPECT_EQ(Read(plain.get()), data);
}

TEST_F(NullTest, MapWritesAndReads) {
  const auto data = Counting(16);
  const Ref<IBuffer> dynamic = Buffer({.byteWidth = 16, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer}),
                     staging = Buffer({.byteWidth = 16, .usage = Usage::Staging});
  Mapped m;
  ASSERT_EQ(context->Map(dynamic.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
  std::memcpy(m.data, data.data(), 16);
  context->Unmap(dynamic.get(), 0);
  context->CopyResource(staging.get(), dynamic.get());
  ASSERT_EQ(context->Map(staging.get(), 0, MapMode::Read, &m), Status::Ok);
  EXPECT_EQ(std::memcmp(m.data, data.data(), 16), 0);
  context->Unmap(staging.get(), 0);
  const uint32_t words[2] = {1, 2};
  context->UpdateConstants(dynamic.get(), words, sizeof words);
  EXPECT_EQ(Read(dynamic.get())[4], 2);
  EXPECT_EQ(device->GetStats(true).ringBytes, 24u);
}

TEST_F(NullTest, TexturesHoldEachSubresource) {
  std::vector<std::vector<uint8_t>> texels;
  std::vector<SubresourceData> init;
  for (uint32_t slice = 0; slice < 2; ++slice)
    for (uint32_t mip = 0; mip < 3; ++mip) {
      texels.push_back(std::vector<uint8_t>((4u >> mip) * (4u >> mip), uint8_t(10 * slice + mip)));
      init.push_back({texels.back().data(), 4u >> mip, 0});
    }
  const Ref<ITexture> t = Texture({.dim = TextureDim::Tex2DArray,
                                   .width = 4,
                                   .height = 4,
                                   .depthOrArray = 2,
                                   .mipLevels = 0,
                                   .format = Format::R8_UNorm},
                                  init.data());
  EXPECT_EQ(t->Desc().mipLevels, 3u);
  for (uint32_t i = 0; i < 6; ++i) EXPECT_EQ(Read(t.get(), i, texels[i].size()), texels[i]) << i;
}

TEST_F(NullTest, UpdatesAndCopiesOfBoxes) {
  const auto data = Counting(64);
  const Ref<ITexture> a = Texture({.width = 8, .height = 8, .format = Format::R8_UNorm}),
                      b = Texture({.width = 4, .height = 4, .format = Format::R8_UNorm});
  context->UpdateSubresource(a.get(), 0, nullptr, data.data(), 8, 0);
  EXPECT_EQ(Read(a.get(), 0, 64), data);
  const Box box{2, 3, 0, 4, 5, 1};
  context->CopySubresourceRegion(b.get(), 0, 1, 1, 0, a.get(), 0, &box);
  EXPECT_EQ(Read(b.get(), 0, 16), (std::vector<uint8_t>{0, 0, 0, 0, 0, 26, 27, 0, 0, 34, 35, 0, 0, 0, 0, 0}));
}

TEST_F(NullTest, ReadBackKeepsToItsPitch) {
  const auto data = Counting(4);
  const SubresourceData init{data.data(), 2, 0};
  const Ref<ITexture> t = Texture({.width = 2, .height = 2, .format = Format::R8_UNorm}, &init);
  std::vector<uint8_t> out(6, 99);
  EXPECT_EQ(device->ReadBack(t.get(), 0, out.data(), out.size(), 4), Status::Ok);
  EXPECT_EQ(out, (std::vector<uint8_t>{0, 1, 99, 99, 2, 3}));
  EXPECT_EQ(device->ReadBack(t.get(), 0, out.data(), 5, 4), Status::InvalidArg);
  Gives(MsgCode::OutOfBounds);
}

TEST_F(NullTest, ClearsOfColours) {
  using Bytes = std::array<uint8_t, 4>;
  EXPECT_EQ((Cleared<uint8_t, 4>(Format::RGBA8_UNorm, {0, 0.5f, 1, 2})), (Bytes{0, 128, 255, 255}));
  EXPECT_EQ((Cleared<uint8_t, 4>(Format::BGRA8_UNorm, {0, 0.5f, 1, 1})), (Bytes{255, 128, 0, 255}));
  EXPECT_EQ((Cleared<uint8_t, 4>(Format::RGBA8_UNorm_sRGB, {0, 0.2159f, 1, 0.5f})), (Bytes{0, 128, 255, 128}));
  EXPECT_EQ((Cleared<float, 4>(Format::RGBA32_Float, {1, -2, 3.5f, 0})), (std::array<float, 4>{1, -2, 3.5f, 0}));
  EXPECT_EQ((Cleared<uint16_t, 4>(Format::RGBA16_Float, {1, -2, 65504, 0.1f})),
            (std::array<uint16_t, 4>{0x3C00, 0xC000, 0x7BFF, 0x2E66}));
  EXPECT_EQ((Cleared<uint32_t, 1>(Format::R32_UInt, {7, 0, 0, 0})), (std::array<uint32_t, 1>{7}));
  EXPECT_EQ((Cleared<uint32_t, 1>(Format::R10G10B10A2_UNorm, {1, 0, 1, 1})), (std::array<uint32_t, 1>{0xFFF003FF}));
}

TEST_F(NullTest, ClearsOfDepthAndStencil) {
  const Ref<ITexture> t =
      Texture({.width = 1, .height = 1, .format = Format::D24_UNorm_S8_UInt, .bind = Bind::DepthStencil});
  Ref<IDepthStencilView> view;
  ASSERT_EQ(device->CreateDepthStencilView(t.get(), nullptr, &view), Status::Ok);
  context->ClearDepthStencilView(view.get(), true, 1, true, 0x12);
  EXPECT_EQ(Read(t.get(), 0, 4), (std::vector<uint8_t>{255, 255, 255, 0x12}));
  context->ClearDepthStencilView(view.get(), true, 0, false, 0);
  EXPECT_EQ(Read(t.get(), 0, 4), (std::vector<uint8_t>{0, 0, 0, 0x12}));
  context->ClearDepthStencilView(view.get(), false, 1, true, 3);
  EXPECT_EQ(Read(t.get(), 0, 4), (std::vector<uint8_t>{0, 0, 0, 3}));
}

TEST_F(NullTest, ClearTouchesTheViewOnly) {
  const Ref<ITexture> t = Texture({.dim = TextureDim::Tex2DArray,
                                   .width = 2,
                                   .height = 2,
                                   .depthOrArray = 3,
                                   .mipLevels = 2,
                                   .format = Format::R8_UNorm,
                                   .bind = Bind::RenderTarget});
  const ViewDesc middle{.firstMip = 1, .firstSlice = 1, .sliceCount = 1};
  Ref<IRenderTargetView> view;
  ASSERT_EQ(device->CreateRenderTargetView(t.get(), &middle, &view), Status::Ok);
  const float white[4] = {1, 1, 1, 1};
  context->ClearRenderTargetView(view.get(), white);
  for (uint32_t i = 0; i < 6; ++i) EXPECT_EQ(Read(t.get(), i, i % 2 ? 1 : 4)[0], i == 3 ? 255 : 0) << i;
}

TEST_F(NullTest, ResolveOfOneColour) {
  const TextureDesc desc{.dim = TextureDim::Tex2DMS,
                         .width = 2,
                         .height = 2,
                         .sampleCount = 4,
                         .format = Format::R8_UNorm,
                         .bind = Bind::RenderTarget};
  const Ref<ITexture> four = Texture(desc), one = Texture({.width = 2, .height = 2, .format = Format::R8_UNorm});
  Ref<IRenderTargetView> view;
  ASSERT_EQ(device->CreateRenderTargetView(four.get(), nullptr, &view), Status::Ok);
  const float half[4] = {0.5f, 0, 0, 0};
  context->ClearRenderTargetView(view.get(), half);
  context->ResolveSubresource(one.get(), 0, four.get(), 0, Format::R8_UNorm);
  EXPECT_EQ(Read(one.get(), 0, 4), std::vector<uint8_t>(4, 128));
  std::vector<uint8_t> out(4);
  EXPECT_EQ(device->ReadBack(four.get(), 0, out.data(), out.size()), Status::InvalidArg);
  Gives(MsgCode::FormatMismatch);
}

TEST_F(NullTest, DescriptorsAreChecked) {
  Ref<IBuffer> b;
  EXPECT_EQ(device->CreateBuffer({}, nullptr, &b), Status::InvalidArg);
  Gives(MsgCode::InvalidDesc);
  Ref<ITexture> t;
  EXPECT_EQ(device->CreateTexture({.width = 1u << 20, .format = Format::R8_UNorm}, nullptr, &t), Status::Unsupported);
  Gives(MsgCode::CapMissing);
  const Ref<ITexture> picture = Texture({.width = 4, .height = 4, .format = Format::R8_UNorm});
  const ViewDesc beyond{.firstMip = 1};
  Ref<IShaderResourceView> v;
  EXPECT_EQ(device->CreateShaderResourceView(picture.get(), &beyond, &v), Status::InvalidArg);
  Gives(MsgCode::SubresourceOutOfRange);
  EXPECT_EQ(device->CreateShaderResourceView(nullptr, nullptr, &v), Status::InvalidArg);
  Gives(MsgCode::InvalidDesc);
  Ref<ISamplerState> s;
  EXPECT_EQ(device->CreateSamplerState({.maxAniso = 17}, &s), Status::InvalidArg);
  Gives(MsgCode::InvalidDesc);
  Ref<ISwapChain> chain;
  EXPECT_EQ(device->CreateSwapChain({.width = 1, .height = 1}, &chain), Status::Unsupported);
  Gives(MsgCode::CapMissing);
  Ref<IShader> vs;
  ASSERT_EQ(device->CreateShader(VertexBlob(), &vs), Status::Ok);
  const InputElement position{.semantic = "POSITION", .format = Format::RGB32_Float};
  Ref<IInputLayout> layout;
  EXPECT_EQ(device->CreateInputLayout(&position, 1, vs.get(), &layout), Status::InvalidArg);
  Gives(MsgCode::LayoutMismatch);
}

TEST_F(NullTest, StatesAreInternedWhileTheyLive) {
  Ref<IRasterizerState> a, b, c;
  ASSERT_EQ(device->CreateRasterizerState({}, &a), Status::Ok);
  ASSERT_EQ(device->CreateRasterizerState({}, &b), Status::Ok);
  ASSERT_EQ(device->CreateRasterizerState({.cull = CullMode::None}, &c), Status::Ok);
  EXPECT_EQ(a.get(), b.get());
  EXPECT_NE(a.get(), c.get());
  device = nullptr;  // states outlive their device
  EXPECT_EQ(c->Desc().cull, CullMode::None);
}

TEST_F(NullTest, BadDataCallsAreRefused) {
  const auto data = Counting(64);
  const Ref<IBuffer> b = Buffer({.byteWidth = 16, .bind = Bind::VertexBuffer});
  const Ref<ITexture> t = Texture({.width = 4, .height = 4, .format = Format::R8_UNorm});
  const Box far{12, 0, 0, 20, 1, 1};
  context->UpdateSubresource(b.get(), 0, &far, data.data(), 0, 0);
  Gives(MsgCode::OutOfBounds);
  context->UpdateSubresource(t.get(), 0, &far, data.data(), 0, 0);
  Gives(MsgCode::OutOfBounds);
  context->CopySubresourceRegion(t.get(), 0, 1, 0, 0, t.get(), 1, nullptr);
  Gives(MsgCode::SubresourceOutOfRange);
  context->CopySubresourceRegion(b.get(), 0, 1, 0, 0, b.get(), 0, nullptr);
  Gives(MsgCode::OutOfBounds);
  context->CopyResource(t.get(), b.get());
  Gives(MsgCode::FormatMismatch);
  Mapped m;
  EXPECT_EQ(context->Map(b.get(), 0, MapMode::Read, &m), Status::InvalidArg);
  Gives(MsgCode::MapMode);
  context->UpdateConstants(b.get(), data.data(), 4);
  Gives(MsgCode::MapMode);
}

TEST_F(NullTest, DrawsAreCountedAndQueriesReady) {
  context->Draw(3, 0);
  context->DrawIndexedInstanced(3, 2, 0, 0, 0);
  context->Dispatch(1, 1, 1);
  const Stats stats = device->GetStats(true);
  EXPECT_EQ(stats.draws, 2u);
  EXPECT_EQ(stats.dispatches, 1u);
  EXPECT_EQ(device->GetStats(false).draws, 0u);
  Ref<IQuery> event, statistics;
  ASSERT_EQ(device->CreateQuery({QueryType::Event}, &event), Status::Ok);
  ASSERT_EQ(device->CreateQuery({QueryType::PipelineStatistics}, &statistics), Status::Ok);
  context->Begin(statistics.get());
  context->End(statistics.get());
  context->End(event.get());
  bool passed = false;
  EXPECT_EQ(context->GetData(event.get(), &passed, sizeof passed, true), Status::Ok);
  EXPECT_TRUE(passed);
  PipelineStatistics values{1, 1, 1, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(context->GetData(statistics.get(), &values, sizeof values, false), Status::Ok);
  EXPECT_EQ(values.iaVertices + values.csInvocations, 0u);
}

}  // namespace
}  // namespace validation_test
