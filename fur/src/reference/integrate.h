// The light along a ray: all crossings of fur in order of depth, up to the first skin.
#pragma once

#include <vector>

#include "cull.h"

namespace fur::reference {

struct Radiance {
  glm::dvec3 color{0};    // over the background
  double furOpacity = 0;  // 1 - exp(-tau)
  bool skin = false;
};

class Integrator {
 public:
  Integrator(const FurScene& scene, const Culler& culler, double tolerance)
      : scene_(scene),
        culler_(culler),
        tolerance_(tolerance),
        opaque_(0.01 * tolerance),
        texelsOfAStep_(tolerance < 1e-4 ? 1 : 4) {}

  // Of one thread: keeps its working memory.
  Radiance Trace(const Ray&, const glm::dvec3& background);

 private:
  // A stay within one prism; t0 < t1, h in the order of t.
  struct Segment {
    const Prism* prism;
    PrismView view;
    double t0, t1, h0, h1;
    uint32_t corners = 0;  // of corners_, once the ray is there
  };
  struct Node {
    FurPoint point;
    glm::dvec3 light{0};
    bool lit = false;
  };
  // A segment between two depths.
  struct Lane {
    const Segment* segment;
    Node from, to;
  };
  struct Step {
    double tau = 0, opacity = 0, error = 0;
    glm::dvec3 light{0};  // mean over the step, weighted by what comes through
  };

  void Collect(const Ray&, const Candidates&);
  void AddSegment(const Prism&, const PrismView&, PrismView::Interval, double tMin, double tMax);
  void Sweep();
  void Cross(std::vector<Lane>& lanes);
  void CrossOne(Lane& lane);
  void CrossTogether(std::vector<Lane>& lanes, int depth);
  void Advance(const Segment&, Node& from, Node& to, int depth);
  void Accept(double opacity, const glm::dvec3& light);
  Step Measure(const Segment&, Node& from, Node& middle, Node& to, bool last);
  Node NodeAt(const Segment&, double h);
  const glm::dvec3& Light(const Segment&, Node&) const;
  uint32_t Pieces(const Segment&, const Node& from, const Node& to) const;

  const FurScene& scene_;
  const Culler& culler_;
  double tolerance_;
  double opaque_;  // transmittance at which nothing behind matters
  double texelsOfAStep_;
  const Ray* ray_ = nullptr;
  Candidates candidates_;
  std::vector<PrismView::Interval> intervals_;
  std::vector<Segment> segments_;
  std::vector<Lane> lanes_;
  std::vector<FurCorners> corners_;
  glm::dvec3 color_{0};
  double through_ = 1;  // transmittance so far
  uint32_t nodes_ = 0;
};

}  // namespace fur::reference
