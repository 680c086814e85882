// All that a case of tests/conformance needs. Names, comparisons, reports: docs/conformance.md.
//
// A case on each backend: the fixtures and macros of rhi_fixture.h (RhiTest, RhiTestOf, BothTest, BothTestOf).
// `gpu.device` is the backend's shared device; its messages fail the case by themselves. In a file fur_techniques.cpp:
//
//   struct FurTechniqueTest : BothTestOf<Technique> {};                       // area: the suite's first word, "fur"
//   TEST_P(FurTechniqueTest, Picture) {                                       // fur.picture/shells_16.both
//     EXPECT_TRUE(SameImage(Render(gl, Parameter()), Render(vulkan, Parameter())));
//   }
//   RHI_MATRIX_ON_BOTH(FurTechniqueTest, kTechniques, NameOfTechnique);
//
// SameImage(result, reference), Matches(result, oracle): exact, and kept for the report. An image of the renderer:
// FromRgba8(w, h, bytes). What cannot be exact: SameImage(a, b, Within("name")), with a row of tolerances.cpp.
// On one backend, hand each picture to TheRecorder().ReadBack(image): GL's are then compared with Vulkan's by the
// suite. Skips: RHI_NEEDS_CAP(geometryShader); GTEST_SKIP() << "no assets: " << file (AssetsFolder() of settings.h).
#pragma once

#include "comparison.h"
#include "recorder.h"
#include "rhi_fixture.h"
#include "settings.h"

namespace conformance {

inline Image FromRgba8(uint32_t width, uint32_t height, std::vector<uint8_t> bytes) {
  return {width, height, 4, std::move(bytes), Component::U8};
}

}  // namespace conformance
