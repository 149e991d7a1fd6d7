// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Compiled once per instruction set (TOFRAY_KERNEL_<SET>). It may include nothing that could leave a shared inline function behind: the
// linker might hand this object's copy of it to a machine that cannot run it. The number type comes first: templates see its functions then.
#if defined(TOFRAY_KERNEL_AVX512)
#include "num/avx512.h"
#include "num/twin.h"
#define TOFRAY_KERNEL tofray_kernel_avx512
using F = tofray::num::Twin<tofray::num::F32x16>;
#elif defined(TOFRAY_KERNEL_AVX2)
#include "num/avx2.h"
#include "num/twin.h"
#define TOFRAY_KERNEL tofray_kernel_avx2
using F = tofray::num::Twin<tofray::num::F32x8>;
#elif defined(TOFRAY_KERNEL_NEON)
#include "num/neon.h"
#include "num/twin.h"
#define TOFRAY_KERNEL tofray_kernel_neon
using F = tofray::num::Twin<tofray::num::F32x4>;
#elif defined(TOFRAY_KERNEL_SCALAR_FMA)
#define TOFRAY_KERNEL tofray_kernel_scalar_fma
using F = float;
#else
#define TOFRAY_KERNEL tofray_kernel_scalar
using F = float;
#endif

#include "backend/cpu/kernel.h"
#include "pipeline/bounce.h"
#include "pipeline/passes.h"
#include "pipeline/path_noise.h"
#include "pipeline/scatter.h"
#include "pipeline/smooth.h"
#include "pipeline/tile.h"
#include "pipeline/transient.h"

namespace tofray::backend {

namespace {

using namespace pipeline;

/// What went past the caches is there for all before the piece counts as done.
TOFRAY_FN void finish(const Work& work) {
  if (work.job->tap_stores == TapStores::past_caches) num::finish_stores<F>();
}

/// Apart, so that the compiler has one of them at a time to find registers for.
template <bool can_move>
TOFRAY_APART void run_tile(const Work& work, int index, void* scratch) {
  one_tile<F, can_move>(*work.setup, *work.job, index, scratch);
  finish(work);
}

template <class Run>
TOFRAY_FN void each_pack(const Work& work, int index, const Run& run) {
  const Tile tile = tile_at(work.setup->lens, index);
  for (int q = 0; q < max_packs<F>; ++q) {
    const Pixels p = pack_at<F>(work.setup->lens, tile, q);
    if (p.count > 0) run(p);
  }
}

void run_input(const Work& work, int index) {
  each_pack(
      work, index, [&](const Pixels& p) __attribute__((always_inline)) { enter<F>(*work.setup, *work.job, *work.input, p); });
  finish(work);
}
void run_bounces(const Work& work, int index) {
  each_pack(
      work, index, [&](const Pixels& p) __attribute__((always_inline)) { bounce_pixels<F>(*work.setup, *work.job, work.item, p); });
}
void run_path_error(const Work& work, int index) {
  each_pack(
      work,
      index, [&](const Pixels& p) __attribute__((always_inline)) { store_path_error<F>(*work.setup, work.job->light, work.item, p); });
}
void run_path_noise(const Work& work, int index) {
  each_pack(
      work,
      index, [&](const Pixels& p) __attribute__((always_inline)) { store_path_noise<F>(*work.setup, work.job->light, work.item, p); });
}
void run_smooth(const Work& work, int index) {
  each_pack(
      work, index, [&](const Pixels& p) __attribute__((always_inline)) { smooth_light<F>(*work.setup, work.job->light, p); });
}
void run_sum(const Work& work, int index) {
  each_pack(
      work, index, [&](const Pixels& p) __attribute__((always_inline)) { sum_light<F>(*work.setup, work.job->light, p); });
}

void run_transient(const Work& work, int index) {
  each_pack(
      work, index, [&](const Pixels& p) __attribute__((always_inline)) { find_transient<F>(*work.setup, *work.job, p); });
}

void run_lines(const Work& work, int k) {
  const camera::SensorView& sensor = work.setup->sensor;
  const raw::FrameIndex index{work.job->index_low, work.job->index_high};
  float* const normals = line_normals_in(*work.setup, *work.job);
  raw::draw_all_lines<F>(sensor, k, index, camera::of_column, sensor.width, normals);
  raw::draw_all_lines<F>(sensor, k, index, camera::of_row, sensor.height, normals);
}

void run_rows(const Work& work, Pass pass, int band) {
  const int height = work.setup->lens.height, first = band * rows_per_band;
  for (int y = first; y < first + rows_per_band && y < height; ++y) {
    if (pass == Pass::bloom) bloom_row(*work.setup, *work.job, y);
    if (pass == Pass::flying) flag_flying_row<F>(*work.setup, *work.job, y);
    if (pass == Pass::filter) filter_row(*work.setup, *work.job, y);
    if (pass == Pass::settle) settle_row<F>(*work.setup, *work.job, y, work.item);
    if (pass == Pass::scatter_rows || pass == Pass::scatter_columns) scatter_rows<F>(*work.setup, *work.job, pass, work.item, y);
  }
}

}  // namespace

extern "C" std::size_t TOFRAY_KERNEL(const Work* work, Pass pass, int index, void* scratch) {
  const scene::SceneView& scene = work->setup->scene;
  if (scratch == nullptr) {
    return scene.moments > 0 ? sizeof(Scratch<F, true>) + Near<true>::room_of(scene)
                             : sizeof(Scratch<F, false>) + Near<false>::room_of(scene);
  }
  switch (pass) {
    case Pass::pixels:
      if (scene.moments > 0) {
        run_tile<true>(*work, index, scratch);
      } else {
        run_tile<false>(*work, index, scratch);
      }
      break;
    case Pass::derive: break;  // the host has done it
    case Pass::lines: run_lines(*work, index); break;
    case Pass::input: run_input(*work, index); break;
    case Pass::bounces: run_bounces(*work, index); break;
    case Pass::path_error: run_path_error(*work, index); break;
    case Pass::path_noise: run_path_noise(*work, index); break;
    case Pass::smooth: run_smooth(*work, index); break;
    case Pass::sum: run_sum(*work, index); break;
    case Pass::transient: run_transient(*work, index); break;
    case Pass::bloom:
    case Pass::flying:
    case Pass::filter:
    case Pass::settle:
    case Pass::scatter_rows:
    case Pass::scatter_columns: run_rows(*work, pass, index); break;
  }
  return 0;
}

}  // namespace tofray::backend
