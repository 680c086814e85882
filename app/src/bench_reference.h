// The references of a scene of fur bench, and how far a frame is from one.
#pragma once

#include "bench_run.h"
#include "fur/compare.h"

namespace app {

// Pixels of a part of the picture.
struct BenchCrop {
  uint32_t x = 0, y = 0, width = 0, height = 0;
};
BenchCrop CropOf(const fur::BenchScene&, const BenchOptions&);

// A frame as it was stored.
struct BenchFrame {
  fur::Picture picture;
  bool isBytes = false;  // the target has 8 bits a channel
};
// The last frame, the crop of it.
fur::Result<BenchFrame> ReadFrame(fur::Renderer&, const fur::RenderSettings&, const BenchCrop&);

// The references of one look and semantics, one for each angle.
class BenchTruth {
 public:
  // Two halves of the samples with seeds of their own; their mean is the reference.
  static fur::Result<BenchTruth> Make(const fur::Model&, const std::vector<SceneView>&, const fur::RenderSettings&,
                                      const BenchCrop&, const BenchOptions&,
                                      const std::function<void(double)>& progress);
  // A frame of 8 bits is compared with the reference rounded to 8 bits.
  fur::Result<fur::Comparison> Compare(size_t angle, const BenchFrame&) const;
  bool IsFor(const fur::RenderSettings&) const;
  const BenchReference& Report() const { return report_; }

 private:
  struct Angle {
    fur::Picture floats, bytes;
    fur::CompareSettings regions;
  };
  std::vector<Angle> angles_;
  BenchReference report_;
};

// RGBA8 to look at, no wider than the page shows it.
std::vector<uint8_t> ShownBytes(fur::Picture);
BenchPicture Thumbnail(const std::vector<uint8_t>& frame, const std::vector<uint8_t>& heat, uint32_t width,
                       uint32_t height);

}  // namespace app
