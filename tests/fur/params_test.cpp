#include "fur/params.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace fur {
namespace {

using Json = nlohmann::json;

TEST(Params, ReadsEveryKey) {
  FurParams params;
  const Json json = Json::parse(R"({"enabled": false, "length_scale": 0.03, "length_map": "l.png",
    "direction_map": "d.png", "layers": ["0.png", "1.png"], "layer_uv_scale": 50, "shells": 20, "self_shadow": 0.5,
    "specular_power": 12.5, "specular_scale": 0, "height_falloff": 0.1,
    "density": 2, "thickness": 3, "comb": [1, 2, 3], "comb_strength": 4, "bend": 5, "gravity": 0.6, "furless_map": "f.png",
    "root_color": [0, 1, 2], "tip_color": [2, 1, 0], "color_from_base": 0.7, "tint": 0.3, "clumping": 0.8, "wetness": 0.9,
    "wind": [-1, 0, 1], "wind_strength": 1.1, "wind_frequency": 1.2, "wind_length": 1.3, "inertia_stiffness": 14,
    "inertia_damping": 15, "front": [1, 0, -1]})");
  ASSERT_TRUE(ApplyFurJson(json, "test", false, &params));
  FurParams expected;
  expected.enabled = false;
  expected.length = 0.03;
  expected.lengthMap = "l.png";
  expected.directionMap = "d.png";
  expected.layers = {"0.png", "1.png"};
  expected.layerUvScale = 50;
  expected.shells = 20;
  expected.selfShadow = 0.5;
  expected.specularPower = 12.5;
  expected.specularScale = 0;
  expected.heightFalloff = 0.1;
  expected.density = 2;
  expected.thickness = 3;
  expected.comb = {1, 2, 3};
  expected.combStrength = 4;
  expected.bend = 5;
  expected.gravity = 0.6;
  expected.furlessMap = "f.png";
  expected.rootColor = {0, 1, 2};
  expected.tipColor = {2, 1, 0};
  expected.colorFromBase = 0.7;
  expected.tint = 0.3;
  expected.clumping = 0.8;
  expected.wetness = 0.9;
  expected.wind = {-1, 0, 1};
  expected.windStrength = 1.1;
  expected.windFrequency = 1.2;
  expected.windLength = 1.3;
  expected.inertiaStiffness = 14;
  expected.inertiaDamping = 15;
  expected.front = {1, 0, -1};
  EXPECT_EQ(params, expected);
}

TEST(Params, KeepsWhatIsNotNamed) {
  FurParams params;
  params.shells = 7;
  ASSERT_TRUE(ApplyFurJson(Json::parse(R"({"length_scale": 1})"), "test", false, &params));
  EXPECT_EQ(params.shells, 7u);
}

TEST(Params, ExtrasTolerateDescriptions) {
  const Json json = Json::parse(R"json({"length_units": "x", "layer_rgb": "x", "layer_alpha": "x", "note": "x",
    "source_shell_alpha": "alpha*(1-i/16)", "source_specular_power": 5, "source_specular_scale": 0.1,
    "specular_scale": 0.2})json");
  FurParams params;
  ASSERT_TRUE(ApplyFurJson(json, "test", true, &params));
  EXPECT_EQ(params.specularPower, 5);
  EXPECT_EQ(params.specularScale, 0.2) << "the plain name wins";
  EXPECT_FALSE(ApplyFurJson(json, "test", false, &params));
}

struct Refusal {
  const char* json;
  const char* keyword;
};

class ParamsRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(ParamsRefusal, NamesTheKeyAndChangesNothing) {
  FurParams params;
  for (const bool extras : {false, true}) {
    const Result<Done> result = ApplyFurJson(Json::parse(GetParam().json), "here", extras, &params);
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().code, ErrorCode::InputMalformed);
    EXPECT_EQ(result.error().message.rfind("here", 0), 0u) << result.error().message;
    EXPECT_NE(result.error().message.find(GetParam().keyword), std::string::npos) << result.error().message;
    EXPECT_EQ(params, FurParams{});
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ParamsRefusal,
    testing::Values(Refusal{R"({"enabled": false, "lenght_scale": 1})", "lenght_scale"},
                    Refusal{R"({"nonsense": 1})", "known are enabled, length_scale"}, Refusal{R"([])", "object"},
                    Refusal{R"(3)", "object"}, Refusal{R"({"enabled": 1})", "true or false"},
                    Refusal{R"({"length_scale": "long"})", "a number"}, Refusal{R"({"length_scale": -0.1})", "from 0"},
                    Refusal{R"({"length_scale": 1e300})", "length_scale"}, Refusal{R"({"length_scale": null})", "null"},
                    Refusal{R"({"length_map": 3})", "a file name"},
                    Refusal{R"({"length_map": "a\u0000b"})", "a file name"},
                    Refusal{R"({"direction_map": []})", "direction_map"},
                    Refusal{R"({"layers": "00.png"})", "an array"}, Refusal{R"({"layers": ["00.png", 1]})", "layers"},
                    Refusal{R"({"layers": [""]})", "layers"}, Refusal{R"({"layer_uv_scale": -1})", "layer_uv_scale"},
                    Refusal{R"({"shells": 1.5})", "a whole number"}, Refusal{R"({"shells": -1})", "shells"},
                    Refusal{R"({"shells": 99999999999999999999})", "shells"},
                    Refusal{R"({"self_shadow": 1.01})", "to 1"}, Refusal{R"({"specular_power": 0})", "above 0"},
                    Refusal{R"({"specular_scale": {}})", "specular_scale"}));

}  // namespace
}  // namespace fur
