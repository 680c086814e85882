#include "fixture.h"

namespace validation_test {

using namespace rhi;

namespace {

template <class T, size_t N>
constexpr Array<T> Table(const T (&table)[N]) {
  return {table, uint32_t(N)};
}

constexpr ShaderInput kMeshInputs[] = {{"POSITION", 0, 0}, {"TEXCOORD", 0, 1}};
constexpr ShaderInput kInstancedInputs[] = {{"POSITION", 0, 0}, {"OFFSET", 0, 1}};
constexpr ShaderConstantBuffer kDraw[] = {{3, 64, "Draw"}};
constexpr ShaderConstantBuffer kPass[] = {{1, 32, "Pass"}};
constexpr ShaderResource kPixelResources[] = {
    {ShaderResourceKind::Texture, 0, TextureDim::Tex2D, false, 0, "picture"},
    {ShaderResourceKind::StructuredBuffer, 1, TextureDim::Tex2D, false, 16, "items"}};
constexpr ShaderSampler kSamplers[] = {{0, "smooth"}};
constexpr ShaderResource kComputeResources[] = {
    {ShaderResourceKind::RWStructuredBuffer, 0, TextureDim::Tex2D, false, 16, "result"},
    {ShaderResourceKind::RWTexture, 1, TextureDim::Tex2D, false, 0, "drawing"},
    {ShaderResourceKind::StructuredBuffer, 0, TextureDim::Tex2D, false, 16, "items"}};

ShaderBlob Blob(Stage stage, const char* name) {
  ShaderBlob blob;
  blob.stage = stage;
  blob.name = name;
  return blob;
}

}  // namespace

ShaderBlob VertexBlob() {
  ShaderBlob blob = Blob(Stage::Vertex, "mesh:VS");
  blob.reflection.inputs = Table(kMeshInputs);
  blob.reflection.constantBuffers = Table(kDraw);
  return blob;
}
ShaderBlob InstancedVertexBlob() {
  ShaderBlob blob = Blob(Stage::Vertex, "instanced:VS");
  blob.reflection.inputs = Table(kInstancedInputs);
  return blob;
}
ShaderBlob PlainVertexBlob() { return Blob(Stage::Vertex, "plain:VS"); }
ShaderBlob GeometryBlob() {
  ShaderBlob blob = Blob(Stage::Geometry, "fins:GS");
  blob.reflection.gsInput = PrimitiveTopology::LineListAdj;
  return blob;
}
ShaderBlob PixelBlob() {
  ShaderBlob blob = Blob(Stage::Pixel, "mesh:PS");
  blob.reflection.constantBuffers = Table(kPass);
  blob.reflection.resources = Table(kPixelResources);
  blob.reflection.samplers = Table(kSamplers);
  return blob;
}
ShaderBlob PlainPixelBlob() { return Blob(Stage::Pixel, "plain:PS"); }
ShaderBlob ComputeBlob() {
  ShaderBlob blob = Blob(Stage::Compute, "sum:CS");
  blob.reflection.resources = Table(kComputeResources);
  blob.reflection.groupSize = {64, 1, 1};
  return blob;
}

std::string KeepingSink::Dump() const {
  std::string all;
  for (const Entry& e : entries)
    all += std::string(ToString(e.severity)) + " " + ToString(e.code) + " '" + e.object + "': " + e.text + "\n";
  return all;
}

ValidationTest::ValidationTest() {
  DeviceDesc desc;
  desc.sink = &sink;
  EXPECT_EQ(CreateNullDevice(desc, &inner), Status::Ok);
  device = WrapWithValidation(inner, &sink);
  context = device->ImmediateContext();
  MakeObjects();
}

void ValidationTest::TearDown() {
  GivesNothing();
  context->EndFrame();
  GivesNothing();
}

void ValidationTest::Gives(MsgCode code, Severity severity) {
  ASSERT_EQ(sink.entries.size(), 1u) << "one message " << ToString(code) << " was expected\n" << sink.Dump();
  EXPECT_EQ(sink.entries[0].code, code) << sink.Dump();
  EXPECT_EQ(sink.entries[0].severity, severity) << sink.Dump();
  EXPECT_NE(sink.entries[0].text, "");
  lastText_ = sink.entries[0].text;
  sink.entries.clear();
}

void ValidationTest::GivesNothing() {
  EXPECT_TRUE(sink.entries.empty()) << sink.Dump();
  sink.entries.clear();
}

Ref<IBuffer> ValidationTest::Buffer(const BufferDesc& desc, const void* init) {
  Ref<IBuffer> b;
  EXPECT_EQ(device->CreateBuffer(desc, init, &b), Status::Ok) << sink.Dump();
  return b;
}

Ref<ITexture> ValidationTest::Texture(const TextureDesc& desc, const SubresourceData* init) {
  Ref<ITexture> t;
  EXPECT_EQ(device->CreateTexture(desc, init, &t), Status::Ok) << sink.Dump();
  return t;
}

Ref<IShaderResourceView> ValidationTest::View(IResource* resource) {
  Ref<IShaderResourceView> v;
  EXPECT_EQ(device->CreateShaderResourceView(resource, nullptr, &v), Status::Ok) << sink.Dump();
  return v;
}

Ref<IRenderTargetView> ValidationTest::TargetView(ITexture* texture, const ViewDesc* desc) {
  Ref<IRenderTargetView> v;
  EXPECT_EQ(device->CreateRenderTargetView(texture, desc, &v), Status::Ok) << sink.Dump();
  return v;
}

Ref<IUnorderedAccessView> ValidationTest::WriteView(IResource* resource) {
  Ref<IUnorderedAccessView> v;
  EXPECT_EQ(device->CreateUnorderedAccessView(resource, nullptr, &v), Status::Ok) << sink.Dump();
  return v;
}

Ref<IShader> ValidationTest::Shader(const ShaderBlob& blob) {
  Ref<IShader> s;
  EXPECT_EQ(device->CreateShader(blob, &s), Status::Ok) << sink.Dump();
  return s;
}

Ref<IQuery> ValidationTest::Query(QueryType type) {
  Ref<IQuery> q;
  EXPECT_EQ(device->CreateQuery({type}, &q), Status::Ok) << sink.Dump();
  return q;
}

Ref<ITexture> ValidationTest::Target(uint32_t width, uint32_t height, uint32_t samples) {
  return Texture({.dim = samples > 1 ? TextureDim::Tex2DMS : TextureDim::Tex2D,
                  .width = width,
                  .height = height,
                  .sampleCount = samples,
                  .format = Format::RGBA8_UNorm,
                  .bind = Bind::RenderTarget | Bind::ShaderResource,
                  .name = "target"});
}

void ValidationTest::MakeObjects() {
  vs = Shader(VertexBlob());
  ps = Shader(PixelBlob());
  const InputElement elements[] = {{.semantic = "POSITION", .format = Format::RGB32_Float},
                                   {.semantic = "TEXCOORD", .format = Format::RG32_Float, .offset = 12}};
  EXPECT_EQ(device->CreateInputLayout(elements, 2, vs.get(), &layout), Status::Ok);
  vertices = Buffer({.byteWidth = 80, .bind = Bind::VertexBuffer, .name = "vertices"});
  indices = Buffer({.byteWidth = 12, .bind = Bind::IndexBuffer, .name = "indices"});
  drawConstants =
      Buffer({.byteWidth = 64, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer, .name = "draw constants"});
  passConstants = Buffer({.byteWidth = 32, .bind = Bind::ConstantBuffer, .name = "pass constants"});
  items = Buffer({.byteWidth = 64, .bind = Bind::ShaderResource, .structureStride = 16, .name = "items"});
  color = Target(16, 16);
  rtv = TargetView(color.get());
  depth =
      Texture({.width = 16, .height = 16, .format = Format::D32_Float, .bind = Bind::DepthStencil, .name = "depth"});
  EXPECT_EQ(device->CreateDepthStencilView(depth.get(), nullptr, &dsv), Status::Ok);
  picture = Texture({.width = 4, .height = 4, .format = Format::RGBA8_UNorm, .name = "picture"});
  EXPECT_EQ(device->CreateSamplerState({}, &smooth), Status::Ok);
  GivesNothing();
}

void ValidationTest::SetGoodState() {
  context->VSSetShader(vs.get());
  context->PSSetShader(ps.get());
  context->IASetInputLayout(layout.get());
  context->IASetPrimitiveTopology(PrimitiveTopology::TriangleList);
  SetVertices(vertices.get());
  context->IASetIndexBuffer(indices.get(), Format::R16_UInt, 0);
  SetConstants(1, passConstants.get());
  SetConstants(3, drawConstants.get());
  SetResource(Stage::Pixel, 0, picture.get());
  SetResource(Stage::Pixel, 1, items.get());
  ISamplerState* s = smooth.get();
  context->PSSetSamplers(0, 1, &s);
  SetTarget(rtv.get(), dsv.get());
  SetViewport(0, 0, 16, 16);
  GivesNothing();
}

void ValidationTest::SetViewport(float x, float y, float width, float height) {
  const Viewport v{x, y, width, height, 0, 1};
  context->RSSetViewports(1, &v);
}

void ValidationTest::SetTarget(IRenderTargetView* target, IDepthStencilView* depthView) {
  context->OMSetRenderTargets(target ? 1 : 0, target ? &target : nullptr, depthView);
}

void ValidationTest::SetVertices(IBuffer* buffer, uint32_t stride, uint32_t offset, uint32_t slot) {
  context->IASetVertexBuffers(slot, 1, &buffer, &stride, &offset);
}

void ValidationTest::SetConstants(uint32_t slot, IBuffer* buffer) { context->SetConstantBuffers(slot, 1, &buffer); }

void ValidationTest::SetResource(Stage stage, uint32_t slot, IResource* resource) {
  const Ref<IShaderResourceView> view = resource ? View(resource) : Ref<IShaderResourceView>();
  IShaderResourceView* v = view.get();
  context->SetShaderResources(stage, slot, 1, &v);
}

}  // namespace validation_test
