// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/results.h"

#include <fmt/core.h>

#include "backend/cuda/cuda.h"
#include "cli/console.h"
#include "pictures/pictures.h"

namespace tofray::app {

std::string gpu_of(const RanOn& machine) { return machine.backend == "cuda" ? machine.device : ""; }

std::string machine_text(const RanOn& machine) {
  if (machine.backend == "cuda") return machine.device;
  return fmt::format("{} on {} thread{}", machine.isa, machine.threads, machine.threads == 1 ? "" : "s");
}

void say_fallback(const Options& options, const RanOn& machine, Remarks& remarks) {
  const std::string& reason = machine.fallback_reason;
  if (reason.empty() || (!options.backend && !backend::why_no_cuda(options.device).gpu_present)) return;
  remarks.tell(fmt::format("note: the processor computes, not a GPU: {}\n", reason));
}

const std::vector<std::string>& flag_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (int bit = 0; const pictures::FlagRow* const row = pictures::flag_of_bit(bit); ++bit) all.emplace_back(row->words);
    return all;
  }();
  return names;
}

std::vector<std::string> names_of_flags(unsigned flags) {
  std::vector<std::string> out;
  for (std::size_t bit = 0; bit < flag_names().size(); ++bit)
    if ((flags >> bit & 1u) != 0) out.push_back(flag_names()[bit]);
  return out;
}

std::string depth_text(const Validity& of, const char* which) {
  const InvalidPixels& pixels = of.pixels;
  const std::int64_t off = pixels.valid_on_wrong_cycle + pixels.wrapped;
  const std::string invalid = of.reasons.empty() ? "" : "; invalid: " + of.reasons;
  if (!of.has_light && pixels.valid > 0)
    return fmt::format("{} of {} pixels {}have a depth, of noise alone{}\n", pixels.valid, pixels.pixels, which, invalid);
  if (off == 0) return fmt::format("{} of {} pixels {}have a depth{}\n", pixels.valid, pixels.pixels, which, invalid);
  return fmt::format("{} of {} pixels {}have a depth that is right, {} one that is whole cycles off{}\n", pixels.valid - off, pixels.pixels,
                     which, off, invalid);
}

}  // namespace tofray::app
