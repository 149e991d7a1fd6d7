// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cpu/cpu.h"

#include <algorithm>
#include <cstdlib>
#include <thread>

#include "backend/cpu/for_each_tile.h"
#include "backend/slab.h"
#include "pipeline/pass/list.h"
#include "tofray/error.h"

namespace tofray::backend {

namespace {

/// Null where this build has no kernel of the instruction set (CMake: TOFRAY_KERNELS).
Kernel kernel_of(Isa isa) {
  switch (isa) {
#if defined(TOFRAY_HAS_AVX512)
    case Isa::avx512: return tofray_kernel_avx512;
#endif
#if defined(TOFRAY_HAS_AVX2)
    case Isa::avx2: return tofray_kernel_avx2;
#endif
#if defined(TOFRAY_HAS_SCALAR_FMA)
    case Isa::scalar_fma: return tofray_kernel_scalar_fma;
#endif
#if defined(TOFRAY_HAS_NEON)
    case Isa::neon: return tofray_kernel_neon;
#endif
    case Isa::scalar: return tofray_kernel_scalar;
    default: return nullptr;
  }
}

/// The widest that this processor has and this build has code for.
Isa best_isa() {
  Isa best = Isa::scalar;
  for (const Isa isa : isas_here) best = isa != Isa::scalar_fma && can_run(isa) ? isa : best;
  return best;
}

/// Whether a step adds a sample's light to the light image.
bool is_sample(const pipeline::Step& step) { return step.part == pipeline::Part::light && step.pass == pipeline::pass<pipeline::FromRays>; }

std::int64_t rays_of(const pipeline::Step& step, const pipeline::Setup& s) { return pipeline::rays_of(step.pass, s, step.item); }

}  // namespace

#if defined(__x86_64__)
bool processor_has(Isa isa) {
  __builtin_cpu_init();
  const bool fma = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  switch (isa) {
    case Isa::best:
    case Isa::scalar: return true;
    case Isa::scalar_fma:
    case Isa::avx2: return fma;
    case Isa::avx512:
      return fma && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") &&
             __builtin_cpu_supports("avx512vl");
    case Isa::neon: break;
  }
  return false;
}
#else
/// Nothing to ask: every 64-bit ARM has NEON, and elsewhere there is scalar code only.
bool processor_has(Isa isa) { return isa == Isa::best || std::find(isas_here.begin(), isas_here.end(), isa) != isas_here.end(); }
#endif

int pieces_of(const pipeline::Step& step, const pipeline::Setup& setup) {
  const camera::LensView& lens = setup.lens;
  switch (pipeline::over_of(step.pass)) {
    case pipeline::Over::raw_frames: return setup.sensor.raw_frames;
    case pipeline::Over::tiles: return pipeline::tile_count(lens);
    case pipeline::Over::rows: return (lens.height + pipeline::rows_per_band - 1) / pipeline::rows_per_band;
    case pipeline::Over::scene: break;
  }
  return 0;
}

bool can_run(Isa isa) { return isa == Isa::best || (kernel_of(isa) != nullptr && processor_has(isa)); }

std::string isa_name(Isa isa) {
  switch (isa) {
    case Isa::scalar: return "scalar";
    case Isa::scalar_fma: return "scalar_fma";
    case Isa::avx2: return "avx2";
    case Isa::avx512: return "avx512";
    case Isa::neon: return "neon";
    case Isa::best: break;
  }
  return "best";
}

Isa choose_isa(Isa wanted) {
  const char* named = std::getenv("TOFRAY_ISA");
  if (wanted == Isa::best && named != nullptr && *named != '\0') {
    for (const Isa isa : every_isa) {
      if (named == isa_name(isa)) wanted = isa;
    }
    if (wanted == Isa::best) {
      throw Error(ErrorKind::bad_input,
                  "error: TOFRAY_ISA=" + std::string(named) + " is unknown\n  expected scalar, scalar_fma, avx2, avx512 or neon");
    }
  }
  if (wanted == Isa::best) wanted = best_isa();
  if (!can_run(wanted)) {
    const std::string who = processor_has(wanted) ? "this build of tofray" : "this processor";
    throw Error(ErrorKind::device,
                "error: " + who + " has no " + isa_name(wanted) + "\n  leave TOFRAY_ISA unset, or choose a lesser instruction set");
  }
  return wanted;
}

struct Cpu::Threads {
  TileRunner runner;
};

Cpu::Cpu(Isa isa, int threads, FrameProgress* progress)
    : isa_(choose_isa(isa)),
      threads_(threads > 0 ? threads : static_cast<int>(std::max(1u, std::thread::hardware_concurrency()))),
      progress_(progress) {
  kernel_ = kernel_of(isa_);
}

Cpu::~Cpu() = default;

void Cpu::load(const pipeline::Setup& setup) {
  light_of_ = {};
  const Work work{&setup, nullptr, nullptr, 0};
  pool_ = std::make_unique<Threads>(Threads{TileRunner(threads_, kernel_(&work, {}, 0, nullptr))});
}

void Cpu::describe(RanOn& out) const { out.backend = "cpu", out.device = out.isa = isa_name(isa_), out.threads = threads_; }

void Cpu::for_each(int count, const std::function<void(int)>& piece) {
  pool_->runner.for_each_tile(count, [&](int i, void*) { piece(i); });
}

void Cpu::run_step(const pipeline::Step& step, const Work& work) {
  const std::int64_t rays = rays_of(step, *work.setup);
  pool_->runner.for_each_tile(pieces_of(step, *work.setup), [&](int index, void* scratch) {
    if (stopped()) return void(gave_up_ = true);
    kernel_(&work, step.pass, index, scratch);
    if (progress_ != nullptr) progress_->done += rays;
  });
}

void Cpu::run_by_tiles(const std::vector<pipeline::Step>& steps, const pipeline::Setup& setup, const pipeline::Job& job,
                       const pipeline::Input& collected) {
  if (steps.empty()) return;
  const auto samples = static_cast<std::size_t>(std::count_if(steps.begin(), steps.end(), is_sample));
  pool_->runner.for_each_tile(pieces_of(steps.front(), setup), [&](int index, void* scratch) {
    pipeline::Setup own_setup = setup;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      if (stopped()) return void(gave_up_ = true);
      const pipeline::Step& step = steps[i];
      pipeline::Job own_job = job;
      if (i == samples) own_setup.lens = setup.lens;
      pipeline::take_step(step, own_setup, own_job);
      if (i < samples) own_job.gather.begins = i == 0;
      if (i + 1 < samples) own_job.gather.next = &setup.subpixel.lens[steps[i + 1].item];
      const Work work{&own_setup, &own_job, i < samples ? nullptr : &collected, step.item};
      kernel_(&work, step.pass, index, scratch);
      if (progress_ != nullptr) progress_->done += rays_of(step, own_setup);
    }
  });
}

void Cpu::run(const pipeline::Setup& setup, const pipeline::Job& job, Own /*own*/, const pipeline::Input* input) {
  flow::LightImage image;
  const std::size_t bytes = place_light(setup, job.out, input, nullptr, image);
  const LightOrigin origin = light_origin(setup, job.out, input);
  const bool known = bytes > 0 && origin.known && origin == light_of_;
  if (bytes > 0 && !known) light_of_ = {};
  if (light_.size() < bytes) light_.resize(bytes);
  run_steps(setup, job, input, {light_.data(), known, false});
  if (bytes > 0 && !gave_up_) light_of_ = origin;
}

void Cpu::run(Batch& batch) {
  const Slab slab(batch.setup, batch.job.out, 0);
  std::vector<unsigned char> memory(slab.bytes());
  batch.job.tap_stores = pipeline::TapStores::some;  // each frame lies where the one before was
  batch.job.out = slab.view(memory.data());
  for (std::uint64_t i = batch.taken; i < batch.count; batch.taken = ++i) {
    batch.set(i, true);
    run(batch.setup, batch.job, Own::scene, nullptr);
    if (stopped()) return;  // the frame is no frame
    batch.take(i, batch.job.out);
  }
}

void Cpu::run_kept(const pipeline::Setup& setup, const pipeline::Job& job, std::vector<unsigned char>& light) {
  flow::LightImage image;
  light.resize(place_light(setup, job.out, nullptr, nullptr, image, true));
  run_steps(setup, job, nullptr, {light.data(), false, true});
}

void Cpu::run_from(const pipeline::Setup& setup, const pipeline::Job& job, const std::vector<unsigned char>& light) {
  // Steps out of an image that is known write nothing there; its pointers are those of who makes one.
  run_steps(setup, job, nullptr, {const_cast<unsigned char*>(light.data()), true, true});
}

void Cpu::run_steps(const pipeline::Setup& setup, const pipeline::Job& job, const pipeline::Input* input, const Light& light) {
  gave_up_ = false;
  flow::LightImage image;
  place_light(setup, job.out, input, light.memory, image, light.kept);
  const pipeline::Input collected = pipeline::from_light_image(image);
  const Stage entry = input == nullptr ? Stage::trace : input->entry;
  const auto each_step = [&](const auto& run) { pipeline::each_step(setup, job, entry, light.known, run, light.kept); };
  if (progress_ != nullptr) {
    std::int64_t all = 0;
    each_step([&](const pipeline::Step& step) { all += rays_of(step, setup) * pieces_of(step, setup); });
    progress_->done = 0, progress_->total = all;
  }
  std::vector<pipeline::Step> by_tiles;
  pipeline::Job with_image = job;
  with_image.light = image;
  const auto run_so_far = [&] { run_by_tiles(by_tiles, setup, with_image, collected), by_tiles.clear(); };
  each_step([&](const pipeline::Step& step) {
    const bool collects = step.part == pipeline::Part::collect && step.pass == pipeline::pass<pipeline::FromArrays>;
    if (is_sample(step) || (collects && !by_tiles.empty())) return by_tiles.push_back(step);
    run_so_far();
    if (step.part == pipeline::Part::all) return run_step(step, {&setup, &job, input, step.item});
    pipeline::Setup own_setup = setup;
    pipeline::Job own_job = with_image;
    pipeline::take_step(step, own_setup, own_job);
    run_step(step, {&own_setup, &own_job, step.part == pipeline::Part::collect ? &collected : input, step.item});
  });
  run_so_far();
}

}  // namespace tofray::backend
