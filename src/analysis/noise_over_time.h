// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <vector>

#include "tofray/frame.h"
#include "tofray/scene.h"

/// What depth does over frames of a still scene, pixel by pixel, in the memory of a few frames however many there are.
namespace tofray::analysis {

/// A scene in which all stands as it does at a time, the camera and meshes that change their shape, too.
Scene standing_still(const Scene& scene, double time_s);

/// Numbers of all pixels; NaN: unknown.
struct NoiseSummary {
  double fill = 0;                ///< valid pixels over all pixels, mean of the frames, 0…1
  double sigma_median_m = 0;      ///< of z over the frames, median of the pixels that are valid in two of them
  double predicted_median_m = 0;  ///< of what the camera estimates of it, of the same pixels
  double chi2 = 0;                ///< Quality::noise_chi2, its outliers counted from the mean
};

/// Takes depth frame by frame: z_m, range_m, noise_m and flags. What is valid is as in tofray/quality.h.
class NoiseOverTime {
 public:
  /// @throws Error (bad_input) where it is of another size than the first one
  void add(const Depth& depth);

  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] int frames() const { return frames_; }
  /// Of each pixel, over the frames in which it is valid: σ of z with divisor n − 1, NaN where n < 2; mean of z, NaN where n is 0; n; and
  /// the root of the mean of the squares of noise_m·z/range_m.
  [[nodiscard]] std::vector<float> sigma_m() const;
  [[nodiscard]] std::vector<float> mean_m() const;
  [[nodiscard]] std::vector<std::uint32_t> counts() const;
  [[nodiscard]] std::vector<float> predicted_m() const;
  [[nodiscard]] NoiseSummary summary() const;

 private:
  struct Pixel {
    std::uint32_t count = 0;
    double z = 0, z_squares = 0;          ///< mean of z, and squares about it
    double range = 0, range_squares = 0;  ///< mean of the range, and squares about it
    double least = 0, most = 0;           ///< range
    double claimed = 0, of_z = 0;         ///< sums of the squares of noise_m, of the range and as z
  };
  [[nodiscard]] static double sigma_of(const Pixel& pixel);
  [[nodiscard]] static double predicted_of(const Pixel& pixel);

  int width_ = 0, height_ = 0, frames_ = 0;
  std::vector<Pixel> pixels_;
};

}  // namespace tofray::analysis
