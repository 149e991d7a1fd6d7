// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "sweep/cells.h"

#include <fmt/core.h>

#include <algorithm>
#include <map>

#include "base/limits.h"
#include "base/text.h"
#include "load/builtin.h"
#include "sweep/elements.h"
#include "tofray/error.h"
#include "tofray/load.h"

namespace tofray::sweeps {

namespace {

const std::string mode_key = "mode", profile_key = "camera.profile";

bool has_axis(const SweepRequest& request, const std::string& key) {
  return std::any_of(request.axes.begin(), request.axes.end(), [&](const SweepAxis& one) { return one.key == key; });
}

void check(const SweepRequest& request) {
  if (request.axes.empty())
    throw Error(ErrorKind::bad_input, "error: nothing varies\n  expected --vary KEY=VALUES, as in --vary illumination.0.power=0.1W:1W:10");
  for (std::size_t i = 0; i < request.axes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (request.axes[i].key == request.axes[j].key)
        throw Error(ErrorKind::bad_input,
                    fmt::format("error: --vary has {} twice\n  expected each key once; all values of a key stand in one list, a,b,c",
                                request.axes[i].key));
}

}  // namespace

Cells::Cells(const SweepRequest& request) : request_(request) {
  check(request);
  constexpr auto most = static_cast<std::uint64_t>(base::limit::sweep_cells.value);
  double product = 1;
  for (const SweepAxis& axis : request.axes) product *= static_cast<double>(axis.values.size());
  if (product > static_cast<double>(most))
    throw Error(ErrorKind::limit,
                fmt::format("error: a sweep of {:.0f} cells is too large\n  at most {} (`tofray --limits`): fewer values, or several "
                            "sweeps",
                            product, most));
  const bool by_cell = has_axis(request, profile_key);
  for (const SweepAxis& axis : request.axes) {
    count_ *= axis.values.size();
    keys_.emplace_back();
    const bool plain = !axis.numbers.empty() || axis.values == std::vector<std::string>{"true", "false"};
    if (axis.stage >= Stage::raw && (!plain || !axis.key.starts_with("camera."))) late_are_plain_ = false;
    if (axis.key.find('*') == std::string::npos)
      keys_.back() = {axis.key};
    else if (!by_cell)
      keys_.back() = elements_of(axis.key, request.inputs, load_inputs(request.inputs));
    else
      late_are_plain_ = false;
  }
}

std::size_t Cells::place(std::uint64_t cell, std::size_t axis) const {
  std::uint64_t below = 1;
  for (std::size_t i = request_.axes.size(); i-- > axis + 1;) below *= request_.axes[i].values.size();
  return cell / below % request_.axes[axis].values.size();
}

std::vector<std::uint64_t> Cells::all() const {
  std::vector<std::uint64_t> out(count_);
  for (std::uint64_t i = 0; i < count_; ++i) out[i] = i;
  return out;
}

std::vector<std::vector<std::uint64_t>> Cells::alike(const std::vector<std::uint64_t>& of, Stage stage) const {
  std::map<std::vector<std::size_t>, std::vector<std::uint64_t>> groups;
  for (const std::uint64_t cell : of) {
    std::vector<std::size_t> early;
    for (std::size_t axis = 0; axis < request_.axes.size(); ++axis)
      if (request_.axes[axis].stage < stage) early.push_back(place(cell, axis));
    groups[early].push_back(cell);
  }
  std::vector<std::vector<std::uint64_t>> out;
  for (auto& [early, cells] : groups) out.push_back(std::move(cells));
  return out;
}

std::string Cells::first_mode(std::uint64_t cell) const {
  if (!request_.inputs.mode.empty() || has_axis(request_, mode_key)) return "";
  for (std::size_t axis = 0; axis < request_.axes.size(); ++axis) {
    if (request_.axes[axis].key != profile_key) continue;
    const std::string& name = request_.axes[axis].values[place(cell, axis)];
    if (load::find_builtin(load::builtin_profiles(), name) != nullptr) return load_camera(name).mode_names.front();
  }
  return "";
}

InputRequest Cells::request_of(std::uint64_t cell) const {
  InputRequest out = request_.inputs;
  std::vector<std::pair<std::string, std::string>> open;
  for (std::size_t axis = 0; axis < request_.axes.size(); ++axis) {
    const SweepAxis& one = request_.axes[axis];
    const std::string& value = one.values[place(cell, axis)];
    if (one.key == mode_key)
      out.mode = value;
    else if (keys_[axis].empty())
      open.emplace_back(one.key, value);
    else
      for (const std::string& key : keys_[axis]) out.set.emplace_back(key, value);
  }
  // A scene's mode is one of its own camera.
  if (const std::string mode = first_mode(cell); !mode.empty()) out.set.emplace_back("camera.mode", mode);
  if (open.empty()) return out;
  const Inputs of_cell = load_inputs(out);
  const InputRequest known = out;
  for (const auto& [key, value] : open)
    for (const std::string& element : elements_of(key, known, of_cell)) out.set.emplace_back(element, value);
  return out;
}

Error Cells::in_cell(const Error& error, std::uint64_t cell) const {
  std::string what = error.what();
  while (what.ends_with("\n")) what.pop_back();
  return {error.kind(), fmt::format("{}\n  in the cell {}", what, name(cell))};
}

Inputs Cells::inputs(std::uint64_t cell) const {
  try {
    return load_inputs(request_of(cell));
  } catch (const Error& error) {
    throw in_cell(error, cell);
  }
}

Camera Cells::camera(std::uint64_t cell, const Inputs& first) const {
  if (!late_are_plain_) return inputs(cell).camera;
  CameraOptions options{request_.inputs.mode, {}, request_.inputs.root};
  for (std::size_t axis = 0; axis < request_.axes.size(); ++axis) {
    const std::string& value = request_.axes[axis].values[place(cell, axis)];
    if (request_.axes[axis].key == mode_key) options.mode = value;
    if (request_.axes[axis].stage < Stage::raw) continue;
    for (const std::string& key : keys_[axis]) options.set.emplace_back(key.substr(7), value);
  }
  try {
    return load_camera(first.scene, options);
  } catch (const Error& error) {
    throw in_cell(error, cell);
  }
}

std::string Cells::name(std::uint64_t cell) const {
  std::string out;
  for (std::size_t axis = 0; axis < request_.axes.size(); ++axis)
    out += fmt::format("{}{}={}", out.empty() ? "" : ", ", request_.axes[axis].key, request_.axes[axis].values[place(cell, axis)]);
  return out;
}

}  // namespace tofray::sweeps
