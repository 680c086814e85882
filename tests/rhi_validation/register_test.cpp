// Registers: what the bound shaders read, against what is bound.
#include "fixture.h"

namespace validation_test {
namespace {

using namespace rhi;

class RegisterTest : public ValidationTest {
 protected:
  void SetUp() override { SetGoodState(); }
  void Refused(MsgCode code) {
    context->Draw(3, 0);
    Gives(code);
  }
  void Warned(MsgCode code) {
    context->Draw(3, 0);
    Gives(code, Severity::Warning);
  }
  void Fine() {
    context->EndFrame();
    context->Draw(3, 0);
    GivesNothing();
  }
};

TEST_F(RegisterTest, NoConstants) {
  SetConstants(3, nullptr);
  Warned(MsgCode::NothingBound);
  EXPECT_NE(LastText().find("b3 (Draw) of the vertex shader"), std::string::npos) << LastText();
  SetConstants(3, drawConstants.get());
  Fine();
}

TEST_F(RegisterTest, ConstantsTooSmall) {
  const Ref<IBuffer> small = Buffer({.byteWidth = 48, .bind = Bind::ConstantBuffer, .name = "small"});
  SetConstants(3, small.get());
  Refused(MsgCode::ConstantsTooSmall);
  const Ref<IBuffer> enough = Buffer({.byteWidth = 52, .bind = Bind::ConstantBuffer});  // four registers, rounded up
  SetConstants(3, enough.get());
  Fine();
}

TEST_F(RegisterTest, NoTexture) {
  SetResource(Stage::Pixel, 0, nullptr);
  Warned(MsgCode::NothingBound);
  EXPECT_NE(LastText().find("t0 (picture)"), std::string::npos) << LastText();
  SetResource(Stage::Pixel, 0, picture.get());
  Fine();
}

TEST_F(RegisterTest, RegistersOfOtherStagesDoNotMatter) {
  SetResource(Stage::Vertex, 0, items.get());
  SetResource(Stage::Pixel, 7, items.get());
  Fine();
}

TEST_F(RegisterTest, NoSampler) {
  ISamplerState* none = nullptr;
  context->PSSetSamplers(0, 1, &none);
  Warned(MsgCode::NothingBound);
  EXPECT_NE(LastText().find("s0 (smooth)"), std::string::npos) << LastText();
  ISamplerState* s = smooth.get();
  context->PSSetSamplers(0, 1, &s);
  Fine();
}

TEST_F(RegisterTest, DimensionMismatch) {
  const Ref<ITexture> cube = Texture({.dim = TextureDim::TexCube,
                                      .width = 4,
                                      .height = 4,
                                      .depthOrArray = 6,
                                      .format = Format::RGBA8_UNorm,
                                      .name = "sky"});
  SetResource(Stage::Pixel, 0, cube.get());
  Refused(MsgCode::ViewMismatch);
  EXPECT_NE(LastText().find("declared as Tex2D, but the bound 'sky' is TexCube"), std::string::npos) << LastText();
  SetResource(Stage::Pixel, 0, picture.get());
  Fine();
}

TEST_F(RegisterTest, BufferForTextureAndTheOtherWayRound) {
  SetResource(Stage::Pixel, 0, items.get());
  Refused(MsgCode::ViewMismatch);
  SetResource(Stage::Pixel, 0, picture.get());
  SetResource(Stage::Pixel, 1, picture.get());
  Refused(MsgCode::ViewMismatch);
  SetResource(Stage::Pixel, 1, items.get());
  Fine();
}

TEST_F(RegisterTest, IntegerTexels) {
  const Ref<ITexture> ids = Texture({.width = 4, .height = 4, .format = Format::R32_UInt, .name = "ids"});
  SetResource(Stage::Pixel, 0, ids.get());
  Refused(MsgCode::ViewMismatch);
  SetResource(Stage::Pixel, 0, picture.get());
  Fine();
}

TEST_F(RegisterTest, StrideMismatch) {
  const Ref<IBuffer> wide =
      Buffer({.byteWidth = 64, .bind = Bind::ShaderResource, .structureStride = 32, .name = "wide"});
  SetResource(Stage::Pixel, 1, wide.get());
  Refused(MsgCode::StrideMismatch);
  SetResource(Stage::Pixel, 1, items.get());
  Fine();
}

}  // namespace
}  // namespace validation_test
