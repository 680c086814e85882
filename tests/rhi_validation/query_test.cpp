// Queries and debug events.
#include "fixture.h"

namespace validation_test {
namespace {

using namespace rhi;

class QueryTest : public ValidationTest {
 protected:
  void SetUp() override { SetGoodState(); }
};

TEST_F(QueryTest, Order) {
  const Ref<IQuery> q = Query(QueryType::Occlusion);
  context->End(q.get());
  Gives(MsgCode::QueryOrder);
  context->EndFrame();
  uint64_t value = 1;
  EXPECT_EQ(context->GetData(q.get(), &value, sizeof value, true), Status::InvalidArg);
  Gives(MsgCode::QueryOrder);
  context->EndFrame();
  context->Begin(q.get());
  context->Begin(q.get());
  Gives(MsgCode::QueryOrder);
  context->EndFrame();
  Gives(MsgCode::QueryOpen, Severity::Warning);
  context->Draw(3, 0);
  context->End(q.get());
  EXPECT_EQ(context->GetData(q.get(), &value, sizeof value, true), Status::Ok);
  EXPECT_EQ(value, 0u);
}

TEST_F(QueryTest, EventsAndTimestampsTakeOnlyEnd) {
  for (const QueryType type : {QueryType::Event, QueryType::Timestamp}) {
    const Ref<IQuery> q = Query(type);
    context->Begin(q.get());
    Gives(MsgCode::QueryOrder);
    context->End(q.get());
  }
}

TEST_F(QueryTest, SeveralOfAKindAtOnce) {
  const Ref<IQuery> a = Query(QueryType::Occlusion), b = Query(QueryType::OcclusionPredicate),
                    stats = Query(QueryType::PipelineStatistics), disjoint = Query(QueryType::TimestampDisjoint);
  context->Begin(disjoint.get());
  context->Begin(stats.get());
  context->Begin(a.get());
  context->Begin(b.get());
  context->Draw(3, 0);
  context->End(a.get());
  context->Draw(3, 0);
  context->End(b.get());
  context->End(stats.get());
  context->End(disjoint.get());
}

TEST_F(QueryTest, NothingDrawnInside) {
  const Ref<IQuery> q = Query(QueryType::Occlusion);
  context->Draw(3, 0);
  context->Begin(q.get());
  context->End(q.get());
  context->Draw(3, 0);
  Gives(MsgCode::QueryEmpty, Severity::Info);
  context->Begin(q.get());
  context->Draw(3, 0);
  context->End(q.get());
}

TEST_F(QueryTest, SizeOfTheResult) {
  const Ref<IQuery> q = Query(QueryType::Timestamp);
  context->End(q.get());
  uint32_t small = 0;
  EXPECT_EQ(context->GetData(q.get(), &small, sizeof small, true), Status::InvalidArg);
  Gives(MsgCode::OutOfBounds);
  uint64_t value = 0;
  EXPECT_EQ(context->GetData(q.get(), &value, sizeof value, true), Status::Ok);
}

TEST_F(QueryTest, NullQueries) {
  context->Begin(nullptr);
  Gives(MsgCode::InvalidDesc);
  context->End(nullptr);
  Gives(MsgCode::InvalidDesc);
  EXPECT_EQ(context->GetData(nullptr, nullptr, 0, true), Status::InvalidArg);
  Gives(MsgCode::QueryOrder);
}

TEST_F(QueryTest, OpenAtEndFrame) {
  const Ref<IQuery> q = Query(QueryType::Occlusion);
  context->Begin(q.get());
  context->EndFrame();
  Gives(MsgCode::QueryOpen, Severity::Warning);
  context->Draw(3, 0);
  context->End(q.get());
  context->EndFrame();
}

TEST_F(QueryTest, NeverEnded) {
  KeepingSink own;
  Ref<IDevice> second;
  ASSERT_EQ(CreateNullDevice({}, &second), Status::Ok);
  second = WrapWithValidation(second, &own);
  Ref<IQuery> q;
  ASSERT_EQ(second->CreateQuery({QueryType::Occlusion}, &q), Status::Ok);
  second->ImmediateContext()->Begin(q.get());
  q = nullptr;  // nobody can end it now
  second = nullptr;
  ASSERT_EQ(own.entries.size(), 1u) << own.Dump();
  EXPECT_EQ(own.entries[0].code, MsgCode::QueryOpen);
}

TEST_F(QueryTest, Events) {
  context->EndEvent();
  Gives(MsgCode::QueryOrder, Severity::Warning);
  context->BeginEvent(nullptr);
  Gives(MsgCode::InvalidDesc);
  context->BeginEvent("frame");
  context->EndFrame();
  Gives(MsgCode::EventOpen, Severity::Warning);
  context->EndEvent();
  context->BeginEvent("frame");
  context->BeginEvent("pass");
  context->EndEvent();
  context->EndEvent();
}

}  // namespace
}  // namespace validation_test
