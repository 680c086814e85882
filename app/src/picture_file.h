// The picture that fur render leaves: a PNG, or the frame itself as an EXR.
#pragma once

#include <filesystem>

#include "render_job.h"

namespace app {

// Whether the name ends in .exr, in any case.
bool IsExrName(const std::filesystem::path& file);

// Usage, in words, where these settings have no frame of floats with opacity for an EXR.
fur::Result<fur::Done> CheckPictureFile(const std::filesystem::path& file, const fur::RenderSettings& settings);

// As it is stored in 8 bits; the frame is of its look's own space.
fur::Image StoredPicture(fur::FloatImage frame, fur::Look look);

// A frame as a PNG or an EXR, by the name.
fur::Result<fur::Done> WriteFrame(const std::filesystem::path& file, fur::FloatImage frame, fur::Look look);

// The EXR is in linear light, also for look seed; alpha is the opacity of skin and fur over the background.
fur::Result<fur::Done> WritePicture(const std::filesystem::path& file, const RenderOutcome& outcome,
                                    const fur::RenderSettings& settings);

}  // namespace app
