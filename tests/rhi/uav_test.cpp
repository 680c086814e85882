// Textures that compute shaders write: every kind, mips, slices, and what is not bound.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

class UavTest : public RhiTest {
 protected:
  void Run(const ShaderBlob& shader, uint32_t slot, ITexture* texture, const ViewDesc* desc, uint32_t slices) {
    const Ref<IUnorderedAccessView> view = gpu.WriteView(texture, desc);
    IUnorderedAccessView* raw = view.get();
    context.CSSetUnorderedAccessViews(slot, 1, &raw);
    context.CSSetShader(gpu.Shader(shader).get());
    context.Dispatch(1, 1, slices);
    raw = nullptr;
    context.CSSetUnorderedAccessViews(slot, 1, &raw);
  }
  Ref<ITexture> Make(TextureDim dim, uint32_t depthOrArray, uint32_t mips) {
    const TextureDesc desc{.dim = dim,
                           .width = 8,
                           .height = 8,
                           .depthOrArray = depthOrArray,
                           .mipLevels = mips,
                           .format = Format::RGBA8_UNorm,
                           .bind = Bind::ShaderResource | Bind::UnorderedAccess};
    const Ref<ITexture> t = gpu.Texture(desc);
    const std::vector<uint8_t> zero(8 * 8 * 4 * 8);
    for (uint32_t i = 0; i < mips * (dim == TextureDim::Tex3D ? 1 : depthOrArray); ++i)
      context.UpdateSubresource(t.get(), i, nullptr, zero.data(), 8 * 4, 8 * 8 * 4);
    return t;
  }
  // The texels (0, 0)..(3, 3) of slice `z` of the view are marked, the others 0.
  static auto Marked(uint32_t z, bool written = true) {
    return [=](uint32_t x, uint32_t y) {
      return written && x < 4 && y < 4 ? Rgba8{uint8_t(x + 1), uint8_t(y + 1), uint8_t(z + 1), 255} : Rgba8{};
    };
  }
};

TEST_P(UavTest, EverySliceOfAnArray) {
  const Ref<ITexture> t = Make(TextureDim::Tex2DArray, 5, 1);
  Run(test_shaders::uav_CSLayers, 2, t.get(), nullptr, 5);
  for (uint32_t s = 0; s < 5; ++s) EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, s), Marked(s))) << s;
}

// A view of some slices of one mip: slice 0 of the shader is the view's first, and nothing else is touched.
TEST_P(UavTest, SomeSlicesOfAMip) {
  const Ref<ITexture> t = Make(TextureDim::Tex2DArray, 5, 2);
  const ViewDesc some{.firstMip = 1, .mipCount = 1, .firstSlice = 2, .sliceCount = 2};
  Run(test_shaders::uav_CSLayers, 2, t.get(), &some, 2);
  for (uint32_t s = 0; s < 5; ++s) {
    const bool inside = s == 2 || s == 3;
    EXPECT_TRUE(Matches(gpu.Read(t.get(), 1, s), Marked(s - 2, inside))) << s;
    EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, s), Marked(0, false))) << s;
  }
}

// HLSL has no RWTextureCube: the faces are the slices of an array.
TEST_P(UavTest, FacesOfACube) {
  const Ref<ITexture> t = Make(TextureDim::TexCube, 6, 1);
  Run(test_shaders::uav_CSLayers, 2, t.get(), nullptr, 6);
  for (uint32_t s = 0; s < 6; ++s) EXPECT_TRUE(Matches(gpu.Read(t.get(), 0, s), Marked(s))) << s;
}

TEST_P(UavTest, EverySliceOfAVolume) {
  const Ref<ITexture> t = Make(TextureDim::Tex3D, 4, 1);
  Run(test_shaders::uav_CSVolume, 3, t.get(), nullptr, 4);
  EXPECT_TRUE(Matches(gpu.Read(t.get()), [](uint32_t x, uint32_t y) { return Marked(y / 8)(x, y % 8); }));
}

TEST_P(UavTest, ReadAndWriteOfOneTexture) {
  const TextureDesc desc{
      .width = 4, .height = 4, .format = Format::R32_Float, .bind = Bind::ShaderResource | Bind::UnorderedAccess};
  const Ref<ITexture> t =
      gpu.TextureOf<float>(desc, [](uint32_t x, uint32_t y, auto, auto) { return float(x + 4 * y); });
  for (int i = 0; i < 3; ++i) Run(test_shaders::uav_CSTwice, 4, t.get(), nullptr, 1);
  EXPECT_TRUE(
      Matches(gpu.Read(t.get()), [](uint32_t x, uint32_t y) { return std::array<float, 1>{8 * float(x + 4 * y)}; }));
}

TEST_P(UavTest, WritesToNothingAreDropped) {
  sink.Expect(MsgCode::NothingBound, "no view");
  context.CSSetShader(gpu.Shader(test_shaders::uav_CSPlane).get());
  gpu.SetDraw({});
  context.Dispatch(1, 1, 1);
}

// A view of another kind, dimension or type of texels is as none.
TEST_P(UavTest, ViewsOfAnotherKindAreNotWritten) {
  sink.Expect(MsgCode::ViewMismatch, "a view of another kind");
  gpu.SetDraw({});
  const Ref<ITexture> array = Make(TextureDim::Tex2DArray, 2, 1), plane = Make(TextureDim::Tex2D, 1, 1);
  const Ref<IBuffer> buffer = gpu.BufferOf(Bind::UnorderedAccess, std::vector<Rgba32F>(4, Rgba32F{1, 1, 1, 1}), 16);
  int count = 0;
  const auto run = [&](const ShaderBlob& shader, uint32_t slot, IResource* resource) {
    const Ref<IUnorderedAccessView> view = gpu.WriteView(resource);
    IUnorderedAccessView* raw = view.get();
    context.CSSetUnorderedAccessViews(slot, 1, &raw);
    context.CSSetShader(gpu.Shader(shader).get());
    context.Dispatch(1, 1, 1);
    EXPECT_EQ(sink.Count(MsgCode::ViewMismatch), ++count) << sink.Dump();
    context.EndFrame();
  };
  run(test_shaders::uav_CSPlane, 0, array.get());
  run(test_shaders::uav_CSPlane, 0, buffer.get());
  run(test_shaders::uav_CSLayers, 2, plane.get());
  run(test_shaders::uav_CSIntegers, 1, plane.get());
  for (uint32_t s = 0; s < 2; ++s) EXPECT_TRUE(Matches(gpu.Read(array.get(), 0, s), Marked(0, false))) << s;
  EXPECT_TRUE(Matches(gpu.Read(plane.get()), Marked(0, false)));
  EXPECT_EQ(gpu.ReadAs<float>(buffer.get(), 0, 16), std::vector<float>(16, 1));
}

// A view that is written shows one mip, and no _sRGB format.
TEST_P(UavTest, WrongViewsAreRefused) {
  sink.Expect(MsgCode::InvalidDesc, "two mips");
  sink.Expect(MsgCode::CapMissing, "sRGB");
  const Ref<ITexture> t = Make(TextureDim::Tex2D, 1, 2);
  const ViewDesc two{.mipCount = 2}, encoded{.format = Format::RGBA8_UNorm_sRGB};
  Ref<IUnorderedAccessView> none;
  EXPECT_EQ(device.CreateUnorderedAccessView(t.get(), &two, &none), Status::InvalidArg);
  EXPECT_EQ(device.CreateUnorderedAccessView(t.get(), &encoded, &none), Status::Unsupported);
  EXPECT_FALSE(none);
  EXPECT_EQ(gpu.WriteView(t.get())->Desc().mipCount, 1u);
}

RHI_ON_EVERY_BACKEND(UavTest);

}  // namespace
}  // namespace rhi_test
