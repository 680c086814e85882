// One misuse has one code, whoever sees it: each backend by itself, the null device, and the validation.
#include <array>
#include <functional>

#include "fixture.h"
#include "rhi_gl/rhi_gl.h"
#include "rhi_validation_shaders/shaders.h"
#include "rhi_vulkan/rhi_vulkan.h"

namespace validation_test {
namespace {

using namespace rhi;

// One buffer and one texture of each usage, and what a draw needs.
struct Objects {
  explicit Objects(IDevice& device);
  IDevice& d;
  IContext& c;
  Ref<IBuffer> plain, small, dynamic, fixed, staging, constants, items;
  Ref<ITexture> picture, other, half, floats, samples, depth, fixedPicture, stagingPicture, blocks, moreBlocks, words,
      cube;
  Ref<IRenderTargetView> rtv;
  Ref<IShader> vs, ps;
  Ref<IInputLayout> layout;
  Ref<IQuery> occlusion, event;
  Ref<ISamplerState> sampler;
  std::array<uint8_t, 4096> bytes{};
  Mapped m;

  Ref<IBuffer> Buffer(BufferDesc desc) {
    Ref<IBuffer> b;
    EXPECT_EQ(d.CreateBuffer(desc, bytes.data(), &b), Status::Ok);
    return b;
  }
  Ref<ITexture> Texture(TextureDesc desc, bool init = false) {
    Ref<ITexture> t;
    const SubresourceData data{bytes.data(), desc.width * 4, desc.width * desc.height * 4};
    EXPECT_EQ(d.CreateTexture(desc, init ? &data : nullptr, &t), Status::Ok);
    return t;
  }
  Status Map(IResource* r, MapMode mode, uint32_t subresource = 0) { return c.Map(r, subresource, mode, &m); }
  void Update(IResource* r, const Box* box = nullptr, uint32_t subresource = 0) {
    c.UpdateSubresource(r, subresource, box, bytes.data(), 0, 0);
  }
  void Copy(IResource* dst, uint32_t x, IResource* src, const Box* box, uint32_t dstSub = 0, uint32_t srcSub = 0) {
    c.CopySubresourceRegion(dst, dstSub, x, 0, 0, src, srcSub, box);
  }
  void View(const ViewDesc& desc) {
    Ref<IShaderResourceView> none;
    EXPECT_EQ(d.CreateShaderResourceView(picture.get(), &desc, &none), Status::InvalidArg);
  }
  void Read(ITexture* t, uint32_t subresource) {
    EXPECT_EQ(d.ReadBack(t, subresource, bytes.data(), bytes.size()), Status::InvalidArg);
  }
  void Mips(ITexture* t, Format format = Format::Unknown) {
    Ref<IShaderResourceView> view;
    const ViewDesc desc{.format = format};
    EXPECT_EQ(d.CreateShaderResourceView(t, &desc, &view), Status::Ok);
    c.GenerateMips(view.get());
  }
  void SetTarget(uint32_t viewports = 1) {
    IRenderTargetView* target = rtv.get();
    const Viewport viewport{0, 0, 8, 8, 0, 1};
    c.OMSetRenderTargets(1, &target, nullptr);
    c.RSSetViewports(viewports, &viewport);
  }
  void SetShaders() {
    c.VSSetShader(vs.get());
    c.PSSetShader(ps.get());
  }
  void SetDraw(uint32_t viewports = 1) {
    SetTarget(viewports), SetShaders();
    c.IASetInputLayout(layout.get());
  }
  // Everything that the shaders read; they want a Texture2D of floats.
  void SetAll(IResource* resource) {
    Ref<IShaderResourceView> view;
    EXPECT_EQ(d.CreateShaderResourceView(resource, nullptr, &view), Status::Ok);
    IBuffer *vertices = plain.get(), *tint = constants.get();
    IShaderResourceView* shown = view.get();
    ISamplerState* smooth = sampler.get();
    const uint32_t stride = 16, offset = 0;
    SetDraw();
    c.UpdateConstants(tint, bytes.data(), 64);
    c.IASetVertexBuffers(0, 1, &vertices, &stride, &offset);
    c.SetConstantBuffers(3, 1, &tint);
    c.PSSetShaderResources(0, 1, &shown);
    c.PSSetSamplers(0, 1, &smooth);
  }
};

Objects::Objects(IDevice& device) : d(device), c(*device.ImmediateContext()) {
  constexpr Format f = Format::RGBA8_UNorm;
  plain = Buffer({.byteWidth = 64, .bind = Bind::VertexBuffer});
  small = Buffer({.byteWidth = 32, .bind = Bind::IndirectArgs});
  dynamic = Buffer({.byteWidth = 64, .usage = Usage::Dynamic, .bind = Bind::VertexBuffer});
  fixed = Buffer({.byteWidth = 64, .usage = Usage::Immutable, .bind = Bind::VertexBuffer});
  staging = Buffer({.byteWidth = 64, .usage = Usage::Staging});
  constants = Buffer({.byteWidth = 64, .usage = Usage::Dynamic, .bind = Bind::ConstantBuffer});
  picture = Texture({.width = 8, .height = 8, .format = f, .bind = Bind::ShaderResource | Bind::RenderTarget});
  other = Texture({.width = 8, .height = 8, .format = f});
  half = Texture({.width = 4, .height = 4, .format = f});
  floats = Texture({.width = 8, .height = 8, .format = Format::R32_Float});
  samples = Texture(
      {.dim = TextureDim::Tex2DMS, .width = 8, .height = 8, .sampleCount = 4, .format = f, .bind = Bind::RenderTarget});
  depth = Texture({.width = 8, .height = 8, .format = Format::D32_Float, .bind = Bind::DepthStencil});
  fixedPicture = Texture({.width = 8, .height = 8, .format = f, .usage = Usage::Immutable}, true);
  stagingPicture = Texture({.width = 8, .height = 8, .format = f, .usage = Usage::Staging, .bind = Bind::None});
  blocks = Texture({.width = 8, .height = 8, .format = Format::BC1_UNorm});
  moreBlocks = Texture({.width = 8, .height = 8, .format = Format::BC1_UNorm});
  cube = Texture({.dim = TextureDim::TexCube, .width = 8, .height = 8, .depthOrArray = 6, .format = f});
  items = Buffer({.byteWidth = 64, .bind = Bind::ShaderResource, .structureStride = 16});
  words = Texture({.width = 8,
                   .height = 8,
                   .mipLevels = 2,
                   .format = Format::R32_UInt,
                   .bind = Bind::ShaderResource | Bind::RenderTarget});
  EXPECT_EQ(d.CreateRenderTargetView(picture.get(), nullptr, &rtv), Status::Ok);
  EXPECT_EQ(d.CreateShader(validation_shaders::triangle_VSMain, &vs), Status::Ok);
  EXPECT_EQ(d.CreateShader(validation_shaders::triangle_PSMain, &ps), Status::Ok);
  const InputElement position{.semantic = "POSITION", .format = Format::RGBA32_Float};
  EXPECT_EQ(d.CreateInputLayout(&position, 1, vs.get(), &layout), Status::Ok);
  EXPECT_EQ(d.CreateQuery({QueryType::Occlusion}, &occlusion), Status::Ok);
  EXPECT_EQ(d.CreateQuery({QueryType::Event}, &event), Status::Ok);
  EXPECT_EQ(d.CreateSamplerState({}, &sampler), Status::Ok);
}

struct MisuseCase {
  const char* name;
  MsgCode code;
  std::function<void(Objects&)> call;
  bool nullSeesIt = true;  // the null device takes every draw
};

constexpr Box kBeyond{4, 4, 0, 12, 8, 1}, kLeft{0, 0, 0, 32, 1, 1}, kPart{1, 0, 0, 4, 4, 1}, kBlock{0, 0, 0, 4, 4, 1},
    kTooMuch{0, 0, 0, 33, 1, 1}, kTurned{4, 0, 0, 2, 4, 1};

std::vector<MisuseCase> Cases() {
  using O = Objects;
  using enum MsgCode;
  return {
      {"CopyOfUnequalBuffers", FormatMismatch, [](O& o) { o.c.CopyResource(o.plain.get(), o.small.get()); }},
      {"CopyOfUnequalTextures", FormatMismatch, [](O& o) { o.c.CopyResource(o.picture.get(), o.half.get()); }},
      {"CopyOfOtherFormat", FormatMismatch, [](O& o) { o.c.CopyResource(o.picture.get(), o.floats.get()); }},
      {"CopyOfOtherSamples", FormatMismatch, [](O& o) { o.c.CopyResource(o.picture.get(), o.samples.get()); }},
      {"CopyBetweenKinds", FormatMismatch, [](O& o) { o.c.CopyResource(o.plain.get(), o.picture.get()); }},
      {"CopyToItself", OutOfBounds, [](O& o) { o.c.CopyResource(o.plain.get(), o.plain.get()); }},
      {"CopyToDynamic", MapMode, [](O& o) { o.c.CopyResource(o.dynamic.get(), o.plain.get()); }},
      {"CopyToImmutable", ImmutableWrite, [](O& o) { o.c.CopyResource(o.fixed.get(), o.plain.get()); }},
      {"CopyToImmutableTexture", ImmutableWrite, [](O& o) { o.c.CopyResource(o.fixedPicture.get(), o.picture.get()); }},
      {"CopyOfNull", InvalidDesc, [](O& o) { o.c.CopyResource(o.plain.get(), nullptr); }},
      {"RegionToDynamic", MapMode, [](O& o) { o.Copy(o.dynamic.get(), 0, o.plain.get(), nullptr); }},
      {"RegionBeyondBuffer", OutOfBounds, [](O& o) { o.Copy(o.plain.get(), 48, o.small.get(), &kLeft); }},
      {"RegionOverItself", OutOfBounds, [](O& o) { o.Copy(o.plain.get(), 16, o.plain.get(), &kLeft); }},
      {"RegionOfOtherFormat", FormatMismatch, [](O& o) { o.Copy(o.picture.get(), 0, o.floats.get(), nullptr); }},
      {"RegionBeyondTexture", OutOfBounds, [](O& o) { o.Copy(o.picture.get(), 0, o.other.get(), &kBeyond); }},
      {"RegionBeyondDestination", OutOfBounds, [](O& o) { o.Copy(o.half.get(), 0, o.picture.get(), nullptr); }},
      {"RegionOfNoSubresource", SubresourceOutOfRange,
       [](O& o) { o.Copy(o.picture.get(), 0, o.other.get(), nullptr, 0, 3); }},
      {"RegionWithinSubresource", OutOfBounds, [](O& o) { o.Copy(o.half.get(), 0, o.half.get(), nullptr); }},
      {"RegionOffBlocks", OutOfBounds, [](O& o) { o.Copy(o.blocks.get(), 0, o.moreBlocks.get(), &kPart); }},
      {"RegionToOffBlocks", OutOfBounds, [](O& o) { o.Copy(o.blocks.get(), 2, o.moreBlocks.get(), &kBlock); }},
      {"RegionTurned", OutOfBounds, [](O& o) { o.Copy(o.picture.get(), 0, o.other.get(), &kTurned); }},
      {"RegionTurnedOfBuffer", OutOfBounds, [](O& o) { o.Copy(o.plain.get(), 0, o.small.get(), &kTurned); }},
      {"RegionOfNull", InvalidDesc, [](O& o) { o.Copy(nullptr, 0, o.other.get(), nullptr); }},
      {"RegionBetweenKinds", FormatMismatch, [](O& o) { o.Copy(o.plain.get(), 0, o.other.get(), nullptr); }},
      {"ResolveOfNull", InvalidDesc,
       [](O& o) { o.c.ResolveSubresource(o.picture.get(), 0, nullptr, 0, Format::RGBA8_UNorm); }},
      {"ResolveOfOneSample", FormatMismatch,
       [](O& o) { o.c.ResolveSubresource(o.picture.get(), 0, o.other.get(), 0, Format::RGBA8_UNorm); }},
      {"ResolveOfNoSubresource", SubresourceOutOfRange,
       [](O& o) { o.c.ResolveSubresource(o.picture.get(), 2, o.samples.get(), 0, Format::RGBA8_UNorm); }},
      {"ResolveToTwin", FormatMismatch,
       [](O& o) { o.c.ResolveSubresource(o.picture.get(), 0, o.samples.get(), 0, Format::RGBA8_UNorm_sRGB); }},
      {"UpdateOfDynamic", MapMode, [](O& o) { o.Update(o.dynamic.get()); }},
      {"UpdateOfStaging", MapMode, [](O& o) { o.Update(o.stagingPicture.get()); }},
      {"UpdateOfImmutable", ImmutableWrite, [](O& o) { o.Update(o.fixed.get()); }},
      {"UpdateBeyondBuffer", OutOfBounds, [](O& o) { o.Update(o.small.get(), &kTooMuch); }},
      {"UpdateBeyondTexture", OutOfBounds, [](O& o) { o.Update(o.picture.get(), &kBeyond); }},
      {"UpdateOffBlocks", OutOfBounds, [](O& o) { o.Update(o.blocks.get(), &kPart); }},
      {"UpdateOfNoSubresource", SubresourceOutOfRange, [](O& o) { o.Update(o.picture.get(), nullptr, 1); }},
      {"UpdateOfDepth", FormatMismatch, [](O& o) { o.Update(o.depth.get()); }},
      {"UpdateOfSamples", FormatMismatch, [](O& o) { o.Update(o.samples.get()); }},
      {"UpdateWithNarrowRows", PitchTooSmall,
       [](O& o) { o.c.UpdateSubresource(o.picture.get(), 0, nullptr, o.bytes.data(), 16, 0); }},
      {"UpdateTurned", OutOfBounds, [](O& o) { o.Update(o.picture.get(), &kTurned); }},
      {"UpdateOfNoData", InvalidDesc, [](O& o) { o.c.UpdateSubresource(o.picture.get(), 0, nullptr, nullptr, 0, 0); }},
      {"UpdateOfNull", InvalidDesc, [](O& o) { o.Update(nullptr); }},
      {"TooManyConstants", OutOfBounds, [](O& o) { o.c.UpdateConstants(o.constants.get(), o.bytes.data(), 65); }},
      {"ConstantsElsewhere", MapMode, [](O& o) { o.c.UpdateConstants(o.plain.get(), o.bytes.data(), 16); }},
      {"ConstantsNowhere", NothingBound, [](O& o) { o.c.UpdateConstants(nullptr, o.bytes.data(), 16); }},
      {"MapOfDefault", MapMode, [](O& o) { o.Map(o.plain.get(), MapMode::Read); }},
      {"MapOfImmutable", ImmutableWrite, [](O& o) { o.Map(o.fixed.get(), MapMode::WriteDiscard); }},
      {"MapOfDynamicToRead", MapMode, [](O& o) { o.Map(o.dynamic.get(), MapMode::Read); }},
      {"MapOfStagingToDiscard", MapMode, [](O& o) { o.Map(o.staging.get(), MapMode::WriteDiscard); }},
      {"MapOfConstantsToAppend", MapMode, [](O& o) { o.Map(o.constants.get(), MapMode::WriteNoOverwrite); }},
      {"MapOfTexture", MapMode, [](O& o) { o.Map(o.picture.get(), MapMode::Read); }},
      {"MapOfNoSubresource", SubresourceOutOfRange, [](O& o) { o.Map(o.stagingPicture.get(), MapMode::Read, 1); }},
      {"MapOfNull", InvalidDesc, [](O& o) { o.Map(nullptr, MapMode::Read); }},
      {"MapTwice", MapTwice,
       [](O& o) {
         EXPECT_EQ(o.Map(o.staging.get(), MapMode::Write), Status::Ok);
         EXPECT_EQ(o.Map(o.staging.get(), MapMode::Write), Status::InvalidArg);
         o.c.Unmap(o.staging.get(), 0);
       }},
      {"UnmapOfUnmapped", MapMode, [](O& o) { o.c.Unmap(o.staging.get(), 0); }},
      {"UnmapOfNull", InvalidDesc, [](O& o) { o.c.Unmap(nullptr, 0); }},
      {"ViewOfNoMip", SubresourceOutOfRange, [](O& o) { o.View({.firstMip = 1}); }},
      {"ViewOfOtherFormat", FormatMismatch, [](O& o) { o.View({.format = Format::R32_Float}); }},
      {"ViewWithoutFlag", WrongBindFlag,
       [](O& o) {
         Ref<IRenderTargetView> none;
         EXPECT_EQ(o.d.CreateRenderTargetView(o.other.get(), nullptr, &none), Status::InvalidArg);
       }},
      {"SlotTooHigh", SlotOutOfRange,
       [](O& o) {
         IBuffer* b = o.constants.get();
         o.c.SetConstantBuffers(kMaxConstantBuffers, 1, &b);
       }},
      {"ShaderOfOtherStage", WrongStage, [](O& o) { o.c.VSSetShader(o.ps.get()); }},
      {"DrawWithoutShader", NoVertexShader, [](O& o) { o.SetTarget(), o.c.Draw(3, 0); }, false},
      {"DrawWithoutTarget", NoTarget,
       [](O& o) {
         o.SetTarget(), o.SetShaders(), o.c.IASetInputLayout(o.layout.get());
         o.c.OMSetRenderTargets(0, nullptr, nullptr), o.c.Draw(3, 0);
       },
       false},
      {"DrawWithoutLayout", LayoutMismatch, [](O& o) { o.SetTarget(), o.SetShaders(), o.c.Draw(3, 0); }, false},
      {"DispatchWithoutShader", NothingBound, [](O& o) { o.c.Dispatch(1, 1, 1); }, false},
      {"DrawWithoutViewport", NothingBound, [](O& o) { o.SetDraw(0), o.c.Draw(3, 0); }, false},
      // Several faults at once: the first in the header's order.
      {"DrawWithoutAnything", NoVertexShader, [](O& o) { o.c.DrawIndexed(3, 0, 0); }, false},
      {"DrawWithShadersAlone", LayoutMismatch, [](O& o) { o.SetShaders(), o.c.DrawIndexed(3, 0, 0); }, false},
      {"DrawWithShadersAndLayout", NoTarget,
       [](O& o) { o.SetShaders(), o.c.IASetInputLayout(o.layout.get()), o.c.DrawIndexed(3, 0, 0); }, false},
      {"DrawWithoutViewportAndIndices", NothingBound,
       [](O& o) { o.SetDraw(0), o.c.DrawIndexedInstanced(3, 1, 0, 0, 0); }, false},
      {"DrawWithoutIndices", IndexBufferMissing, [](O& o) { o.SetAll(o.other.get()), o.c.DrawIndexed(3, 0, 0); },
       false},
      {"IndirectWithoutIndices", IndexBufferMissing,
       [](O& o) { o.SetAll(o.other.get()), o.c.DrawIndexedInstancedIndirect(o.small.get(), 0); }, false},
      {"IndirectIndexedOfNull", WrongBindFlag, [](O& o) { o.c.DrawIndexedInstancedIndirect(nullptr, 0); }, false},
      {"IndirectIndexedBeyond", OutOfBounds, [](O& o) { o.c.DrawIndexedInstancedIndirect(o.small.get(), 16); }, false},
      {"DispatchIndirectOfNull", WrongBindFlag, [](O& o) { o.c.DispatchIndirect(nullptr, 0); }, false},
      {"DispatchIndirectBeyond", OutOfBounds, [](O& o) { o.c.DispatchIndirect(o.small.get(), 24); }, false},
      {"DispatchIndirectWithoutShader", NothingBound, [](O& o) { o.c.DispatchIndirect(o.small.get(), 0); }, false},
      {"DispatchOfTooMany", OutOfBounds, [](O& o) { o.c.Dispatch(1, 65536, 1); }, false},
      {"ViewOfOtherDimension", ViewMismatch, [](O& o) { o.SetAll(o.cube.get()), o.c.Draw(3, 0); }, false},
      {"ViewOfOtherTexels", ViewMismatch, [](O& o) { o.SetAll(o.words.get()), o.c.Draw(3, 0); }, false},
      {"ViewOfBuffer", ViewMismatch, [](O& o) { o.SetAll(o.items.get()), o.c.Draw(3, 0); }, false},
      {"IndirectOfNull", WrongBindFlag, [](O& o) { o.c.DrawInstancedIndirect(nullptr, 0); }, false},
      {"IndirectWithoutFlag", WrongBindFlag, [](O& o) { o.c.DrawInstancedIndirect(o.plain.get(), 0); }, false},
      {"IndirectBeyond", OutOfBounds, [](O& o) { o.c.DrawInstancedIndirect(o.small.get(), 20); }, false},
      {"IndirectOffFour", OutOfBounds, [](O& o) { o.c.DrawInstancedIndirect(o.small.get(), 2); }, false},
      {"MipsOfATwin", FormatMismatch, [](O& o) { o.Mips(o.picture.get(), Format::RGBA8_UNorm_sRGB); }},
      {"MipsOfNull", InvalidDesc, [](O& o) { o.c.GenerateMips(nullptr); }},
      {"MipsOfNoTarget", WrongBindFlag, [](O& o) { o.Mips(o.other.get()); }},
      {"MipsOfIntegers", CapMissing, [](O& o) { o.Mips(o.words.get()); }},
      {"PrecacheOfNothing", NoVertexShader, [](O& o) { EXPECT_EQ(o.d.PrecachePipeline({}), Status::InvalidArg); }},
      {"PrecacheOfTooManyTargets", NoVertexShader,
       [](O& o) {
         const PipelineKeyDesc key{.vs = o.vs.get(), .rtvCount = kMaxRenderTargets + 1};
         EXPECT_EQ(o.d.PrecachePipeline(key), Status::InvalidArg);
       }},
      {"ReadOfNull", InvalidDesc, [](O& o) { o.Read(nullptr, 0); }},
      {"ReadOfSamples", FormatMismatch, [](O& o) { o.Read(o.samples.get(), 0); }},
      {"ReadOfNoSubresource", SubresourceOutOfRange, [](O& o) { o.Read(o.picture.get(), 1); }},
      {"ReadOfNullBuffer", InvalidDesc,
       [](O& o) { EXPECT_EQ(o.d.ReadBack(nullptr, 0, 4, o.bytes.data()), Status::InvalidArg); }},
      {"ReadIntoTooLittle", OutOfBounds,
       [](O& o) { EXPECT_EQ(o.d.ReadBack(o.picture.get(), 0, o.bytes.data(), 255), Status::InvalidArg); }},
      {"ReadIntoNull", InvalidDesc,
       [](O& o) { EXPECT_EQ(o.d.ReadBack(o.picture.get(), 0, nullptr, 256), Status::InvalidArg); }},
      {"ReadOfBufferIntoNull", InvalidDesc,
       [](O& o) { EXPECT_EQ(o.d.ReadBack(o.plain.get(), 0, 4, nullptr), Status::InvalidArg); }},
      {"ReadBeyondBuffer", OutOfBounds,
       [](O& o) { EXPECT_EQ(o.d.ReadBack(o.plain.get(), 48, 32, o.bytes.data()), Status::InvalidArg); }},
      {"EventsEndTwice", QueryOrder, [](O& o) { o.c.EndEvent(); }, false},
      {"DataOfWrongSize", OutOfBounds,
       [](O& o) {
         uint32_t out = 0;
         o.c.Begin(o.occlusion.get()), o.c.End(o.occlusion.get());
         EXPECT_EQ(o.c.GetData(o.occlusion.get(), &out, sizeof out, true), Status::InvalidArg);
       },
       false},
      {"EndWithoutBegin", QueryOrder, [](O& o) { o.c.End(o.occlusion.get()); }},
      {"BeginOfEvent", QueryOrder, [](O& o) { o.c.Begin(o.event.get()); }},
      {"DataOfUnended", QueryOrder, [](O& o) { o.c.GetData(o.event.get(), nullptr, 0, true); }},
  };
}
void PrintTo(const MisuseCase& one, std::ostream* out) { *out << one.name; }

enum class Seer { Vulkan, OpenGL, Null, Validation };
void PrintTo(Seer seer, std::ostream* out) {
  *out << std::to_array({"vulkan", "gl", "null", "validation"})[size_t(seer)];
}

class MisuseTest : public testing::TestWithParam<std::tuple<MisuseCase, Seer>> {
 protected:
  Ref<IDevice> Open(Seer seer) {
    const DeviceDesc desc{.preferSoftware = true, .sink = &sink};
    Ref<IDevice> device;
    Status s = Status::Unsupported;
    switch (seer) {
      case Seer::Vulkan: s = rhi_vulkan::CreateDevice(desc, &device); break;
      case Seer::OpenGL: s = rhi_gl::CreateDevice(desc, &device); break;
      case Seer::Null:
      case Seer::Validation: s = CreateNullDevice(desc, &device); break;
    }
    EXPECT_EQ(s, Status::Ok);
    return seer == Seer::Validation ? WrapWithValidation(device, &sink) : device;
  }
  KeepingSink sink;
};

TEST_P(MisuseTest, HasItsCode) {
  const auto& [misuse, seer] = GetParam();
  if (seer == Seer::Null && !misuse.nullSeesIt) GTEST_SKIP() << "the null device takes every draw";
  const Ref<IDevice> device = Open(seer);
  ASSERT_TRUE(device) << sink.Dump();
  Objects objects(*device);
  const auto dropInfos = [&] {
    std::erase_if(sink.entries, [](const auto& e) { return e.severity == Severity::Info; });
  };
  dropInfos();
  ASSERT_TRUE(sink.entries.empty()) << sink.Dump();
  misuse.call(objects);
  dropInfos();
  ASSERT_EQ(sink.entries.size(), 1u) << sink.Dump();
  EXPECT_EQ(sink.entries[0].code, misuse.code) << sink.Dump();
  EXPECT_GE(sink.entries[0].severity, Severity::Warning) << sink.Dump();
  device->ImmediateContext()->ClearState();
}

INSTANTIATE_TEST_SUITE_P(Every, MisuseTest,
                         testing::Combine(testing::ValuesIn(Cases()),
                                          testing::Values(Seer::Vulkan, Seer::OpenGL, Seer::Null, Seer::Validation)),
                         [](const auto& one) {
                           constexpr auto kSeers = std::to_array({"_vulkan", "_gl", "_null", "_validation"});
                           return std::get<0>(one.param).name + std::string(kSeers[size_t(std::get<1>(one.param))]);
                         });

}  // namespace
}  // namespace validation_test
