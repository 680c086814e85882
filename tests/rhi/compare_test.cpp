// The comparisons themselves: each must be able to fail.
#include "image.h"
#include "test_sink.h"

namespace rhi_test {
namespace {

Image Gray(uint32_t width, uint32_t height) {
  return {width, height, 4, std::vector<uint8_t>(size_t(width) * height * 4, 128)};
}

TEST(Comparison, EqualPicturesAreEqual) {
  EXPECT_TRUE(SameImage(Gray(7, 5), Gray(7, 5)));
  EXPECT_TRUE(Matches(Gray(7, 5), [](uint32_t, uint32_t) { return Rgba8{128, 128, 128, 128}; }));
}

TEST(Comparison, OneByteOfOnePixelIsCaught) {
  Image b = Gray(7, 5);
  b.bytes[(3 * 7 + 2) * 4 + 1] = 129;
  EXPECT_FALSE(SameImage(Gray(7, 5), b));
  const Difference d = Compare(Gray(7, 5), b);
  EXPECT_EQ(d.pixels, 1u);
  EXPECT_EQ(d.x, 2u);
  EXPECT_EQ(d.y, 3u);
  EXPECT_FALSE(Matches(b, [](uint32_t, uint32_t) { return Rgba8{128, 128, 128, 128}; }));
}

TEST(Comparison, OtherShapesAreCaught) {
  EXPECT_FALSE(SameImage(Gray(7, 5), Gray(5, 7)));
  EXPECT_FALSE(Matches(Gray(7, 5), [](uint32_t, uint32_t) { return Rgba32F{}; }));
}

TEST(Comparison, ToleranceIsInclusiveAndNaNIsCaught) {
  const auto off = [](uint32_t, uint32_t) { return Rgba8{128, 127, 128, 129}; };
  EXPECT_TRUE(Matches(Gray(2, 2), off, 1));
  EXPECT_FALSE(Matches(Gray(2, 2), off, 0.5));
  EXPECT_FALSE(Near(Rgba32F{0, 0, 0, NAN}, Rgba32F{0, 0, 0, 0}, 1e9));
}

rhi::Message Make(rhi::Severity severity, rhi::MsgCode code) { return {severity, code, "", "text", 0}; }

TEST(Sink, UnexpectedWarningIsAProblem) {
  TestSink sink;
  sink.OnMessage(Make(rhi::Severity::Info, rhi::MsgCode::ApiValidation));
  EXPECT_TRUE(sink.TakeProblems().empty());
  sink.OnMessage(Make(rhi::Severity::Warning, rhi::MsgCode::ApiValidation));
  EXPECT_EQ(sink.TakeProblems().size(), 1u);
  EXPECT_TRUE(sink.TakeProblems().empty());
}

TEST(Sink, ExpectedMessageMustComeAndOthersMayNot) {
  TestSink sink;
  sink.Expect(rhi::MsgCode::InvalidDesc, "planted");
  EXPECT_EQ(sink.TakeProblems().size(), 1u);
  sink.Expect(rhi::MsgCode::InvalidDesc, "planted");
  sink.OnMessage(Make(rhi::Severity::Error, rhi::MsgCode::InvalidDesc));
  EXPECT_TRUE(sink.TakeProblems().empty());
  sink.Expect(rhi::MsgCode::InvalidDesc, "planted");
  sink.OnMessage(Make(rhi::Severity::Error, rhi::MsgCode::OutOfBounds));
  EXPECT_EQ(sink.TakeProblems().size(), 2u);
}

TEST(Sink, AllowedMessageMayStayAway) {
  TestSink sink;
  sink.Allow(rhi::MsgCode::NothingBound, "planted");
  EXPECT_TRUE(sink.TakeProblems().empty());
}

}  // namespace
}  // namespace rhi_test
