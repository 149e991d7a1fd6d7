// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// How long a sweep takes: sensor settings of 224 x 172 pixels, without noise, on so many threads. Best of three, since other work only adds.
//   bench_sweep [CELLS] [THREADS]
#include <tofray/tofray.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>

namespace {

void measure(const char* what, const std::string& vary, const std::vector<std::string>& metrics, tofray::Noise noise, int threads) {
  tofray::SweepRequest request;
  request.inputs.scene = "card";
  request.axes = {tofray::sweep_axis(vary, request.inputs)};
  request.metrics = metrics;
  request.simulator.noise = noise, request.simulator.threads = threads;
  double best = 1e9, processor = 0;
  tofray::Sweep found;
  for (int i = 0; i < 3; ++i) {
    const std::clock_t begin = std::clock();
    found = tofray::sweep(request);
    if (found.seconds < best) best = found.seconds, processor = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  }
  std::printf("%-44s %6.2f s, %6.2f s of processors; from rays %llu, light %llu, raw frames %llu\n", what, best, processor,
              static_cast<unsigned long long>(found.traced), static_cast<unsigned long long>(found.from_light),
              static_cast<unsigned long long>(found.from_raw));
}

}  // namespace

int main(int count, char** words) {
  const std::string cells = count > 1 ? words[1] : "1000";
  const int threads = count > 2 ? std::atoi(words[2]) : 2;
  const std::vector<std::string> few = {"bias", "sigma", "rmse", "fill"};
  using tofray::Noise;
  measure("pixel.read_noise, four metrics, no noise", "pixel.read_noise=1e:100e:" + cells, few, Noise::off, threads);
  measure("pixel.read_noise, all metrics, no noise", "pixel.read_noise=1e:100e:" + cells, {}, Noise::off, threads);
  measure("pixel.read_noise, all metrics, noise", "pixel.read_noise=1e:100e:" + cells, {}, Noise::exact, threads);
  measure("decoding.noise_threshold, all metrics, noise", "decoding.noise_threshold=5mm:100mm:" + cells, {}, Noise::exact, threads);
  measure("lens.f_number, all metrics, no noise", "lens.f_number=1:3:" + cells, {}, Noise::off, threads);
  return 0;
}
