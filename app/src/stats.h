// The JSON of --stats.
#pragma once

#include <nlohmann/json.hpp>

#include "render_job.h"

namespace app {

nlohmann::ordered_json StatsJson(const RenderOutcome&, const RenderJob&);
nlohmann::ordered_json DifferenceJson(const ImageDifference&);

// Names as the flags spell them.
const char* ToString(fur::Technique);
const char* ToString(fur::Look);
const char* ToString(fur::Semantics);
const char* ToString(fur::Preset);
const char* ToString(fur::FourCoat);

}  // namespace app
