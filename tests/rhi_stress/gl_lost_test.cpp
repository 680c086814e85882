// OpenGL's driver says that the GPU was reset, or that memory is out. libepoxy's entry points are pointers that a test
// may set, so the driver is the real one but for the few calls that bring the news.
#include <epoxy/gl.h>

#include <functional>
#include <utility>

#include "rig.h"

namespace rhi_stress {
namespace {

using namespace rhi;

// An entry point is another function for as long as this lives.
template <class F>
class Replaced {
 public:
  Replaced(F& entry, F with) : entry_(entry), before_(std::exchange(entry, with)) {}
  ~Replaced() { entry_ = before_; }
  Replaced(const Replaced&) = delete;
  Replaced& operator=(const Replaced&) = delete;

 private:
  F& entry_;
  const F before_;
};

void MakeNoNames(GLsizei count, GLuint* names) { std::fill(names, names + count, 0u); }

// What KHR_robustness asks of a driver that lost a context, and of the worst kind: it tells of the reset once, then
// claims that all is well; fences fail, names are 0, nothing can be mapped.
class LostDriver {
 public:
  LostDriver() { untold_ = true, draws = 0, waits = 0; }
  static inline int draws = 0, waits = 0;

 private:
  static inline bool untold_ = false;
  Replaced<PFNGLGETGRAPHICSRESETSTATUSPROC> status_{
      epoxy_glGetGraphicsResetStatus,
      +[] { return std::exchange(untold_, false) ? GLenum(GL_INNOCENT_CONTEXT_RESET) : GLenum(GL_NO_ERROR); }};
  Replaced<PFNGLFENCESYNCPROC> fence_{epoxy_glFenceSync, +[](GLenum, GLbitfield) { return GLsync(nullptr); }};
  Replaced<PFNGLCLIENTWAITSYNCPROC> wait_{epoxy_glClientWaitSync, +[](GLsync, GLbitfield, GLuint64) {
                                            ++waits;
                                            return GLenum(GL_WAIT_FAILED);
                                          }};
  Replaced<PFNGLCREATEBUFFERSPROC> buffers_{epoxy_glCreateBuffers, &MakeNoNames};
  Replaced<PFNGLMAPNAMEDBUFFERRANGEPROC> map_{
      epoxy_glMapNamedBufferRange, +[](GLuint, GLintptr, GLsizeiptr, GLbitfield) -> void* { return nullptr; }};
  Replaced<PFNGLDRAWARRAYSPROC> draw_{epoxy_glDrawArrays, +[](GLenum, GLint, GLsizei) { ++draws; }};
};

// A device in the middle of its work, with something of everything.
struct Work {
  explicit Work(Rig& r) : rig(r) {
    IDevice& d = *rig.device;
    rig.context->OMSetRenderTargets(0, nullptr, nullptr);
    staging = rig.Texture(
        {.width = 8, .height = 8, .format = Format::RGBA8_UNorm, .usage = Usage::Staging, .bind = Bind::None});
    rig.Require(d.CreateQuery({QueryType::Event}, &event), "CreateQuery");
    rig.Require(d.CreateQuery({QueryType::Occlusion}, &occlusion), "CreateQuery");
    rig.context->Begin(occlusion.get());
    rig.SetTarget(target);
    rig.SetConstants(constants.get(), {});
    rig.DrawRect(vs.get(), ps.get());
    rig.context->End(event.get());
    rig.context->CopyResource(staging.get(), target.texture.get());
  }

  Rig& rig;
  const Target target = rig.MakeTarget(8);
  const Ref<IBuffer> constants = rig.Constants();
  const Ref<IBuffer> plain = rig.Buffer({.byteWidth = 64, .bind = Bind::VertexBuffer});
  const Ref<IBuffer> dynamic = rig.Buffer({.byteWidth = 64, .usage = Usage::Dynamic, .bind = Bind::VertexBuffer});
  const Ref<IShader> vs = rig.Shader(stress_shaders::stress_VSRect), ps = rig.Shader(stress_shaders::stress_PSTint);
  Ref<ITexture> staging;
  Ref<IQuery> event, occlusion;
  std::array<uint8_t, 256> bytes{};
};

using StatusCall = std::function<Status(Work&)>;
template <class T, class F>
StatusCall Creates(F create) {
  return [create](Work& w) {
    Ref<T> made;
    const Status s = create(*w.rig.device, w, &made);
    EXPECT_FALSE(made);
    return s;
  };
}

struct Case {
  const char* name;
  StatusCall call;
};
void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

// The calls that may be the first to see a loss. Those without a status ask WaitIdle for it.
std::vector<Case> Seeing() {
  using W = Work;
  using D = IDevice;
  const auto then = [](void (IContext::*call)()) {
    return [call](W& w) {
      (w.rig.context->*call)();
      EXPECT_EQ(w.rig.sink.Count(MsgCode::DeviceLost), 1) << w.rig.sink.Dump();
      return w.rig.device->WaitIdle();
    };
  };
  return {
      {"Flush", then(&IContext::Flush)},
      {"EndFrame", then(&IContext::EndFrame)},
      {"WaitIdle", [](W& w) { return w.rig.device->WaitIdle(); }},
      {"ReadBackTexture",
       [](W& w) { return w.rig.device->ReadBack(w.target.texture.get(), 0, w.bytes.data(), w.bytes.size()); }},
      {"ReadBackBuffer", [](W& w) { return w.rig.device->ReadBack(w.plain.get(), 0, 64, w.bytes.data()); }},
      {"MapRead",
       [](W& w) {
         Mapped m;
         return w.rig.context->Map(w.staging.get(), 0, MapMode::Read, &m);
       }},
      {"GetData", [](W& w) { return w.rig.context->GetData(w.event.get(), nullptr, 0, true); }},
      {"CreateBuffer", Creates<IBuffer>([](D& d, W&, auto* out) {
         return d.CreateBuffer({.byteWidth = 64, .bind = Bind::VertexBuffer}, nullptr, out);
       })},
      {"CreateStagingBuffer", Creates<IBuffer>([](D& d, W&, auto* out) {
         return d.CreateBuffer({.byteWidth = 64, .usage = Usage::Staging}, nullptr, out);
       })},
      {"CreateTexture", Creates<ITexture>([](D& d, W&, auto* out) {
         return d.CreateTexture({.width = 4, .height = 4, .format = Format::RGBA8_UNorm}, nullptr, out);
       })},
      {"CreateShaderResourceView", Creates<IShaderResourceView>([](D& d, W& w, auto* out) {
         return d.CreateShaderResourceView(w.target.texture.get(), nullptr, out);
       })},
      {"CreateRenderTargetView", Creates<IRenderTargetView>([](D& d, W& w, auto* out) {
         return d.CreateRenderTargetView(w.target.texture.get(), nullptr, out);
       })},
      {"CreateShader",
       Creates<IShader>([](D& d, W&, auto* out) { return d.CreateShader(stress_shaders::stress_PSTinted, out); })},
      {"CreateSamplerState",
       Creates<ISamplerState>([](D& d, W&, auto* out) { return d.CreateSamplerState({.mipBias = 1}, out); })},
      {"CreateQuery", Creates<IQuery>([](D& d, W&, auto* out) { return d.CreateQuery({QueryType::Timestamp}, out); })},
      {"PrecachePipeline", [](W& w) { return w.rig.device->PrecachePipeline({.vs = w.vs.get(), .ps = w.ps.get()}); }},
  };
}

// Everything that a program may still do before it notices.
void CallEverything(Work& w) {
  IContext& c = *w.rig.context;
  c.ClearRenderTargetView(w.target.view.get(), Rgba32F{}.data());
  w.rig.SetTarget(w.target);
  w.rig.SetConstants(w.constants.get(), {});
  w.rig.DrawRect(w.vs.get(), w.ps.get());
  c.Draw(3, 1);
  c.UpdateSubresource(w.plain.get(), 0, nullptr, w.bytes.data(), 0, 0);
  c.CopyResource(w.staging.get(), w.target.texture.get());
  c.End(w.event.get());
  c.End(w.occlusion.get());
  c.BeginEvent("event");
  c.EndEvent();
  Mapped m;
  EXPECT_EQ(c.Map(w.dynamic.get(), 0, MapMode::WriteDiscard, &m), Status::DeviceLost);
  EXPECT_EQ(m.data, nullptr);
  for (int frame = 0; frame < 4; ++frame) {
    c.Flush();
    c.EndFrame();
  }
  Ref<IBlendState> blend;
  EXPECT_EQ(w.rig.device->CreateBlendState({.alphaToCoverage = true}, &blend), Status::DeviceLost);
  EXPECT_FALSE(blend);
  for (const Case& other : Seeing()) EXPECT_EQ(other.call(w), Status::DeviceLost) << other.name;
}

class GlLostTest : public testing::TestWithParam<Case> {};

TEST_P(GlLostTest, IsSaidOnceAndLeavesNothingBehind) {
  auto rig = std::make_unique<Rig>(Backend::OpenGL, false);
  TestSink& sink = rig->sink;
  sink.Expect(MsgCode::DeviceLost, "the driver says so");
  auto work = std::make_unique<Work>(*rig);
  {
    const LostDriver driver;
    EXPECT_EQ(GetParam().call(*work), Status::DeviceLost);
    EXPECT_EQ(sink.Count(MsgCode::DeviceLost), 1) << sink.Dump();
    LostDriver::draws = LostDriver::waits = 0;
    CallEverything(*work);
    EXPECT_EQ(LostDriver::draws + LostDriver::waits, 0) << "a lost device is left alone";
    EXPECT_EQ(sink.Count(MsgCode::DeviceLost), 1) << sink.Dump();
    work = nullptr;
    rig->context->ClearState();
    rig->device = nullptr;
    sink.Verify();
  }
  Rig next(Backend::OpenGL, true);
  next.ExpectUsable();
  next.Finish();
  next.sink.Verify();
}

INSTANTIATE_TEST_SUITE_P(Seen, GlLostTest, testing::ValuesIn(Seeing()),
                         [](const auto& one) { return std::string(one.param.name); });

// A GPU that hangs, of which the driver does not tell: the wait for its frames has an end.
TEST(GlHungTest, FramesThatDoNotEnd) {
  Rig rig(Backend::OpenGL, false);
  rig.sink.Expect(MsgCode::DeviceLost, "the fences are never passed");
  {
    const Replaced<PFNGLCLIENTWAITSYNCPROC> wait{
        epoxy_glClientWaitSync, +[](GLsync, GLbitfield, GLuint64) { return GLenum(GL_TIMEOUT_EXPIRED); }};
    for (int frame = 0; frame < 6; ++frame) rig.context->EndFrame();
    EXPECT_EQ(rig.sink.Count(MsgCode::DeviceLost), 1) << rig.sink.Dump();
    EXPECT_EQ(rig.device->WaitIdle(), Status::DeviceLost);
  }
  rig.sink.Verify();
}

// Without it a reset would never be told.
TEST(GlContextTest, AsksForResetNotification) {
  const Rig rig(Backend::OpenGL, false);
  GLint strategy = 0, flags = 0;
  glGetIntegerv(GL_RESET_NOTIFICATION_STRATEGY, &strategy);
  glGetIntegerv(GL_CONTEXT_FLAGS, &flags);
  if (!(flags & GL_CONTEXT_FLAG_ROBUST_ACCESS_BIT)) GTEST_SKIP() << "this driver makes no robust contexts";
  EXPECT_EQ(strategy, GL_LOSE_CONTEXT_ON_RESET);
}

}  // namespace
}  // namespace rhi_stress
