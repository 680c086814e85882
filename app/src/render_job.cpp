#include "render_job.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>

#include "picture_file.h"

namespace app {
namespace {

fur::Result<fur::Done> TimeFrames(fur::Renderer& renderer, const RenderJob& job, RenderOutcome* out) {
  for (uint32_t i = 1; i <= job.repeat; ++i) {
    fur::Result<double> ms = TimeFrame(renderer, fur::TurnCamera(job.camera, kTurnDegrees * i), job.placements);
    if (!ms) return ms.error();
    out->frameMs.push_back(*ms);
  }
  return fur::Done{};
}

// Adds what the driver said to an error that only has a status.
fur::Error Explain(fur::Error error, const MessageCollector& messages) {
  if (!messages.Lines().empty()) error.message += " (" + messages.Last() + ")";
  return error;
}

fur::Result<fur::Done> ReadPicture(fur::Renderer& renderer, const RenderJob& job, RenderOutcome* out) {
  if (job.floatFrame || job.supersample > 1) {
    fur::Result<fur::FloatImage> frame = renderer.ReadPixels();
    if (!frame) return frame.error();
    out->frame = job.supersample > 1 ? Reduced(*frame, job.supersample) : std::move(*frame);
  }
  if (job.supersample > 1) {
    out->image = StoredPicture(out->frame, job.settings.look);
    return fur::Done{};
  }
  fur::Result<fur::Image> image = renderer.ReadImage();
  if (!image) return image.error();
  out->image = std::move(*image);
  return fur::Done{};
}

fur::Result<RenderOutcome> RunOnDevice(rhi::IDevice& device, const fur::Model& model, const RenderJob& job) {
  RenderOutcome out;
  out.caps = device.GetCaps();
  fur::Result<std::unique_ptr<fur::Renderer>> renderer = fur::MakeRenderer(device, model, job.settings);
  if (!renderer) return renderer.error();
  device.GetStats(true);
  fur::Result<double> first = TimeFrame(**renderer, job.camera, job.placements);
  if (!first) return first.error();
  out.firstFrameMs = *first;
  out.rhiStats = device.GetStats(true);
  if (fur::Result<fur::Done> read = ReadPicture(**renderer, job, &out); !read) return read.error();
  if (fur::Result<fur::Done> timed = TimeFrames(**renderer, job, &out); !timed) return timed.error();
  fur::Result<fur::FrameCounts> counts = (*renderer)->Count(job.camera, job.placements);
  if (!counts) return counts.error();
  out.counts = *counts;
  return out;
}

}  // namespace

fur::Result<double> TimeFrame(fur::Renderer& renderer, const fur::Camera& camera, std::span<const glm::dmat4> placements) {
  const auto start = std::chrono::steady_clock::now();
  renderer.Draw(camera, placements);
  if (fur::Result<fur::Done> done = renderer.Finish(); !done) return done.error();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

fur::Result<RenderOutcome> RunRenderJob(const BackendEntry& backend, const fur::Model& model, const RenderJob& job) {
  MessageCollector messages;
  fur::Result<RenderOutcome> out = RenderOutcome{};
  {
    fur::Result<rhi::Ref<rhi::IDevice>> device = MakeDevice(backend, job.adapter, job.validate, &messages);
    if (!device) return device.error();
    out = RunOnDevice(**device, model, job);
  }  // the device dies here: leaks that its validation reports are among the messages
  if (!out) return Explain(out.error(), messages);
  out->backend = backend.name;
  out->messages = messages.Lines();
  return out;
}

ImageDifference CompareImages(const fur::Image& a, const fur::Image& b) {
  ImageDifference d;
  d.pixels = uint64_t(a.width) * a.height;
  uint64_t sum = 0;
  for (uint64_t p = 0; p < d.pixels; ++p) {
    int largest = 0;
    for (uint64_t c = 0; c < 3; ++c) {
      const int delta = std::abs(int(a.pixels[p * 4 + c]) - int(b.pixels[p * 4 + c]));
      largest = std::max(largest, delta);
      sum += uint64_t(delta);
    }
    d.differing += largest > 0;
    d.largest = std::max(d.largest, largest);
  }
  d.mean = d.pixels ? double(sum) / double(d.pixels * 3) : 0;
  return d;
}

}  // namespace app
