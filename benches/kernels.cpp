// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Time of single kernels per pack of eight pixels.
#include "num/avx2.h"
// The number type comes first.
#include <benchmark/benchmark.h>

#include "camera/frozen_camera.h"
#include "depth/decode.h"
#include "power/phasors.h"
#include "raw/expose.h"
#include "scene/frozen_scene.h"
#include "tofray/tofray.h"
#include "trace/nearest.h"

using namespace tofray;
using F = num::F32x8;

namespace {

Camera camera() { return load_camera("pico-flexx"); }

flow::Light<F> light(const camera::PhasorView& phasors) {
  flow::Light<F> out;
  const flow::Path<F> path{F(1.5e6f), F(2.4f) + num::to_float(num::lane_index<F>()) * F(0.01f)};
  if (phasors.sums_alone != 0) {
    power::sums_of_path(phasors, power::all_of(phasors), path, out);
  } else {
    power::add_path(phasors, power::all_of(phasors), 0, path, true, out);
    power::add_up(phasors, power::all_of(phasors), out);
  }
  out.ambient_rate = F(4e5f);
  return out;
}

void philox(benchmark::State& state) {
  const num::RoundKeys keys = num::round_keys(1, 2);
  num::Uint<F> counter = num::to_uint(num::lane_index<F>());
  for (auto _ : state) {
    auto words = num::philox<F>(counter, 1, 2, 3, keys);
    benchmark::DoNotOptimize(words);
    counter = counter + num::Uint<F>(8u);
  }
}
BENCHMARK(philox);

void normal_pair(benchmark::State& state) {
  const auto words = num::philox<F>(num::to_uint(num::lane_index<F>()), 1, 2, 3, num::round_keys(1, 2));
  auto radius = words.w[0], angle = words.w[1];
  for (auto _ : state) {
    F a, b;
    num::normal_pair<F>(radius, angle, a, b);
    benchmark::DoNotOptimize(a);
    benchmark::DoNotOptimize(b);
    radius = radius + num::Uint<F>(0x9E3779B9u), angle = angle + num::Uint<F>(0xBB67AE85u);
  }
}
BENCHMARK(normal_pair);

/// One path to phasors of all modulation frequencies.
void phasors(benchmark::State& state) {
  const camera::FrozenCamera frozen(camera(), false, 7);
  for (auto _ : state) {
    auto sum = light(frozen.phasors());
    benchmark::DoNotOptimize(sum);
  }
}
BENCHMARK(phasors);

/// All raw frames of a pack; argument: as in camera::Noise.
void nine_raw_frames(benchmark::State& state) {
  camera::FrozenCamera frozen(camera(), true, 7);
  camera::SensorView sensor = frozen.sensor(0);
  sensor.noise = static_cast<camera::Noise>(state.range(0));
  const flow::Light<F> incoming = light(frozen.phasors());
  std::uint32_t frame = 0;
  for (auto _ : state) {
    auto exposure = raw::start<F>(sensor, {0, 8}, nullptr);
    for (int k = 0; k < sensor.raw_frames; ++k) {
      auto taps = raw::expose(sensor, k, incoming, frozen.phasors().orders, {frame, 0}, exposure);
      benchmark::DoNotOptimize(taps);
    }
    ++frame;
  }
}
BENCHMARK(nine_raw_frames)->Arg(0)->Arg(1)->Arg(2);

void decode(benchmark::State& state) {
  const camera::FrozenCamera frozen(camera(), true, 7);
  F difference[flow::max_raw_frames];
  for (int k = 0; k < 9; ++k) difference[k] = F(static_cast<float>(k % 4 < 2 ? 900 - 100 * k : 100 * k - 900));
  const auto ray = flow::make_ray(num::to_float(num::lane_index<F>()) * F(0.01f), F(0.1f), F(1.0f));
  for (auto _ : state) {
    benchmark::DoNotOptimize(difference);
    auto found = depth::decode<F>(frozen.decoder(), difference, F(1.0f) < F(0.0f), F(1.0f) < F(0.0f), ray, {0, 8});
    benchmark::DoNotOptimize(found);
  }
}
BENCHMARK(decode);

/// Every form of bench-primitives, without culling.
void nearest(benchmark::State& state) {
  const scene::FrozenScene frozen(load_scene("bench-primitives"), {{0.01547, 0, 0}}, 9);
  const scene::Forms forms = frozen.view().camera_still();
  trace::Culled everything{};
  trace::cull<F>(forms, nullptr, {}, everything);
  F x = num::to_float(num::lane_index<F>()) * F(0.01f);
  for (auto _ : state) {
    auto hit = trace::nearest(everything, flow::make_ray(x, F(0.05f), F(1.0f)), flow::no_hit<F>());
    benchmark::DoNotOptimize(hit);
    benchmark::DoNotOptimize(x);
  }
}
BENCHMARK(nearest);

}  // namespace
