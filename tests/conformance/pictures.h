// Pictures of a comparison, for the page.
#pragma once

#include "run.h"

namespace conformance {

// What a picture looks like: RGBA8, floats clamped to 0..1, one component as grey, integers by their lowest bytes.
std::vector<uint8_t> Shown(const Image&);
Pictures MakePictures(const Compared&);

}  // namespace conformance
