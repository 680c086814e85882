// Whole files as bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "fur/result.h"

namespace fur {

// Reads a regular file of at most `limit` bytes. Errors: InputMissing (not there, a folder, unreadable), InputMalformed
// (too large); the message starts with the file's path.
Result<std::vector<uint8_t>> ReadFileBytes(const std::filesystem::path& file, uint64_t limit);

}  // namespace fur
