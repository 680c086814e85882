// The flags that say what is seen: model, coat, look, camera. Every command that makes pictures has them.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "fur/renderer.h"

namespace app {

struct SceneFlags {
  std::string model, size = "1280x720", look = "correct", semantics, eye, target, furFile, furMaterial, background, comb;
  uint32_t count = 1;
  double fov = 0, zNear = 0, zFar = 0, furLength = 0, uvScale = 0, combStrength = 1, bend = 2;
};
void AddSceneFlags(CLI::App*, SceneFlags*);

// For numbers: CLI11's ranges let NaN through.
extern const CLI::Validator kFinite;

// Three finite numbers X,Y,Z; Usage names the flag.
fur::Result<glm::dvec3> ParseVector(const std::string& text, const char* flag);

// Size, look, semantics, background, comb and bend. `published`: the flags ask for a published technique, whose shells
// are sheets when nothing else is said.
fur::Result<fur::Done> SetScene(const SceneFlags&, bool published, fur::RenderSettings*);

fur::Result<fur::Model> LoadModel(const SceneFlags&);

struct SceneView {
  fur::Camera camera;
  std::vector<glm::dmat4> placements;
};
fur::Result<SceneView> MakeView(const SceneFlags&, const fur::Model&, double aspect);

// Each on a line of stderr.
void PrintMessages(const std::vector<std::string>& messages);

}  // namespace app
