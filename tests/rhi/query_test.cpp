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

TEST_P(QueryTest, PipelineStatsOfVerticesAndGsPrims) {
  RHI_NEEDS_CAP(pipelineStatistics);
  RHI_NEEDS_CAP(geometryShader);
  Start();
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
  EXPECT_GT(s.psInvocations, 0u);
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

RHI_ON_EVERY_BACKEND(QueryTest);

}  // namespace
}  // namespace rhi_test
