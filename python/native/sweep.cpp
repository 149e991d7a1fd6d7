// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "sweep.h"

#include <optional>

#include "arrays.h"
#include "convert.h"
#include "interrupt.h"
#include "simulator.h"
#include "tofray/tofray.h"

namespace tofray::python {

namespace {

template <class T>
T taken(py::handle value, const char* name) {
  T out{};
  from_python(value, out, {nullptr, name});
  return out;
}
template <class T>
T swept_word(const py::dict& words, const char* name) {
  return taken<T>(words[name], name);
}

constexpr const char* stage_names[] = {"trace", "power", "raw", "depth"};

py::list axes_of(const Sweep& of) {
  py::list out;
  for (const SweepAxis& axis : of.axes)
    out.append(
        py::make_tuple(axis.key, to_python(axis.values), to_python(axis.numbers), axis.unit, stage_names[static_cast<int>(axis.stage)]));
  return out;
}

ImageRegion swept_region(py::handle value) {
  ImageRegion out;
  if (value.is_none()) return out;
  const std::vector<py::object> four = items_of(value, {nullptr, "region"}, "column, row, width and height in pixels", 4);
  int* const into[] = {&out.u, &out.v, &out.width, &out.height};
  for (std::size_t i = 0; i < 4; ++i) *into[i] = static_cast<int>(from_whole(four[i], {nullptr, "region"}, i < 2 ? 0 : 1, 1'000'000));
  return out;
}

/// @param vary  of each axis the key and its values: a text as of the command line, or a list of texts; or (key, None, list of numbers)
SweepRequest request_of(const py::dict& words, const py::list& vary, const py::dict& options) {
  SweepRequest out;
  out.inputs.scene = swept_word<std::string>(words, "scene"), out.inputs.mode = swept_word<std::string>(words, "mode");
  out.inputs.root = swept_word<std::string>(words, "root");
  from_python(words["set"], out.inputs.set, {nullptr, "set"}), from_python(words["metrics"], out.metrics, {nullptr, "metrics"});
  out.repeat = swept_word<std::uint64_t>(words, "repeat"), out.by_object = swept_word<bool>(words, "by_object");
  out.region = swept_region(words["region"]);
  out.simulator = options_from_python(options);
  for (const py::handle one : vary) {
    const auto pair = py::reinterpret_borrow<py::tuple>(one);
    const auto key = taken<std::string>(pair[0], "vary");
    if (pair.size() == 3) {
      out.axes.push_back(sweep_axis_of_numbers(key, taken<std::vector<double>>(pair[2], "vary"), out.inputs));
      continue;
    }
    out.axes.push_back(py::isinstance<py::str>(pair[1]) ? sweep_axis(key + "=" + taken<std::string>(pair[1], "vary"), out.inputs)
                                                        : sweep_axis(key, taken<std::vector<std::string>>(pair[1], "vary"), out.inputs));
  }
  return out;
}

/// @param folder  empty: nothing is written
/// @param each    called with the cells that are done and with all; None: nothing is
py::tuple sweep_of(const py::dict& words, const py::list& vary, const py::dict& options, const std::string& folder,
                   const py::object& each) {
  const SweepRequest request = request_of(words, vary, options);
  FrameProgress progress;
  std::optional<py::error_already_set> fault;
  SweepWatch watch;
  watch.progress = &progress;
  if (!each.is_none())
    watch.cell_done = [&](std::uint64_t done, std::uint64_t all) {
      const py::gil_scoped_acquire held;
      try {
        if (!fault) each(done, all);
      } catch (py::error_already_set& raised) {
        fault.emplace(raised);
        progress.stop = true;
      }
    };
  Sweep out;
  {
    const StopOnInterrupt interrupt(progress);
    const py::gil_scoped_release free;
    out = sweep(request, watch);
    if (!folder.empty() && !out.interrupted) save_sweep(out, request, folder);
  }
  if (fault) throw *fault;
  if (progress.stop && PyErr_CheckSignals() != 0) throw py::error_already_set();
  Shape shape;
  for (const SweepAxis& axis : out.axes) shape.push_back(static_cast<py::ssize_t>(axis.values.size()));
  shape.push_back(static_cast<py::ssize_t>(out.regions.size())), shape.push_back(static_cast<py::ssize_t>(out.metrics.size()));
  py::array_t<double> values(shape);
  std::copy(out.values.begin(), out.values.end(), values.mutable_data());
  py::dict counts;
  counts["traced"] = out.traced, counts["from_light"] = out.from_light, counts["from_raw"] = out.from_raw, counts["seconds"] = out.seconds;
  return py::make_tuple(axes_of(out), to_python(out.regions), to_python(out.metrics), values, counts);
}

/// @param axes  pairs of a key, its numbers (or an empty list) and its unit, and how many values it has
py::list best_of(const py::list& axes, const py::list& metrics, const py::array_t<double>& values, const std::string& wish) {
  Sweep of;
  for (const py::handle one : axes) {
    const auto axis = py::reinterpret_borrow<py::tuple>(one);
    SweepAxis& to = of.axes.emplace_back();
    to.key = taken<std::string>(axis[0], "axis"), to.values.resize(axis[3].cast<std::size_t>());
    to.numbers = taken<std::vector<double>>(axis[1], "axis"), to.unit = taken<std::string>(axis[2], "axis");
  }
  of.regions = {"all"}, of.metrics = taken<std::vector<std::string>>(metrics, "metrics");
  of.values.assign(values.data(), values.data() + values.size());
  py::list out;
  for (const std::uint64_t cell : best_cells(of, wish)) {
    py::tuple places(of.axes.size());
    for (std::size_t i = 0; i < of.axes.size(); ++i) places[i] = of.place(cell, i);
    out.append(places);
  }
  return out;
}

}  // namespace

void bind_sweep(py::module_& module) {
  module.def("sweep", &sweep_of);
  module.def("best_cells", &best_of);
  module.def("sweep_metrics", [] {
    py::list out;
    for (const SweepMetric& one : sweep_metrics()) out.append(py::make_tuple(one.name, one.what, one.at_least));
    return out;
  });
}

}  // namespace tofray::python
