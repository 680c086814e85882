#include "fur/exr_io.h"

#include <tinyexr.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "file_bytes.h"
#include "fur/file.h"
#include "fur/image_io.h"

namespace fur {
namespace {

constexpr uint64_t kMaxExrFile = uint64_t{1} << 30;
constexpr int kMaxChannels = 64;
constexpr size_t kMagicAndVersion = 8;  // bytes before the header

Error Malformed(const std::string& where, const std::string& what) {
  return {ErrorCode::InputMalformed, where + ": " + what};
}

// The library's message, freed, without its line breaks.
std::string TakeMessage(const char* message) {
  if (!message) return "no reason given";
  std::string text = message;
  FreeEXRErrorMessage(message);
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && (text.back() == ' ' || text.back() == '.')) text.pop_back();
  return text;
}

struct HeaderOwner {
  EXRHeader value;
  HeaderOwner() { InitEXRHeader(&value); }
  ~HeaderOwner() { FreeEXRHeader(&value); }
  HeaderOwner(const HeaderOwner&) = delete;
  HeaderOwner& operator=(const HeaderOwner&) = delete;
};

// Lines that a block of compressed pixels holds; 0: a compression that is not read.
int64_t LinesInABlock(int compression) {
  switch (compression) {
    case TINYEXR_COMPRESSIONTYPE_NONE:
    case TINYEXR_COMPRESSIONTYPE_RLE:
    case TINYEXR_COMPRESSIONTYPE_ZIPS: return 1;
    case TINYEXR_COMPRESSIONTYPE_ZIP: return 16;
    case TINYEXR_COMPRESSIONTYPE_PIZ: return 32;
    default: return 0;
  }
}

int64_t Width(const EXRHeader& h) { return int64_t{h.data_window.max_x} - h.data_window.min_x + 1; }
int64_t Height(const EXRHeader& h) { return int64_t{h.data_window.max_y} - h.data_window.min_y + 1; }

Result<Done> CheckHeader(const EXRHeader& h, const std::string& where) {
  const int64_t w = Width(h), height = Height(h);
  if (w < 1 || height < 1 || w > kMaxImageSide || height > kMaxImageSide || uint64_t(w * height) > kMaxImagePixels)
    return Malformed(where, "has an image size of " + std::to_string(w) + " x " + std::to_string(height) +
                                "; at most " + std::to_string(kMaxImageSide) + " a side and " +
                                std::to_string(kMaxImagePixels) + " pixels are read");
  if (LinesInABlock(h.compression_type) == 0)
    return Malformed(where, "is compressed in a way that is not read; use ZIP, ZIPS, RLE, PIZ or none");
  if (h.num_channels < 1 || h.num_channels > kMaxChannels)
    return Malformed(where, "has " + std::to_string(h.num_channels) + " channels; 1 to " +
                                std::to_string(kMaxChannels) + " are read");
  for (int c = 0; c < h.num_channels; ++c) {
    if (h.channels[c].x_sampling != 1 || h.channels[c].y_sampling != 1)
      return Malformed(where, "has a channel of another resolution, which is not read");
    if (h.pixel_types[c] != TINYEXR_PIXELTYPE_HALF && h.pixel_types[c] != TINYEXR_PIXELTYPE_FLOAT)
      return Malformed(where, "has a channel that is neither half nor float");
  }
  return Done{};
}

uint64_t LittleEndian(const uint8_t* bytes, size_t count) {
  uint64_t v = 0;
  for (size_t i = 0; i < count; ++i) v |= uint64_t{bytes[i]} << (8 * i);
  return v;
}

// Every block must be there and say that it holds the lines that its place in the table stands for: the library leaves
// the lines of a missing block as the memory was.
Result<Done> CheckBlocks(std::span<const uint8_t> bytes, const EXRHeader& h, const std::string& where) {
  const int64_t lines = LinesInABlock(h.compression_type), blocks = (Height(h) + lines - 1) / lines;
  const size_t table = kMagicAndVersion + h.header_len;
  if (table + size_t(blocks) * 8 > bytes.size()) return Malformed(where, "ends within its table of blocks");
  for (int64_t i = 0; i < blocks; ++i) {
    const uint64_t offset = LittleEndian(&bytes[table + size_t(i) * 8], 8);
    if (offset > bytes.size() || bytes.size() - offset < 8) return Malformed(where, "ends before its last block");
    const auto line = int32_t(uint32_t(LittleEndian(&bytes[size_t(offset)], 4)));
    const uint64_t length = LittleEndian(&bytes[size_t(offset) + 4], 4);
    if (line != h.data_window.min_y + i * lines || length > bytes.size() - offset - 8)
      return Malformed(where, "has a broken block of lines, or ends within one");
  }
  return Done{};
}

// The channel of that name; -1: none.
int FindChannel(const EXRHeader& h, const char* name) {
  for (int c = 0; c < h.num_channels; ++c)
    if (std::strcmp(h.channels[c].name, name) == 0) return c;
  return -1;
}

Result<std::array<int, 4>> FindChannels(const EXRHeader& h, const std::string& where) {
  std::array<int, 4> rgba{FindChannel(h, "R"), FindChannel(h, "G"), FindChannel(h, "B"), FindChannel(h, "A")};
  const int grey = FindChannel(h, "Y");
  if (rgba[0] < 0 && rgba[1] < 0 && rgba[2] < 0 && grey >= 0) rgba[0] = rgba[1] = rgba[2] = grey;
  if (rgba[0] < 0 || rgba[1] < 0 || rgba[2] < 0) return Malformed(where, "has neither channels R, G, B nor Y");
  return rgba;
}

Result<ExrImage> Decode(std::span<const uint8_t> bytes, EXRHeader* h, const std::string& where) {
  Result<std::array<int, 4>> channels = FindChannels(*h, where);
  if (!channels) return channels.error();
  for (int c = 0; c < h->num_channels; ++c) h->requested_pixel_types[c] = TINYEXR_PIXELTYPE_FLOAT;
  EXRImage planes;
  InitEXRImage(&planes);
  // When the library fails it frees its planes, but only as many as it finds here.
  planes.num_channels = h->num_channels;
  const char* message = nullptr;
  if (LoadEXRImageFromMemory(&planes, h, bytes.data(), bytes.size(), &message) != TINYEXR_SUCCESS)
    return Malformed(where, "is a broken EXR file (" + TakeMessage(message) + ")");
  const std::unique_ptr<EXRImage, decltype(&FreeEXRImage)> owner(&planes, &FreeEXRImage);
  ExrImage out{{uint32_t(Width(*h)), uint32_t(Height(*h)), {}}, (*channels)[3] >= 0};
  out.image.pixels.assign(size_t(out.image.width) * out.image.height, glm::vec4(1));
  for (int c = 0; c < 4; ++c) {
    if ((*channels)[size_t(c)] < 0) continue;
    const auto* plane = reinterpret_cast<const float*>(planes.images[(*channels)[size_t(c)]]);
    for (size_t i = 0; i < out.image.pixels.size(); ++i) out.image.pixels[i][c] = plane[i];
  }
  return out;
}

}  // namespace

bool IsExr(std::span<const uint8_t> bytes) {
  return bytes.size() >= 4 && bytes[0] == 0x76 && bytes[1] == 0x2f && bytes[2] == 0x31 && bytes[3] == 0x01;
}

Result<ExrImage> ReadExrFromMemory(std::span<const uint8_t> bytes, const std::string& where) {
  if (!IsExr(bytes)) return Malformed(where, "is not an EXR file");
  EXRVersion version;
  if (bytes.size() < kMagicAndVersion ||
      ParseEXRVersionFromMemory(&version, bytes.data(), bytes.size()) != TINYEXR_SUCCESS)
    return Malformed(where, "is no EXR file of version 2");
  if (version.tiled || version.multipart || version.non_image)
    return Malformed(where, "is a tiled, deep or multi-part EXR file; only one part of scan lines is read");
  HeaderOwner header;
  const char* message = nullptr;
  if (ParseEXRHeaderFromMemory(&header.value, &version, bytes.data(), bytes.size(), &message) != TINYEXR_SUCCESS)
    return Malformed(where, "has a broken EXR header (" + TakeMessage(message) + ")");
  if (Result<Done> ok = CheckHeader(header.value, where); !ok) return ok.error();
  if (Result<Done> ok = CheckBlocks(bytes, header.value, where); !ok) return ok.error();
  return Decode(bytes, &header.value, where);
}

Result<ExrImage> ReadExr(const std::filesystem::path& file) {
  Result<std::vector<uint8_t>> bytes = ReadFileBytes(file, kMaxExrFile);
  if (!bytes) return bytes.error();
  return ReadExrFromMemory(*bytes, file.string());
}

Result<Done> WriteExr(const std::filesystem::path& file, const FloatImage& image) {
  const size_t count = size_t(image.width) * image.height;
  if (count == 0 || image.width > kMaxImageSide || image.height > kMaxImageSide || image.pixels.size() != count)
    return Error{ErrorCode::Usage, file.string() + ": cannot write " + std::to_string(image.pixels.size()) +
                                       " pixels as an image of " + std::to_string(image.width) + " x " +
                                       std::to_string(image.height)};
  // Channels in the order of their names, as the format wants them.
  constexpr std::array<std::pair<char, int>, 4> kChannels{{{'A', 3}, {'B', 2}, {'G', 1}, {'R', 0}}};
  std::array<std::vector<float>, 4> planes;
  std::array<unsigned char*, 4> pointers{};
  std::array<EXRChannelInfo, 4> infos{};
  std::array<int, 4> types{};
  for (size_t k = 0; k < 4; ++k) {
    infos[k].name[0] = kChannels[k].first;
    types[k] = TINYEXR_PIXELTYPE_FLOAT;
    for (const glm::vec4& p : image.pixels) planes[k].push_back(p[kChannels[k].second]);
    pointers[k] = reinterpret_cast<unsigned char*>(planes[k].data());
  }
  EXRHeader header;
  InitEXRHeader(&header);
  header.num_channels = 4;
  header.channels = infos.data();
  header.pixel_types = header.requested_pixel_types = types.data();
  header.compression_type = TINYEXR_COMPRESSIONTYPE_ZIP;
  EXRImage exr;
  InitEXRImage(&exr);
  exr.images = pointers.data();
  exr.width = int(image.width);
  exr.height = int(image.height);
  exr.num_channels = 4;
  unsigned char* bytes = nullptr;
  const char* message = nullptr;
  const size_t size = SaveEXRImageToMemory(&exr, &header, &bytes, &message);
  if (size == 0)
    return Error{ErrorCode::OutputFailed,
                 file.string() + ": the EXR could not be encoded (" + TakeMessage(message) + ")"};
  const std::unique_ptr<unsigned char, decltype(&std::free)> owner(bytes, &std::free);
  return WriteFile(file, {bytes, size});
}

}  // namespace fur
