#include "picture_file.h"

#include <algorithm>

#include "fur/exr_io.h"
#include "fur/image_io.h"

namespace app {

bool IsExrName(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c; });
  return extension == ".exr";
}

fur::Result<fur::Done> CheckPictureFile(const std::filesystem::path& file, const fur::RenderSettings& settings) {
  if (!IsExrName(file)) return fur::Done{};
  if (settings.technique == fur::Technique::Shells && settings.target != fur::TargetFormat::Unorm8) return fur::Done{};
  return fur::Error{fur::ErrorCode::Usage,
                    "an EXR holds the frame of floats with its opacity, which only --technique shells has; name a .png "
                    "instead of " +
                        file.string()};
}

fur::Image StoredPicture(fur::FloatImage frame, fur::Look look) {
  if (look == fur::Look::Correct) fur::EncodeSrgb(&frame);
  return {"frame", frame.width, frame.height, fur::ToBytes(frame)};
}

fur::Result<fur::Done> WriteFrame(const std::filesystem::path& file, fur::FloatImage frame, fur::Look look) {
  if (!IsExrName(file)) {
    const fur::Image stored = StoredPicture(std::move(frame), look);
    return fur::WritePng(file, stored.width, stored.height, stored.pixels);
  }
  if (look == fur::Look::Seed) fur::DecodeSrgb(&frame);
  return fur::WriteExr(file, frame);
}

fur::Result<fur::Done> WritePicture(const std::filesystem::path& file, const RenderOutcome& outcome,
                                    const fur::RenderSettings& settings) {
  if (IsExrName(file)) return WriteFrame(file, outcome.frame, settings.look);
  return fur::WritePng(file, outcome.image.width, outcome.image.height, outcome.image.pixels);
}

}  // namespace app
