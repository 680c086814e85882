// Draws and dispatches: each wrong state gives its message and draws nothing; put right, it draws without one.
#include "fixture.h"

namespace validation_test {
namespace {

using namespace rhi;

class DrawTest : public ValidationTest {
 protected:
  void SetUp() override { SetGoodState(); }
  uint64_t Drawn() { return device->GetStats(true).draws; }
  // The draw is refused with this message.
  void Refused(MsgCode code) {
    Drawn();
    context->Draw(3, 0);
    Gives(code);
    EXPECT_EQ(Drawn(), 0u);
  }
  // The draw goes on, with this message.
  void Warned(MsgCode code) {
    Drawn();
    context->Draw(3, 0);
    Gives(code, Severity::Warning);
    EXPECT_EQ(Drawn(), 1u);
  }
  // After a new frame, in which messages may come again.
  void Fine() {
    context->EndFrame();
    Drawn();
    context->Draw(3, 0);
    context->DrawIndexed(6, 0, 0);
    context->DrawInstanced(4, 5, 0, 0);
    context->DrawIndexedInstanced(3, 2, 3, 0, 1);
    GivesNothing();
    EXPECT_EQ(Drawn(), 4u);
  }
};

TEST_F(DrawTest, GoodStateGivesNothing) { Fine(); }

TEST_F(DrawTest, NoVertexShader) {
  context->VSSetShader(nullptr);
  Refused(MsgCode::NoVertexShader);
  context->VSSetShader(vs.get());
  Fine();
}

TEST_F(DrawTest, NoTarget) {
  SetTarget(nullptr);
  Refused(MsgCode::NoTarget);
  SetTarget(nullptr, dsv.get());
  Fine();
}

TEST_F(DrawTest, TargetsOfOtherSizes) {
  const Ref<ITexture> small = Target(8, 16);
  IRenderTargetView* views[] = {rtv.get(), nullptr, nullptr};
  const Ref<IRenderTargetView> smallView = TargetView(small.get());
  views[2] = smallView.get();
  context->OMSetRenderTargets(3, views, nullptr);
  Refused(MsgCode::TargetsDiffer);
  EXPECT_NE(LastText().find("8 x 16"), std::string::npos) << LastText();
  context->OMSetRenderTargets(2, views, nullptr);
  Fine();
}

TEST_F(DrawTest, TargetsOfOtherSampleCounts) {
  const Ref<ITexture> four = Target(16, 16, 4);
  const Ref<IRenderTargetView> view = TargetView(four.get());
  SetTarget(view.get(), dsv.get());
  Refused(MsgCode::TargetsDiffer);
  SetTarget(view.get());
  Fine();
}

TEST_F(DrawTest, MipsOfOneSizeAreEqualTargets) {
  const Ref<ITexture> large =
      Texture({.width = 32, .height = 32, .mipLevels = 2, .format = Format::RGBA8_UNorm, .bind = Bind::RenderTarget});
  const ViewDesc second{.firstMip = 1};
  const Ref<IRenderTargetView> view = TargetView(large.get(), &second);
  SetTarget(view.get(), dsv.get());
  Fine();
}

TEST_F(DrawTest, NoViewport) {
  context->RSSetViewports(0, nullptr);
  Refused(MsgCode::NothingBound);
  SetViewport(0, 0, 16, 16);
  Fine();
}

TEST_F(DrawTest, ViewportThatShowsNothing) {
  SetViewport(16, 0, 16, 16);
  Warned(MsgCode::ViewportOutside);
  SetViewport(4, 4, 12, 12);
  Fine();
}

TEST_F(DrawTest, EmptyViewport) {
  SetViewport(0, 0, 0, 16);
  Warned(MsgCode::ViewportOutside);
  SetViewport(0, 0, 1, 16);
  Fine();
}

TEST_F(DrawTest, ViewportPartlyOutsideIsToldOnly) {
  SetViewport(8, 8, 16, 16);
  context->Draw(3, 0);
  Gives(MsgCode::ViewportOutside, Severity::Info);
  SetViewport(8, 8, 8, 8);
  Fine();
}

TEST_F(DrawTest, NoLayout) {
  context->IASetInputLayout(nullptr);
  Refused(MsgCode::LayoutMismatch);
  context->IASetInputLayout(layout.get());
  Fine();
}

TEST_F(DrawTest, LayoutOfAnotherShader) {
  const Ref<IShader> instanced = Shader(InstancedVertexBlob());
  context->VSSetShader(instanced.get());
  Refused(MsgCode::LayoutMismatch);
  EXPECT_NE(LastText().find("OFFSET0"), std::string::npos) << LastText();
  context->VSSetShader(vs.get());
  Fine();
}

TEST_F(DrawTest, TopologyOfTheGeometryShader) {
  const Ref<IShader> gs = Shader(GeometryBlob());
  context->GSSetShader(gs.get());
  Refused(MsgCode::TopologyMismatch);
  context->IASetPrimitiveTopology(PrimitiveTopology::LineStripAdj);  // cut into its lines
  Fine();
  context->IASetPrimitiveTopology(PrimitiveTopology::LineListAdj);
  Fine();
}

TEST_F(DrawTest, NoIndexBuffer) {
  context->IASetIndexBuffer(nullptr, Format::R16_UInt, 0);
  context->DrawIndexed(3, 0, 0);
  Gives(MsgCode::IndexBufferMissing);
  context->IASetIndexBuffer(indices.get(), Format::R16_UInt, 0);
  Fine();
}

TEST_F(DrawTest, IndicesBeyondTheBuffer) {
  context->DrawIndexed(6, 1, 0);
  Gives(MsgCode::OutOfBounds);
  context->IASetIndexBuffer(indices.get(), Format::R32_UInt, 0);
  context->EndFrame();
  context->DrawIndexed(4, 0, 0);
  Gives(MsgCode::OutOfBounds);
  context->DrawIndexed(3, 0, 0);
  context->IASetIndexBuffer(indices.get(), Format::R16_UInt, 0);
  Fine();
}

TEST_F(DrawTest, NoVertexBuffer) {
  SetVertices(nullptr);
  Drawn();
  context->Draw(3, 0);
  ASSERT_EQ(sink.entries.size(), 2u) << sink.Dump();  // one for each element
  for (const auto& e : sink.entries) EXPECT_EQ(e.code, MsgCode::NothingBound);
  sink.entries.clear();
  EXPECT_EQ(Drawn(), 1u);
  SetVertices(vertices.get());
  Fine();
}

TEST_F(DrawTest, VerticesBeyondTheBuffer) {
  context->Draw(4, 1);
  Gives(MsgCode::OutOfBounds);
  context->Draw(4, 0);  // the last vertex ends with the buffer
  SetVertices(vertices.get(), 20, 4);
  context->EndFrame();
  context->Draw(4, 0);
  Gives(MsgCode::OutOfBounds);
  context->Draw(0, 100);
  SetVertices(vertices.get());
  Fine();
}

TEST_F(DrawTest, InstancesBeyondTheBuffer) {
  const Ref<IShader> instanced = Shader(InstancedVertexBlob());
  const InputElement elements[] = {{.semantic = "Position", .format = Format::RGB32_Float},
                                   {.semantic = "OFFSET",
                                    .format = Format::RG32_Float,
                                    .slot = 1,
                                    .inputClass = InputClass::PerInstance,
                                    .stepRate = 2}};
  Ref<IInputLayout> two;
  ASSERT_EQ(device->CreateInputLayout(elements, 2, instanced.get(), &two), Status::Ok);
  context->VSSetShader(instanced.get());
  context->IASetInputLayout(two.get());
  const Ref<IBuffer> offsets = Buffer({.byteWidth = 16, .bind = Bind::VertexBuffer, .name = "offsets"});
  SetVertices(offsets.get(), 8, 0, 1);
  context->DrawInstanced(3, 4, 0, 0);  // steps 0, 0, 1, 1
  context->DrawIndexedInstanced(3, 4, 0, 0, 0);
  GivesNothing();
  context->DrawInstanced(3, 5, 0, 0);
  Gives(MsgCode::OutOfBounds);
  context->EndFrame();
  context->DrawIndexedInstanced(3, 4, 0, 0, 1);
  Gives(MsgCode::OutOfBounds);
}

TEST_F(DrawTest, IndirectArguments) {
  const Ref<IBuffer> args = Buffer({.byteWidth = 32, .bind = Bind::IndirectArgs, .name = "arguments"});
  context->DrawInstancedIndirect(args.get(), 16);
  context->DrawIndexedInstancedIndirect(args.get(), 12);
  GivesNothing();
  context->DrawInstancedIndirect(args.get(), 20);
  Gives(MsgCode::OutOfBounds);
  context->EndFrame();
  context->DrawIndexedInstancedIndirect(args.get(), 2);
  Gives(MsgCode::OutOfBounds);
  context->DrawInstancedIndirect(vertices.get(), 0);
  Gives(MsgCode::WrongBindFlag);
  context->DrawInstancedIndirect(nullptr, 0);
  Gives(MsgCode::WrongBindFlag);
}

TEST_F(DrawTest, MappedBufferInUse) {
  const Ref<IBuffer> dynamic =
      Buffer({.byteWidth = 80, .usage = Usage::Dynamic, .bind = Bind::VertexBuffer, .name = "moving"});
  SetVertices(dynamic.get());
  Mapped m;
  ASSERT_EQ(context->Map(dynamic.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
  Refused(MsgCode::MappedInUse);
  context->Unmap(dynamic.get(), 0);
  Fine();
  ASSERT_EQ(context->Map(drawConstants.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
  Refused(MsgCode::MappedInUse);
  context->Unmap(drawConstants.get(), 0);
  Fine();
}

TEST_F(DrawTest, MappedStructuredBufferInUse) {
  const Ref<IBuffer> moving = Buffer({.byteWidth = 64,
                                      .usage = Usage::Dynamic,
                                      .bind = Bind::ShaderResource,
                                      .structureStride = 16,
                                      .name = "moving items"});
  SetResource(Stage::Pixel, 1, moving.get());
  Mapped m;
  ASSERT_EQ(context->Map(moving.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
  Refused(MsgCode::MappedInUse);
  context->Unmap(moving.get(), 0);
  Fine();
}

TEST_F(DrawTest, MappedIndexBufferInUse) {
  const Ref<IBuffer> moving = Buffer({.byteWidth = 12, .usage = Usage::Dynamic, .bind = Bind::IndexBuffer});
  context->IASetIndexBuffer(moving.get(), Format::R16_UInt, 0);
  Mapped m;
  ASSERT_EQ(context->Map(moving.get(), 0, MapMode::WriteDiscard, &m), Status::Ok);
  context->Draw(3, 0);  // does not read it
  context->DrawIndexed(3, 0, 0);
  Gives(MsgCode::MappedInUse);
  context->Unmap(moving.get(), 0);
  Fine();
}

class DispatchTest : public ValidationTest {
 protected:
  void SetUp() override {
    result_ = Buffer({.byteWidth = 64, .bind = Bind::UnorderedAccess, .structureStride = 16, .name = "result"});
    drawing_ = Texture({.width = 4, .height = 4, .format = Format::RGBA8_UNorm, .bind = Bind::UnorderedAccess});
    shader_ = Shader(ComputeBlob());
    context->CSSetShader(shader_.get());
    SetResource(Stage::Compute, 0, items.get());
    SetWritten(result_.get(), drawing_.get());
  }
  void SetWritten(IResource* a, IResource* b) {
    const Ref<IUnorderedAccessView> first = a ? WriteView(a) : Ref<IUnorderedAccessView>(), second = WriteView(b);
    IUnorderedAccessView* views[] = {first.get(), second.get()};
    context->CSSetUnorderedAccessViews(0, 2, views);
  }
  Ref<IShader> shader_;
  Ref<IBuffer> result_;
  Ref<ITexture> drawing_;
};

TEST_F(DispatchTest, NoComputeShader) {
  context->CSSetShader(nullptr);
  context->Dispatch(1, 1, 1);
  Gives(MsgCode::NothingBound);
  context->CSSetShader(shader_.get());
  context->Dispatch(1, 1, 1);
  EXPECT_EQ(device->GetStats(true).dispatches, 1u);
}

TEST_F(DispatchTest, TooManyGroups) {
  context->Dispatch(1, 65536, 1);
  Gives(MsgCode::OutOfBounds);
  context->Dispatch(1, 65535, 0);
}

TEST_F(DispatchTest, WrittenRegisters) {
  SetWritten(nullptr, drawing_.get());
  context->Dispatch(1, 1, 1);
  Gives(MsgCode::NothingBound, Severity::Warning);
  SetWritten(drawing_.get(), drawing_.get());
  context->Dispatch(1, 1, 1);
  Gives(MsgCode::ViewMismatch);
  const Ref<IBuffer> wide = Buffer({.byteWidth = 64, .bind = Bind::UnorderedAccess, .structureStride = 32});
  SetWritten(wide.get(), drawing_.get());
  context->Dispatch(1, 1, 1);
  Gives(MsgCode::StrideMismatch);
  SetWritten(result_.get(), drawing_.get());
  context->Dispatch(1, 1, 1);
}

TEST_F(DispatchTest, IndirectArguments) {
  const Ref<IBuffer> args = Buffer({.byteWidth = 16, .bind = Bind::IndirectArgs});
  context->DispatchIndirect(args.get(), 8);
  Gives(MsgCode::OutOfBounds);
  context->DispatchIndirect(items.get(), 0);
  Gives(MsgCode::WrongBindFlag);
  context->DispatchIndirect(args.get(), 4);
}

}  // namespace
}  // namespace validation_test
