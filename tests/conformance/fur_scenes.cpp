#include "fur_scenes.h"

#include <cctype>
#include <filesystem>
#include <map>

#include "../fur_render/frames.h"
#include "fur/builtin.h"
#include "fur/gltf.h"

namespace conformance {

using fur::test::Colors;
using rhi_test::Gpu;

constexpr size_t kFewColors = 100;

const fur::Model& Animal() {
  static const fur::Model animal = fur::MakeBuiltinAnimal();
  return animal;
}

FurShot CloseShot(const fur::Model& model, const fur::RenderSettings& settings) {
  const fur::Bounds bounds = fur::ComputeBounds(model);
  FurShot shot{.settings = settings, .placements = fur::PlaceAnimals(1, fur::SceneScale(bounds))};
  shot.camera = fur::FrameBounds(bounds, shot.placements, 40, double(settings.width) / settings.height);
  return shot;
}

const fur::Model* AssetModel(const std::string& file) {
  static std::map<std::string, fur::Model> models;
  if (const auto known = models.find(file); known != models.end()) return &known->second;
  const std::filesystem::path path = std::filesystem::path(AssetsFolder()) / file;
  if (!std::filesystem::exists(path)) return nullptr;
  fur::Result<fur::Model> model = fur::LoadGltf(path);
  if (!model) throw std::runtime_error(model.error().message);
  return &models.emplace(file, std::move(*model)).first->second;
}

std::string CaseWord(std::string text) {
  for (char& c : text)
    if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
  return text;
}

Image PictureOf(const fur::Image& image) { return FromRgba8(image.width, image.height, image.pixels); }

Image PictureOf(const fur::FloatImage& image) {
  Image picture{image.width, image.height, 16, std::vector<uint8_t>(image.pixels.size() * 16), Component::F32};
  if (!image.pixels.empty()) std::memcpy(picture.bytes.data(), image.pixels.data(), picture.bytes.size());
  return picture;
}

fur::Image Draw(Gpu& gpu, const fur::Model& model, const FurShot& shot) {
  const fur::Image image =
      fur::test::Draw(*gpu.device, model, shot.settings, shot.camera, shot.placements, shot.Motion());
  TheRecorder().ReadBack(PictureOf(image));
  return image;
}

fur::FloatImage DrawFloats(Gpu& gpu, const fur::Model& model, const FurShot& shot) {
  fur::FloatImage image = fur::test::Pixels(*gpu.device, model, shot.settings, shot.camera, shot.placements);
  TheRecorder().ReadBack(PictureOf(image));
  return image;
}

bool NeedsGeometryShader(const fur::RenderSettings& s) {
  const bool published = s.technique == fur::Technique::Seed;
  if (published) return s.drawFins || s.preset == fur::Preset::GsShells || s.preset == fur::Preset::FourCoats;
  return (s.drawFins && s.finMode == fur::FinMode::Geometry) ||
         (s.drawShells && s.shellMode == fur::ShellMode::Amplified);
}

namespace {

bool HaveToBeEqual() {
  const Recorder& recorder = TheRecorder();
  return ParityLimitOf(recorder.Running().Base(), recorder.Driver()).differing == 0;
}

bool CanDraw(const fur::RenderSettings& settings, const Gpu& vulkan, const Gpu& gl) {
  const auto able = [](const Gpu& gpu) { return gpu.device->GetCaps().geometryShader; };
  return !NeedsGeometryShader(settings) || (able(vulkan) && able(gl));
}

void ExpectSamePicture(const fur::Image& ofGl, const fur::Image& ofVulkan) {
  EXPECT_GT(Colors(ofVulkan), kFewColors) << "there is hardly anything to compare";
  EXPECT_TRUE(SameImage(PictureOf(ofGl), PictureOf(ofVulkan)));
}

}  // namespace

void ExpectAlike(Gpu& vulkan, Gpu& gl, const fur::Model& model, const FurShot& shot, fur::Image* picture) {
  if (!CanDraw(shot.settings, vulkan, gl)) GTEST_SKIP() << "this adapter lacks Caps::geometryShader";
  const fur::Image ofVulkan = Draw(vulkan, model, shot);
  ExpectSamePicture(Draw(gl, model, shot), ofVulkan);
  if (picture) *picture = ofVulkan;
}

void ExpectAlikeAndCounted(Gpu& vulkan, Gpu& gl, const fur::Model& model, const FurShot& shot) {
  if (!CanDraw(shot.settings, vulkan, gl)) GTEST_SKIP() << "this adapter lacks Caps::geometryShader";
  const auto render = [&](Gpu& gpu) {
    return fur::test::Render(*gpu.device, model, shot.settings, shot.camera, shot.placements);
  };
  const fur::test::Frame ofVulkan = render(vulkan), ofGl = render(gl);
  ExpectSamePicture(ofGl.image, ofVulkan.image);
  const fur::FrameCounts &a = ofVulkan.counts, &b = ofGl.counts;
  EXPECT_GT(a.finFragments, 100u);
  EXPECT_GT(a.shellFragments, 1000u);
  if (!HaveToBeEqual()) return;
  EXPECT_EQ(a.baseFragments, b.baseFragments);
  EXPECT_EQ(a.finFragments, b.finFragments);
  EXPECT_EQ(a.shellFragments, b.shellFragments);
}

}  // namespace conformance
