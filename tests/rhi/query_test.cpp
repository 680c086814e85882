// Queries.
#include "rhi_fixture.h"

namespace rhi_test {
namespace {

using namespace rhi;

class QueryTest : public RhiTest {
 protected:
  Target Start() {
    const Target target = gpu.MakeTarget({.width = 16, .height = 16, .depthFormat = Format::D32_Float});
    gpu.Clear(target, {0, 0, 0, 0}, 0.5f);
    gpu.SetTarget(target);
    return target;
  }
  static Rgba32F Pixels(uint32_t left, uint32_t top, uint32_t right, uint32_t bottom) {
    return {float(left) / 8 - 1, 1 - float(top) / 8, float(right) / 8 - 1, 1 - float(bottom) / 8};
  }
};

TEST_P(QueryTest, OcclusionExact) {
  RHI_NEEDS_CAP(occlusionPrecise);
  Start();
  struct Case {
    Rgba32F rectangle;
    float depth;
    uint64_t samples;
  };
  const Case cases[] = {{Pixels(0, 0, 5, 3), 0.25f, 15},
                        {Pixels(3, 3, 16, 16), 0.75f, 0},
                        {Pixels(0, 0, 16, 16), 0.1f, 256},
                        {Pixels(7, 7, 8, 8), 0.05f, 1}};
  std::vector<Ref<IQuery>> queries;
  for (const Case& c : cases) {
    queries.push_back(gpu.Query(QueryType::Occlusion));
    context.Begin(queries.back().get());
    gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = c.rectangle, .extra = {c.depth, 0, 0, 0}});
    context.End(queries.back().get());
  }
  for (size_t i = 0; i < std::size(cases); ++i)
    EXPECT_EQ(gpu.Result<uint64_t>(queries[i].get()), cases[i].samples) << i;
}

TEST_P(QueryTest, OcclusionOverTwoTargetsAndReuse) {
  RHI_NEEDS_CAP(occlusionPrecise);
  const Ref<IQuery> q = gpu.Query(QueryType::Occlusion);
  for (uint32_t round = 1; round <= 2; ++round) {
    context.Begin(q.get());
    Start();
    for (uint32_t i = 0; i < round; ++i)
      gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = Pixels(i, 0, i + 1, 4), .extra = {0.1f, 0, 0, 0}});
    Start();
    gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = Pixels(0, 0, 2, 2), .extra = {0.1f, 0, 0, 0}});
    context.End(q.get());
    EXPECT_EQ(gpu.Result<uint64_t>(q.get()), 4 * round + 4);
  }
}

TEST_P(QueryTest, OcclusionWithoutDraws) {
  Start();
  const Ref<IQuery> q = gpu.Query(QueryType::Occlusion);
  context.Begin(q.get());
  context.End(q.get());
  EXPECT_EQ(gpu.Result<uint64_t>(q.get()), 0u);
}

TEST_P(QueryTest, OcclusionPredicate) {
  Start();
  const Ref<IQuery> seen = gpu.Query(QueryType::OcclusionPredicate), hidden = gpu.Query(QueryType::OcclusionPredicate);
  context.Begin(seen.get());
  gpu.DrawRect(test_shaders::rect_PSTint, {.extra = {0.25f, 0, 0, 0}});
  context.End(seen.get());
  context.Begin(hidden.get());
  gpu.DrawRect(test_shaders::rect_PSTint, {.extra = {0.75f, 0, 0, 0}});
  context.End(hidden.get());
  EXPECT_TRUE(gpu.Result<bool>(seen.get()));
  EXPECT_FALSE(gpu.Result<bool>(hidden.get()));
}

TEST_P(QueryTest, PipelineStatsGsPrims) {
  RHI_NEEDS_CAP(pipelineStatistics);
  RHI_NEEDS_CAP(geometryShader);
  // The quads are at 0.5, and a pixel that fails the depth test need not be shaded.
  gpu.Clear(Start(), {0, 0, 0, 0}, 1);
  const Ref<IQuery> q = gpu.Query(QueryType::PipelineStatistics);
  context.Begin(q.get());
  gpu.SetShaders(test_shaders::prims_VSPrimitive, test_shaders::prims_PSPrimitive);
  gpu.SetGeometryShader(test_shaders::prims_GSPrimitiveLineAdj);
  context.IASetPrimitiveTopology(PrimitiveTopology::LineListAdj);
  context.Draw(20, 0);
  context.End(q.get());
  const PipelineStatistics s = gpu.Result<PipelineStatistics>(q.get());
  EXPECT_EQ(s.iaVertices, 20u);
  EXPECT_EQ(s.iaPrimitives, 5u);
  EXPECT_GE(s.vsInvocations, 5u);
  EXPECT_LE(s.vsInvocations, 20u);
  EXPECT_EQ(s.gsInvocations, 5u);
  EXPECT_EQ(s.gsPrimitives, 20u);  // two quads of two triangles for each
  EXPECT_EQ(s.cInvocations, 20u);
  EXPECT_GE(s.psInvocations, 5u * 16u);  // the columns 0 to 4
}

TEST_P(QueryTest, TimestampsMonotone) {
  RHI_NEEDS_CAP(timestamp);
  Start();
  const Ref<IQuery> disjoint = gpu.Query(QueryType::TimestampDisjoint);
  context.Begin(disjoint.get());
  std::vector<Ref<IQuery>> stamps;
  for (int i = 0; i < 5; ++i) {
    stamps.push_back(gpu.Query(QueryType::Timestamp));
    context.End(stamps.back().get());
    gpu.DrawRect(test_shaders::rect_PSTint, {.extra = {0.1f, 0, 0, 0}});
  }
  context.End(disjoint.get());
  uint64_t last = 0;
  for (const auto& stamp : stamps) {
    const uint64_t t = gpu.Result<uint64_t>(stamp.get());
    EXPECT_GE(t, last);
    last = t;
  }
  EXPECT_GT(last, 0u);
  EXPECT_GT(gpu.Result<TimestampDisjoint>(disjoint.get()).frequency, 0u);
}

TEST_P(QueryTest, EventComesWithTheWork) {
  Start();
  const Ref<IQuery> q = gpu.Query(QueryType::Event);
  gpu.DrawRect(test_shaders::rect_PSTint);
  context.End(q.get());
  EXPECT_TRUE(gpu.Result<bool>(q.get()));
}

TEST_P(QueryTest, ResultsOutliveFrames) {
  Start();
  const Ref<IQuery> q = gpu.Query(QueryType::Occlusion);
  context.Begin(q.get());
  gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = Pixels(0, 0, 4, 4), .extra = {0.1f, 0, 0, 0}});
  context.End(q.get());
  for (int i = 0; i < 5; ++i) context.EndFrame();
  EXPECT_EQ(gpu.Result<uint64_t>(q.get()), 16u);
}

TEST_P(QueryTest, WrongOrderIsReported) {
  sink.Expect(MsgCode::QueryOrder, "End without Begin, Begin twice, Begin of an event");
  const Ref<IQuery> q = gpu.Query(QueryType::Occlusion), event = gpu.Query(QueryType::Event);
  context.End(q.get());
  context.Begin(q.get());
  context.Begin(q.get());
  context.Begin(event.get());
  context.End(q.get());
  EXPECT_EQ(sink.Count(MsgCode::QueryOrder), 3) << sink.Dump();
}

// Queries of one kind nest and overlap; each counts what is drawn between its own Begin and End.
TEST_P(QueryTest, QueriesOfAKindOverlap) {
  RHI_NEEDS_CAP(occlusionPrecise);
  Start();
  const auto draw = [&](uint32_t pixels) {
    gpu.DrawRect(test_shaders::rect_PSTint, {.rectangle = Pixels(0, 0, pixels, 1), .extra = {0.1f, 0, 0, 0}});
  };
  context.OMSetDepthStencilState(gpu.DepthStencil({.depthEnable = false}).get());
  const Ref<IQuery> a = gpu.Query(QueryType::Occlusion), b = gpu.Query(QueryType::Occlusion),
                    c = gpu.Query(QueryType::OcclusionPredicate);
  for (int round = 0; round < 2; ++round) {
    context.Begin(a.get());
    draw(1);
    context.Begin(b.get());
    draw(2);
    context.Begin(c.get());
    context.End(a.get());
    draw(4);
    context.End(c.get());
    draw(8);
    context.End(b.get());
    draw(16);
    EXPECT_EQ(gpu.Result<uint64_t>(a.get()), 3u);
    EXPECT_EQ(gpu.Result<uint64_t>(b.get()), 14u);
    EXPECT_TRUE(gpu.Result<bool>(c.get()));
  }
}

TEST_P(QueryTest, StatisticsOverlapAndCountDispatches) {
  RHI_NEEDS_CAP(pipelineStatistics);
  RHI_NEEDS_CAP(compute);
  const Target target = Start();
  const Ref<IQuery> outer = gpu.Query(QueryType::PipelineStatistics), inner = gpu.Query(QueryType::PipelineStatistics);
  const Ref<IBuffer> out = gpu.BufferOf(Bind::UnorderedAccess, std::vector<uint32_t>(1), 4);
  const Ref<IUnorderedAccessView> view = gpu.WriteView(out.get());
  IUnorderedAccessView* raw = view.get();
  context.CSSetUnorderedAccessViews(1, 1, &raw);
  context.CSSetShader(gpu.Shader(test_shaders::compute_CSCount).get());
  context.Begin(outer.get());
  gpu.DrawRect(test_shaders::rect_PSTint, {.extra = {0.1f, 0, 0, 0}});
  context.Begin(inner.get());
  context.Dispatch(3, 2, 1);
  context.End(inner.get());
  gpu.DrawRect(test_shaders::rect_PSTint, {.extra = {0.1f, 0, 0, 0}});
  context.End(outer.get());
  const auto o = gpu.Result<PipelineStatistics>(outer.get()), i = gpu.Result<PipelineStatistics>(inner.get());
  EXPECT_EQ(o.iaVertices, 8u);
  EXPECT_EQ(i.iaVertices, 0u);
  EXPECT_EQ(o.csInvocations, 6u);
  EXPECT_EQ(i.csInvocations, 6u);
}

// Null data only asks whether the result is there; other sizes than the result's are refused.
TEST_P(QueryTest, GetDataWithoutMemoryAndOfOtherSizes) {
  Start();
  const Ref<IQuery> q = gpu.Query(QueryType::Occlusion);
  context.Begin(q.get());
  context.End(q.get());
  EXPECT_EQ(gpu.Result<uint64_t>(q.get()), 0u);
  EXPECT_EQ(context.GetData(q.get(), nullptr, 0, true), Status::Ok);
  sink.Expect(MsgCode::OutOfBounds, "too little and too much memory");
  std::array<uint8_t, 16> data{};
  EXPECT_EQ(context.GetData(q.get(), data.data(), 4, true), Status::InvalidArg);
  EXPECT_EQ(context.GetData(q.get(), data.data(), 16, true), Status::InvalidArg);
  EXPECT_EQ(sink.Count(MsgCode::OutOfBounds), 2);
}

TEST_P(QueryTest, NoQueryIsReported) {
  sink.Expect(MsgCode::QueryOrder, "no query");
  context.Begin(nullptr);
  context.End(nullptr);
  uint64_t value;
  EXPECT_EQ(context.GetData(nullptr, &value, sizeof value, true), Status::InvalidArg);
  EXPECT_EQ(sink.Count(MsgCode::QueryOrder), 3);
}

// Debug markers nest, within passes and over frames, and change nothing.
TEST_P(QueryTest, DebugMarkersNest) {
  const Target target = Start();
  context.BeginEvent("frame");
  context.BeginEvent("pass");
  gpu.DrawRect(test_shaders::rect_PSTint, {.extra = {0.1f, 0, 0, 0}});
  context.EndEvent();
  context.Flush();
  context.BeginEvent(nullptr);  // no name
  context.EndEvent();
  context.BeginEvent("over a frame");
  context.EndFrame();
  context.EndEvent();
  context.EndEvent();
  EXPECT_TRUE(Matches(gpu.Read(target), [](auto, auto) { return Rgba8{255, 255, 255, 255}; }));
}

RHI_ON_EVERY_BACKEND(QueryTest);

}  // namespace
}  // namespace rhi_test
