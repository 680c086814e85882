#include "fur/image_io.h"

#include "fur/coat.h"
#include "gltf_builder.h"

namespace fur::test {
namespace {

Bytes ReadAll(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return Bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
}

size_t FilesIn(const Folder& folder) {
  size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.Path())) ++count;
  return count;
}

TEST(ImageIo, PngRoundTripKeepsEveryByteAndTheRowOrder) {
  const Folder folder;
  Bytes pixels(4 * 5 * 3);
  for (size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<uint8_t>(i * 37);
  ASSERT_TRUE(WritePng(folder / "a.png", 5, 3, pixels));
  ASSERT_TRUE(WritePng(folder / "a.png", 5, 3, pixels)) << "replaces the old file";
  const Result<Image> image = ReadImage(folder / "a.png");
  ASSERT_TRUE(image);
  EXPECT_EQ(image->name, "a.png");
  EXPECT_EQ(image->width, 5u);
  EXPECT_EQ(image->height, 3u);
  EXPECT_EQ(image->pixels, pixels);
  EXPECT_EQ(FilesIn(folder), 1u) << "no temporary file stays";
}

TEST(ImageIo, FailedWriteLeavesNothing) {
  const Folder folder;
  const Bytes pixels(16, 1);
  const Result<Done> nowhere = WritePng(folder / "no/such/folder/a.png", 2, 2, pixels);
  ASSERT_FALSE(nowhere);
  EXPECT_EQ(nowhere.error().code, ErrorCode::OutputFailed);
  std::filesystem::create_directories(folder / "taken.png/inside");
  const Result<Done> taken = WritePng(folder / "taken.png", 2, 2, pixels);
  ASSERT_FALSE(taken);
  EXPECT_EQ(taken.error().code, ErrorCode::OutputFailed);
  EXPECT_EQ(FilesIn(folder), 1u);
}

TEST(ImageIo, WriteRefusesSizesThatDoNotMatch) {
  const Folder folder;
  EXPECT_EQ(WritePng(folder / "a.png", 2, 2, Bytes(15)).error().code, ErrorCode::Usage);
  EXPECT_EQ(WritePng(folder / "a.png", 0, 2, Bytes()).error().code, ErrorCode::Usage);
  EXPECT_EQ(WritePng(folder / "a.png", 65536, 65536, Bytes()).error().code, ErrorCode::Usage);
  EXPECT_EQ(FilesIn(folder), 0u);
}

TEST(ImageIo, NamesMissingAndBrokenFiles) {
  const Folder folder;
  const Result<Image> missing = ReadImage(folder / "none.png");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, ErrorCode::InputMissing);
  EXPECT_NE(missing.error().message.find("none.png"), std::string::npos);
  const Result<Image> empty = ReadImage(folder.Write("empty.png", std::string()));
  ASSERT_FALSE(empty);
  EXPECT_EQ(empty.error().code, ErrorCode::InputMalformed);
  EXPECT_EQ(ReadImage(folder.Path()).error().code, ErrorCode::InputMissing);
}

// Each prefix is a fresh allocation, so that AddressSanitizer sees an over-read.
TEST(ImageIo, EveryTruncationOfAPngIsSafe) {
  const Folder folder;
  folder.WritePicture("a.png", 8, 8, 77);
  const Bytes png = ReadAll(folder / "a.png");
  for (size_t length = 0; length < png.size(); ++length) {
    const Bytes part(png.begin(), png.begin() + static_cast<ptrdiff_t>(length));
    const Result<Image> image = ReadImageFromMemory(part, "part", "part");
    if (image) {
      EXPECT_EQ(image->pixels.size(), 256u) << "only the trailer may be missing, at " << length;
      EXPECT_GE(length + 32, png.size());
    } else {
      EXPECT_EQ(image.error().code, ErrorCode::InputMalformed);
    }
  }
}

TEST(ImageIo, RefusesAbsurdSizesByTheHeader) {
  const Folder folder;
  folder.WritePicture("a.png", 8, 8, 77);
  Bytes png = ReadAll(folder / "a.png");
  png[16] = 0, png[17] = 1, png[18] = 0, png[19] = 0;  // IHDR width 65536; stb_image checks no CRC
  const Result<Image> image = ReadImageFromMemory(png, "big", "big.png");
  ASSERT_FALSE(image);
  EXPECT_NE(image.error().message.find("65536 x 8"), std::string::npos) << image.error().message;
}

TEST(FurLayers, StacksSlicesFromTheRoot) {
  const Folder folder;
  const std::vector<std::filesystem::path> files = {folder.WritePicture("a.png", 4, 2, 10),
                                                    folder.WritePicture("b.png", 4, 2, 20)};
  const Result<FurVolume> volume = LoadFurLayers(files);
  ASSERT_TRUE(volume);
  EXPECT_EQ(volume->layers, 2u);
  EXPECT_EQ(volume->width, 4u);
  EXPECT_EQ(volume->height, 2u);
  ASSERT_EQ(volume->pixels.size(), 64u);
  EXPECT_EQ(volume->pixels[0], 10);
  EXPECT_EQ(volume->pixels[32], 20);
}

TEST(FurLayers, RefusesDifferentSizesMissingFilesAndNone) {
  const Folder folder;
  std::vector<std::filesystem::path> files = {folder.WritePicture("a.png", 4, 2, 10),
                                              folder.WritePicture("b.png", 2, 4, 20)};
  const Result<FurVolume> odd = LoadFurLayers(files);
  ASSERT_FALSE(odd);
  EXPECT_NE(odd.error().message.find("b.png"), std::string::npos);
  files[1] = folder / "c.png";
  EXPECT_EQ(LoadFurLayers(files).error().code, ErrorCode::InputMissing);
  EXPECT_EQ(LoadFurLayers({}).error().code, ErrorCode::Usage);
}

}  // namespace
}  // namespace fur::test
