// The parameters of a coat: names, ranges, JSON; and each of them acts.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "bake_helpers.h"
#include "fur/bake_files.h"

namespace fur::test {
namespace {

using Json = nlohmann::json;

std::string PathOf(const CoatKey& key) {
  return (*key.group != '\0' ? std::string(key.group) + "." : std::string()) + key.name;
}

Json ObjectOf(const CoatKey& key, Json value) {
  Json inner{{key.name, std::move(value)}};
  return *key.group != '\0' ? Json{{key.group, inner}} : inner;
}

TEST(CoatKeys, NamesAreUniqueAndDefaultsAreInRange) {
  std::set<std::string> names;
  for (const CoatKey& key : CoatKeys()) {
    EXPECT_TRUE(names.insert(PathOf(key)).second) << PathOf(key);
    CoatParams params;
    EXPECT_TRUE(SetCoatValue(key, CoatValue(params, key), &params)) << PathOf(key);
  }
  EXPECT_EQ(names.size(), 7u + 2 * 21);
}

TEST(CoatKeys, ValuesReachTheirMemberAndNoOther) {
  for (const CoatKey& key : CoatKeys()) {
    CoatParams params;
    ASSERT_TRUE(SetCoatValue(key, key.max, &params));
    for (const CoatKey& other : CoatKeys())
      EXPECT_EQ(CoatValue(params, other), &other == &key ? key.max : CoatValue(CoatParams{}, other))
          << PathOf(key) << ", " << PathOf(other);
  }
}

TEST(CoatJson, RangesAreRefusedByName) {
  for (const CoatKey& key : CoatKeys()) {
    for (const double bad : {key.min - 1, key.max + 1}) {
      CoatParams params;
      const Result<Done> result = ApplyCoatJson(ObjectOf(key, bad), "coat.json", &params);
      ASSERT_FALSE(result) << PathOf(key) << " = " << bad;
      EXPECT_EQ(result.error().code, ErrorCode::InputMalformed);
      EXPECT_NE(result.error().message.find("coat.json: \"" + PathOf(key) + "\" must be a "), std::string::npos)
          << result.error().message;
    }
    CoatParams params;
    EXPECT_TRUE(ApplyCoatJson(ObjectOf(key, key.min), "", &params));
    EXPECT_TRUE(ApplyCoatJson(ObjectOf(key, key.max), "", &params));
    EXPECT_FALSE(ApplyCoatJson(ObjectOf(key, "many"), "", &params));
    EXPECT_FALSE(ApplyCoatJson(ObjectOf(key, nullptr), "", &params));
    EXPECT_EQ(bool(ApplyCoatJson(ObjectOf(key, std::floor((key.min + key.max) / 2) + 0.25), "", &params)), !key.whole)
        << key.name;
  }
}

TEST(CoatJson, UnknownKeysAreRefusedByNameAndNothingIsApplied) {
  for (const auto& [text, name] : {std::pair{R"({"size": 64, "sizes": 3})", "\"sizes\""},
                                   {R"({"over": {"lenght": 1}})", "\"over.lenght\""},
                                   {R"({"length": 1})", "\"length\""},
                                   {R"({"middle": {}})", "\"middle\""},
                                   {R"({"under": 3})", "\"under\""},
                                   {R"([1])", "object"}}) {
    CoatParams params;
    const Result<Done> result = ApplyCoatJson(Json::parse(text), "coat.json", &params);
    ASSERT_FALSE(result) << text;
    EXPECT_NE(result.error().message.find(name), std::string::npos) << result.error().message;
    EXPECT_EQ(params.size, CoatParams{}.size);
  }
}

TEST(CoatJson, ReadsWhatItWrites) {
  CoatParams params, again;
  params.seed = 4294967295u, params.over.length = 1.0 / 3, params.under.biasX = -0.1;
  ASSERT_TRUE(ApplyCoatJson(Json::parse(CoatJson(params))["strands"], "", &again));
  for (const CoatKey& key : CoatKeys()) EXPECT_EQ(CoatValue(again, key), CoatValue(params, key)) << PathOf(key);
}

TEST(CheckCoat, RefusesWhatIsTooMuch) {
  EXPECT_TRUE(CheckCoat({}));
  CoatParams params;
  params.size = 2048, params.layers = 256;
  EXPECT_FALSE(CheckCoat(params));
  params = {};
  params.tile = 64, params.under.density = 0, params.over.density = 1000;
  const Result<Done> result = CheckCoat(params);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("over"), std::string::npos);
}

// Everything at once, so that no parameter is switched off by another.
CoatParams Lively() {
  CoatParams p = SmallCoat();
  p.layers = 4, p.size = 32;
  for (StrandClass* kind : {&p.under, &p.over}) {
    kind->curl = 0.05, kind->gravity = 0.5, kind->biasX = 0.2, kind->density = 20;
  }
  return p;
}

TEST(CoatParameters, EachChangesTheBytes) {
  const CoatParams base = Lively();
  const auto bake = [](const CoatParams& p) {
    const std::vector<Strand> strands = GrowStrandList(p);
    FurVolume v = BakeVolume(p, strands);
    const Image fin = BakeFinSlice(p, strands);
    v.pixels.insert(v.pixels.end(), fin.pixels.begin(), fin.pixels.end());
    return v;
  };
  const FurVolume before = bake(base);
  for (const CoatKey& key : CoatKeys()) {
    CoatParams params = base;
    const double value = CoatValue(params, key);
    ASSERT_TRUE(SetCoatValue(key, key.whole ? value + 1 : value * 0.8 + (value == 0 ? 0.1 : 0), &params))
        << PathOf(key);
    const FurVolume after = bake(params);
    const bool isTint = std::string(key.name).starts_with("tint") || std::string(key.name).starts_with("warmth");
    EXPECT_EQ(after.pixels == before.pixels, isTint) << PathOf(key);
    EXPECT_TRUE(after.tint != before.tint || key.name == std::string("fin_depth")) << PathOf(key);
  }
}

double TotalCoverage(const CoatParams& p) {
  const FurVolume v = BakeVolume(p, GrowStrandList(p));
  double sum = 0;
  for (uint32_t j = 0; j < v.layers; ++j) sum += MeanCoverage(v, j);
  return sum;
}

TEST(CoatParameters, CoverageRisesAndFallsWithThem) {
  const auto expectMonotone = [](const char* group, const char* name, std::vector<double> values, int sign) {
    double last = -1e300;
    for (const double value : values) {
      CoatParams params = SmallCoat();
      for (const CoatKey& key : CoatKeys()) {
        if (key.group != std::string(group) || key.name != std::string(name)) continue;
        ASSERT_TRUE(SetCoatValue(key, value, &params));
      }
      const double coverage = sign * TotalCoverage(params);
      EXPECT_GT(coverage, last) << group << '.' << name << " = " << value;
      last = coverage;
    }
  };
  for (const char* group : {"under", "over"}) {
    expectMonotone(group, "density", {10, 30, 90, 200}, 1);
    expectMonotone(group, "length", {0.3, 0.5, 0.7, 0.9}, 1);
    expectMonotone(group, "radius", {0.01, 0.02, 0.04, 0.08}, 1);
    expectMonotone(group, "taper", {0, 0.5, 1, 2}, -1);
    expectMonotone(group, "curl", {0, 0.05, 0.1, 0.2}, 1);
  }
}

}  // namespace
}  // namespace fur::test
