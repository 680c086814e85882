// OpenEXR files: pictures of floats in linear light.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "fur/float_image.h"
#include "fur/result.h"

namespace fur {

struct ExrImage {
  FloatImage image;       // linear; alpha 1 where the file has none
  bool hasAlpha = false;  // the file has a channel A
};

// Reads a single-part scan line file with channels R, G, B or Y, and A perhaps, of half or float; other channels are
// left out. Uncompressed, RLE, ZIPS, ZIP or PIZ. At most kMaxImageSide a side and kMaxImagePixels pixels (image_io.h).
// The data window is the picture. Errors: InputMissing, InputMalformed; both name the file.
Result<ExrImage> ReadExr(const std::filesystem::path& file);

// The same from the bytes of a file; `where` starts the message of an error.
Result<ExrImage> ReadExrFromMemory(std::span<const uint8_t> bytes, const std::string& where);

// Whether the bytes start as an EXR file does.
bool IsExr(std::span<const uint8_t> bytes);

// Writes R, G, B, A as floats, ZIP-compressed, bit for bit. The file appears whole or not at all. Errors: Usage
// (sizes), OutputFailed.
Result<Done> WriteExr(const std::filesystem::path& file, const FloatImage& image);

}  // namespace fur
