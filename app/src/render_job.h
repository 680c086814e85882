// One rendering of a scene on one backend, timed.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "backends.h"
#include "fur/renderer.h"

namespace app {

inline constexpr double kTurnDegrees = 0.5;  // of the camera, from one timed frame to the next

struct RenderJob {
  fur::RenderSettings settings;
  fur::Camera camera;
  std::vector<glm::dmat4> placements;
  uint32_t repeat = 1;     // timed frames after the first
  bool validate = false;   // API and synchronization validation
  std::string adapter;
  bool floatFrame = false; // read the frame as floats too
  uint32_t supersample = 1; // the settings' sides are this many times the picture's; needs a frame of floats
};

struct RenderOutcome {
  std::string backend;
  rhi::Caps caps;
  fur::Image image;               // the first frame, at the job's camera
  fur::FloatImage frame;          // the same before it is brought to 8 bits; empty without floatFrame
  double firstFrameMs = 0;        // with the drivers' shader compilation
  std::vector<double> frameMs;    // docs/accuracy.md: first call to finished GPU, the camera turning 0.5 degrees a frame
  fur::FrameCounts counts;
  rhi::Stats rhiStats;            // of the first frame
  std::vector<std::string> messages;
};

fur::Result<RenderOutcome> RunRenderJob(const BackendEntry& backend, const fur::Model& model, const RenderJob& job);

// From the first call to the finished GPU.
fur::Result<double> TimeFrame(fur::Renderer& renderer, const fur::Camera& camera, std::span<const glm::dmat4> placements);

// How far two pictures of one size are apart.
struct ImageDifference {
  uint64_t pixels = 0, differing = 0;
  int largest = 0;   // of a channel, 0..255
  double mean = 0;   // of all channels, 0..255
  double EqualShare() const { return pixels ? double(pixels - differing) / double(pixels) : 1; }
};
ImageDifference CompareImages(const fur::Image& a, const fur::Image& b);

}  // namespace app
