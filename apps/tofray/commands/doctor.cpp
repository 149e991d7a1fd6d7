// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <sched.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "backend/cpu/cpu.h"
#include "backend/cuda/cuda.h"
#include "base/version.h"
#include "cli/commands.h"
#include "cli/console.h"
#include "cli/requests.h"
#include "files/json.h"
#include "load/load.h"
#include "results/manifest.h"
#include "tofray/error.h"
#include "tofray/mcap.h"

namespace tofray::app {

namespace {

constexpr double wall_limit_m = 1e-4;
#ifdef __clang__
constexpr const char* compiler = "clang " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

/// A wall at 1 m, without noise and harmonics, on one instruction set or on the GPU.
struct SelfTest {
  std::string isa;     ///< or "cuda"
  double worst_m = 0;  ///< largest |z - 1 m|
  std::size_t pixels = 0, valid = 0;
  bool same = true;   ///< the same z in every bit as scalar code
  std::string fault;  ///< what stopped it
  [[nodiscard]] bool good() const { return fault.empty() && same && valid == pixels && pixels > 0 && worst_m < wall_limit_m; }
};

SelfTest test_wall(Backend backend, Isa isa, const Options& wanted, std::vector<float>& scalar_z) {
  SelfTest out;
  out.isa = backend == Backend::cuda ? "cuda" : backend::isa_name(isa);
  try {
    const Scene scene = load::load_scene("card", {{"camera.illumination.0.waveform", "{kind: sine}"}});
    SimulatorOptions options;
    options.noise = Noise::off;
    options.threads = wanted.threads;
    options.isa = isa;
    options.backend = backend;
    options.device = wanted.device;
    const Frame frame = Simulator(scene, load_camera(scene), options).frame(0);
    out.pixels = frame.depth.z_m.size();
    for (const float z : frame.depth.z_m) {
      if (!std::isfinite(z)) continue;
      ++out.valid;
      out.worst_m = std::fmax(out.worst_m, std::fabs(static_cast<double>(z) - 1));
    }
    if (scalar_z.empty()) scalar_z = frame.depth.z_m;
    out.same = frame.depth.z_m == scalar_z;
  } catch (const Error& error) {
    out.fault = error.what();
  }
  return out;
}

/// A line of /proc/meminfo in bytes; 0 where there is none.
double memory_bytes(const char* key) {
  std::FILE* file = std::fopen("/proc/meminfo", "re");
  if (file == nullptr) return 0;
  char line[256];
  double bytes = 0;
  while (bytes == 0 && std::fgets(line, sizeof line, file) != nullptr) {
    const std::string text(line);
    if (text.starts_with(std::string(key) + ":"))
      bytes = 1024 * static_cast<double>(std::strtoull(line + std::string(key).size() + 1, nullptr, 10));
  }
  std::fclose(file);
  return bytes;
}

/// How many cores this process may use.
int cores_allowed() {
  cpu_set_t set;
  CPU_ZERO(&set);
  return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : static_cast<int>(std::thread::hardware_concurrency());
}

/// Where the widest code there is for this kind of processor does not run.
std::string lacking_packs() {
  for (auto isa = backend::isas_here.rbegin(); isa != backend::isas_here.rend(); ++isa) {
    if (!backend::processor_has(*isa)) continue;
    if (backend::can_run(*isa)) break;
    return fmt::format("{}: this processor has it, this build has no code for it; `./dev build` makes it: faster, with the same results",
                       backend::isa_name(*isa));
  }
  if (backend::isas_here.back() == Isa::neon)
    return "NEON: this build has no code for it; scalar code runs, several times slower, with the same results";
  return backend::can_run(Isa::avx2)
             ? "AVX-512: this processor does not have it; AVX2 code runs, with the same results"
             : "AVX2 with FMA: this processor has neither; scalar code runs, several times slower, with the same results";
}

std::vector<std::string> missing_things() {
  std::vector<std::string> missing;
  constexpr Isa widest = backend::isas_here.back();
  if (!backend::can_run(widest)) missing.emplace_back(lacking_packs());
  if (widest == Isa::scalar) missing.emplace_back("packs: tofray has scalar code only for this kind of processor, with the same results");
  if (widest == Isa::neon)
    missing.emplace_back("trials: on 64-bit ARM tofray has run under qemu alone so far; please report what this says");
  if (usual_mcap_compression() == McapCompression::none)
    missing.emplace_back("libzstd: run.mcap is written and read without compression (Debian: libzstd-dev, then build again)");
  const std::string lack = backend::why_no_cuda(-1).reason;
  if (!lack.empty()) missing.push_back("GPU: " + lack + "; the processor computes, with the same results");
  return missing;
}

std::string test_line(const SelfTest& test) {
  if (!test.fault.empty()) return fmt::format("  {:<11} FAILED: {}\n", test.isa, test.fault);
  return fmt::format("  {:<11} {}: {} of {} pixels, at most {:.4f} mm off{}\n", test.isa, test.good() ? "good" : "FAILED", test.valid,
                     test.pixels, 1e3 * test.worst_m, test.same ? "" : ", not the bits of scalar code");
}

struct Diagnosis {
  std::string isa, forced;
  std::vector<std::string> sets, gpus, missing;
  std::vector<SelfTest> tests;
  bool good = true;
};

Diagnosis diagnose(const Options& options) {
  Diagnosis out;
  const char* forced = std::getenv("TOFRAY_ISA");
  out.forced = forced == nullptr ? "" : forced;
  out.isa = backend::isa_name(backend::choose_isa(Isa::best));
  out.missing = missing_things();
  std::vector<float> scalar_z;
  for (const Isa isa : backend::isas_here) {
    if (!backend::can_run(isa)) continue;
    out.sets.push_back(backend::isa_name(isa));
    out.tests.push_back(test_wall(Backend::cpu, isa, options, scalar_z));
    out.good = out.good && out.tests.back().good();
  }
  out.gpus = backend::usable_gpus();
  if (out.gpus.empty()) return out;
  out.tests.push_back(test_wall(Backend::cuda, Isa::best, options, scalar_z));
  out.good = out.good && out.tests.back().good();
  return out;
}

std::string text_of(const Diagnosis& d) {
  std::string sets, text;
  for (const std::string& one : d.sets) sets += (sets.empty() ? "" : ", ") + one;
  text += fmt::format("tofray      {}, built with {}\n", base::version(), compiler);
  text += fmt::format("processor   {}\n", results::cpu_model());
  text += fmt::format("code        {}; in use: {}{}\n", sets, d.isa, d.forced.empty() ? "" : " (TOFRAY_ISA)");
  text += fmt::format("threads     {} cores, {} of them for this process\n", std::thread::hardware_concurrency(), cores_allowed());
  text += fmt::format("memory      {:.1f} GB, {:.1f} GB available\n", 1e-9 * memory_bytes("MemTotal"), 1e-9 * memory_bytes("MemAvailable"));
  for (const std::string& gpu : d.gpus) text += fmt::format("GPU         {}\n", gpu);
  text += "self-test   a wall at 1 m, no noise, sine: z within 0.1 mm, the same bits from every code\n";
  for (const SelfTest& test : d.tests) text += test_line(test);
  text += "missing\n";
  for (const std::string& one : d.missing) text += "  " + one + "\n";
  return text +
         (d.good ? "all good\n" : "the self-test FAILED: results on this machine cannot be trusted; please report it with this output\n");
}

files::Json json_of(const Diagnosis& d) {
  files::Json tests = files::Json::array();
  for (const SelfTest& one : d.tests)
    tests.push(files::Json::object()
                   .set("isa", one.isa)
                   .set("good", one.good())
                   .set("worst_m", one.worst_m)
                   .set("valid_pixels", one.valid)
                   .set("pixels", one.pixels)
                   .set("same_bits", one.same)
                   .set("fault", one.fault));
  files::Json json = files::Json::object();
  json.set("tofray", base::version())
      .set("compiler", compiler)
      .set("cpu", results::cpu_model())
      .set("instruction_sets", files::Json::list(d.sets))
      .set("isa", d.isa)
      .set("gpus", files::Json::list(d.gpus));
  json.set("cores", std::thread::hardware_concurrency()).set("cores_allowed", cores_allowed());
  json.set("memory_bytes", memory_bytes("MemTotal")).set("memory_available_bytes", memory_bytes("MemAvailable"));
  return json.set("self_test", std::move(tests)).set("missing", files::Json::list(d.missing)).set("good", d.good);
}

}  // namespace

int run_doctor(const Options& options) {
  const Diagnosis found = diagnose(options);
  print(options.json ? files::json_text(json_of(found), 2) + "\n" : text_of(found));
  return found.good ? 0 : 1;
}

}  // namespace tofray::app
