// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "bench/bench_energy.h"

#include <fmt/core.h>

#include <chrono>
#include <memory>

#include "energy/nvml.h"
#include "energy/rapl.h"

namespace tofray::app {

namespace {

constexpr double rapl_seconds = 1, nvml_seconds = 4;
constexpr double reread_seconds = 10;  ///< far less than a counter takes to go around twice
constexpr int least_calls = 10;

FrameEnergy share_of(energy::Meter& meter, double frames) {
  const double joules = meter.joules();  // before its reason is asked for, which reading may set
  return {joules / frames, meter.what(), meter.reason()};
}

void set_json(files::Json& json, const std::string& who, const FrameEnergy& one) {
  const bool known = one.reason.empty();
  json.set(who + "_j_per_frame", known ? files::Json(one.joules) : files::Json());
  json.set(who + "_counter", known ? files::Json(one.what) : files::Json());
  json.set(who + "_not_readable", known ? files::Json() : files::Json(one.reason));
}

std::string text_of(const files::Json& json, const std::string& who, const char* name) {
  double joules = 0;
  if (!json.find(who + "_j_per_frame")->number(joules))
    return fmt::format("{} not readable here: {}", name, *json.find(who + "_not_readable")->string());
  return fmt::format("{} {:.4g} J ({})", name, joules, *json.find(who + "_counter")->string());
}

}  // namespace

Energy energy_per_frame(energy::Meter& cpu, energy::Meter* gpu, double seconds, std::uint64_t frames,
                        const std::function<void()>& simulate) {
  using Clock = std::chrono::steady_clock;
  const auto since = [](Clock::time_point then) { return std::chrono::duration<double>(Clock::now() - then).count(); };
  const bool any = cpu.readable() || (gpu != nullptr && gpu->readable());
  cpu.start();
  if (gpu != nullptr) gpu->start();
  const Clock::time_point begin = Clock::now();
  Clock::time_point last = begin;
  int calls = 0;
  while (any && (calls < least_calls || since(begin) < seconds)) {
    simulate();
    ++calls;
    if (since(last) < reread_seconds) continue;
    cpu.joules();
    if (gpu != nullptr) gpu->joules();
    last = Clock::now();
  }
  Energy out;
  const double all = static_cast<double>(frames) * calls;
  out.cpu = share_of(cpu, all);
  out.with_gpu = gpu != nullptr;
  if (gpu != nullptr) out.gpu = share_of(*gpu, all);
  return out;
}

Energy energy_per_frame(const std::string& gpu_bus_id, std::uint64_t frames, const std::function<void()>& simulate) {
  energy::Rapl cpu;
  std::unique_ptr<energy::Meter> gpu;
  if (!gpu_bus_id.empty()) gpu = std::make_unique<energy::Nvml>(gpu_bus_id);
  return energy_per_frame(cpu, gpu.get(), gpu != nullptr && gpu->readable() ? nvml_seconds : rapl_seconds, frames, simulate);
}

files::Json energy_json(const Energy& energy) {
  files::Json json = files::Json::object();
  set_json(json, "cpu", energy.cpu);
  if (energy.with_gpu) set_json(json, "gpu", energy.gpu);
  return json;
}

std::string energy_text(const files::Json& energy) {
  return text_of(energy, "cpu", "CPU") + (energy.find("gpu_j_per_frame") != nullptr ? "; " + text_of(energy, "gpu", "GPU") : "");
}

}  // namespace tofray::app
