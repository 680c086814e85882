// The flags that say what is seen: model, coat, look, camera. Every command that makes pictures has them.
#pragma once

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "fur/renderer.h"

namespace app {

inline constexpr uint32_t kMaxSide = 16384;  // of a frame, pixels

struct SceneFlags {
  std::string model, size = "1280x720", look = "correct", semantics, eye, target, coat, furFile, furMaterial, background;
  std::map<std::string, std::string> fur;  // FurParams keys that flags set, as they were spelled
  uint32_t count = 1;
  double fov = 0, zNear = 0, zFar = 0, time = 0;
};
void AddSceneFlags(CLI::App*, SceneFlags*);

fur::Look LookOf(const SceneFlags&);

// Size, semantics, time, light and background; the settings' technique, look and preset are set already.
fur::Result<fur::Done> SetScene(const SceneFlags&, fur::RenderSettings*);

// With its coat groomed.
fur::Result<fur::Model> LoadModel(const SceneFlags&);

struct SceneView {
  fur::Camera camera;
  std::vector<glm::dmat4> placements;
};
// `aspect`: width / height.
fur::Result<SceneView> MakeView(const SceneFlags&, const fur::Model&, double aspect);

// Each on a line of stderr.
void PrintMessages(const std::vector<std::string>& messages);

}  // namespace app
