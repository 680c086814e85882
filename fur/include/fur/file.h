// Files, whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

#include "fur/result.h"

namespace fur {

// Writes a file so that it appears whole or not at all: beside the target under another name, then renamed. A symbolic
// link is followed; a device or a pipe is written to as it is. OutputFailed says which file and why.
Result<Done> WriteFile(const std::filesystem::path& file, std::span<const uint8_t> bytes);
Result<Done> WriteFile(const std::filesystem::path& file, std::string_view text);

// Whether WriteFile could make this file now, for a check before long work. Leaves nothing behind.
Result<Done> CheckWritable(const std::filesystem::path& file);

}  // namespace fur
