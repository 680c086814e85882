// Reference pictures: threads, crops, samples, the cache.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fur/builtin.h"
#include "fur/reference.h"
#include "models.h"

namespace fur::test {
namespace {

const std::vector<glm::dmat4> kOne{glm::dmat4(1)};

ReferenceSettings Small() {
  ReferenceSettings s;
  s.width = 72;
  s.height = 40;
  s.samplesPerPixel = 2;
  s.background = {0.3, 0.2, 0.1};
  return s;
}

class ReferencePicture : public testing::Test {
 protected:
  ReferenceImage Render(const ReferenceSettings& s) {
    Result<ReferenceImage> image = RenderReference(model_, camera_, kOne, s);
    if (!image) ADD_FAILURE() << image.error().message;
    return image ? std::move(*image) : ReferenceImage{};
  }
  Model model_ = MakeBuiltinAnimal();
  Camera camera_ = FrameBounds(ComputeBounds(model_), kOne, 40, 1.8);
};

TEST_F(ReferencePicture, DoesNotDependOnThreads) {
  ReferenceSettings s = Small();
  s.threads = 1;
  const ReferenceImage one = Render(s);
  s.threads = 5;
  const ReferenceImage five = Render(s);
  EXPECT_EQ(one.color.pixels, five.color.pixels);
  EXPECT_EQ(one.furOpacity, five.furOpacity);
  EXPECT_EQ(one.skin, five.skin);
}

TEST_F(ReferencePicture, CropIsThePartOfTheWhole) {
  const ReferenceImage whole = Render(Small());
  ReferenceSettings s = Small();
  s.cropX = 30;
  s.cropY = 11;
  s.cropWidth = 20;
  s.cropHeight = 17;
  const ReferenceImage crop = Render(s);
  ASSERT_EQ(crop.color.pixels.size(), 20u * 17);
  for (uint32_t y = 0; y < 17; ++y)
    for (uint32_t x = 0; x < 20; ++x) EXPECT_EQ(crop.color.pixels[y * 20 + x], whole.color.pixels[(y + 11) * 72 + x + 30]);
  s.cropWidth = 43;
  EXPECT_FALSE(RenderReference(model_, camera_, kOne, s));
}

TEST_F(ReferencePicture, MaskAndSkinAreOfTheAnimal) {
  const ReferenceImage image = Render(Small());
  size_t fur = 0, skin = 0, band = 0;
  for (size_t i = 0; i < image.skin.size(); ++i) {
    fur += image.furOpacity[i] > 1 / 255.0f;
    skin += image.skin[i];
    band += image.furOpacity[i] > 1 / 255.0f && !image.skin[i];
    if (image.furOpacity[i] == 0 && !image.skin[i] && image.color.pixels[i].a == 0) {
      EXPECT_EQ(glm::vec3(image.color.pixels[i]), glm::vec3(0.3f, 0.2f, 0.1f));
    }
    EXPECT_GE(image.color.pixels[i].a + 1e-6f, image.furOpacity[i]);
  }
  EXPECT_GT(fur, 200u);
  EXPECT_GT(skin, 200u);
  EXPECT_GT(band, 20u);
}

TEST_F(ReferencePicture, SeedsAreIndependentAndProgressEnds) {
  ReferenceSettings s = Small();
  double last = 0;
  s.progress = [&](double done) { last = done; };
  const ReferenceImage a = Render(s);
  EXPECT_EQ(last, 1);
  s.seed = 1;
  const ReferenceImage b = Render(s);
  EXPECT_NE(a.color.pixels, b.color.pixels);
}

TEST_F(ReferencePicture, TheCacheGivesItBack) {
  const std::string folder = testing::TempDir() + "fur_reference_cache";
  std::filesystem::remove_all(folder);
  ReferenceSettings s = Small();
  s.cropWidth = 9;
  const std::string key = ReferenceKey(model_, camera_, kOne, s);
  EXPECT_EQ(key.size(), 32u);
  EXPECT_FALSE(LoadReference(folder, key));
  const ReferenceImage image = Render(s);
  ASSERT_TRUE(StoreReference(folder, key, image));
  const Result<ReferenceImage> kept = LoadReference(folder, key);
  ASSERT_TRUE(kept) << kept.error().message;
  EXPECT_EQ(kept->color.pixels, image.color.pixels);
  EXPECT_EQ(kept->furOpacity, image.furOpacity);
  EXPECT_EQ(kept->skin, image.skin);
  std::filesystem::resize_file(std::filesystem::path(folder) / (key + ".furref"), 100);
  EXPECT_FALSE(LoadReference(folder, key)) << "a damaged file";
  std::filesystem::remove_all(folder);
}

TEST_F(ReferencePicture, TheKeyIsOfWhatIsSeen) {
  const auto key = [&](const Model& m, const Camera& c, const ReferenceSettings& s) { return ReferenceKey(m, c, kOne, s); };
  const ReferenceSettings s = Small();
  const std::string first = key(model_, camera_, s);
  ReferenceSettings threads = s, seed = s, sheet = s;
  threads.threads = 3;
  seed.seed = 9;
  sheet.semantics = Semantics::Sheet;
  EXPECT_EQ(key(model_, camera_, threads), first) << "threads change nothing";
  EXPECT_NE(key(model_, camera_, seed), first);
  EXPECT_NE(key(model_, camera_, sheet), first);
  EXPECT_NE(key(model_, TurnCamera(camera_, 0.01), s), first);
  Model model = model_;
  model.volumes[0].pixels[7] ^= 1;
  EXPECT_NE(key(model, camera_, s), first);
  model = model_;
  model.primitives[0].vertices[3].position.x += 1e-6f;
  EXPECT_NE(key(model, camera_, s), first);
}

}  // namespace
}  // namespace fur::test
