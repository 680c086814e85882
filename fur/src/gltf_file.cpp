// From a path to a checked Document.
#include <algorithm>
#include <cstring>

#include "file_bytes.h"
#include "gltf_internal.h"

namespace fur::gltf {
namespace {

constexpr uint64_t kMaxFile = uint64_t{1} << 30;
constexpr int kMaxJsonDepth = 64;
constexpr size_t kMaxMessage = 400, kMaxWarnings = 100;

// tinygltf looks for files in a base folder and then in the current one, and expands their names with a shell's rules.
// With these callbacks it sees a made-up base folder, so that only names that start with it are meant, and plain names.
constexpr std::string_view kBase = "model:";

struct Files {
  std::filesystem::path folder;
  std::string missing;  // the last name that was asked for and is not there
};

std::filesystem::path Resolve(const Files& files, std::string_view name) {
  return files.folder / std::filesystem::path(name.substr(kBase.size() + 1));  // an absolute name replaces the folder
}

bool FileExists(const std::string& name, void* user) {
  auto* files = static_cast<Files*>(user);
  if (!name.starts_with(kBase) || name.size() <= kBase.size() + 1) return false;
  std::error_code failed;
  if (std::filesystem::exists(Resolve(*files, name), failed)) return true;
  files->missing = Resolve(*files, name).string();
  return false;
}

std::string KeepName(const std::string& name, void*) { return name; }

bool ReadWholeFile(std::vector<unsigned char>* out, std::string* error, const std::string& name, void* user) {
  Result<std::vector<uint8_t>> bytes = ReadFileBytes(Resolve(*static_cast<Files*>(user), name), kMaxFile);
  if (bytes)
    *out = std::move(*bytes);
  else
    *error = bytes.error().message;
  return static_cast<bool>(bytes);
}

// Keeps a picture's bytes undecoded. Those in a buffer are read from it later; here nobody has checked their range.
bool KeepImageBytes(tinygltf::Image* image, int, std::string*, std::string*, int, int, const unsigned char* bytes,
                    int size, void*) {
  if (image->bufferView < 0) image->image.assign(bytes, bytes + size);
  return true;
}

uint32_t LittleEndian(std::span<const uint8_t> bytes, size_t offset) {
  return uint32_t{bytes[offset]} | uint32_t{bytes[offset + 1]} << 8 | uint32_t{bytes[offset + 2]} << 16 |
         uint32_t{bytes[offset + 3]} << 24;
}

bool IsGlb(std::span<const uint8_t> bytes) { return bytes.size() >= 4 && std::memcmp(bytes.data(), "glTF", 4) == 0; }

// Returns the JSON chunk. Checks the binary chunk too: tinygltf 2.7 lets it end 8 bytes behind the file.
std::span<const uint8_t> SplitGlb(std::span<const uint8_t> bytes, const Document& doc) {
  constexpr size_t kHeader = 12, kChunkHeader = 8;
  constexpr uint32_t kJson = 0x4E4F534A, kBinary = 0x004E4942;
  if (bytes.size() < kHeader + kChunkHeader) doc.Malformed("is a GLB file cut off in its header");
  if (LittleEndian(bytes, 4) != 2) doc.Malformed("is GLB version ", LittleEndian(bytes, 4), "; only 2 is read");
  const size_t length = LittleEndian(bytes, 8);
  if (length > bytes.size())
    doc.Malformed("is cut off: the GLB header says ", length, " bytes, there are ", bytes.size());
  const size_t jsonEnd = kHeader + kChunkHeader + LittleEndian(bytes, 12);
  if (LittleEndian(bytes, 16) != kJson || jsonEnd > length) doc.Malformed("has no complete GLB JSON chunk");
  if (jsonEnd < length) {
    if (length - jsonEnd < kChunkHeader) doc.Malformed("is cut off in the header of its GLB binary chunk");
    const size_t end = jsonEnd + kChunkHeader + LittleEndian(bytes, jsonEnd);
    if (end > length) doc.Malformed("has a GLB binary chunk that ends at byte ", end, " of ", length);
    if (LittleEndian(bytes, jsonEnd + 4) != kBinary) doc.Malformed("has a second GLB chunk that is not binary data");
  }
  return bytes.subspan(kHeader + kChunkHeader, jsonEnd - kHeader - kChunkHeader);
}

void RunTinygltf(std::span<const uint8_t> bytes, Document* doc) {
  Files files{doc->file.parent_path(), {}};
  tinygltf::TinyGLTF reader;
  reader.SetImageLoader(KeepImageBytes, nullptr);
  reader.SetFsCallbacks({FileExists, KeepName, ReadWholeFile, nullptr, &files});
  std::string error, warning;
  const unsigned size = static_cast<unsigned>(bytes.size());
  const std::string base(kBase);
  const bool ok = IsGlb(bytes) ? reader.LoadBinaryFromMemory(&doc->model, &error, &warning, bytes.data(), size, base)
                               : reader.LoadASCIIFromString(&doc->model, &error, &warning,
                                                            reinterpret_cast<const char*>(bytes.data()), size, base);
  if (ok && error.empty()) return;
  if (!files.missing.empty() && error.find("not found") != std::string::npos)
    throw LoadFailure(ErrorCode::InputMissing, Text(doc->file.string(), ": its buffer ", files.missing, " is missing"));
  // tinygltf's own message would quote the whole data.
  if (error.find("data:") != std::string::npos)
    doc->Malformed("has a data URI that is not base64, or whose buffer's byteLength is not the number of bytes in it");
  doc->Malformed(error.empty() ? "cannot be read as glTF" : error);
}

// The arrays must agree, because the rest of the reader trusts the references that CheckSchema saw in the JSON.
void CheckCounts(const Document& doc) {
  const tinygltf::Model& m = doc.model;
  const std::pair<const char*, size_t> counts[] = {
      {"accessors", m.accessors.size()}, {"bufferViews", m.bufferViews.size()}, {"buffers", m.buffers.size()},
      {"images", m.images.size()},       {"materials", m.materials.size()},     {"meshes", m.meshes.size()},
      {"nodes", m.nodes.size()},         {"samplers", m.samplers.size()},       {"scenes", m.scenes.size()},
      {"skins", m.skins.size()},         {"textures", m.textures.size()}};
  for (const auto& [key, count] : counts) {
    const auto it = doc.json.find(key);
    if ((it == doc.json.end() ? 0 : it->size()) != count)
      doc.Malformed("has elements in ", key, " that cannot be read");
  }
}

// Counts brackets outside strings. (The library's parser callback knows the depth too, but makes the time grow with the
// square of an array's length.)
int JsonDepth(std::span<const uint8_t> text) {
  int depth = 0, deepest = 0;
  bool inString = false;
  for (size_t i = 0; i < text.size() && deepest <= kMaxJsonDepth; ++i) {
    const uint8_t c = text[i];
    if (inString && c == '\\') ++i;
    if (c == '"') inString = !inString;
    if (inString) continue;
    if (c == '[' || c == '{') deepest = std::max(deepest, ++depth);
    if (c == ']' || c == '}') --depth;
  }
  return deepest;
}

}  // namespace

std::string OneLine(std::string text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  if (text.size() > kMaxMessage) text = text.substr(0, kMaxMessage) + "...";
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) c = c == '\n' ? ' ' : '?';
  return text;
}

void Document::AddWarning(std::string line) {
  if (warnings.size() < kMaxWarnings && std::find(warnings.begin(), warnings.end(), line) == warnings.end())
    warnings.push_back(std::move(line));
}

Json ParseJson(std::span<const uint8_t> text, const std::string& where) {
  if (JsonDepth(text) > kMaxJsonDepth) throw LoadFailure(ErrorCode::InputMalformed, where + ": JSON nested too deep");
  try {
    return Json::parse(text.begin(), text.end());
  } catch (const Json::exception& e) {
    throw LoadFailure(ErrorCode::InputMalformed, where + ": is not valid JSON: " + e.what());
  }
}

Document OpenDocument(const std::filesystem::path& file) {
  Document doc;
  doc.file = file;
  Result<std::vector<uint8_t>> bytes = ReadFileBytes(file, kMaxFile);
  if (!bytes) throw LoadFailure(bytes.error().code, bytes.error().message);
  if (bytes->empty()) doc.Malformed("is empty");
  doc.json = ParseJson(IsGlb(*bytes) ? SplitGlb(*bytes, doc) : std::span<const uint8_t>(*bytes), file.string());
  CheckSchema(doc.json, file.string());
  RunTinygltf(*bytes, &doc);
  CheckCounts(doc);
  for (size_t i = 0; i < doc.model.accessors.size(); ++i) CheckAccessor(doc, static_cast<int>(i));
  return doc;
}

}  // namespace fur::gltf
