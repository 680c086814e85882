#include "fur/image_io.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>

#include "file_bytes.h"
#include "fur/file.h"

namespace fur {
namespace {

constexpr uint64_t kMaxImageFile = uint64_t{1} << 30;

Error Malformed(const std::string& where, const std::string& what) {
  return {ErrorCode::InputMalformed, where + ": " + what};
}

bool SizeIsSane(int width, int height) {
  if (width < 1 || height < 1) return false;
  const uint64_t w = static_cast<uint64_t>(width), h = static_cast<uint64_t>(height);
  return w <= kMaxImageSide && h <= kMaxImageSide && w * h <= kMaxImagePixels;
}

void AppendBytes(void* context, void* data, int size) {
  auto* out = static_cast<std::vector<uint8_t>*>(context);
  const auto* bytes = static_cast<const uint8_t*>(data);
  out->insert(out->end(), bytes, bytes + size);
}

}  // namespace

Result<std::vector<uint8_t>> ReadFileBytes(const std::filesystem::path& file, uint64_t limit) {
  std::error_code failed;
  if (!std::filesystem::exists(file, failed)) return Error{ErrorCode::InputMissing, file.string() + ": no such file"};
  // Reading a device or a pipe could block or never end.
  if (!std::filesystem::is_regular_file(file, failed))
    return Error{ErrorCode::InputMissing, file.string() + ": not a regular file"};
  const uint64_t size = std::filesystem::file_size(file, failed);
  if (failed) return Error{ErrorCode::InputMissing, file.string() + ": cannot be read: " + failed.message()};
  if (size > limit)
    return Malformed(file.string(), "is larger than the " + std::to_string(limit) + " bytes this program accepts");
  std::vector<uint8_t> bytes(size);
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!in) return Error{ErrorCode::InputMissing, file.string() + ": cannot be read"};
  return bytes;
}

Result<Image> ReadImageFromMemory(std::span<const uint8_t> bytes, const std::string& name, const std::string& where) {
  if (bytes.empty()) return Malformed(where, "is empty, expected an image");
  if (bytes.size() > kMaxImageFile) return Malformed(where, "is too large for an image");
  const int length = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  // The header first, so that an absurd size costs no memory.
  if (!stbi_info_from_memory(bytes.data(), length, &width, &height, &channels))
    return Malformed(where, "is not a readable PNG or JPEG image");
  if (!SizeIsSane(width, height))
    return Malformed(where, "has an image size of " + std::to_string(width) + " x " + std::to_string(height) +
                                "; at most " + std::to_string(kMaxImageSide) + " a side and " +
                                std::to_string(kMaxImagePixels) + " pixels are read");
  const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(bytes.data(), length, &width, &height, &channels, 4), &stbi_image_free);
  if (!pixels) return Malformed(where, std::string("is a broken image (") + stbi_failure_reason() + ")");
  Image image{name, static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
  image.pixels.assign(pixels.get(), pixels.get() + size_t{4} * image.width * image.height);
  return image;
}

Result<Image> ReadImage(const std::filesystem::path& file) {
  Result<std::vector<uint8_t>> bytes = ReadFileBytes(file, kMaxImageFile);
  if (!bytes) return bytes.error();
  return ReadImageFromMemory(*bytes, file.filename().string(), file.string());
}

Result<std::vector<uint8_t>> EncodePng(uint32_t width, uint32_t height, std::span<const uint8_t> rgba) {
  if (width == 0 || height == 0 || width > kMaxImageSide || height > kMaxImageSide)
    return Error{ErrorCode::Usage, "cannot write an image of " + std::to_string(width) + " x " + std::to_string(height) +
                                       " pixels; 1 to " + std::to_string(kMaxImageSide) + " a side"};
  if (rgba.size() != size_t{4} * width * height)
    return Error{ErrorCode::Usage, "has " + std::to_string(rgba.size()) + " bytes for " + std::to_string(width) + " x " +
                                       std::to_string(height) + " RGBA pixels"};
  std::vector<uint8_t> png;
  const int stride = static_cast<int>(width * 4);
  if (!stbi_write_png_to_func(AppendBytes, &png, static_cast<int>(width), static_cast<int>(height), 4, rgba.data(),
                              stride))
    return Error{ErrorCode::OutputFailed, "the PNG could not be encoded (out of memory)"};
  return png;
}

Result<Done> WritePng(const std::filesystem::path& file, uint32_t width, uint32_t height,
                      std::span<const uint8_t> rgba) {
  const Result<std::vector<uint8_t>> png = EncodePng(width, height, rgba);
  if (!png) return Error{png.error().code, file.string() + ": " + png.error().message};
  return WriteFile(file, *png);
}

}  // namespace fur
