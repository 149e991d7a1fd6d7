// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/enter.h"
#include "pipeline/setup.h"

/// What is done to a frame, step by step, each over all its pixels before the next begins.
///
/// Where one look at the scene gives a pixel's light, a frame goes from rays to depth in one pass. Where a pixel's light is a sum (samples
/// within the pixel, light that bounces, what the lens scatters), it is gathered in the light image first: its ground truth, which is that of
/// the pixel's middle; its light, sample by sample; likewise what comes by several surfaces; what is scattered; then raw frames and depth
/// out of the image. Of a scene that stands still the image is good for the next frame, too.
namespace tofray::pipeline {

enum class Part : std::int32_t {
  all,      ///< from rays (or what came from elsewhere) to depth
  truth,    ///< ground truth alone
  light,    ///< stages 1 and 2 into the light image
  bounce,   ///< light that has met several surfaces, into a part of the image of its own
  sum,      ///< both, for the light that reaches the sensor
  collect,  ///< stages 3 and 4 out of it
};

struct Step {
  Pass pass;
  Part part;
  std::int32_t item;     ///< which sample of the pixel, which kernel of the lens, which round of paths, whether the range is a filter's
  std::int32_t swapped;  ///< 1: the light image's `values` are where `before` is said to be
  std::int32_t turned;   ///< 1: its `indirect` is where `indirect_before` is said to be
};

/// Whether frames go through the light image.
TOFRAY_FN bool has_light_image(const Setup& s, Stage entry) {
  if (entry == Stage::depth) return false;
  return s.scatter.terms > 0 || ((s.subpixel.lens != nullptr || bounces(s, entry)) && entry == Stage::trace);
}
/// … and whether anybody wants to know what samples see that the middle of a pixel does not.
TOFRAY_FN bool wants_mixed(const Setup& s, const flow::FrameView& out) {
  return s.subpixel.lens != nullptr && out.gt_object_id != nullptr && (out.gt_mixed != nullptr || out.gt_object_share != nullptr);
}
TOFRAY_FN bool wants_truth(const flow::FrameView& out) {
#define TOFRAY_OR(name, ...) || out.name != nullptr
  return false TOFRAY_TRUTH_ARRAYS(TOFRAY_OR);
#undef TOFRAY_OR
}
/// Whether anybody wants to know how well light that bounces is known, …
TOFRAY_FN bool wants_path_noise(const Setup& s, const flow::FrameView& out, Stage entry) {
  return bounces(s, entry) && (out.gt_path_noise_m != nullptr || s.bounces.rounds > 1);
}
/// … and what a pixel's neighbours see.
TOFRAY_FN bool wants_guide(const Setup& s, const flow::FrameView& out, Stage entry) {
  return wants_path_noise(s, out, entry) || (bounces(s, entry) && s.bounces.smooth != 0);
}

TOFRAY_FN bool wants_transient(const flow::FrameView& out) {
  return out.transient_e_per_s != nullptr || out.transient_lost_e_per_s != nullptr;
}

/// Whether a part makes the light image.
TOFRAY_FN bool gathers(Part part) { return part == Part::light || part == Part::bounce || part == Part::sum; }

/// Input that stands for what is in the light image.
TOFRAY_FN Input from_light_image(const flow::LightImage& image) {
  Input out{};
  out.entry = Stage::raw, out.moments = image.times, out.from_image = 1;
  return out;
}

/// Puts what a step has of its own into the settings of its frame: of passes over images …
TOFRAY_FN void take_image_step(const Step& step, Job& job) {
  const auto swap = [](float*& a, float*& b) __attribute__((always_inline)) {
    float* const first = a;
    a = b, b = first;
  };
  if (step.swapped != 0) swap(job.light.before, job.light.values);
  if (step.turned != 0) swap(job.light.indirect_before, job.light.indirect);
  if (step.part == Part::light) job.gather = {1, step.item == 0, 1.0f, nullptr};
}
/// … and of the pass that begins with rays.
TOFRAY_FN void take_step(const Step& step, Setup& s, Job& job) {
  take_image_step(step, job);
  if (step.part == Part::truth && s.last_stage > Stage::power) s.last_stage = Stage::power;
  if (step.part != Part::light || step.pass != Pass::pixels) return;
  if (wants_mixed(s, job.out)) job.gather.middle = job.out.gt_object_id;
  if (s.subpixel.lens != nullptr) job.gather.share = s.subpixel.share[step.item], s.lens = s.subpixel.lens[step.item];
  job.out = flow::FrameView{};
  if (job.gather.middle != nullptr) job.out.gt_object_id = job.light.object, job.out.gt_range_m = job.light.range;
}

/// Calls run(step) for each step that follows light from surface to surface, once the direct light is where `before` is.
/// @param swapped  for that to be so
/// @return what `turned` is afterwards
template <class Run>
TOFRAY_FN int each_bounce_step(const Setup& s, const Job& job, bool known, int swapped, const Run& run) {
  const int samples = s.subpixel.count, steps = s.bounces.rounds * samples;
  const bool noise = wants_path_noise(s, job.out, Stage::trace);
  int turned = (steps - 1) % 2;
  if (!known) {
    for (int i = 0; i < steps; ++i) {
      run(Step{Pass::bounces, Part::bounce, i, swapped, i % 2});
      if (!noise || (i + 1) % samples != 0) continue;
      run(Step{Pass::path_error, Part::bounce, i / samples, swapped, i % 2});
      run(Step{Pass::path_noise, Part::bounce, i / samples, swapped, i % 2});
    }
    if (s.bounces.smooth != 0) run(Step{Pass::smooth, Part::bounce, 0, swapped, turned});
  }
  if (s.bounces.smooth != 0) turned = 1 - turned;
  if (!known) run(Step{Pass::sum, Part::sum, 0, swapped, turned});
  return turned;
}

/// The image filter, and its range to z, points and confidence.
template <class Run>
void each_filter_step(const Run& run) {
  run(Step{Pass::filter, Part::all, 0, 0, 0});
  run(Step{Pass::settle, Part::all, of_filter, 0, 0});
}

/// Calls run(step) for each step of a frame.
/// @param entry  the first stage that is computed
/// @param known  the light image is that of this frame already
/// @param kept   light goes through the image whatever the frame, for others to begin with; once it is known, so is the truth of stages 1 and 2
template <class Run>
void each_step(const Setup& s, const Job& job, Stage entry, bool known, const Run& run, bool kept = false) {
  const Pass begin = entry == Stage::trace ? Pass::pixels : Pass::input;
  const bool exposes = s.last_stage >= Stage::raw && entry != Stage::depth;
  if (exposes && raw::draws_lines(s.sensor)) run(Step{Pass::lines, Part::all, 0, 0, 0});
  if (!kept && !has_light_image(s, entry)) {
    run(Step{begin, Part::all, 0, 0, 0});
  } else {
    if (entry == Stage::trace && wants_truth(job.out) && !(kept && known)) run(Step{begin, Part::truth, 0, 0, 0});
    const bool collects = s.last_stage >= Stage::raw, bouncing = bounces(s, entry);
    const int samples = entry == Stage::trace ? s.subpixel.count : 1;
    // The last sample's is where `values` is; where light bounces, that is all of it in the end, and the direct light where `before` is.
    const int swapped = bouncing ? samples % 2 : (samples - 1) % 2;
    const bool makes = !known && (collects || entry != Stage::trace || wants_mixed(s, job.out));
    for (int i = 0; i < samples && makes; ++i) run(Step{begin, Part::light, i, i % 2, 0});
    const int turned = bouncing ? each_bounce_step(s, job, !makes, swapped, run) : 0;
    for (int i = 0; i < s.scatter.terms && collects && makes; ++i) {
      if (s.scatter.has_rows(i)) run(Step{Pass::scatter_rows, Part::light, i, swapped, turned});
      run(Step{Pass::scatter_columns, Part::light, i, swapped, turned});
    }
    if (collects || wants_mixed(s, job.out)) run(Step{Pass::input, Part::collect, 0, swapped, turned});
  }
  if (entry == Stage::trace && wants_transient(job.out))
    run(Step{Pass::transient, kept || has_light_image(s, entry) ? Part::collect : Part::all, 0, 0, 0});
  if (s.last_stage < Stage::depth || job.out.z_m == nullptr || job.out.flags == nullptr) return;
  if (s.sensor.blooms != 0 && entry != Stage::depth) run(Step{Pass::bloom, Part::all, 0, 0, 0});
  const bool first = keeps_edges(job.filter), check = s.decoder.flying_check != 0;
  if (first) each_filter_step(run);
  if (check) run(Step{Pass::flying, Part::all, 0, 0, 0});
  if (job.filter != Filter::none && !first) {
    each_filter_step(run);
  } else if (check) {
    run(Step{Pass::settle, Part::all, 0, 0, 0});
  }
}

}  // namespace tofray::pipeline
