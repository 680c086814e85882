#include "cull.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace fur::reference {
namespace {

// The scene is brought into the unit ball, where Embree's rays, origins and boxes are off by some 1e-7 each.
constexpr double kPad = 1e-5;

struct Box {
  glm::dvec3 min{std::numeric_limits<double>::infinity()}, max{-std::numeric_limits<double>::infinity()};
  void Add(const glm::dvec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
};

// h and h^k are both within 0..1.
Box BoxOf(const Prism& prism) {
  Box box;
  for (size_t i = 0; i < 3; ++i)
    for (const auto& [h, g] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}})
      box.Add(prism.p[i] + prism.a[i] * double(h) + prism.c[i] * double(g));
  return box;
}

Box BoxOf(const SkinTriangle& t) {
  Box box;
  for (const glm::dvec3& p : t.p) box.Add(p);
  return box;
}

// Embree keeps the context of a ray: ours carries what is collected.
struct RayContext {
  RTCIntersectContext context;
  const Ray* ray;
  Candidates* candidates;
  double start, scale;  // of Embree's ray: where it begins on ours, its units in ours
};

class EmbreeCuller final : public Culler {
 public:
  explicit EmbreeCuller(const FurScene& scene) : scene_(scene) {
    Fit();
    device_ = rtcNewDevice(nullptr);
    if (!device_) return;
    rtc_ = rtcNewScene(device_);
    rtcSetSceneFlags(rtc_, RTC_SCENE_FLAG_ROBUST);
    Attach(scene.Prisms().size(), PrismBounds, VisitPrism);
    Attach(scene.SkinTriangles().size(), SkinBounds, VisitSkin);
    rtcCommitScene(rtc_);
  }
  ~EmbreeCuller() override {
    if (rtc_) rtcReleaseScene(rtc_);
    if (device_) rtcReleaseDevice(device_);
  }
  EmbreeCuller(const EmbreeCuller&) = delete;
  EmbreeCuller& operator=(const EmbreeCuller&) = delete;
  RTCError Error() const { return device_ ? rtcGetDeviceError(device_) : rtcGetDeviceError(nullptr); }
  bool Made() const { return device_ != nullptr; }

  void Gather(const Ray& ray, Candidates* candidates) const override {
    candidates->skin = kNoSkin;
    candidates->prisms.clear();
    // The part of the ray within the ball.
    const glm::dvec3 from = (ray.origin - center_) / radius_;
    const double middle = -glm::dot(from, ray.direction), apart = glm::length(from + ray.direction * middle);
    if (!(apart < 1.01)) return;
    const double half = std::sqrt(1.0201 - apart * apart);
    const double first = std::max(middle - half, 0.0), last = middle + half;
    if (last <= first) return;
    RayContext context{{}, &ray, candidates, first * radius_, radius_};
    rtcInitIntersectContext(&context.context);
    const glm::vec3 origin(from + ray.direction * first), direction(ray.direction);
    RTCRayHit hit{};
    hit.ray = {origin.x, origin.y, origin.z, 0, direction.x, direction.y, direction.z, 0, float(last - first),
               ~0u, 0, 0};
    hit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(rtc_, &context.context, &hit);
    std::sort(candidates->prisms.begin(), candidates->prisms.end());
  }

 private:
  void Fit() {
    Box box;
    for (const Prism& p : scene_.Prisms()) Add(BoxOf(p), &box);
    for (const SkinTriangle& t : scene_.SkinTriangles()) Add(BoxOf(t), &box);
    center_ = (box.min + box.max) * 0.5;
    const double radius = glm::length(box.max - box.min) * 0.5;
    radius_ = radius > 0 && std::isfinite(radius) ? radius : 1;
  }
  static void Add(const Box& b, Box* box) {
    box->Add(b.min);
    box->Add(b.max);
  }

  void Attach(size_t count, RTCBoundsFunction bounds, RTCIntersectFunctionN visit) {
    RTCGeometry g = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(g, uint32_t(count));
    rtcSetGeometryUserData(g, this);
    rtcSetGeometryBoundsFunction(g, bounds, nullptr);
    rtcSetGeometryIntersectFunction(g, visit);
    rtcCommitGeometry(g);
    rtcAttachGeometry(rtc_, g);
    rtcReleaseGeometry(g);
  }

  void SetBounds(const Box& box, RTCBounds* out) const {
    const glm::vec3 low((box.min - center_) / radius_ - kPad), high((box.max - center_) / radius_ + kPad);
    *out = {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
  }
  static void PrismBounds(const RTCBoundsFunctionArguments* args) {
    const auto& self = *static_cast<const EmbreeCuller*>(args->geometryUserPtr);
    self.SetBounds(BoxOf(self.scene_.Prisms()[args->primID]), args->bounds_o);
  }
  static void SkinBounds(const RTCBoundsFunctionArguments* args) {
    const auto& self = *static_cast<const EmbreeCuller*>(args->geometryUserPtr);
    self.SetBounds(BoxOf(self.scene_.SkinTriangles()[args->primID]), args->bounds_o);
  }
  static void VisitPrism(const RTCIntersectFunctionNArguments* args) {
    reinterpret_cast<RayContext*>(args->context)->candidates->prisms.push_back(args->primID);
  }
  // Skin that is met ends the search, a little behind it.
  static void VisitSkin(const RTCIntersectFunctionNArguments* args) {
    const auto& self = *static_cast<const EmbreeCuller*>(args->geometryUserPtr);
    auto& context = *reinterpret_cast<RayContext*>(args->context);
    SkinHit& skin = context.candidates->skin;
    const double before = skin.t;
    Intersect(self.scene_.SkinTriangles()[args->primID], args->primID, *context.ray, &skin);
    if (skin.t >= before) return;
    RTCRay& ray = reinterpret_cast<RTCRayHit*>(args->rayhit)->ray;
    ray.tfar = std::min(ray.tfar, float((skin.t - context.start) / context.scale + kPad));
  }

  const FurScene& scene_;
  RTCDevice device_ = nullptr;
  RTCScene rtc_ = nullptr;
  glm::dvec3 center_{0};
  double radius_ = 1;
};

class BruteCuller final : public Culler {
 public:
  explicit BruteCuller(const FurScene& scene) : scene_(scene) {}
  void Gather(const Ray& ray, Candidates* candidates) const override {
    candidates->skin = kNoSkin;
    candidates->prisms.clear();
    for (uint32_t i = 0; i < scene_.SkinTriangles().size(); ++i)
      Intersect(scene_.SkinTriangles()[i], i, ray, &candidates->skin);
    for (uint32_t i = 0; i < scene_.Prisms().size(); ++i) candidates->prisms.push_back(i);
  }

 private:
  const FurScene& scene_;
};

}  // namespace

Result<std::unique_ptr<Culler>> MakeEmbreeCuller(const FurScene& scene) {
  auto culler = std::make_unique<EmbreeCuller>(scene);
  if (const RTCError error = culler->Error(); !culler->Made() || error != RTC_ERROR_NONE)
    return fur::Error{ErrorCode::Internal, "Embree failed with error " + std::to_string(int(error))};
  return std::unique_ptr<Culler>(std::move(culler));
}

std::unique_ptr<Culler> MakeBruteCuller(const FurScene& scene) { return std::make_unique<BruteCuller>(scene); }

}  // namespace fur::reference
