// Objects of other devices, leaks, repeated messages, codes.
#include <set>

#include "fixture.h"

namespace validation_test {
namespace {

using namespace rhi;

using ObjectTest = ValidationTest;

Ref<IDevice> Second(IMessageSink* sink) {
  Ref<IDevice> device;
  DeviceDesc desc;
  desc.sink = sink;
  EXPECT_EQ(CreateNullDevice(desc, &device), Status::Ok);
  return WrapWithValidation(device, sink);
}

TEST_F(ObjectTest, ObjectsOfAnotherDevice) {
  KeepingSink other;
  const Ref<IDevice> second = Second(&other);
  Ref<IShader> shader;
  Ref<IBuffer> buffer;
  Ref<ITexture> texture;
  Ref<IRenderTargetView> target;
  Ref<ISamplerState> sampler;
  Ref<IQuery> query;
  ASSERT_EQ(second->CreateShader(PlainVertexBlob(), &shader), Status::Ok);
  ASSERT_EQ(second->CreateBuffer({.byteWidth = 80, .bind = Bind::VertexBuffer}, nullptr, &buffer), Status::Ok);
  ASSERT_EQ(second->CreateTexture({.width = 4, .height = 4, .format = Format::RGBA8_UNorm, .bind = Bind::RenderTarget},
                                  nullptr, &texture),
            Status::Ok);
  ASSERT_EQ(second->CreateRenderTargetView(texture.get(), nullptr, &target), Status::Ok);
  ASSERT_EQ(second->CreateSamplerState({}, &sampler), Status::Ok);
  ASSERT_EQ(second->CreateQuery({QueryType::Event}, &query), Status::Ok);

  context->VSSetShader(shader.get());
  Gives(MsgCode::ForeignObject);
  SetVertices(buffer.get());
  Gives(MsgCode::ForeignObject);
  SetTarget(target.get());
  Gives(MsgCode::ForeignObject);
  ISamplerState* s = sampler.get();
  context->PSSetSamplers(0, 1, &s);
  Gives(MsgCode::ForeignObject);
  context->End(query.get());
  Gives(MsgCode::ForeignObject);
  context->CopyResource(picture.get(), texture.get());
  Gives(MsgCode::ForeignObject);
  context->EndFrame();
  Ref<IRenderTargetView> none;
  EXPECT_EQ(device->CreateRenderTargetView(texture.get(), nullptr, &none), Status::InvalidArg);
  EXPECT_FALSE(none);
  Gives(MsgCode::ForeignObject);
  uint32_t word = 0;
  EXPECT_EQ(device->ReadBack(buffer.get(), 0, 4, &word), Status::InvalidArg);
  Gives(MsgCode::ForeignObject);
  EXPECT_EQ(device->PrecachePipeline({.vs = shader.get()}), Status::InvalidArg);
  Gives(MsgCode::ForeignObject);
  EXPECT_TRUE(other.entries.empty()) << other.Dump();
}

TEST_F(ObjectTest, ReadBackIntoNothing) {
  EXPECT_EQ(device->ReadBack(vertices.get(), 0, 4, nullptr), Status::InvalidArg);
  Gives(MsgCode::InvalidDesc);
  EXPECT_EQ(device->ReadBack(picture.get(), 0, nullptr, 64), Status::InvalidArg);
  Gives(MsgCode::InvalidDesc);
  uint32_t word = 1;
  EXPECT_EQ(device->ReadBack(vertices.get(), 0, 4, &word), Status::Ok);
}

TEST_F(ObjectTest, DestroyedObjectsAreForeign) {
  IBuffer* gone = Buffer({.byteWidth = 80, .bind = Bind::VertexBuffer}).get();
  context->EndFrame();  // here the validation lets go of it
  SetVertices(gone);
  Gives(MsgCode::ForeignObject);
}

TEST_F(ObjectTest, BoundObjectsLive) {
  SetVertices(Buffer({.byteWidth = 80, .bind = Bind::VertexBuffer}).get());
  context->EndFrame();
  IBuffer* constants = Buffer({.byteWidth = 64, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer}).get();
  SetConstants(3, constants);
  context->EndFrame();
  const float data[16] = {};
  context->UpdateConstants(constants, data, sizeof data);
}

TEST_F(ObjectTest, StateObjectsStayInterned) {
  Ref<IBlendState> a, b;
  ASSERT_EQ(device->CreateBlendState({}, &a), Status::Ok);
  ASSERT_EQ(device->CreateBlendState({}, &b), Status::Ok);
  EXPECT_EQ(a.get(), b.get());
}

TEST_F(ObjectTest, ManyObjectsInOneFrameAreLetGo) {
  for (int i = 0; i < 5000; ++i) Buffer({.byteWidth = 1u << 16, .bind = Bind::VertexBuffer});
  SUCCEED();  // 320 MiB otherwise
}

TEST_F(ObjectTest, TheWrapperIsTheDevice) {
  EXPECT_EQ(context->Device(), device.get());
  EXPECT_EQ(device->ImmediateContext(), context);
  EXPECT_EQ(device->GetCaps().backend, Backend::Null);
  EXPECT_FALSE(WrapWithValidation(nullptr, &sink));
}

TEST_F(ObjectTest, RepeatedOnceForEachCodeAndObjectAndFrame) {
  SetGoodState();
  SetVertices(indices.get());
  SetVertices(indices.get());
  Gives(MsgCode::WrongBindFlag);
  SetVertices(drawConstants.get());  // another object
  Gives(MsgCode::WrongBindFlag);
  context->IASetIndexBuffer(indices.get(), Format::RGBA8_UNorm, 0);  // another code
  Gives(MsgCode::FormatMismatch);
  context->EndFrame();
  SetVertices(indices.get());
  Gives(MsgCode::WrongBindFlag);
}

TEST(LeakTest, LiveObjectsAreNamed) {
  KeepingSink sink;
  Ref<IDevice> device = Second(&sink);
  Ref<IBuffer> leaked, bound;
  Ref<ITexture> texture;
  Ref<IShaderResourceView> view;
  ASSERT_EQ(device->CreateBuffer({.byteWidth = 4, .bind = Bind::VertexBuffer, .name = "strands"}, nullptr, &leaked),
            Status::Ok);
  ASSERT_EQ(device->CreateBuffer({.byteWidth = 4, .bind = Bind::VertexBuffer, .name = "bound"}, nullptr, &bound),
            Status::Ok);
  ASSERT_EQ(
      device->CreateTexture({.width = 4, .height = 4, .format = Format::R8_UNorm, .name = "noise"}, nullptr, &texture),
      Status::Ok);
  ASSERT_EQ(device->CreateShaderResourceView(texture.get(), nullptr, &view), Status::Ok);
  IBuffer* raw = bound.get();
  const uint32_t zero = 0;
  device->ImmediateContext()->IASetVertexBuffers(0, 1, &raw, &zero, &zero);
  bound = nullptr;    // bound objects are no leaks
  texture = nullptr;  // the view holds it
  device = nullptr;
  std::set<std::string> names;
  for (const auto& e : sink.entries) {
    EXPECT_EQ(e.code, MsgCode::LiveObjects);
    EXPECT_EQ(e.severity, Severity::Warning);
    names.insert(e.object);
  }
  EXPECT_EQ(sink.entries.size(), 3u) << sink.Dump();  // the view bears its texture's name
  EXPECT_EQ(names, (std::set<std::string>{"strands", "noise"}));
}

TEST(LeakTest, NoneWhenAllIsReleased) {
  KeepingSink sink;
  Ref<IDevice> device = Second(&sink);
  {
    Ref<ITexture> texture;
    Ref<IShaderResourceView> view;
    ASSERT_EQ(device->CreateTexture({.width = 4, .height = 4, .format = Format::R8_UNorm}, nullptr, &texture),
              Status::Ok);
    ASSERT_EQ(device->CreateShaderResourceView(texture.get(), nullptr, &view), Status::Ok);
    IShaderResourceView* raw = view.get();
    device->ImmediateContext()->PSSetShaderResources(3, 1, &raw);
  }
  device = nullptr;
  EXPECT_TRUE(sink.entries.empty()) << sink.Dump();
}

TEST(LeakTest, ManyLeaksAreSummedUp) {
  KeepingSink sink;
  Ref<IDevice> device = Second(&sink);
  std::vector<Ref<IBuffer>> leaked(40);
  for (auto& b : leaked)
    ASSERT_EQ(device->CreateBuffer({.byteWidth = 4, .bind = Bind::VertexBuffer}, nullptr, &b), Status::Ok);
  device = nullptr;
  EXPECT_EQ(sink.entries.size(), 17u) << sink.Dump();
  EXPECT_NE(sink.entries.back().text.find("40 objects in all"), std::string::npos);
}

TEST(CodeTest, CodesOfTheValidationAreStable) {
  EXPECT_EQ(int(MsgCode::LiveObjects), 107);
  EXPECT_EQ(int(MsgCode::ForeignObject), 205);
  EXPECT_EQ(int(MsgCode::ViewMismatch), 306);
  EXPECT_EQ(int(MsgCode::StrideMismatch), 307);
  EXPECT_EQ(int(MsgCode::ConstantsTooSmall), 308);
  EXPECT_EQ(int(MsgCode::ViewportOutside), 309);
  EXPECT_EQ(int(MsgCode::MappedInUse), 405);
  EXPECT_EQ(int(MsgCode::MapOpen), 406);
  EXPECT_EQ(int(MsgCode::PitchTooSmall), 407);
  EXPECT_EQ(int(MsgCode::QueryOpen), 501);
  EXPECT_EQ(int(MsgCode::QueryEmpty), 502);
  EXPECT_EQ(int(MsgCode::EventOpen), 503);
  for (const int code : {107, 205, 306, 307, 308, 309, 405, 406, 407, 501, 502, 503})
    EXPECT_STRNE(ToString(MsgCode(code)), "unknown code") << code;
}

// A frame with a little of everything gives no message at all, not even an Info.
TEST_F(ObjectTest, TypicalFrame) {
  const Ref<ITexture> four = Target(16, 16, 4);
  const Ref<IRenderTargetView> view = TargetView(four.get());
  const Ref<IQuery> samples = Query(QueryType::Occlusion), stamp = Query(QueryType::Timestamp);
  const float black[4] = {}, constants[16] = {};
  for (int frame = 0; frame < 3; ++frame) {
    SetGoodState();
    context->BeginEvent("frame");
    SetTarget(view.get());
    context->ClearRenderTargetView(view.get(), black);
    context->Begin(samples.get());
    for (int i = 0; i < 4; ++i) {
      context->UpdateConstants(drawConstants.get(), constants, sizeof constants);
      context->DrawIndexed(6, 0, 0);
    }
    context->End(samples.get());
    context->ResolveSubresource(color.get(), 0, four.get(), 0, Format::RGBA8_UNorm);
    context->End(stamp.get());
    context->EndEvent();
    context->EndFrame();
    uint64_t count = 1;
    EXPECT_EQ(context->GetData(samples.get(), &count, sizeof count, true), Status::Ok);
    std::vector<uint8_t> pixels(16 * 16 * 4);
    EXPECT_EQ(device->ReadBack(color.get(), 0, pixels.data(), pixels.size()), Status::Ok);
    GivesNothing();
  }
  EXPECT_EQ(device->GetStats(true).draws, 12u);
}

}  // namespace
}  // namespace validation_test
