// Clears, copies, resolves, mips.
#include <array>

#include "fixture.h"

namespace validation_test {
namespace {

using namespace rhi;

class CopyTest : public ValidationTest {
 protected:
  Ref<IBuffer> Bytes(uint32_t size, Usage usage = Usage::Default) {
    const std::vector<uint8_t> data(size);
    const Bind bind = usage == Usage::Staging ? Bind::None : Bind::VertexBuffer;
    return Buffer({.byteWidth = size, .usage = usage, .bind = bind, .name = "bytes"}, data.data());
  }
  Ref<ITexture> Square(uint32_t size, Format format = Format::RGBA8_UNorm) {
    return Texture({.width = size, .height = size, .format = format, .name = "square"});
  }
  void RegionGives(IResource* dst, uint32_t dstSub, uint32_t x, IResource* src, uint32_t srcSub, const Box* box,
                   MsgCode code) {
    context->CopySubresourceRegion(dst, dstSub, x, 0, 0, src, srcSub, box);
    Gives(code);
    context->EndFrame();
  }
};

TEST_F(CopyTest, Clears) {
  const float black[4] = {};
  context->ClearRenderTargetView(nullptr, black);
  Gives(MsgCode::InvalidDesc);
  context->ClearDepthStencilView(nullptr, true, 1, false, 0);
  Gives(MsgCode::InvalidDesc);
  context->ClearDepthStencilView(dsv.get(), true, 1.5f, false, 0);
  Gives(MsgCode::OutOfBounds);
  context->ClearDepthStencilView(dsv.get(), true, 1, true, 0);  // D32_Float
  Gives(MsgCode::FormatMismatch, Severity::Warning);
  context->ClearRenderTargetView(rtv.get(), black);
  context->ClearDepthStencilView(dsv.get(), true, 1, false, 0);
}

TEST_F(CopyTest, WholeResources) {
  const Ref<IBuffer> small = Bytes(32), large = Bytes(64), other = Bytes(64);
  const Ref<ITexture> four = Square(4), eight = Square(8);
  context->CopyResource(nullptr, large.get());
  Gives(MsgCode::InvalidDesc);
  context->CopyResource(large.get(), small.get());
  Gives(MsgCode::FormatMismatch);
  context->CopyResource(small.get(), four.get());
  Gives(MsgCode::FormatMismatch);
  context->CopyResource(four.get(), eight.get());
  Gives(MsgCode::FormatMismatch);
  context->CopyResource(four.get(), four.get());
  Gives(MsgCode::OutOfBounds);
  context->CopyResource(large.get(), other.get());
  context->CopyResource(four.get(), picture.get());
}

TEST_F(CopyTest, Destinations) {
  const Ref<IBuffer> source = Bytes(64), fixed = Bytes(64, Usage::Immutable), dynamic = Bytes(64, Usage::Dynamic);
  context->CopyResource(fixed.get(), source.get());
  Gives(MsgCode::ImmutableWrite);
  context->CopyResource(dynamic.get(), source.get());
  Gives(MsgCode::MapMode);
  context->CopyResource(source.get(), dynamic.get());
}

TEST_F(CopyTest, Formats) {
  const Ref<ITexture> a = Square(4), half = Square(4, Format::RGBA16_Float), twin = Square(4, Format::RGBA8_UNorm_sRGB);
  RegionGives(a.get(), 0, 0, half.get(), 0, nullptr, MsgCode::FormatMismatch);
  const Ref<ITexture> one = Target(4, 4), four = Target(4, 4, 4);
  RegionGives(one.get(), 0, 0, four.get(), 0, nullptr, MsgCode::FormatMismatch);
  context->CopySubresourceRegion(a.get(), 0, 0, 0, 0, twin.get(), 0, nullptr);
}

TEST_F(CopyTest, TextureBounds) {
  const Ref<ITexture> small = Square(4), large = Square(8);
  const Box corner{6, 6, 0, 8, 8, 1}, beyond{6, 6, 0, 9, 8, 1};
  RegionGives(small.get(), 0, 0, large.get(), 0, nullptr, MsgCode::OutOfBounds);
  RegionGives(small.get(), 0, 0, large.get(), 0, &beyond, MsgCode::OutOfBounds);
  RegionGives(small.get(), 0, 3, large.get(), 0, &corner, MsgCode::OutOfBounds);
  RegionGives(small.get(), 1, 0, large.get(), 0, &corner, MsgCode::SubresourceOutOfRange);
  RegionGives(small.get(), 0, 0, large.get(), 1, &corner, MsgCode::SubresourceOutOfRange);
  RegionGives(large.get(), 0, 0, large.get(), 0, &corner, MsgCode::OutOfBounds);
  context->CopySubresourceRegion(small.get(), 0, 2, 0, 0, large.get(), 0, &corner);
}

TEST_F(CopyTest, BlocksAreWhole) {
  const Ref<ITexture> a = Square(16, Format::BC1_UNorm), b = Square(16, Format::BC1_UNorm);
  const Box part{0, 0, 0, 6, 4, 1}, blocks{4, 0, 0, 8, 4, 1};
  RegionGives(a.get(), 0, 0, b.get(), 0, &part, MsgCode::OutOfBounds);
  RegionGives(a.get(), 0, 2, b.get(), 0, &blocks, MsgCode::OutOfBounds);
  context->CopySubresourceRegion(a.get(), 0, 8, 0, 0, b.get(), 0, &blocks);
}

TEST_F(CopyTest, BufferBoundsAndOverlap) {
  const Ref<IBuffer> a = Bytes(64), b = Bytes(64);
  const Box half{0, 0, 0, 32, 1, 1}, beyond{40, 0, 0, 65, 1, 1};
  RegionGives(a.get(), 0, 33, b.get(), 0, &half, MsgCode::OutOfBounds);
  RegionGives(a.get(), 0, 0, b.get(), 0, &beyond, MsgCode::OutOfBounds);
  RegionGives(a.get(), 0, 31, a.get(), 0, &half, MsgCode::OutOfBounds);
  context->CopySubresourceRegion(a.get(), 0, 32, 0, 0, a.get(), 0, &half);
  context->CopySubresourceRegion(a.get(), 0, 32, 0, 0, b.get(), 0, &half);
}

TEST_F(CopyTest, MappedResources) {
  const Ref<IBuffer> staging = Bytes(64, Usage::Staging), plain = Bytes(64);
  Mapped m;
  ASSERT_EQ(context->Map(staging.get(), 0, MapMode::Read, &m), Status::Ok);
  context->CopyResource(staging.get(), plain.get());
  Gives(MsgCode::MappedInUse);
  context->Unmap(staging.get(), 0);
  context->CopyResource(staging.get(), plain.get());
}

TEST_F(CopyTest, Resolve) {
  const Ref<ITexture> four = Target(8, 8, 4), one = Target(8, 8), small = Target(4, 4);
  const Ref<ITexture> half = Square(8, Format::RGBA16_Float);
  const auto gives = [&](ITexture* dst, ITexture* src, Format format, MsgCode code) {
    context->ResolveSubresource(dst, 0, src, 0, format);
    Gives(code);
    context->EndFrame();
  };
  gives(nullptr, four.get(), Format::RGBA8_UNorm, MsgCode::InvalidDesc);
  gives(small.get(), one.get(), Format::RGBA8_UNorm, MsgCode::FormatMismatch);   // no samples to resolve
  gives(half.get(), four.get(), Format::RGBA8_UNorm, MsgCode::FormatMismatch);   // formats
  gives(one.get(), four.get(), Format::RGBA16_Float, MsgCode::FormatMismatch);   // the call's format
  gives(small.get(), four.get(), Format::RGBA8_UNorm, MsgCode::FormatMismatch);  // sizes
  context->ResolveSubresource(one.get(), 1, four.get(), 0, Format::RGBA8_UNorm);
  Gives(MsgCode::SubresourceOutOfRange);
  context->ResolveSubresource(one.get(), 0, four.get(), 0, Format::RGBA8_UNorm);
}

TEST_F(CopyTest, GenerateMips) {
  const auto make = [&](Format format, Bind bind) {
    return Texture({.width = 8, .height = 8, .mipLevels = 0, .format = format, .bind = bind, .name = "chain"});
  };
  const Ref<ITexture> good = make(Format::RGBA8_UNorm, Bind::RenderTarget | Bind::ShaderResource),
                      noTarget = make(Format::RGBA8_UNorm, Bind::ShaderResource),
                      integer = make(Format::RGBA8_UInt, Bind::RenderTarget | Bind::ShaderResource);
  context->GenerateMips(nullptr);
  Gives(MsgCode::InvalidDesc);
  context->GenerateMips(View(items.get()).get());
  Gives(MsgCode::InvalidDesc);
  context->GenerateMips(View(noTarget.get()).get());
  Gives(MsgCode::WrongBindFlag);
  context->GenerateMips(View(integer.get()).get());
  Gives(MsgCode::CapMissing);
  context->GenerateMips(View(good.get()).get());
}

}  // namespace
}  // namespace validation_test
