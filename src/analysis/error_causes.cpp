// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analysis/pixel_arrays.h"
#include "analysis/without_cause.h"
#include "base/calibration.h"
#include "base/readout.h"
#include "tofray/causes.h"
#include "tofray/error.h"

namespace tofray {

namespace {

constexpr double no_error = std::numeric_limits<double>::quiet_NaN();

/// Errors of z of a region's pixels, row by row; NaN where there is no depth or no truth.
struct Errors {
  std::vector<double> measured;  ///< as they are
  std::vector<double> nearest;   ///< by the cycles nearest to the truth
  std::vector<double> sigma;     ///< of z
};

/// What the range is off by whole cycles: as it was chosen, less the candidate nearest to the truth.
/// @param common_m  the range after which all cycles begin anew
double wrong_by_cycles(const PixelChain& chain, double true_range_m, double common_m) {
  const auto off = [&](double range) { return range - true_range_m - common_m * std::round((range - true_range_m) / common_m); };
  if (chain.candidates.empty()) return chain.range_m - true_range_m - off(chain.range_m);
  double best = std::numeric_limits<double>::infinity();
  for (const UnwrapCandidate& one : chain.candidates)
    if (std::abs(off(one.range_m)) < std::abs(best)) best = off(one.range_m);
  return chain.candidates.front().range_m - true_range_m - best;
}

Errors errors_of(const Frame& frame, const Camera& camera, bool noise_free, const PixelRegion& region) {
  const camera::FrozenCamera frozen(base::with_offsets(camera), true, 0);
  const camera::DecoderView& decoder = frozen.decoder();
  const PixelArrays arrays = pixel_arrays(frame);
  double least_half_wave = static_cast<double>(decoder.common_range);
  for (int i = 0; i < decoder.modulations; ++i)
    least_half_wave = std::min(least_half_wave, static_cast<double>(decoder.modulation[i].half_wave));
  Errors out;
  for (int v = region.v0; v <= region.v1; ++v)
    for (int u = region.u0; u <= region.u1; ++u) {
      const std::size_t pixel = analysis::pixel_index(arrays, u, v);
      const double z = arrays.at("z_m", pixel), true_z = arrays.at("gt_z_m", pixel);
      const double range = arrays.at("range_m", pixel), true_range = arrays.at("gt_range_m", pixel), error = z - true_z;
      out.measured.push_back(std::isfinite(error) ? error : no_error), out.nearest.push_back(out.measured.back());
      out.sigma.push_back(arrays.at("noise_m", pixel) * z / range);
      // Less than a part of a cycle is no cycle.
      if (!std::isfinite(error) || !(std::abs(range - true_range) > 0.25 * least_half_wave)) continue;
      const PixelChain chain = analysis::chain_of(arrays, camera, frozen, noise_free, u, v);
      out.nearest.back() -= wrong_by_cycles(chain, true_range, static_cast<double>(decoder.common_range)) * z / range;
    }
  return out;
}

/// Mean over the elements that are numbers.
template <class Of>
double mean_of_numbers(std::size_t count, const Of& of) {
  double sum = 0;
  int numbers = 0;
  for (std::size_t i = 0; i < count; ++i)
    if (const double value = of(i); std::isfinite(value)) sum += value, ++numbers;
  return numbers > 0 ? sum / numbers : no_error;
}

void check_region(const Camera& camera, const PixelRegion& r) {
  const base::ImageExtent image = base::image_extent(camera);
  if (r.u0 < 0 || r.v0 < 0 || r.u1 < r.u0 || r.v1 < r.v0 || r.u1 >= image.width || r.v1 >= image.height)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: the pixels {},{} to {},{} are no part of the image\n  expected columns of 0 to {} and rows "
                            "of 0 to {}, the smaller one first",
                            r.u0, r.v0, r.u1, r.v1, image.width - 1, image.height - 1));
}

}  // namespace

struct ErrorCauses::Impl {
  analysis::FrameInputs in;
  std::uint64_t index = 0;
  PixelRegion region;
  std::size_t next = 0;  ///< cause to switch off
  std::optional<Errors> all;
  Errors base;        ///< what causes are counted from: without noise once that has been switched off
  double time_s = 0;  ///< of the truth
  ErrorSplit split;

  /// @return none where it was stopped
  std::optional<Errors> simulated(const analysis::FrameInputs& of, double* truth_s = nullptr) const {
    const Frame frame = Simulator(of.scene, of.camera, of.options).frame(index);
    if (of.options.progress != nullptr && of.options.progress->stop) return {};
    if (truth_s != nullptr) *truth_s = frame.truth.time_s;
    return errors_of(frame, of.camera, of.options.noise == Noise::off, region);
  }
  void begin(Errors&& errors) {
    all = std::move(errors), base = *all;
    const std::size_t count = all->measured.size();
    split.pixels = static_cast<int>(count);
    split.valid =
        static_cast<int>(std::count_if(all->measured.begin(), all->measured.end(), [](double one) { return std::isfinite(one); }));
    split.error_m = mean_of_numbers(count, [&](std::size_t i) { return all->measured[i]; });
    split.sigma_m = std::sqrt(
        mean_of_numbers(count, [&](std::size_t i) { return std::isfinite(all->measured[i]) ? all->sigma[i] * all->sigma[i] : no_error; }));
    const double cycles = mean_of_numbers(count, [&](std::size_t i) { return all->measured[i] - all->nearest[i]; });
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) any = any || std::abs(all->measured[i] - all->nearest[i]) > 0;
    if (any) add("wrong_cycle", cycles);
  }
  void add(std::string_view cause, double error_m) { split.causes.push_back({std::string(cause), error_m}); }
  void end() {
    const auto size = [](const ErrorCause& one) { return std::isfinite(one.error_m) ? std::abs(one.error_m) : -1; };
    std::stable_sort(split.causes.begin(), split.causes.end(), [&](const ErrorCause& a, const ErrorCause& b) { return size(a) > size(b); });
    split.rest_m = split.error_m;
    for (const ErrorCause& one : split.causes)
      if (std::isfinite(one.error_m)) split.rest_m -= one.error_m;
  }
};

ErrorCauses::ErrorCauses(const Scene& scene, const Camera& camera, const SimulatorOptions& options, std::uint64_t index,
                         const PixelRegion& region)
    : impl_(std::make_unique<Impl>()) {
  check_region(camera, region);
  impl_->in = {scene, camera, options}, impl_->index = index, impl_->region = region;
  impl_->in.scene.transport.transient = {};
  SimulatorOptions& wanted = impl_->in.options;
  wanted.arrays = {"raw", "tap_a", "tap_b", "z_m", "range_m", "noise_m", "flags", "gt_z_m", "gt_range_m"};
  wanted.truth = true, wanted.last_stage = Stage::depth;
}
ErrorCauses::~ErrorCauses() = default;
ErrorCauses::ErrorCauses(ErrorCauses&&) noexcept = default;
ErrorCauses& ErrorCauses::operator=(ErrorCauses&&) noexcept = default;

bool ErrorCauses::step() {
  Impl& of = *impl_;
  const std::vector<std::string_view>& causes = analysis::causes_of_inputs();
  if (!of.all) {
    if (auto errors = of.simulated(of.in, &of.time_s)) of.begin(std::move(*errors));
    if (!of.all || of.split.valid > 0) return true;
    of.next = causes.size();
    return of.end(), false;
  }
  for (; of.next < causes.size(); ++of.next) {
    const auto off = analysis::without(causes[of.next], of.in, of.time_s);
    if (!off) continue;
    auto without = of.simulated(*off);
    if (!without) return true;
    of.add(causes[of.next],
           mean_of_numbers(of.base.nearest.size(), [&](std::size_t i) { return of.base.nearest[i] - without->nearest[i]; }));
    // Another cause off is other light, of which chance draws other counts: noise once, all else of expected values.
    if (causes[of.next++] == "noise") of.in = *off, of.base = std::move(*without);
    return true;
  }
  return of.end(), false;
}

ErrorSplit ErrorCauses::result() const { return impl_->split; }

ErrorSplit error_causes(const Scene& scene, const Camera& camera, const SimulatorOptions& options, std::uint64_t index,
                        const PixelRegion& region) {
  ErrorCauses causes(scene, camera, options, index, region);
  while (causes.step())
    if (options.progress != nullptr && options.progress->stop) break;
  return causes.result();
}

}  // namespace tofray
