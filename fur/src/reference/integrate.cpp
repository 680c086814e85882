#include "integrate.h"

#include <algorithm>
#include <cmath>

namespace fur::reference {
namespace {

constexpr double kUnseen = 0.01;         // of the tolerance: less than this of a step's light is left out
constexpr double kFaint = 16;           // times the tolerance: what a faint step shows
constexpr int kMostSplits = 40;
constexpr uint32_t kMostNodes = 1u << 22;  // of one ray: noise is not worth more
constexpr double kSameDepth = 1e-12;     // relative: walls of neighbours

}  // namespace

Radiance Integrator::Trace(const Ray& ray, const glm::dvec3& background) {
  ray_ = &ray;
  color_ = glm::dvec3(0);
  through_ = 1;
  nodes_ = 0;
  culler_.Gather(ray, &candidates_);
  Collect(ray, candidates_);
  Sweep();
  Radiance out;
  out.skin = candidates_.skin.Found();
  out.furOpacity = 1 - through_;
  const bool shows = out.skin && through_ > opaque_;
  out.color = color_ + (shows ? scene_.Shade(candidates_.skin, ray) : background) * through_;
  return out;
}

void Integrator::Collect(const Ray& ray, const Candidates& candidates) {
  segments_.clear();
  const double tMax = std::min(ray.tMax, candidates.skin.t);
  for (const uint32_t index : candidates.prisms) {
    const Prism& prism = scene_.Prisms()[index];
    PrismView view(prism, ray);
    intervals_.clear();
    view.Intervals(&intervals_);
    if (!intervals_.empty()) view.FindNormals();
    for (const PrismView::Interval& interval : intervals_) AddSegment(prism, view, interval, ray.tMin, tMax);
  }
  std::stable_sort(segments_.begin(), segments_.end(), [](const Segment& a, const Segment& b) { return a.t0 < b.t0; });
}

void Integrator::AddSegment(const Prism& prism, const PrismView& view, PrismView::Interval i, double tMin, double tMax) {
  PrismView::Point from = view.At(i.h0), to = view.At(i.h1);
  // At an end all three edge functions may vanish.
  const double inset = (i.h1 - i.h0) * 1e-9;
  if (!from.valid) from = view.At(i.h0 += inset);
  if (!to.valid) to = view.At(i.h1 -= inset);
  if (!from.valid || !to.valid) return;
  Segment s{&prism, view, from.t, to.t, i.h0, i.h1, 0};
  if (s.t0 > s.t1) {
    std::swap(s.t0, s.t1);
    std::swap(s.h0, s.h1);
  }
  if (!(s.t0 < tMax && s.t1 > tMin)) return;
  if (s.t0 < tMin) {
    s.h0 = view.Solve(tMin, s.h0, s.h1);
    s.t0 = tMin;
  }
  if (s.t1 > tMax) {
    s.h1 = view.Solve(tMax, s.h0, s.h1);
    s.t1 = tMax;
  }
  segments_.push_back(s);
}

// Between two neighbouring ends of segments the same segments are crossed at once: one, or several where fur overlaps.
void Integrator::Sweep() {
  std::vector<Lane>& lanes = lanes_;
  lanes.clear();
  corners_.clear();
  size_t next = 0;
  double t = 0;
  while (through_ > opaque_ && (next < segments_.size() || !lanes.empty())) {
    if (lanes.empty()) t = segments_[next].t0;
    const double same = kSameDepth * std::max(1.0, std::abs(t));
    for (; next < segments_.size() && segments_[next].t0 <= t + same; ++next) {
      segments_[next].corners = uint32_t(corners_.size());
      corners_.push_back(scene_.LightingOf(*segments_[next].prism));
      lanes.push_back({&segments_[next], NodeAt(segments_[next], segments_[next].h0), {}});
    }
    double end = next < segments_.size() ? segments_[next].t0 : lanes[0].segment->t1;
    for (const Lane& lane : lanes) end = std::min(end, lane.segment->t1);
    for (Lane& lane : lanes) {
      const Segment& s = *lane.segment;
      lane.to = NodeAt(s, s.t1 <= end + same ? s.h1 : s.view.Solve(end, lane.from.point.h, s.h1));
    }
    Cross(lanes);
    t = end;
    std::erase_if(lanes, [&](const Lane& lane) { return lane.segment->t1 <= end + same; });
    for (Lane& lane : lanes) lane.from = lane.to;
  }
}

void Integrator::Cross(std::vector<Lane>& lanes) {
  if (lanes.size() == 1) {
    CrossOne(lanes[0]);
  } else if (!lanes.empty()) {
    std::vector<Lane> copy = lanes;
    CrossTogether(copy, 0);
  }
}

// As many steps as keep texels apart.
uint32_t Integrator::Pieces(const Segment& s, const Node& from, const Node& to) const {
  const double texels = scene_.Texels(*s.prism, from.point, to.point);
  return uint32_t(std::clamp(std::ceil(texels / texelsOfAStep_), 1.0, 1e6));
}

// The volume is smooth between the middles of slices: cut there, then by texels.
void Integrator::CrossOne(Lane& lane) {
  const uint32_t slices = scene_.Slices(*lane.segment->prism);
  const double h0 = lane.from.point.h, h1 = lane.to.point.h;
  const bool rising = h1 > h0;
  double h = h0;
  Node from = lane.from;
  while (h != h1 && through_ > opaque_) {
    // The next middle (j + 1/2) / n beyond h.
    const double z = h * slices - 0.5;
    const double middle = ((rising ? std::floor(z + 1e-9) + 1 : std::ceil(z - 1e-9) - 1) + 0.5) / slices;
    const double next = rising ? std::min(middle, h1) : std::max(middle, h1);
    Node to = next == h1 ? lane.to : NodeAt(*lane.segment, next);
    const uint32_t pieces = Pieces(*lane.segment, from, to);
    Node* start = &from;
    Node ends[2];
    for (uint32_t i = 1; i <= pieces && through_ > opaque_; ++i) {
      Node* const end = i == pieces ? &to : &ends[i % 2];
      if (i < pieces) *end = NodeAt(*lane.segment, h + (next - h) * i / pieces);
      Advance(*lane.segment, *start, *end, 0);
      start = end;
    }
    from = to;
    h = next;
  }
}

Integrator::Node Integrator::NodeAt(const Segment& s, double h) {
  ++nodes_;
  return {scene_.Read(*s.prism, s.view, h), glm::dvec3(0), false};
}

const glm::dvec3& Integrator::Light(const Segment& s, Node& node) const {
  if (!node.lit) {
    node.light = scene_.Shade(*s.prism, corners_[s.corners], node.point, *ray_);
    node.lit = true;
  }
  return node.light;
}

// Simpson's rule for the optical depth. The light is a mean with the weights that Simpson's rule gives to s exp(-tau), tau
// at the middle being that of the parabola through the three points: exact for constant light, of fourth order else.
Integrator::Step Integrator::Measure(const Segment& s, Node& from, Node& middle, Node& to, bool last) {
  Step step;
  const double width = std::abs(to.point.h - from.point.h);
  const double s0 = from.point.density, s1 = middle.point.density, s2 = to.point.density;
  step.tau = width / 6 * (s0 + 4 * s1 + s2);
  if (!(step.tau > 0)) return step;
  step.opacity = -std::expm1(-step.tau);
  // The midpoint rule is the other opinion.
  step.error = std::abs(step.opacity + std::expm1(-width * s1));
  if (through_ * step.error > tolerance_ && !last) return step;  // will be halved: no light yet
  const double half = std::clamp(width / 24 * (5 * s0 + 8 * s1 - s2), 0.0, step.tau);
  const std::array<double, 3> weights{s0, 4 * s1 * std::exp(-half), s2 * (1 - step.opacity)};
  const double sum = weights[0] + weights[1] + weights[2];
  // Light that hardly shows is not computed: the middle's alone where the whole step is faint.
  const double shows = through_ * step.opacity;
  const bool faint = shows < kFaint * tolerance_ && weights[1] > sum / 2;
  const double least = sum * (faint ? 0.5 : std::min(0.3, kUnseen * tolerance_ / shows));
  double used = 0;
  Node* const nodes[] = {&from, &middle, &to};
  for (size_t i = 0; i < 3; ++i) {
    if (!(weights[i] > 0) || weights[i] < least) continue;
    const glm::dvec3& light = Light(s, *nodes[i]);
    step.light += light * weights[i];
    used += weights[i];
  }
  step.light /= used;
  if (middle.lit) {
    const glm::dvec3 off = glm::abs(step.light - middle.light);
    step.error += step.opacity * std::max(off.x, std::max(off.y, off.z));
  }
  return step;
}

void Integrator::Accept(double opacity, const glm::dvec3& light) {
  color_ += light * (through_ * opacity);
  through_ *= 1 - opacity;
}

void Integrator::Advance(const Segment& s, Node& from, Node& to, int depth) {
  if (through_ <= opaque_) return;
  Node middle = NodeAt(s, (from.point.h + to.point.h) / 2);
  const bool last = depth == kMostSplits || nodes_ > kMostNodes;
  const Step step = Measure(s, from, middle, to, last);
  if (through_ * step.error > tolerance_ && !last) {
    Advance(s, from, middle, depth + 1);
    Advance(s, middle, to, depth + 1);
    return;
  }
  Accept(step.opacity, step.light);
}

// Overlapping fur is a mixture: depths add, and each shines by its share.
void Integrator::CrossTogether(std::vector<Lane>& lanes, int depth) {
  if (through_ <= opaque_) return;
  const bool last = depth == kMostSplits || nodes_ > kMostNodes;
  double tau = 0, error = 0;
  glm::dvec3 light(0), least(1e300), most(-1e300);
  uint32_t pieces = 1;
  for (Lane& lane : lanes) {
    const uint32_t slices = scene_.Slices(*lane.segment->prism);
    const double crossed = std::abs(lane.to.point.h - lane.from.point.h) * slices;
    pieces = std::max({pieces, Pieces(*lane.segment, lane.from, lane.to), uint32_t(std::ceil(crossed))});
  }
  if (pieces == 1 || last) {
    for (Lane& lane : lanes) {
      Node middle = NodeAt(*lane.segment, (lane.from.point.h + lane.to.point.h) / 2);
      const Step step = Measure(*lane.segment, lane.from, middle, lane.to, last);
      error += step.error;
      if (step.tau == 0) continue;
      tau += step.tau;
      light += step.light * step.tau;
      least = glm::min(least, step.light);
      most = glm::max(most, step.light);
    }
    // Within a step the shares are taken as even: what that is off by goes with the square of the depth.
    const glm::dvec3 apart = most - least;
    if (tau > 0) error += std::min(1.0, tau * tau / 8) * std::max(apart.x, std::max(apart.y, apart.z));
  }
  if (!last && (pieces > 1 || through_ * error > tolerance_)) {
    const double t = (lanes[0].from.point.t + lanes[0].to.point.t) / 2;
    std::vector<Lane> first = lanes, second = lanes;
    for (size_t i = 0; i < lanes.size(); ++i) {
      const Segment& s = *lanes[i].segment;
      first[i].to = NodeAt(s, s.view.Solve(t, lanes[i].from.point.h, lanes[i].to.point.h));
      second[i].from = first[i].to;
    }
    CrossTogether(first, depth + 1);
    CrossTogether(second, depth + 1);
    return;
  }
  if (tau > 0) Accept(-std::expm1(-tau), light / tau);
}

}  // namespace fur::reference
