// Pictures from and to files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "fur/model.h"
#include "fur/result.h"

namespace fur {

// Larger pictures are refused: a small file can claim any size.
inline constexpr uint32_t kMaxImageSide = 16384;
inline constexpr uint64_t kMaxImagePixels = uint64_t{1} << 26;  // 8192 x 8192, 256 MiB decoded

// Reads PNG or JPEG (whatever else stb_image knows is read too) as RGBA8; missing alpha reads as 255, grey is repeated,
// 16 bit becomes 8. Image::name is the file's name without its folder. Errors: InputMissing, InputMalformed; both name
// the file.
Result<Image> ReadImage(const std::filesystem::path& file);

// The same from the bytes of a file. `name` becomes Image::name, `where` starts the message of an error.
Result<Image> ReadImageFromMemory(std::span<const uint8_t> bytes, const std::string& name, const std::string& where);

// A PNG of RGBA8, row 0 on top; rgba.size() must be width * height * 4. Errors: Usage (sizes), OutputFailed.
Result<std::vector<uint8_t>> EncodePng(uint32_t width, uint32_t height, std::span<const uint8_t> rgba);

// Writes RGBA8, row 0 on top; rgba.size() must be width * height * 4. The file appears whole or not at all: it is
// written beside the target under another name and renamed. Errors: Usage (sizes), OutputFailed.
Result<Done> WritePng(const std::filesystem::path& file, uint32_t width, uint32_t height,
                      std::span<const uint8_t> rgba);

}  // namespace fur
