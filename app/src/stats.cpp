#include "stats.h"

#include <algorithm>

#include "fur/bench.h"

namespace app {

const char* ToString(fur::Technique technique) { return technique == fur::Technique::Seed ? "seed" : "shells"; }
const char* ToString(fur::Look look) { return look == fur::Look::Seed ? "seed" : "correct"; }
const char* ToString(fur::Semantics semantics) { return semantics == fur::Semantics::Sheet ? "sheet" : "volume"; }
const char* ToString(fur::Preset preset) {
  constexpr const char* kNames[] = {"demo-fur", "nvidia-d3d10", "gs-shells", "four-coats"};
  return kNames[size_t(preset)];
}
const char* ToString(fur::FourCoat coat) {
  constexpr const char* kNames[] = {"bear", "panther", "snow", "tiger"};
  return kNames[size_t(coat)];
}

nlohmann::ordered_json StatsJson(const RenderOutcome& out, const RenderJob& job) {
  const fur::FrameCounts& c = out.counts;
  nlohmann::ordered_json j;
  j["backend"] = out.backend;
  j["adapter"] = out.caps.adapter.data();
  j["driver"] = out.caps.driver.data();
  j["technique"] = ToString(job.settings.technique);
  if (job.settings.technique == fur::Technique::Seed) j["preset"] = ToString(job.settings.preset);
  if (job.settings.preset == fur::Preset::FourCoats) j["coat"] = ToString(job.settings.fourCoat);
  j["look"] = ToString(job.settings.look);
  j["semantics"] = ToString(job.settings.semantics);
  j["width"] = job.settings.width / job.supersample;
  j["height"] = job.settings.height / job.supersample;
  j["supersample"] = job.supersample;
  j["samples"] = job.settings.samples;
  j["skin_samples"] = std::max(job.settings.skinSamples, job.settings.samples);
  j["animals"] = job.placements.size();
  j["first_frame_ms"] = out.firstFrameMs;
  j["frame_ms"] = out.frameMs;
  j["frame_ms_median"] = fur::Median(out.frameMs);
  j["draws"] = c.draws;
  j["triangles_submitted"] = c.triangles;
  j["edges_submitted"] = c.edges;
  j["dispatches"] = c.dispatches;
  j["fragments_shaded"] = c.baseFragments + c.finFragments + c.shellFragments;
  j["fragments"] = {{"base", c.baseFragments}, {"fins", c.finFragments}, {"shells", c.shellFragments}};
  j["skipped"] = {{"animals", c.skippedAnimals}, {"edges", c.skippedEdges}, {"shells", c.skippedShells}};
  const rhi::Stats& r = out.rhiStats;
  j["rhi"] = {{"draws", r.draws}, {"pipeline_misses", r.pipelineMisses}, {"descriptor_misses", r.descriptorMisses},
              {"ring_bytes", r.ringBytes}, {"passes", r.passes}, {"pass_breaks", r.passBreaks}, {"barriers", r.barriers},
              {"redundant_sets", r.redundantSets}};
  j["messages"] = out.messages;
  return j;
}

nlohmann::ordered_json DifferenceJson(const ImageDifference& d) {
  return {{"pixels", d.pixels}, {"differing", d.differing}, {"equal_share", d.EqualShare()}, {"largest", d.largest}, {"mean", d.mean}};
}

}  // namespace app
