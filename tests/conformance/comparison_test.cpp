// The comparisons themselves, of each kind: what is planted must be caught.
#include "comparison.h"

#include <sstream>

#include "names.h"
#include "test_sink.h"

namespace conformance {
namespace {

using rhi_test::TestSink;

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
  const Outcome d = Measure(Gray(7, 5), b);
  EXPECT_EQ(d.differing, 1u);
  EXPECT_EQ(d.x, 2u);
  EXPECT_EQ(d.y, 3u);
  EXPECT_FALSE(Matches(b, [](uint32_t, uint32_t) { return Rgba8{128, 128, 128, 128}; }));
}

TEST(Comparison, OtherShapesAreCaught) {
  EXPECT_FALSE(SameImage(Gray(7, 5), Gray(5, 7)));
  EXPECT_FALSE(Matches(Gray(7, 5), [](uint32_t, uint32_t) { return Rgba32F{}; }));
}

constexpr Tolerance Of(Unit unit, double limit, uint64_t pixels = 0, double floor = 0) {
  return {"planted", "*", "*", unit, limit, pixels, floor, limit, "planted"};
}
const auto kGray = [](uint32_t, uint32_t) { return Rgba8{128, 128, 128, 128}; };

TEST(Comparison, OneLsbBeyondTheToleranceIsCaught) {
  const auto off = [](uint32_t, uint32_t) { return Rgba8{128, 127, 128, 129}; };
  EXPECT_TRUE(Matches(Gray(2, 2), off, Of(Unit::Lsb, 1))) << "the limit is inclusive";
  EXPECT_FALSE(Matches(Gray(2, 2), off));
  const auto farther = [](uint32_t x, uint32_t y) { return Rgba8{uint8_t(x + y == 2 ? 126 : 128), 128, 128, 128}; };
  EXPECT_FALSE(Matches(Gray(2, 2), farther, Of(Unit::Lsb, 1)));
}

TEST(Comparison, OnePixelMoreThanAllowedIsCaught) {
  Image few = Gray(7, 5);
  few.bytes[4] = few.bytes[40] = 255;
  EXPECT_TRUE(Matches(few, kGray, Of(Unit::Lsb, 3, 2)));
  EXPECT_TRUE(SameImage(few, Gray(7, 5), Of(Unit::Lsb, 3, 2)));
  few.bytes[80] = 132;  // 4 from 128: one more than the limit
  EXPECT_FALSE(Matches(few, kGray, Of(Unit::Lsb, 3, 2)));
  EXPECT_FALSE(SameImage(few, Gray(7, 5), Of(Unit::Lsb, 3, 2)));
}

Image Floats(float value) {
  Image image{2, 1, 16, std::vector<uint8_t>(32), Component::F32};
  for (size_t i = 0; i < 8; ++i) std::memcpy(&image.bytes[4 * i], &value, 4);
  return image;
}

TEST(Comparison, OneUlpBeyondTheToleranceIsCaught) {
  const float value = 0.3f, one = std::nextafter(value, 1.f), two = std::nextafter(one, 1.f);
  const auto oracle = [&](uint32_t, uint32_t) { return Rgba32F{value, value, value, value}; };
  EXPECT_TRUE(Matches(Floats(one), oracle, Of(Unit::Ulp, 1)));
  EXPECT_FALSE(Matches(Floats(two), oracle, Of(Unit::Ulp, 1)));
  EXPECT_FALSE(Matches(Floats(one), oracle));
  EXPECT_FALSE(SameImage(Floats(one), Floats(value)));
  EXPECT_TRUE(SameImage(Floats(one), Floats(value), Of(Unit::Ulp, 1)));
  EXPECT_FALSE(SameImage(Floats(two), Floats(value), Of(Unit::Ulp, 1)));
}

TEST(Comparison, UlpsAreOfTheLargerOfValueAndFloor) {
  EXPECT_EQ(UlpDistance(1 + 0x1p-23f, 1), 1);
  EXPECT_EQ(UlpDistance(0, 0x1p-23f), std::ldexp(1.0, 23));
  EXPECT_EQ(UlpDistance(0, 0x1p-23f, 1), 1) << "of 1: what a sum near 1 that cancels may be off by";
  EXPECT_EQ(UlpDistance(-0.f, 0.f), 0);
}

TEST(Comparison, WhatIsNotANumberIsCaught) {
  const auto zero = [](uint32_t, uint32_t) { return Rgba32F{}; };
  EXPECT_FALSE(Matches(Floats(NAN), zero, Of(Unit::Ulp, 1e9)));
  EXPECT_FALSE(Matches(Floats(INFINITY), zero, Of(Unit::Ulp, 1e9)));
  EXPECT_FALSE(Agrees(NAN, 0, Of(Unit::Value, 1e9)));
}

TEST(Comparison, NumbersAgreeWithinTheLimitOnly) {
  EXPECT_TRUE(Agrees(0.75, 0.5, Of(Unit::Value, 0.25)));
  EXPECT_FALSE(Agrees(std::nextafter(0.75, 1), 0.5, Of(Unit::Value, 0.25)));
  EXPECT_FALSE(Agrees(0.5 + 0x1p-50, 0.5, kExact));
}

// A half has 10 bits after the point.
TEST(Comparison, HalvesAreComparedInTheirOwnUnits) {
  Image a{1, 1, 8, std::vector<uint8_t>(8), Component::F16}, b = a;
  const uint16_t one = 0x3C00, next = 0x3C02;
  std::memcpy(&a.bytes[2], &one, 2);
  std::memcpy(&b.bytes[2], &next, 2);
  EXPECT_TRUE(SameImage(a, b, Of(Unit::Ulp, 2)));
  EXPECT_FALSE(SameImage(a, b, Of(Unit::Ulp, 1)));
}

rhi::Message Make(rhi::Severity severity, rhi::MsgCode code) { return {severity, code, "", "text", 0}; }

TEST(Messages, UnexpectedWarningIsAProblem) {
  TestSink sink;
  sink.OnMessage(Make(rhi::Severity::Info, rhi::MsgCode::ApiValidation));
  EXPECT_TRUE(sink.TakeProblems().empty());
  sink.OnMessage(Make(rhi::Severity::Warning, rhi::MsgCode::ApiValidation));
  EXPECT_EQ(sink.TakeProblems().size(), 1u);
  EXPECT_TRUE(sink.TakeProblems().empty());
}

TEST(Messages, ExpectedMessageMustComeAndOthersMayNot) {
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

TEST(Messages, AllowedMessageMayStayAway) {
  TestSink sink;
  sink.Allow(rhi::MsgCode::NothingBound, "planted");
  EXPECT_TRUE(sink.TakeProblems().empty());
}

}  // namespace
}  // namespace conformance
