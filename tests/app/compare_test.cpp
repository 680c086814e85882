// fur compare: what it prints, the heat map, the exit codes; the EXR of fur render.
#include "fur/exr_io.h"
#include "program.h"

namespace app::test {
namespace {

std::string FlatPng(const Folder& folder, const std::string& name, uint32_t width, uint32_t height, uint8_t grey) {
  std::vector<uint8_t> rgba(size_t{4} * width * height, grey);
  for (size_t i = 3; i < rgba.size(); i += 4) rgba[i] = 255;
  EXPECT_TRUE(fur::WritePng(folder / name, width, height, rgba));
  return folder / name;
}

std::string FlatExr(const Folder& folder, const std::string& name, glm::vec4 color) {
  EXPECT_TRUE(fur::WriteExr(folder / name, {20, 16, std::vector<glm::vec4>(320, color)}));
  return folder / name;
}

nlohmann::json Json(const Outcome& o) {
  nlohmann::json j = nlohmann::json::parse(o.out, nullptr, false);
  EXPECT_FALSE(j.is_discarded()) << o.out;
  return j.is_discarded() ? nlohmann::json::object() : j;
}

// Exit code 8 and one line that names each of the words; the report is printed all the same.
void ExpectExceeded(const Outcome& o, const std::vector<std::string>& words) {
  EXPECT_EQ(o.exitCode, kComparisonFailed) << o.err;
  EXPECT_EQ(o.err.rfind("fur: error: ", 0), 0u) << o.err;
  EXPECT_EQ(std::count(o.err.begin(), o.err.end(), '\n'), 1) << o.err;
  for (const std::string& word : words) EXPECT_NE(o.err.find(word), std::string::npos) << word << ": " << o.err;
  EXPECT_FALSE(o.out.empty());
}

TEST(CompareCommand, JsonHasItsShape) {
  const Folder folder;
  const std::string a = FlatPng(folder, "a.png", 20, 16, 100), b = FlatPng(folder, "b.png", 20, 16, 110);
  const Outcome o = RunFur({"compare", a, b, "--json"});
  ExpectSuccess(o);
  const nlohmann::json j = Json(o);
  for (const char* key : {"mean", "mask_mean", "weighted_median", "q1", "q3", "p99", "min", "max"})
    EXPECT_TRUE(j["flip"][key].is_number()) << key;
  for (const char* key : {"rmse", "psnr", "ssim", "max", "equal_share"}) EXPECT_TRUE(j[key].is_number()) << key;
  EXPECT_TRUE(j["mask"]["rmse"].is_number() && j["mask"]["relmse"].is_number());
  EXPECT_TRUE(j["band"].contains("opacity_rmse") && j["band"]["opacity_rmse"].is_null());
  EXPECT_EQ(j["mask_source"], "whole_picture");
  EXPECT_EQ(j["band_source"], "none");
  EXPECT_EQ(j["clamped_and_encoded"]["reference"], false);
  EXPECT_NEAR(j["max"].get<double>(), 10 / 255.0, 1e-6);
  EXPECT_EQ(j["equal_share"], 0.0);
  EXPECT_EQ(j["width"], 20);
}

TEST(CompareCommand, EqualPicturesPassEveryLimit) {
  const Folder folder;
  const std::string a = FlatPng(folder, "a.png", 20, 16, 100);
  const Outcome o = RunFur({"compare",
                            a,
                            a,
                            "--json",
                            "--max-flip",
                            "0",
                            "--max-mask-flip",
                            "0",
                            "--max-rmse",
                            "0",
                            "--max-mask-rmse",
                            "0",
                            "--max-difference",
                            "0",
                            "--min-ssim",
                            "0.999",
                            "--min-psnr",
                            "200",
                            "--max-differing-share",
                            "0"});
  ExpectSuccess(o);
  EXPECT_TRUE(Json(o)["psnr"].is_null()) << "infinite";
  const Outcome text = RunFur({"compare", a, a});
  ExpectSuccess(text);
  for (const char* word : {"FLIP", "SSIM", "PSNR", "RMSE", "a.png"}) EXPECT_NE(text.out.find(word), std::string::npos);
}

TEST(CompareCommand, EachLimitFailsByItsName) {
  const Folder folder;
  const std::string a = FlatPng(folder, "a.png", 20, 16, 100), b = FlatPng(folder, "b.png", 20, 16, 110);
  const std::vector<std::pair<std::string, std::string>> limits{
      {"--max-flip", "0.01"},        {"--max-mask-flip", "0.01"},  {"--max-rmse", "0.001"},
      {"--max-mask-rmse", "0.001"},  {"--min-ssim", "0.9999"},     {"--min-psnr", "60"},
      {"--max-difference", "9/255"}, {"--max-difference", "0.01"}, {"--max-differing-share", "0.5"},
      {"--max-band-rmse", "0.5"}};
  for (const auto& [flag, value] : limits) ExpectExceeded(RunFur({"compare", a, b, flag, value}), {flag});
  ExpectExceeded(RunFur({"compare", a, b, "--max-flip", "0.01", "--min-psnr", "60"}), {"--max-flip", "--min-psnr"});
  ExpectExceeded(RunFur({"compare", a, b, "--max-differing-share", "0.5"}), {"1", "0.5"});
  ExpectSuccess(RunFur({"compare", a, b, "--max-difference", "10/255", "--max-flip", "0.5", "--min-psnr", "20"}));
}

TEST(CompareCommand, WritesAHeatMapOfThePicturesSize) {
  const Folder folder;
  const std::string a = FlatPng(folder, "a.png", 20, 16, 0), b = FlatPng(folder, "b.png", 20, 16, 255);
  ExpectExceeded(RunFur({"compare", a, b, "--heat", folder / "h.png", "--max-flip", "0.1"}), {"--max-flip"});
  const fur::Image heat = Picture(folder / "h.png");
  EXPECT_EQ(heat.width, 20u);
  EXPECT_EQ(heat.height, 16u);
  EXPECT_GT(heat.pixels[0], 240) << "bright";
  ExpectSuccess(RunFur({"compare", a, b, "--heat", folder / "h.png", "--heat-scale", "0.001"}));
  EXPECT_LT(Picture(folder / "h.png").pixels[0], 5) << "dark";
}

TEST(CompareCommand, MaskAndBandFromFiles) {
  const Folder folder;
  const std::string a = FlatExr(folder, "a.exr", {0.5f, 0.5f, 0.5f, 0.5f}),
                    b = FlatExr(folder, "b.exr", {0.4f, 0.5f, 0.5f, 0.7f});
  const nlohmann::json own = Json(RunFur({"compare", a, b, "--json"}));
  EXPECT_EQ(own["mask_source"], "reference_alpha");
  EXPECT_NEAR(own["band"]["opacity_rmse"].get<double>(), 0.2, 1e-6);
  EXPECT_EQ(own["clamped_and_encoded"]["test"], true);
  const std::string none = FlatPng(folder, "none.png", 20, 16, 0), all = FlatPng(folder, "all.png", 20, 16, 255);
  const nlohmann::json given = Json(RunFur({"compare", a, b, "--json", "--mask", none, "--band", all}));
  EXPECT_EQ(given["mask_source"], "file");
  EXPECT_EQ(given["mask"]["pixels"], 0);
  EXPECT_TRUE(given["flip"]["mask_mean"].is_null());
  EXPECT_EQ(given["band"]["pixels"], 320);
  ExpectExceeded(RunFur({"compare", a, a, "--mask", none, "--max-mask-flip", "1"}), {"--max-mask-flip", "no value"});
}

TEST(CompareCommand, RefusesInWords) {
  const Folder folder;
  const std::string a = FlatPng(folder, "a.png", 20, 16, 100), b = FlatPng(folder, "b.png", 16, 20, 100);
  ExpectFailure(RunFur({"compare", a, b}), kUsage, {"16 x 20", "20 x 16"});
  ExpectFailure(RunFur({"compare", a, a, "--mask", b}), kUsage, {"mask"});
  ExpectFailure(RunFur({"compare", a}), kUsage, {"B"});
  ExpectFailure(RunFur({"compare", a, folder / "none.png"}), kInputMissing, {"none.png"});
  ExpectFailure(RunFur({"compare", folder.Write("x.exr", "v/1\1"), a}), kInputMalformed, {"x.exr"});
  ExpectFailure(RunFur({"compare", a, folder.Write("x.png", "no picture")}), kInputMalformed, {"x.png"});
  ExpectFailure(RunFur({"compare", a, a, "--heat", "/proc/no.png"}), kOutputFailed, {"/proc/no.png"});
  ExpectFailure(RunFur({"compare", a, a, "--heat", a}), kUsage, {"--heat"});
  for (const char* bad : {"x", "1/0", "-1", "nan", "1/2/3", "inf", ""})
    ExpectFailure(RunFur({"compare", a, a, "--max-difference=" + std::string(bad)}), kUsage, {"--max-difference"});
  for (const char* flag : {"--ppd", "--heat-scale", "--max-flip", "--min-ssim"})
    ExpectFailure(RunFur({"compare", a, a, flag, "nan"}), kUsage, {flag});
  ExpectFailure(RunFur({"compare", a, a, "--ppd", "0"}), kUsage, {"--ppd"});
}

TEST(RenderExr, IsTheFrameOfFloats) {
  const Folder folder;
  ExpectSuccess(RunFur({"render", "--size", "96x64", "--background", "0.25,0.5,0.75", "-o", folder / "a.exr"}));
  ExpectSuccess(RunFur({"render", "--size", "96x64", "--background", "0.25,0.5,0.75", "-o", folder / "a.png"}));
  const fur::Result<fur::ExrImage> exr = fur::ReadExr(folder / "a.exr");
  ASSERT_TRUE(exr) << exr.error().message;
  EXPECT_TRUE(exr->hasAlpha);
  EXPECT_EQ(exr->image.pixels[0], glm::vec4(0.25f, 0.5f, 0.75f, 0)) << "the background, with nothing over it";
  EXPECT_EQ(exr->image.pixels[32 * 96 + 48].a, 1) << "skin and fur";
  const nlohmann::json j = Json(RunFur({"compare", folder / "a.exr", folder / "a.png", "--json"}));
  EXPECT_LE(j["max"].get<double>(), 0.501 / 255) << "the PNG is the frame, rounded";
  EXPECT_EQ(j["mask_source"], "reference_alpha");
  EXPECT_GT(j["band"]["pixels"], 0);
}

TEST(RenderExr, LookSeedIsDecoded) {
  const Folder folder;
  ExpectSuccess(RunFur({"render", "--size", "64x48", "--look", "seed", "-o", folder / "a.EXR"}));
  ExpectSuccess(RunFur({"render", "--size", "64x48", "--look", "seed", "-o", folder / "a.png"}));
  EXPECT_LE(Json(RunFur({"compare", folder / "a.EXR", folder / "a.png", "--json"}))["max"].get<double>(), 0.501 / 255);
}

TEST(RenderExr, NeedsTechniqueShells) {
  const Folder folder;
  ExpectRenderFailure({"--technique", "seed", "-o", folder / "a.exr"}, kUsage, {"shells", "a.exr"});
  ExpectRenderFailure({"--preset", "gs-shells", "-o", folder / "a.exr"}, kUsage, {"shells"});
  EXPECT_TRUE(folder.Content().empty());
}

}  // namespace
}  // namespace app::test
