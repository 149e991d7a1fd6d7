// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <memory>

#include "analysis/image_geometry.h"
#include "backend/cpu/cpu.h"
#include "base/readout.h"
#include "bench/bench.h"
#include "cli/progress.h"
#include "cli/requests.h"

namespace tofray::app {

namespace {

/// A pair that differs in one thing.
struct Pair {
  std::string name;
  run::Loaded a_in, b_in;
  SimulatorOptions a, b;
  bool rate = false;  ///< ratio of pixel rates, not of times
  Places a_places = Places::same, b_places = Places::same;
};

/// The scene with its first object that is no plane on the move: what moves is traced anew for each raw frame.
run::Loaded moving(run::Loaded in) {
  for (Object& object : in.scene.objects) {
    if (std::holds_alternative<Plane>(object.shape)) continue;
    object.velocity_m_per_s = {0.1, 0, -0.5};
    break;
  }
  in.scene.name += "+motion";
  return in;
}

/// The camera's view on 640 x 480 pixels.
run::Loaded enlarged(run::Loaded in) {
  in.camera = analysis::image_camera(in.camera);
  Sensor& sensor = in.camera.sensor;
  Lens& lens = in.camera.lens;
  const double x = 640.0 / sensor.width, y = 480.0 / sensor.height;
  lens.fx_px *= x, lens.fy_px *= y;
  lens.cx_px = (lens.cx_px + 0.5) * x - 0.5, lens.cy_px = (lens.cy_px + 0.5) * y - 0.5;
  sensor.pixel_pitch_m /= x;
  sensor.width = 640, sensor.height = 480;
  in.scene.name += "+640x480";
  return in;
}

SimulatorOptions with(SimulatorOptions base, Isa isa, int threads, Noise noise) {
  base.isa = isa, base.threads = threads, base.noise = noise;
  return base;
}

std::vector<Pair> pairs_of(const Options& options, const run::Loaded& in) {
  SimulatorOptions base = bench_options(options);
  base.backend = Backend::cpu;
  const Isa best = backend::choose_isa(Isa::best);
  const std::string vector = backend::isa_name(best);
  const Isa plain = backend::can_run(Isa::scalar_fma) ? Isa::scalar_fma : Isa::scalar;
  const auto one = [&](Noise noise) { return with(base, best, 1, noise); };
  const SimulatorOptions standard = one(base.noise);
  std::vector<Pair> pairs;
  pairs.push_back(
      {fmt::format("time: {} / {}, 1 thread", backend::isa_name(plain), vector), in, in, with(base, plain, 1, base.noise), standard});
  pairs.push_back({"time: 1 thread / 2 threads", in, in, standard, with(base, best, 2, base.noise)});
  pairs.push_back({"time: noise exact / off", in, in, one(Noise::exact), one(Noise::off)});
  pairs.push_back({"time: one object moves / nothing moves", moving(in), in, standard, standard});
  const base::ImageExtent image = base::image_extent(in.camera);
  pairs.push_back(
      {fmt::format("pixels per second: 640 x 480 / {} x {}", image.width, image.height), enlarged(in), in, standard, standard, true});
  pairs.push_back({"time: each frame to another place / to the same", in, in, standard, standard, false, Places::others});
  pairs.push_back({fmt::format("pixels per second, to other places: 640 x 480 / {} x {}", image.width, image.height), enlarged(in), in,
                   standard, standard, true, Places::others, Places::others});
  return pairs;
}

}  // namespace

std::vector<Ratio> compare(const Options& options, const std::string& scene, files::Json& results) {
  const run::Loaded in = run::load(input_request(scene, options));
  const std::uint64_t frames = options.frames.value_or(30);
  const std::vector<Pair> pairs = pairs_of(options, in);
  std::vector<Ratio> ratios;
  Progress progress(pairs.size() * (frames + options.warmup), "pairs of frames", options.json);
  for (const Pair& pair : pairs) {
    Contender a(pair.a_in, pair.a, pair.a_places), b(pair.b_in, pair.b, pair.b_places);
    for (std::uint64_t i = 0; i < frames + options.warmup; ++i) {
      a.step(i >= options.warmup);
      b.step(i >= options.warmup);
      progress.step();
    }
    ratios.push_back({pair.name, pair.rate ? a.pixel_rate() / b.pixel_rate() : a.median_ms() / b.median_ms()});
    results.push(a.result());
    results.push(b.result());
  }
  return ratios;
}

}  // namespace tofray::app
