// Reference pictures, made once.
#pragma once

#include <string>

#include "fur/reference.h"
#include "scene_flags.h"

namespace app {

struct CachedReference {
  fur::ReferenceImage image;
  bool cached = false;
  double seconds = 0;  // that it took; 0 from the cache
};

// From the folder, or rendered and kept there; empty: no cache. A folder that cannot be written costs time only, and is
// said on stderr.
fur::Result<CachedReference> ObtainReference(const std::string& folder, const fur::Model&, const SceneView&,
                                             const fur::ReferenceSettings&);

// $XDG_CACHE_HOME/fur, else ~/.cache/fur, else empty.
std::string DefaultCacheFolder();

// Size, look, semantics, background, light and time of what is rendered on a GPU.
fur::ReferenceSettings ReferenceOf(const fur::RenderSettings&);

}  // namespace app
