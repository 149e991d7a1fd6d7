// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "tofray/camera.h"
#include "tofray/frame.h"
#include "tofray/sweep.h"

/// What is measured of a cell's frames.
namespace tofray::sweeps {

/// Which metrics, by their places in sweep_metrics().
struct Wanted {
  std::vector<std::size_t> metrics;
  [[nodiscard]] bool has(std::size_t first, std::size_t last) const;
};
/// @throws Error (bad_input) for a name that there is not
Wanted wanted_metrics(const std::vector<std::string>& names);
/// The arrays that they are made of.
std::vector<std::string> arrays_for(const Wanted& wanted, bool by_object);
/// The place of a metric in sweep_metrics() by its name, whose unit may be left away. @throws Error (bad_input)
std::size_t metric_named(const std::string& name);

/// The numbers of one cell, frame by frame.
class Measuring {
 public:
  /// @param region   that is measured, in the image
  /// @param part_of  by Scene::objects: which part of the region its pixels are, from 1 on; empty: the region is measured as a whole alone
  Measuring(const Wanted& wanted, const Camera& camera, const ImageRegion& region, const std::vector<int>& part_of, std::uint64_t frames);
  void take(const Frame& frame);
  /// [part][wanted metric]: the whole region, then the parts of objects.
  [[nodiscard]] std::vector<double> values() const;

 private:
  /// Of a pixel over the frames, as far as it has a depth in all.
  struct Spread {
    int count = 0;
    int part = 0;
    double mean = 0, squares = 0;
  };
  struct Part {
    std::size_t pixels = 0, valid = 0, known = 0, wrong = 0;  ///< known: valid, with a truth
    std::vector<double> errors;
    double amplitude = 0, noise = 0, claimed = 0, taps = 0, codes = 0;
    std::vector<std::size_t> flagged;
  };
  void add(const Frame& frame, std::size_t pixel, Part& part) const;
  void find_filling(const Frame& frame);
  [[nodiscard]] double sigma(int part) const;
  [[nodiscard]] double number(const Part& part, std::size_t metric, double sigma) const;

  const Wanted& wanted_;
  const std::vector<int>& part_of_;
  ImageRegion region_;
  std::uint64_t frames_;
  bool filling_, errors_;
  double half_cycle_m_ = 0, full_well_e_ = 0, mid_code_ = 0, code_reach_ = 0;
  std::vector<Part> parts_;
  std::vector<float> fullest_, farthest_;  ///< by pixel of the image, of one frame
  std::vector<Spread> spread_;             ///< by pixel of the region; empty: of one frame
};

}  // namespace tofray::sweeps
