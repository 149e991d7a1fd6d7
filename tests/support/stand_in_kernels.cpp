// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// The pipeline on plain floats, as nvcc compiles it: for the host, and once for all programs of tests, since it takes long.
#include "backend/cuda/pixel.h"

#include <map>
#include <vector>

#include "support/stand_in_cuda.h"

namespace tofray::test {

namespace {

/// What the lanes of a warp have told each other.
struct Said {
  struct Vote {
    const void* forms;  ///< of one view, which the lanes look at through one rectangle
    std::uint32_t word;
  };
  std::map<int, pipeline::Rectangle<float>> rectangles;
  std::vector<Vote> votes;
};

/// The 32 lanes of a warp, one after the other. The rectangle that all lanes span is known only when all have been there, so each warp
/// runs twice: first to collect rectangles (with none, every form is tested), then with them. A vote is counted by the lane that comes to
/// it first.
struct HostWarp {
  Said& said;
  bool collecting;
  mutable std::size_t next = 0;  ///< where the vote that this lane comes to is likely to be

  template <class Test>
  [[nodiscard]] std::uint32_t vote(const void* forms, const Test& test) const {
    for (std::size_t i = 0; i < said.votes.size(); ++i) {
      if (next >= said.votes.size()) next = 0;
      const Said::Vote& one = said.votes[next++];
      if (one.forms == forms) return one.word;
    }
    std::uint32_t word = 0;
    for (int lane = 0; lane < backend::gpu::warp_size; ++lane) word |= static_cast<std::uint32_t>(test(lane)) << lane;
    said.votes.push_back({forms, word});
    next = said.votes.size();
    return word;
  }
  /// (Each lane is alone at that time, and a lane that goes along for another's sake changes nothing.)
  [[nodiscard]] static bool any(bool mask) { return mask; }
  void unite(int key, pipeline::Rectangle<float>& own) const {
    if (!collecting) {
      own = said.rectangles.at(key);
      return;
    }
    pipeline::Rectangle<float>& all = said.rectangles[key];
    all.open = all.open || own.open;
    all.x_min = num::min(all.x_min, own.x_min), all.x_max = num::max(all.x_max, own.x_max);
    all.y_min = num::min(all.y_min, own.y_min), all.y_max = num::max(all.y_max, own.y_max);
    own.open = true;
  }
  static int lowest_bit(std::uint32_t word) { return __builtin_ctz(word); }
};

/// All threads of a pass over images, and some more than it has units.
void run_image_pass(const backend::gpu::Launch& what, const pipeline::PassWork& work) {
  pipeline::with_pass(what.pass, [&](auto pass) {
    using P = decltype(pass);
    if constexpr (P::over != pipeline::Over::scene && !num::same<P, pipeline::FromRays>) {
      for (int i = 0; i < backend::gpu::units_of<P>(work.s) + 7; ++i) backend::gpu::run_unit<P>(work, i);
    }
  });
}

}  // namespace

void run_on_host(const backend::gpu::Launch& what, const backend::gpu::FrameArguments& common) {
  using namespace backend::gpu;
  for (int frame = 0; frame < what.batch.frames; ++frame) {
    const FrameNumber number = what.batch.numbers[frame];
    const bool owns = what.batch.own != nullptr;
    FrameArguments a = owns ? what.batch.own[frame] : common;
    if (what.pass == pipeline::pass<pipeline::DeriveScene>) {
      for (int i = 0; i < scene::unit_count(common.setup.scene, what.batch.derive) + 7; ++i) run_derive(a.setup, what.batch.derive, i);
      continue;
    }
    if (what.pass != pipeline::pass<pipeline::FromRays>) {
      if (owns) pipeline::take_image_step(what.batch.step, a.job);
      for (int i = 0; i <= flow::array_count; ++i) take_frame(number, owns ? 0 : frame * what.batch.stride, i, a.job);
      run_image_pass(what, {a.setup, a.job, &what.input, what.batch.step.item});
      continue;
    }
    if (owns) pipeline::take_step(what.batch.step, a.setup, a.job);
    for (int i = 0; i <= flow::array_count; ++i) take_frame(number, owns ? 0 : frame * what.batch.stride, i, a.job);
    for (int patch = 0; patch < patch_count(a.setup.lens); ++patch) {
      Said said;
      for (const bool collecting : {true, false}) {
        for (int lane = 0; lane < warp_size; ++lane) {
          HostWarp warp{said, collecting};
          if (owns)
            run_pixel<true>(a.setup, a.job, warp, patch, lane);
          else
            run_pixel<false>(a.setup, a.job, warp, patch, lane);
        }
      }
    }
  }
}

}  // namespace tofray::test
