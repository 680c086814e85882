#include "fur/exr_io.h"

#include <limits>

#include "gltf_builder.h"
#include "random.h"

namespace fur::test {
namespace {

Bytes ReadAll(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return Bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
}

FloatImage Ramp(uint32_t width, uint32_t height) {
  FloatImage image{width, height, {}};
  for (uint32_t i = 0; i < width * height; ++i)
    image.pixels.push_back({float(i) * 0.37f, -float(i % 7), 1.0f / float(i + 1), float(i % 256) / 255});
  return image;
}

Bytes ExrBytes(const FloatImage& image) {
  const Folder folder;
  EXPECT_TRUE(WriteExr(folder / "a.exr", image));
  return ReadAll(folder / "a.exr");
}

bool SameBits(const FloatImage& a, const FloatImage& b) {
  return a.width == b.width && a.height == b.height && a.pixels.size() == b.pixels.size() &&
         std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(glm::vec4)) == 0;
}

TEST(ExrIo, RoundTripKeepsEveryBit) {
  for (const auto& [w, h] : {std::pair{1u, 1u}, {5u, 3u}, {33u, 16u}, {20u, 40u}}) {
    FloatImage image = Ramp(w, h);
    image.pixels[0] = {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), -0.0f, 1e-41f};
    const Result<ExrImage> read = ReadExrFromMemory(ExrBytes(image), "x");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_TRUE(SameBits(read->image, image)) << w << " x " << h;
    EXPECT_TRUE(read->hasAlpha);
  }
}

TEST(ExrIo, WriteRefusesWhatCannotBe) {
  const Folder folder;
  EXPECT_EQ(WriteExr(folder / "a.exr", {2, 2, std::vector<glm::vec4>(3)}).error().code, ErrorCode::Usage);
  EXPECT_EQ(WriteExr(folder / "a.exr", {}).error().code, ErrorCode::Usage);
  EXPECT_EQ(WriteExr(folder / "no/such/a.exr", Ramp(2, 2)).error().code, ErrorCode::OutputFailed);
  EXPECT_TRUE(std::filesystem::is_empty(folder.Path()));
}

TEST(ExrIo, NamesMissingAndWrongFiles) {
  const Folder folder;
  EXPECT_EQ(ReadExr(folder / "none.exr").error().code, ErrorCode::InputMissing);
  const Result<ExrImage> png = ReadExr(folder.WritePicture("a.exr", 2, 2, 5));
  ASSERT_FALSE(png);
  EXPECT_EQ(png.error().code, ErrorCode::InputMalformed);
  EXPECT_NE(png.error().message.find("a.exr"), std::string::npos);
}

// Each prefix is a fresh allocation, so that AddressSanitizer sees an over-read.
TEST(ExrIo, EveryTruncationIsRefused) {
  const Bytes whole = ExrBytes(Ramp(9, 20));
  for (size_t length = 0; length < whole.size(); ++length) {
    const Bytes part(whole.begin(), whole.begin() + std::ptrdiff_t(length));
    const Result<ExrImage> read = ReadExrFromMemory(part, "part");
    ASSERT_FALSE(read) << length << " of " << whole.size() << " bytes";
    EXPECT_EQ(read.error().code, ErrorCode::InputMalformed);
    EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
  }
}

TEST(ExrIo, DamagedFilesAreReadOrRefused) {
  const Bytes whole = ExrBytes(Ramp(9, 20));
  Pcg32 random(7);
  size_t refused = 0;
  for (int i = 0; i < 4000; ++i) {
    Bytes damaged = whole;
    for (uint32_t k = 1 + random.Next() % 3; k > 0; --k)
      damaged[random.Next() % damaged.size()] = uint8_t(random.Next());
    const Result<ExrImage> read = ReadExrFromMemory(damaged, "damaged");
    if (read) {
      EXPECT_EQ(read->image.pixels.size(), size_t(read->image.width) * read->image.height);
    }
    refused += !read;
  }
  EXPECT_GT(refused, 500u);
}

// The four bytes after the attribute's name, type and size.
void SetWindow(Bytes* exr, int32_t maxX, int32_t maxY) {
  const std::string name("dataWindow\0box2i\0", 17);
  const auto at = std::search(exr->begin(), exr->end(), name.begin(), name.end());
  ASSERT_NE(at, exr->end());
  std::memcpy(&*at + 17 + 4 + 8, &maxX, 4);
  std::memcpy(&*at + 17 + 4 + 12, &maxY, 4);
}

TEST(ExrIo, AbsurdSizesCostNoMemory) {
  for (const auto& [x, y] : {std::pair{2147483647, 2147483647}, {100000, 2}, {-5, 2}, {16383, 16383}, {8, 4000}}) {
    Bytes exr = ExrBytes(Ramp(9, 20));
    SetWindow(&exr, x, y);
    const Result<ExrImage> read = ReadExrFromMemory(exr, "absurd");
    ASSERT_FALSE(read) << x << " " << y;
    EXPECT_EQ(read.error().code, ErrorCode::InputMalformed);
  }
}

// Two entries of the table of blocks point to one block: the lines of the other would be undefined.
TEST(ExrIo, MissingBlocksAreRefused) {
  Bytes exr = ExrBytes(Ramp(9, 20));
  const std::string last("screenWindowWidth\0float\0", 24);
  const auto at = std::search(exr.begin(), exr.end(), last.begin(), last.end());
  ASSERT_NE(at, exr.end());
  uint8_t* table = &*at + 24 + 4 + 4 + 1;
  std::memcpy(table + 8, table, 8);
  EXPECT_FALSE(ReadExrFromMemory(exr, "x"));
}

}  // namespace
}  // namespace fur::test
