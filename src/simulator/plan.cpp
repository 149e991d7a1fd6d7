// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "pipeline/plan.h"
#include "pipeline/pass/list.h"
#include "simulator/impl.h"

namespace tofray {

namespace {

using pipeline::Part;

std::string of_all(int item, int count) { return std::to_string(item + 1) + " of " + std::to_string(count); }

/// What of a pass's work a step is.
std::string part_of(const pipeline::Step& step, const pipeline::Setup& s) {
  const bool of_rows = pipeline::over_of(step.pass) == pipeline::Over::rows;
  switch (step.part) {
    case Part::truth: return "ground truth";
    case Part::light:
      return of_rows ? "kernel " + of_all(step.item, s.scatter.terms) : "light, sample " + of_all(step.item, s.subpixel.count);
    case Part::bounce:
      return step.pass == pipeline::pass<pipeline::Bounces> ? "paths, step " + of_all(step.item, s.bounces.rounds * s.subpixel.count) : "";
    case Part::collect: return "from the light image";
    case Part::all: return of_rows && step.item == pipeline::of_filter ? "what the filter left" : "";
    case Part::sum: break;
  }
  return "";
}

std::string over_of(const pipeline::Step& step) {
  switch (pipeline::over_of(step.pass)) {
    case pipeline::Over::tiles: return "tiles";
    case pipeline::Over::rows: return "bands of rows";
    case pipeline::Over::raw_frames: return "raw frames";
    case pipeline::Over::scene: break;
  }
  return "scene";
}

}  // namespace

std::vector<PlanStep> Simulator::plan() {
  Impl& impl = *impl_;
  Frame frame;
  impl.begin({0, {}, {}}, nullptr, impl.options, impl.scene.transport, frame);
  std::vector<PlanStep> out;
  pipeline::each_step(impl.setup, impl.job, Stage::trace, false, [&](const pipeline::Step& step) {
    out.push_back({pipeline::name_of(step.pass), pipeline::what_does(step.pass), part_of(step, impl.setup), over_of(step),
                   backend::pieces_of(step, impl.setup)});
  });
  return out;
}

}  // namespace tofray
