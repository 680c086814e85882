#include <system_error>
#include <vector>

#include "fur/coat.h"
#include "fur/image_io.h"

namespace fur {
namespace {

constexpr size_t kMaxLayers = 256;
constexpr uint64_t kMaxVolumeTexels = uint64_t{1} << 28;  // 1 GiB

std::string SizeText(uint32_t width, uint32_t height) { return std::to_string(width) + " x " + std::to_string(height); }

Result<FurVolume> LoadStack(std::span<const std::filesystem::path> files) {
  if (files.empty() || files.size() > kMaxLayers)
    return Error{ErrorCode::Usage, "a fur volume has 1 to " + std::to_string(kMaxLayers) + " layers, not " +
                                       std::to_string(files.size())};
  FurVolume volume;
  volume.name = files[0].parent_path().filename().string();
  volume.layers = static_cast<uint32_t>(files.size());
  for (const std::filesystem::path& file : files) {
    Result<Image> image = ReadImage(file);
    if (!image) return image.error();
    if (volume.pixels.empty()) {
      volume.width = image->width;
      volume.height = image->height;
      if (uint64_t{volume.width} * volume.height * volume.layers > kMaxVolumeTexels)
        return Error{ErrorCode::InputMalformed, file.string() + ": is too large for a fur layer"};
      volume.pixels.reserve(size_t{4} * volume.width * volume.height * volume.layers);
    }
    if (image->width != volume.width || image->height != volume.height)
      return Error{ErrorCode::InputMalformed, file.string() + ": is " + SizeText(image->width, image->height) +
                                                  " pixels, but the first fur layer is " +
                                                  SizeText(volume.width, volume.height) + "; all must be the same"};
    // The image reader gives alpha 255 where a file has none, which is coverage 1.
    volume.pixels.insert(volume.pixels.end(), image->pixels.begin(), image->pixels.end());
  }
  return volume;
}

std::vector<std::filesystem::path> TintFiles(std::span<const std::filesystem::path> files) {
  std::vector<std::filesystem::path> tint;
  std::error_code ignored;
  for (const std::filesystem::path& file : files) {
    tint.push_back(file.parent_path() / "tint" / file.filename());
    if (!std::filesystem::exists(tint.back(), ignored)) return {};
  }
  return tint;
}

}  // namespace

Result<FurVolume> LoadFurLayers(std::span<const std::filesystem::path> files) {
  Result<FurVolume> volume = LoadStack(files);
  if (!volume) return volume;
  const std::vector<std::filesystem::path> tintFiles = TintFiles(files);
  if (tintFiles.empty()) return volume;
  Result<FurVolume> tint = LoadStack(tintFiles);
  if (!tint) return tint;
  if (tint->width != volume->width || tint->height != volume->height)
    return Error{ErrorCode::InputMalformed, tintFiles[0].string() + ": is " + SizeText(tint->width, tint->height) +
                                                " pixels, but the fur layers are " +
                                                SizeText(volume->width, volume->height)};
  volume->tint = std::move(tint->pixels);
  return volume;
}

}  // namespace fur
