#include "reference_cache.h"

#include <chrono>
#include <cstdlib>

namespace app {

std::string DefaultCacheFolder() {
  const char* const base = std::getenv("XDG_CACHE_HOME");
  if (base && *base) return std::string(base) + "/fur";
  const char* const home = std::getenv("HOME");
  return home && *home ? std::string(home) + "/.cache/fur" : std::string();
}

fur::ReferenceSettings ReferenceOf(const fur::RenderSettings& render) {
  fur::ReferenceSettings s;
  s.width = render.width;
  s.height = render.height;
  s.look = render.look;
  s.semantics = render.semantics;
  s.background = render.background;
  s.light = render.light;
  s.comb = render.comb;
  s.bend = render.bend;
  s.time = render.time;
  return s;
}

fur::Result<CachedReference> ObtainReference(const std::string& folder, const fur::Model& model, const SceneView& view,
                                             const fur::ReferenceSettings& settings) {
  const std::string key = fur::ReferenceKey(model, view.camera, view.placements, settings);
  if (!folder.empty())
    if (fur::Result<fur::ReferenceImage> kept = fur::LoadReference(folder, key))
      return CachedReference{std::move(*kept), true, 0};
  const auto start = std::chrono::steady_clock::now();
  fur::Result<fur::ReferenceImage> made = fur::RenderReference(model, view.camera, view.placements, settings);
  if (!made) return made.error();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  CachedReference reference{std::move(*made), false, took.count()};
  if (folder.empty()) return reference;
  if (fur::Result<fur::Done> stored = fur::StoreReference(folder, key, reference.image); !stored)
    PrintMessages({"the reference is not kept: " + stored.error().message});
  return reference;
}

}  // namespace app
