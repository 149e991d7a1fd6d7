// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "quality.h"

#include "analysis/quality_metrics.h"
#include "arrays.h"
#include "convert.h"
#include "frames.h"
#include "tofray/tofray.h"

namespace tofray::python {

namespace {

ImageRegion region_of(py::handle value) {
  ImageRegion out;
  if (value.is_none()) return out;
  const std::vector<py::object> four = items_of(value, {nullptr, "region"}, "column, row, width and height in pixels", 4);
  int* const into[] = {&out.u, &out.v, &out.width, &out.height};
  for (std::size_t i = 0; i < 4; ++i) *into[i] = static_cast<int>(from_whole(four[i], {nullptr, "region"}, i < 2 ? 0 : 1, 1'000'000));
  return out;
}

py::tuple tuple_of(const ImageRegion& region) { return py::make_tuple(region.u, region.v, region.width, region.height); }

template <class T>
T word_of(const py::dict& words, const char* name) {
  T out{};
  from_python(words[name], out, {nullptr, name});
  return out;
}

/// @param truth  a tofray.Frame whose truth is meant; None: there is none
py::tuple quality_of(const py::list& frames, const py::object& truth, const py::dict& words) {
  std::vector<Depth> depths;
  for (const py::handle one : frames) depths.push_back(frame_from_python(one)->depth);
  Depth right;
  if (!truth.is_none()) right = depth_of(frame_from_python(truth)->truth);
  QualityRequest request;
  request.region = region_of(words["region"]), request.preset = word_of<std::string>(words, "like");
  request.truth_m = word_of<double>(words, "truth_m");
  Quality found;
  {
    const py::gil_scoped_release free;
    found = quality(depths, request, right.z_m.empty() ? nullptr : &right);
  }
  py::dict metrics;
  for (const analysis::QualityMetric& one : analysis::quality_metrics()) metrics[one.name] = found.*(one.member);
  return py::make_tuple(metrics, tuple_of(found.region), to_python(found.notes));
}

py::dict dict_of(const Differences& from) {
  py::dict out;
  out["pixels"] = from.pixels;
  for (const analysis::DifferenceColumn& one : analysis::difference_columns()) out[one.name] = from.*(one.member);
  return out;
}

template <class T>
py::array_t<T> array_of_numbers(const std::vector<T>& values, const Shape& shape) {
  py::array_t<T> out(shape);
  std::copy(values.begin(), values.end(), out.mutable_data());
  return out;
}

/// @param truths  whether the truth of the one and of the other is meant, not its depth
py::dict comparison_of(const py::object& a, const py::object& b, const py::tuple& truths, const py::dict& words) {
  const auto side = [](const py::object& frame, bool truth) {
    const std::shared_ptr<Frame> one = frame_from_python(frame);
    return truth ? depth_of(one->truth) : one->depth;
  };
  const Depth of_a = side(a, truths[0].cast<bool>()), of_b = side(b, truths[1].cast<bool>());
  CompareRequest request;
  request.region = region_of(words["region"]), request.range = word_of<bool>(words, "range"),
  request.fit_shift = word_of<bool>(words, "fit_shift");
  from_python(words["distances_m"], request.distances_m, {nullptr, "distances_m"});
  request.edge_step_m = word_of<double>(words, "edge_step_m"), request.edge_px = word_of<int>(words, "edge_px");
  Comparison found;
  {
    const py::gil_scoped_release free;
    found = compare(of_a, of_b, request);
  }
  py::list distances, flags;
  for (const DifferencesAt& one : found.by_distance) {
    py::dict row = dict_of(one.of);
    row["low_m"] = one.low_m, row["high_m"] = one.high_m;
    distances.append(row);
  }
  for (const DifferencesOfFlag& one : found.by_flag) {
    py::dict row = dict_of(one.of);
    row["flag"] = one.flag, row["only_a"] = one.only_in_a, row["only_b"] = one.only_in_b;
    flags.append(row);
  }
  py::dict out;
  out["region"] = tuple_of(found.region), out["pixels"] = found.pixels, out["both"] = found.both;
  out["only_a"] = found.only_a, out["only_b"] = found.only_b, out["neither"] = found.neither, out["shift_m"] = found.shift_m;
  out["all"] = dict_of(found.all), out["flats"] = dict_of(found.flats), out["edges"] = dict_of(found.edges);
  out["by_distance"] = distances, out["by_flag"] = flags;
  out["chi2"] = found.chi2, out["chi2_error"] = found.chi2_error, out["chi2_pixels"] = found.chi2_pixels;
  out["chi2_outliers"] = found.chi2_outliers, out["amplitude_correlation"] = found.amplitude_correlation;
  out["map_m"] = array_of_numbers(found.map_m, {found.region.height, found.region.width});
  out["histogram"] = array_of_numbers(found.histogram, {static_cast<py::ssize_t>(found.histogram.size())});
  out["histogram_low_m"] = found.histogram_low_m, out["histogram_step_m"] = found.histogram_step_m;
  return out;
}

/// Frames with the depth and the truth of files. @param intrinsics  fx, fy, cx, cy, or None
py::list depths_of(const std::string& file, double unit_m, const py::object& intrinsics) {
  DepthFileOptions options;
  options.unit_m = unit_m;
  if (!intrinsics.is_none()) {
    std::array<double, 4> numbers{};
    from_python(intrinsics, numbers, {nullptr, "intrinsics"});
    options.intrinsics = numbers;
  }
  std::vector<DepthFile> found;
  {
    const py::gil_scoped_release free;
    found = load_depths(file, options);
  }
  py::list out;
  for (DepthFile& one : found) {
    auto frame = std::make_shared<Frame>();
    frame->depth = std::move(one.depth), frame->truth = std::move(one.truth);
    out.append(py::make_tuple(one.file, FrameMemory{std::move(frame)}));
  }
  return out;
}

}  // namespace

void bind_quality(py::module_& module) {
  module.def("quality", &quality_of);
  module.def("compare", &comparison_of);
  module.def("load_depths", &depths_of);
}

}  // namespace tofray::python
