// Measures one scene of fur bench: time and error of every configuration on every backend, in turns.
#pragma once

#include <functional>
#include <optional>

#include "backends.h"
#include "fur/bench.h"
#include "reference_cache.h"

namespace app {

struct BenchOptions {
  std::string assets, cache, size = "1280x720";
  uint32_t width = 0, height = 0;  // of `size`
  uint32_t rounds = 15, warmUp = 2;
  uint32_t samples = 64;     // a pixel, of a reference
  double secondsLeft = 1e9;  // for a scene: beyond them, rounds end early
  bool pictures = false;     // keep them for a page
};

// Means over the scene's angles. fur/compare.h.
struct BenchError {
  double maskFlip = 0, maskRmse = 0, flip = 0, flipP99 = 0, rmse = 0;
  std::optional<double> bandRmse;  // none: a frame without opacity
};

struct BenchPicture {
  uint32_t width = 0, height = 0;
  std::vector<uint8_t> frame, heat;  // RGBA8, sRGB-encoded; heat: empty for a reference
};

struct BenchReference {
  fur::Look look = fur::Look::Correct;
  fur::Semantics semantics = fur::Semantics::Volume;
  double seconds = 0;                     // 0: from the cache
  double halvesFlip = 0, halvesRmse = 0;  // between two independent halves of the samples, in the mask
  uint64_t maskPixels = 0;                // of the first angle
  BenchPicture picture;
};

struct BenchResult {
  fur::BenchConfig config;
  std::string backend, driver;
  std::vector<double> frameMs;  // one for each round
  double firstFrameMs = 0;      // with the driver's compilation, as far as nobody compiled the same before
  fur::BenchSummary ms;
  fur::BenchRatio ratio;  // to the first configuration on the same backend
  BenchError error;
  bool errorWithoutFins = false;  // the baseline's is smaller without its fins: that one counts
  fur::FrameCounts counts;
  bool onFront = false;  // among those of its backend, look and semantics
  BenchPicture picture;  // of the first backend only
};

struct BenchSceneResult {
  fur::BenchScene scene;
  std::vector<BenchReference> references;
  std::vector<BenchResult> results;  // backend by backend, in the order of the configurations
  std::vector<std::string> skipped;  // configurations that a device cannot draw, and why
  double seconds = 0;
};

// A device of each backend, kept over the scenes.
struct BenchDevice {
  const BackendEntry* backend = nullptr;
  rhi::Ref<rhi::IDevice> device;
};

using BenchProgress = std::function<void(const std::string& what, double share)>;

fur::Result<BenchSceneResult> RunBenchScene(const fur::BenchScene&, const std::vector<fur::BenchConfig>&,
                                            const std::vector<BenchDevice>&, const BenchOptions&, const BenchProgress&);

}  // namespace app
