// Map, Unmap, UpdateConstants, UpdateSubresource.
#include <array>

#include "fixture.h"

namespace validation_test {
namespace {

using namespace rhi;

class DataTest : public ValidationTest {
 protected:
  Ref<IBuffer> Made(Usage usage, Bind bind = Bind::VertexBuffer) {
    const std::array<uint8_t, 64> data{};
    return Buffer({.byteWidth = 64, .usage = usage, .bind = bind, .name = "made"}, data.data());
  }
  void MapGives(IResource* resource, MapMode mode, MsgCode code, uint32_t subresource = 0) {
    Mapped m{&m, 1, 1};
    EXPECT_EQ(context->Map(resource, subresource, mode, &m), Status::InvalidArg);
    EXPECT_EQ(m.data, nullptr);
    Gives(code);
    context->EndFrame();
  }
  void MapsWell(IResource* resource, MapMode mode, uint32_t subresource = 0) {
    Mapped m;
    EXPECT_EQ(context->Map(resource, subresource, mode, &m), Status::Ok);
    EXPECT_NE(m.data, nullptr);
    context->Unmap(resource, subresource);
    GivesNothing();
  }
  const std::array<uint8_t, 256> bytes_{};
};

TEST_F(DataTest, MapModes) {
  const Ref<IBuffer> dynamic = Made(Usage::Dynamic), staging = Made(Usage::Staging, Bind::None),
                     fixed = Made(Usage::Immutable), plain = Made(Usage::Default);
  MapGives(dynamic.get(), MapMode::Write, MsgCode::MapMode);
  MapsWell(dynamic.get(), MapMode::WriteDiscard);
  MapsWell(dynamic.get(), MapMode::WriteNoOverwrite);
  MapGives(staging.get(), MapMode::WriteDiscard, MsgCode::MapMode);
  MapsWell(staging.get(), MapMode::Read);
  MapsWell(staging.get(), MapMode::Write);
  MapGives(plain.get(), MapMode::Read, MsgCode::MapMode);
  MapGives(fixed.get(), MapMode::WriteDiscard, MsgCode::ImmutableWrite);
  MapGives(drawConstants.get(), MapMode::WriteNoOverwrite, MsgCode::MapMode);
  MapsWell(drawConstants.get(), MapMode::WriteDiscard);
}

TEST_F(DataTest, MapOfNothing) {
  MapGives(nullptr, MapMode::Read, MsgCode::InvalidDesc);
  const Ref<IBuffer> staging = Made(Usage::Staging, Bind::None);
  EXPECT_EQ(context->Map(staging.get(), 0, MapMode::Read, nullptr), Status::InvalidArg);
  Gives(MsgCode::InvalidDesc);
}

TEST_F(DataTest, MapOfSubresources) {
  const Ref<ITexture> t = Texture({.width = 4,
                                   .height = 4,
                                   .mipLevels = 3,
                                   .format = Format::RGBA8_UNorm,
                                   .usage = Usage::Staging,
                                   .bind = Bind::None,
                                   .name = "staging"});
  MapGives(t.get(), MapMode::Read, MsgCode::SubresourceOutOfRange, 3);
  MapsWell(t.get(), MapMode::Read, 2);
  Mapped m;
  ASSERT_EQ(context->Map(t.get(), 1, MapMode::Write, &m), Status::Ok);
  MapsWell(t.get(), MapMode::Write, 0);
  EXPECT_EQ(context->Map(t.get(), 1, MapMode::Write, &m), Status::InvalidArg);
  Gives(MsgCode::MapTwice);
  context->Unmap(t.get(), 1);
}

TEST_F(DataTest, MapTwice) {
  const Ref<IBuffer> dynamic = Made(Usage::Dynamic);
  Mapped m;
  ASSERT_EQ(context->Map(dynamic.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
  EXPECT_EQ(context->Map(dynamic.get(), 0, MapMode::WriteDiscard, &m), Status::InvalidArg);
  Gives(MsgCode::MapTwice);
  context->Unmap(dynamic.get(), 0);
  MapsWell(dynamic.get(), MapMode::WriteDiscard);
}

TEST_F(DataTest, UnmapWithoutMap) {
  context->Unmap(drawConstants.get(), 0);
  Gives(MsgCode::MapMode);
  context->Unmap(nullptr, 0);
  Gives(MsgCode::InvalidDesc);
  MapsWell(drawConstants.get(), MapMode::WriteDiscard);
}

TEST_F(DataTest, MappedAtEndFrame) {
  Mapped m;
  ASSERT_EQ(context->Map(drawConstants.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
  context->EndFrame();
  Gives(MsgCode::MapOpen, Severity::Warning);
  context->Unmap(drawConstants.get(), 0);
  context->EndFrame();
}

TEST_F(DataTest, UpdateConstants) {
  context->UpdateConstants(nullptr, bytes_.data(), 16);
  Gives(MsgCode::NothingBound);
  context->UpdateConstants(drawConstants.get(), nullptr, 16);
  Gives(MsgCode::InvalidDesc);
  context->UpdateConstants(drawConstants.get(), bytes_.data(), 65);
  Gives(MsgCode::OutOfBounds);
  context->UpdateConstants(passConstants.get(), bytes_.data(), 16);  // Default usage
  Gives(MsgCode::MapMode);
  Mapped m;
  ASSERT_EQ(context->Map(drawConstants.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
  context->UpdateConstants(drawConstants.get(), bytes_.data(), 64);
  Gives(MsgCode::MappedInUse);
  context->Unmap(drawConstants.get(), 0);
  context->UpdateConstants(drawConstants.get(), bytes_.data(), 64);
}

TEST_F(DataTest, UpdateOfUsages) {
  const Ref<IBuffer> fixed = Made(Usage::Immutable), dynamic = Made(Usage::Dynamic);
  context->UpdateSubresource(fixed.get(), 0, nullptr, bytes_.data(), 0, 0);
  Gives(MsgCode::ImmutableWrite);
  context->UpdateSubresource(dynamic.get(), 0, nullptr, bytes_.data(), 0, 0);
  Gives(MsgCode::MapMode);
  context->UpdateSubresource(vertices.get(), 0, nullptr, nullptr, 0, 0);
  Gives(MsgCode::InvalidDesc);
  context->UpdateSubresource(vertices.get(), 0, nullptr, bytes_.data(), 0, 0);
}

TEST_F(DataTest, UpdateOfBufferRanges) {
  const Box beyond{60, 0, 0, 81, 1, 1}, within{60, 0, 0, 80, 1, 1};
  context->UpdateSubresource(vertices.get(), 0, &beyond, bytes_.data(), 0, 0);
  Gives(MsgCode::OutOfBounds);
  context->UpdateSubresource(vertices.get(), 0, &within, bytes_.data(), 0, 0);
}

TEST_F(DataTest, UpdateOfTextures) {
  context->UpdateSubresource(picture.get(), 1, nullptr, bytes_.data(), 16, 0);
  Gives(MsgCode::SubresourceOutOfRange);
  const Box beyond{2, 2, 0, 5, 4, 1}, within{2, 2, 0, 4, 4, 1};
  context->UpdateSubresource(picture.get(), 0, &beyond, bytes_.data(), 16, 0);
  Gives(MsgCode::OutOfBounds);
  context->UpdateSubresource(picture.get(), 0, nullptr, bytes_.data(), 12, 0);
  Gives(MsgCode::PitchTooSmall);
  context->EndFrame();
  const Ref<ITexture> volume =
      Texture({.dim = TextureDim::Tex3D, .width = 4, .height = 4, .depthOrArray = 4, .format = Format::R8_UNorm});
  context->UpdateSubresource(volume.get(), 0, nullptr, bytes_.data(), 4, 12);
  Gives(MsgCode::PitchTooSmall);
  context->UpdateSubresource(volume.get(), 0, nullptr, bytes_.data(), 4, 16);
  context->UpdateSubresource(depth.get(), 0, nullptr, bytes_.data(), 64, 0);
  Gives(MsgCode::FormatMismatch);
  context->UpdateSubresource(picture.get(), 0, &within, bytes_.data(), 8, 0);
  context->UpdateSubresource(picture.get(), 0, nullptr, bytes_.data(), 16, 0);
  context->UpdateSubresource(picture.get(), 0, nullptr, bytes_.data(), 0, 0);
}

}  // namespace
}  // namespace validation_test
