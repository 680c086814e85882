#include "fur/file.h"

#include <unistd.h>

#include <fstream>
#include <system_error>

namespace fur {
namespace {

namespace fs = std::filesystem;

Error Refuse(const fs::path& file, const std::string& why) {
  return {ErrorCode::OutputFailed, "cannot write " + file.string() + ": " + why};
}

// The process id keeps two programs that write the same target apart.
fs::path TemporaryBeside(const fs::path& file) {
  return file.parent_path() / ("." + file.filename().string() + "." + std::to_string(::getpid()) + ".tmp");
}

bool WriteBytes(const fs::path& file, std::span<const uint8_t> bytes) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  out.close();  // a full disk may show only here
  return !out.fail();
}

// Renaming over a device would replace it by a file.
bool IsSpecial(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored) && !fs::is_regular_file(file, ignored) && !fs::is_directory(file, ignored);
}

fs::path FollowLinks(const fs::path& file) {
  std::error_code failed;
  if (!fs::is_symlink(file, failed)) return file;
  const fs::path target = fs::weakly_canonical(file, failed);
  return failed ? file : target;
}

Result<Done> ReplaceFile(const fs::path& file, std::span<const uint8_t> bytes) {
  const fs::path temporary = TemporaryBeside(file);
  std::error_code ignored, failed;
  if (!WriteBytes(temporary, bytes)) {
    fs::remove(temporary, ignored);
    return Refuse(file, "check the folder and the free space");
  }
  fs::rename(temporary, file, failed);
  if (!failed) return Done{};
  fs::remove(temporary, ignored);
  return Refuse(file, failed.message());
}

}  // namespace

Result<Done> WriteFile(const fs::path& file, std::span<const uint8_t> bytes) {
  const fs::path target = FollowLinks(file);
  if (!IsSpecial(target)) return ReplaceFile(target, bytes);
  if (WriteBytes(target, bytes)) return Done{};
  return Refuse(file, "the device does not take it");
}

Result<Done> WriteFile(const fs::path& file, std::string_view text) {
  return WriteFile(file, {reinterpret_cast<const uint8_t*>(text.data()), text.size()});
}

Result<Done> CheckWritable(const fs::path& file) {
  std::error_code ignored;
  const fs::path target = FollowLinks(file);
  const fs::path folder = target.has_parent_path() ? target.parent_path() : ".";
  if (IsSpecial(target)) return Done{};
  if (fs::is_directory(target, ignored)) return Refuse(file, "it is a folder");
  if (!fs::is_directory(folder, ignored)) return Refuse(file, folder.string() + " is not a folder");
  const fs::path probe = TemporaryBeside(target);
  const bool writable = WriteBytes(probe, {});
  fs::remove(probe, ignored);
  if (!writable) return Refuse(file, "no file can be made in " + folder.string());
  return Done{};
}

}  // namespace fur
