// Which prisms and triangles a ray may meet.
#pragma once

#include <memory>
#include <vector>

#include "fur/result.h"
#include "scene.h"

namespace fur::reference {

struct Candidates {
  SkinHit skin = kNoSkin;        // the nearest: decided here, in double
  std::vector<uint32_t> prisms;  // ascending; may hold some that the ray misses
};

class Culler {
 public:
  virtual ~Culler() = default;
  virtual void Gather(const Ray&, Candidates*) const = 0;  // from any thread
};

// Embree's boxes, padded for its floats. The scene must outlive the culler.
Result<std::unique_ptr<Culler>> MakeEmbreeCuller(const FurScene&);
// Everything, always: what the other is checked against.
std::unique_ptr<Culler> MakeBruteCuller(const FurScene&);

}  // namespace fur::reference
