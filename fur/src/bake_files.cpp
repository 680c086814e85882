#include "fur/bake_files.h"

#include <unistd.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <optional>
#include <system_error>

#include "for_all.h"
#include "fur/file.h"
#include "fur/image_io.h"
#include "volume_mips.h"

namespace fur {
namespace {

namespace fs = std::filesystem;

Error Refuse(const fs::path& folder, const std::string& why) {
  return {ErrorCode::OutputFailed, "cannot write " + folder.string() + ": " + why};
}

std::string SliceName(uint32_t slice) { return (slice < 10 ? "0" : "") + std::to_string(slice) + ".png"; }

bool IsNumber(const std::string& text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

// Whether a baked coat has a file or folder of this name, relative to its folder.
bool IsOurs(const fs::path& entry) {
  std::vector<std::string> parts;
  for (const fs::path& part : entry) parts.push_back(part.string());
  const std::string name = parts.back();
  const bool isSlice = name.ends_with(".png") && IsNumber(name.substr(0, name.size() - 4));
  if (parts.size() == 1) {
    const auto known = {"tint", "mips", "fin.png", "coat.json", "fur.json", "strands.json", "strands.ply"};
    return isSlice || std::find(known.begin(), known.end(), name) != known.end();
  }
  if (parts.size() == 2) return parts[0] == "tint" ? isSlice : parts[0] == "mips" && IsNumber(name);
  return parts.size() == 3 && parts[0] == "mips" && IsNumber(parts[1]) && isSlice;
}

// The name of something in the folder that is no part of a baked coat.
std::optional<std::string> ForeignEntry(const fs::path& folder) {
  std::error_code failed;
  for (fs::recursive_directory_iterator it(folder, failed), end; !failed && it != end; it.increment(failed)) {
    const fs::path entry = it->path().lexically_relative(folder);
    if (!IsOurs(entry)) return entry.string();
  }
  if (failed) return failed.message();
  return std::nullopt;
}

fs::path WithoutSlash(const fs::path& folder) {
  const fs::path normal = folder.lexically_normal();
  return normal.has_filename() ? normal : normal.parent_path();
}

fs::path Beside(const fs::path& folder, const char* ending) {
  return folder.parent_path() / ("." + folder.filename().string() + "." + std::to_string(::getpid()) + ending);
}

// A folder that is gone with this object unless it was moved to its place.
class Staging {
 public:
  explicit Staging(const fs::path& target) : target_(target), path_(Beside(target, ".tmp")) {}
  ~Staging() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;
  const fs::path& path() const { return path_; }

  // An old coat in its place is moved away first and comes back if the new one cannot take its place.
  Result<Done> Commit() {
    const fs::path old = Beside(target_, ".old");
    std::error_code failed, ignored;
    const bool replaces = fs::exists(target_, ignored);
    if (replaces) fs::rename(target_, old, failed);
    if (failed) return Refuse(target_, failed.message());
    fs::rename(path_, target_, failed);
    if (failed && replaces) fs::rename(old, target_, ignored);
    if (failed) return Refuse(target_, failed.message());
    if (replaces) fs::remove_all(old, ignored);
    return Done{};
  }

 private:
  fs::path target_, path_;
};

struct PictureFile {
  std::string name;
  uint32_t width, height;
  std::span<const uint8_t> rgba;
};

void ListSlices(const FurVolume& volume, const std::vector<uint8_t>& pixels, const std::string& folder,
                std::vector<PictureFile>* files) {
  const size_t bytes = size_t{4} * volume.width * volume.height;
  for (uint32_t j = 0; j < volume.layers; ++j)
    files->push_back({folder + SliceName(j), volume.width, volume.height, {&pixels[j * bytes], bytes}});
}

void ListMips(const FurVolume& volume, const std::vector<MipChain>& mips, std::vector<PictureFile>* files) {
  for (uint32_t j = 0; j < mips.size(); ++j)
    for (uint32_t level = 1; level < mips[j].size(); ++level)
      files->push_back({"mips/" + std::to_string(level) + "/" + SliceName(j), std::max(1u, volume.width >> level),
                        std::max(1u, volume.height >> level), mips[j][level]});
}

std::string FurJson(const FurVolume& volume) {
  nlohmann::ordered_json json;
  for (uint32_t j = 0; j < volume.layers; ++j) json["default"]["layers"].push_back(SliceName(j));
  return json.dump(2) + "\n";
}

Result<Done> WritePictures(const fs::path& folder, const std::vector<PictureFile>& files, uint32_t threads,
                           const BakeProgress& progress) {
  std::error_code failed;
  for (const PictureFile& file : files) fs::create_directories((folder / file.name).parent_path(), failed);
  if (failed) return Refuse(folder, failed.message());
  std::vector<std::optional<Error>> errors(files.size());
  ForAll(static_cast<uint32_t>(files.size()), threads, progress, [&](uint32_t i) {
    const PictureFile& file = files[i];
    if (Result<Done> ok = WritePng(folder / file.name, file.width, file.height, file.rgba); !ok) errors[i] = ok.error();
  });
  for (const std::optional<Error>& error : errors)
    if (error) return *error;
  return Done{};
}

Result<Done> CheckFolder(const fs::path& given) {
  const fs::path folder = WithoutSlash(given);
  std::error_code ignored;
  if (folder.empty() || folder.filename() == ".." || folder.filename() == "." || folder == folder.root_path())
    return Refuse(given, "name a folder of its own");
  if (fs::is_symlink(folder, ignored)) return Refuse(folder, "it is a link; name the folder itself");
  if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored)) return Refuse(folder, "it is not a folder");
  if (fs::exists(folder, ignored)) {
    if (const std::optional<std::string> foreign = ForeignEntry(folder))
      return Refuse(folder, "it holds " + *foreign + ", which is no part of a baked coat; name another folder");
  }
  const fs::path probe = Beside(folder, ".tmp");
  std::error_code failed;
  fs::create_directory(probe, failed);
  fs::remove(probe, ignored);
  if (failed) return Refuse(folder, failed.message());
  return Done{};
}

bool IsInside(const CoatOutput& output) {
  std::error_code ignored;
  const auto plain = [&](const fs::path& p) {
    return (fs::weakly_canonical(p.empty() ? "." : p, ignored) / "").lexically_normal();
  };
  return !output.strands.empty() && plain(output.strands.parent_path()) == plain(output.folder);
}

}  // namespace

BakedCoat Bake(const CoatParams& params, uint32_t threads, const BakeProgress& progress) {
  BakedCoat coat{params, GrowStrandList(params), {}, {}};
  coat.volume = BakeVolume(params, coat.strands, threads, progress);
  coat.fin = BakeFinSlice(params, coat.strands);
  return coat;
}

Result<Done> CheckCoatOutput(const CoatOutput& output) {
  if (Result<Done> ok = CheckFolder(output.folder); !ok) return ok;
  if (output.strands.empty()) return Done{};
  const std::string name = output.strands.filename().string();
  if (output.strands.extension() != ".json" && output.strands.extension() != ".ply")
    return Error{ErrorCode::Usage, output.strands.string() + ": a list of strands is a .json or a .ply"};
  if (!IsInside(output)) return CheckWritable(output.strands);
  if (name == "strands.json" || name == "strands.ply") return Done{};
  return Error{ErrorCode::Usage,
               output.strands.string() + ": in the coat's own folder it must be strands.json or strands.ply"};
}

Result<Done> WriteCoat(const CoatOutput& output, const BakedCoat& coat, const BakeProgress& progress) {
  if (Result<Done> ok = CheckCoatOutput(output); !ok) return ok;
  Staging staging(WithoutSlash(output.folder));
  const fs::path& folder = staging.path();
  std::vector<MipChain> mips;
  if (output.mips) mips = MakeVolumeMips(coat.volume, 0);
  std::vector<PictureFile> files{{"fin.png", coat.fin.width, coat.fin.height, coat.fin.pixels}};
  ListSlices(coat.volume, coat.volume.pixels, "", &files);
  ListSlices(coat.volume, coat.volume.tint, "tint/", &files);
  ListMips(coat.volume, mips, &files);
  if (Result<Done> ok = WritePictures(folder, files, output.threads, progress); !ok) return ok;
  if (Result<Done> ok = WriteFile(folder / "coat.json", CoatJson(coat.params)); !ok) return ok;
  if (Result<Done> ok = WriteFile(folder / "fur.json", FurJson(coat.volume)); !ok) return ok;
  if (!output.strands.empty()) {
    // Last but for the folder's renaming, which the check has made sure of.
    const fs::path file = IsInside(output) ? folder / output.strands.filename() : output.strands;
    if (Result<Done> ok = WriteStrands(file, coat); !ok) return ok;
  }
  return staging.Commit();
}

}  // namespace fur
