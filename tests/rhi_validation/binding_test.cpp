// Setters: a wrong one gives its message and changes nothing; the right one gives none.
#include <limits>

#include "fixture.h"

namespace validation_test {
namespace {

using namespace rhi;

class BindingTest : public ValidationTest {
 protected:
  void SetUp() override { SetGoodState(); }
};

TEST_F(BindingTest, VertexBufferFlag) {
  SetVertices(indices.get());
  Gives(MsgCode::WrongBindFlag);
  context->Draw(3, 0);  // the right buffer is still bound
  SetVertices(vertices.get());
}

TEST_F(BindingTest, IndexBufferFlagFormatAndOffset) {
  context->IASetIndexBuffer(vertices.get(), Format::R16_UInt, 0);
  Gives(MsgCode::WrongBindFlag);
  context->IASetIndexBuffer(indices.get(), Format::RGBA8_UInt, 0);
  Gives(MsgCode::FormatMismatch);
  context->IASetIndexBuffer(indices.get(), Format::R16_UInt, 3);
  Gives(MsgCode::OutOfBounds);
  context->IASetIndexBuffer(indices.get(), Format::R16_UInt, 2);
}

TEST_F(BindingTest, ConstantBufferFlag) {
  SetConstants(3, vertices.get());
  Gives(MsgCode::WrongBindFlag);
  SetConstants(3, drawConstants.get());
}

TEST_F(BindingTest, ViewFlags) {
  Ref<IShaderResourceView> none;
  EXPECT_EQ(device->CreateShaderResourceView(vertices.get(), nullptr, &none), Status::InvalidArg);
  Gives(MsgCode::WrongBindFlag);
  EXPECT_EQ(device->CreateShaderResourceView(items.get(), nullptr, &none), Status::Ok);
}

TEST_F(BindingTest, Slots) {
  IBuffer* buffers[2] = {vertices.get(), vertices.get()};
  const uint32_t zeros[2] = {};
  context->IASetVertexBuffers(15, 2, buffers, zeros, zeros);
  Gives(MsgCode::SlotOutOfRange);
  context->IASetVertexBuffers(14, 2, buffers, zeros, zeros);
  IBuffer* constants[2] = {};
  context->SetConstantBuffers(3, 2, constants);
  Gives(MsgCode::SlotOutOfRange);
  context->SetConstantBuffers(2, 2, constants);
  IShaderResourceView* views[2] = {};
  context->PSSetShaderResources(15, 2, views);
  Gives(MsgCode::SlotOutOfRange);
  context->PSSetShaderResources(14, 2, views);
  ISamplerState* samplers[2] = {};
  context->PSSetSamplers(~0u, 2, samplers);
  Gives(MsgCode::SlotOutOfRange);
  context->PSSetSamplers(14, 2, samplers);
  IUnorderedAccessView* written[2] = {};
  context->CSSetUnorderedAccessViews(7, 2, written);
  Gives(MsgCode::SlotOutOfRange);
  context->CSSetUnorderedAccessViews(6, 2, written);
  IRenderTargetView* targets[9] = {};
  context->OMSetRenderTargets(9, targets, nullptr);
  Gives(MsgCode::SlotOutOfRange);
  context->OMSetRenderTargets(8, targets, nullptr);
  const Viewport viewports[17] = {};
  context->RSSetViewports(17, viewports);
  Gives(MsgCode::SlotOutOfRange);
  context->RSSetViewports(16, viewports);
  const Rect rects[17] = {};
  context->RSSetScissorRects(17, rects);
  Gives(MsgCode::SlotOutOfRange);
  context->RSSetScissorRects(16, rects);
}

TEST_F(BindingTest, NullArrays) {
  context->IASetVertexBuffers(0, 1, nullptr, nullptr, nullptr);
  Gives(MsgCode::InvalidDesc);
  context->SetConstantBuffers(0, 1, nullptr);
  Gives(MsgCode::InvalidDesc);
  context->SetConstantBuffers(0, 0, nullptr);
}

TEST_F(BindingTest, Stages) {
  context->VSSetShader(ps.get());
  Gives(MsgCode::WrongStage);
  context->SetShader(Stage(7), ps.get());
  Gives(MsgCode::WrongStage);
  context->PSSetShader(ps.get());
}

TEST_F(BindingTest, Topology) {
  context->IASetPrimitiveTopology(PrimitiveTopology(9));
  Gives(MsgCode::InvalidDesc);
  context->IASetPrimitiveTopology(PrimitiveTopology::TriangleStripAdj);
}

TEST_F(BindingTest, Viewports) {
  SetViewport(0, 0, -1, 4);
  Gives(MsgCode::InvalidDesc);
  context->EndFrame();
  SetViewport(0, std::numeric_limits<float>::quiet_NaN(), 4, 4);
  Gives(MsgCode::InvalidDesc);
  context->EndFrame();
  const Viewport deep{0, 0, 4, 4, 0.5f, 1.5f};
  context->RSSetViewports(1, &deep);
  Gives(MsgCode::InvalidDesc);
  SetViewport(0, 0, 4, 4);
}

// Direct3D 10's hazards are the backend's message; the shadow state follows.
TEST_F(BindingTest, TargetUnbindsItsInput) {
  SetTarget(nullptr);
  SetResource(Stage::Pixel, 0, color.get());
  SetTarget(rtv.get());
  Gives(MsgCode::TargetStillBoundAsInput, Severity::Warning);
  context->Draw(3, 0);
  Gives(MsgCode::NothingBound, Severity::Warning);
  context->EndFrame();
  SetResource(Stage::Pixel, 0, color.get());
  Gives(MsgCode::InputStillBoundAsTarget, Severity::Warning);
  SetResource(Stage::Pixel, 0, picture.get());
  context->Draw(3, 0);
}

}  // namespace
}  // namespace validation_test
