// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "pipeline/external_input.h"
#include "pipeline/pass/list.h"

/// The plan of a frame: which passes it takes, in which order.
///
/// Where one look at the scene gives a pixel's light, a frame goes from rays to depth in one pass. Where a pixel's light is a sum (samples
/// within the pixel, light that bounces, what the lens scatters), it is gathered in the light image first: its ground truth, which is that of
/// the pixel's middle; its light, sample by sample; likewise what comes by several surfaces; what is scattered; then raw frames and depth
/// out of the image. Of a scene that stands still the image is good for the next frame, too.
namespace tofray::pipeline {

/// How much of the way from rays to depth a step goes.
enum class Part : std::int32_t {
  all,      ///< from rays (or what came from elsewhere) to depth
  truth,    ///< ground truth alone
  light,    ///< stages 1 and 2 into the light image
  bounce,   ///< light that has met several surfaces, into a part of the image of its own
  sum,      ///< both, for the light that reaches the sensor
  collect,  ///< stages 3 and 4 out of it
};

/// Two buffers of the light image that change places: what is written is never what is read, so that a piece may be done twice.
struct TwoBuffers {
  std::int32_t changed;  ///< 1: the front one is where the light image says that the back one is

  TOFRAY_INLINE void change() { changed = 1 - changed; }
  /// Where they are now, out of where the light image has them.
  TOFRAY_INLINE void place(float*& front, float*& back) const {
    if (changed == 0) return;
    float* const first = front;
    front = back, back = first;
  }
};

/// Which buffer of the light image is which in a step.
struct LightBuffers {
  TwoBuffers all;       ///< `values` before `before`
  TwoBuffers indirect;  ///< `indirect` before `indirect_before`
};

struct Step {
  Pass pass;
  Part part;
  std::int32_t item;  ///< which sample of the pixel, which kernel of the lens, which round of paths, whether the range is a filter's
  LightBuffers light;
};

/// Whether frames go through the light image.
TOFRAY_INLINE bool has_light_image(const Setup& s, Stage entry) {
  if (entry == Stage::depth) return false;
  return s.scatter.terms > 0 || ((s.subpixel.lens != nullptr || bounces(s, entry)) && entry == Stage::trace);
}
/// Whether arrays are wanted of what samples see that the middle of a pixel does not.
TOFRAY_INLINE bool wants_mixed(const Setup& s, const flow::FrameView& out) {
  return s.subpixel.lens != nullptr && out.gt_object_id != nullptr && (out.gt_mixed != nullptr || out.gt_object_share != nullptr);
}
TOFRAY_INLINE bool wants_truth(const flow::FrameView& out) {
#define TOFRAY_OR(name, ...) || out.name != nullptr
  return false TOFRAY_TRUTH_ARRAYS(TOFRAY_OR);
#undef TOFRAY_OR
}
/// Whether the Monte Carlo error of light that bounces is wanted.
TOFRAY_INLINE bool wants_path_noise(const Setup& s, const flow::FrameView& out, Stage entry) {
  return bounces(s, entry) && (out.gt_path_noise_m != nullptr || s.bounces.rounds > 1);
}
/// Whether what a pixel's neighbours see is wanted.
TOFRAY_INLINE bool wants_guide(const Setup& s, const flow::FrameView& out, Stage entry) {
  return wants_path_noise(s, out, entry) || (bounces(s, entry) && s.bounces.smooth != 0);
}

TOFRAY_INLINE bool wants_transient(const flow::FrameView& out) {
  return out.transient_e_per_s != nullptr || out.transient_lost_e_per_s != nullptr;
}

/// Whether a part makes the light image.
TOFRAY_INLINE bool gathers(Part part) { return part == Part::light || part == Part::bounce || part == Part::sum; }

/// Input that stands for what is in the light image.
TOFRAY_INLINE Input from_light_image(const flow::LightImage& image) {
  Input out{};
  out.entry = Stage::raw, out.moments = image.times, out.from_image = 1;
  return out;
}

/// Puts what a step over images has of its own into the settings of its frame.
TOFRAY_INLINE void take_image_step(const Step& step, Job& job) {
  step.light.all.place(job.light.values, job.light.before);
  step.light.indirect.place(job.light.indirect, job.light.indirect_before);
  if (step.part == Part::light) job.gather = {1, step.item == 0, 1.0f, 1, nullptr, nullptr};
}
/// Puts what any step has of its own into the settings of its frame, those of the pass that begins with rays included.
TOFRAY_INLINE void take_step(const Step& step, Setup& s, Job& job) {
  take_image_step(step, job);
  if (step.part == Part::truth && s.last_stage > Stage::power) s.last_stage = Stage::power;
  if (step.part != Part::light || step.pass != pass<FromRays>) return;
  if (wants_mixed(s, job.out)) job.gather.middle = job.out.gt_object_id;
  if (s.subpixel.lens != nullptr) job.gather.share = s.subpixel.share[step.item], s.lens = s.subpixel.lens[step.item];
  job.out = flow::FrameView{};
  if (job.gather.middle != nullptr) job.out.gt_object_id = job.light.object, job.out.gt_range_m = job.light.range;
}

/// Calls run(step) for each step that follows light from surface to surface, once the direct light is at the back.
/// @param known  no step is needed: the buffers end where they would
template <class Run>
TOFRAY_INLINE void each_bounce_step(const Setup& s, const Job& job, bool known, LightBuffers& light, const Run& run) {
  const int samples = s.subpixel.count, steps = s.bounces.rounds * samples;
  const bool noise = wants_path_noise(s, job.out, Stage::trace);
  for (int i = 0; i < steps; ++i) {
    if (i > 0) light.indirect.change();
    if (known) continue;
    run(Step{pass<Bounces>, Part::bounce, i, light});
    if (!noise || (i + 1) % samples != 0) continue;
    run(Step{pass<PathError>, Part::bounce, i / samples, light});
    run(Step{pass<PathNoise>, Part::bounce, i / samples, light});
  }
  if (s.bounces.smooth != 0) {
    if (!known) run(Step{pass<Smooth>, Part::bounce, 0, light});
    light.indirect.change();
  }
  if (!known) run(Step{pass<SumLight>, Part::sum, 0, light});
}

/// Calls run(step) for each step by way of the light image, from light to depth.
/// @param known  the light image is that of this frame already
template <class Run>
void each_step_by_light_image(const Setup& s, const Job& job, Stage entry, bool known, const Run& run) {
  const bool collects = s.last_stage >= Stage::raw, bouncing = bounces(s, entry);
  const bool makes = !known && (collects || entry != Stage::trace || wants_mixed(s, job.out));
  const Pass begin = entry == Stage::trace ? pass<FromRays> : pass<FromArrays>;
  LightBuffers light{};
  for (int i = 0; i < (entry == Stage::trace ? s.subpixel.count : 1); ++i) {
    if (i > 0) light.all.change();
    if (makes) run(Step{begin, Part::light, i, light});
  }
  if (bouncing) {
    light.all.change();
    each_bounce_step(s, job, !makes, light, run);
  }
  for (int i = 0; i < s.scatter.terms && collects && makes; ++i) {
    if (s.scatter.has_rows(i)) run(Step{pass<ScatterRows>, Part::light, i, light});
    run(Step{pass<ScatterColumns>, Part::light, i, light});
  }
  if (collects || wants_mixed(s, job.out)) run(Step{pass<FromArrays>, Part::collect, 0, light});
}

/// @return whether the frame takes the pass then
template <When when, class P, class Run>
bool take_at(const Setup& s, const Job& job, Stage entry, const Run& run) {
  if constexpr (requires { P::when; }) {
    if (P::when != when || !P::wanted(s, job, entry)) return false;
    run(Step{pass<P>, Part::all, 0, {}});
    return true;
  }
  return false;
}
template <When when, class Run, class... P>
bool each_pass_at(const Setup& s, const Job& job, Stage entry, const Run& run, num::List<P...>) {
  bool any = false;
  ((any = take_at<when, P>(s, job, entry, run) || any), ...);
  return any;
}
/// Calls run(step) for each pass that the frame takes then. @return whether there is one
template <When when, class Run>
bool each_pass_at(const Setup& s, const Job& job, Stage entry, const Run& run) {
  return each_pass_at<when>(s, job, entry, run, Passes{});
}

/// Calls run(step) for each step after the depth of all pixels is known.
template <class Run>
void each_step_over_depth(const Setup& s, const Job& job, Stage entry, const Run& run) {
  const auto filter = [&] {
    run(Step{pass<RangeFilter>, Part::all, 0, {}});
    run(Step{pass<WriteDepth>, Part::all, of_filter, {}});
  };
  each_pass_at<When::after_pixels>(s, job, entry, run);
  const bool first = keeps_edges(job.filter);
  if (first) filter();
  const bool flags = each_pass_at<When::over_depth>(s, job, entry, run);
  if (job.filter != FilterKind::none && !first) {
    filter();
  } else if (flags) {
    run(Step{pass<WriteDepth>, Part::all, 0, {}});
  }
}

/// Calls run(step) for each step of a frame.
/// @param entry  the first stage that is computed
/// @param known  the light image is that of this frame already
/// @param kept   light goes through the image whatever the frame, for others to begin with; once it is known, so is the truth of stages 1 and 2
template <class Run>
void each_step(const Setup& s, const Job& job, Stage entry, bool known, const Run& run, bool kept = false) {
  const bool by_image = kept || has_light_image(s, entry);
  each_pass_at<When::before_pixels>(s, job, entry, run);
  if (!by_image) {
    run(Step{entry == Stage::trace ? pass<FromRays> : pass<FromArrays>, Part::all, 0, {}});
  } else {
    if (entry == Stage::trace && wants_truth(job.out) && !(kept && known)) run(Step{pass<FromRays>, Part::truth, 0, {}});
    each_step_by_light_image(s, job, entry, known, run);
  }
  if (entry == Stage::trace && wants_transient(job.out)) run(Step{pass<TransientHistogram>, by_image ? Part::collect : Part::all, 0, {}});
  if (s.last_stage >= Stage::depth && job.out.z_m != nullptr && job.out.flags != nullptr) each_step_over_depth(s, job, entry, run);
}

}  // namespace tofray::pipeline
