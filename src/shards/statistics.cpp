// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "shards/statistics.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "tofray/error.h"
#include "tofray/flags.h"

namespace tofray::shards {

namespace {

template <std::size_t n>
std::size_t bin_of(double value, double low, double step) {
  const double at = std::floor((value - low) / step);
  return static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(n - 1)));
}

constexpr double error_low_m = -Statistics::error_step_m * Statistics::error_bins / 2;

const char* flag_name(int bit) {
#define TOFRAY_NAME(name, value, ...) \
  if ((value) == (1 << bit)) return #name;
  TOFRAY_FLAGS(TOFRAY_NAME)
#undef TOFRAY_NAME
  return nullptr;
}

template <std::size_t n>
void read_counts(const files::Json* json, std::array<std::uint64_t, n>& into, bool& good) {
  good = good && json != nullptr && json->items() != nullptr && json->items()->size() == n;
  for (std::size_t i = 0; good && i < n; ++i) good = (*json->items())[i].unsigned_integer(into[i]);
}

}  // namespace

void Statistics::add(const Frame& frame) {
  ++frames;
  const std::size_t count = frame.depth.z_m.size();
  pixels += count;
  for (std::size_t i = 0; i < count; ++i) {
    const double z = frame.depth.z_m[i], truth = frame.truth.z_m[i];
    for (unsigned rest = frame.depth.flags[i], bit = 0; rest != 0; rest >>= 1, ++bit) flags[bit] += rest & 1;
    if (std::isfinite(truth)) ++true_z[bin_of<range_bins>(truth, 0, range_step_m)];
    if (!std::isfinite(z)) continue;
    ++valid;
    if (std::isfinite(truth)) ++error[bin_of<error_bins>(z - truth, error_low_m, error_step_m)];
  }
}

void Statistics::add(const Statistics& other) {
  frames += other.frames, pixels += other.pixels, valid += other.valid;
  const auto sum = [](auto& into, const auto& from) {
    std::transform(into.begin(), into.end(), from.begin(), into.begin(), std::plus<>());
  };
  sum(flags, other.flags), sum(true_z, other.true_z), sum(error, other.error);
  for (const auto& [path, counts] : other.draws) draws[path].add(counts);
}

files::Json Statistics::json() const {
  using files::Json;
  Json by_flag = Json::object();
  for (int bit = 0; bit < flag_bits; ++bit)
    if (const char* name = flag_name(bit)) by_flag.set(name, flags[static_cast<std::size_t>(bit)]);
  Json out = Json::object();
  out.set("frames", frames).set("pixels", pixels).set("valid", valid).set("flags", std::move(by_flag));
  out.set("gt_z_m", Json::object().set("low", 0.0).set("step", range_step_m).set("counts", Json::list(true_z)));
  out.set("z_error_m", Json::object().set("low", error_low_m).set("step", error_step_m).set("counts", Json::list(error)));
  Json drawn = Json::object();
  for (const auto& [path, counts] : draws)
    drawn.set(path, Json::object().set("form", counts.form).set("counts", Json::list(counts.counts)));
  return out.set("draws", std::move(drawn));
}

Statistics statistics_of(const files::Json& json, const std::string& where) {
  Statistics out;
  bool good = true;
  const auto count = [&](const files::Json* one, std::uint64_t& into) { good = good && one != nullptr && one->unsigned_integer(into); };
  count(json.find("frames"), out.frames), count(json.find("pixels"), out.pixels), count(json.find("valid"), out.valid);
  if (const files::Json* flags = json.find("flags"))
    for (int bit = 0; bit < Statistics::flag_bits; ++bit)
      if (const char* name = flag_name(bit)) count(flags->find(name), out.flags[static_cast<std::size_t>(bit)]);
  const files::Json *true_z = json.find("gt_z_m"), *error = json.find("z_error_m");
  good = good && true_z != nullptr && error != nullptr;
  if (good) read_counts(true_z->find("counts"), out.true_z, good), read_counts(error->find("counts"), out.error, good);
  if (const files::Json* draws = json.find("draws"); good && draws != nullptr && draws->is_object())
    for (const auto& [path, one] : *draws->members()) {
      const files::Json* form = one.find("form");
      good = good && form != nullptr && form->string() != nullptr;
      if (!good) break;
      out.draws[path].form = *form->string();
      read_counts(one.find("counts"), out.draws[path].counts, good);
    }
  if (!good)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: its statistics are not those that this tofray counts\n  expected a record of this version", where));
  return out;
}

}  // namespace tofray::shards
