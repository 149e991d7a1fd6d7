// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/transient_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "base/limits.h"
#include "base/text.h"
#include "camera/readout/image_camera.h"
#include "files/json.h"
#include "files/npz.h"
#include "tofray/error.h"

namespace tofray::results {

using files::NamedArray;
using files::NpyArray;
using files::NpyShape;

namespace {

constexpr const char* own_name = "transient_e_per_s";
constexpr double most_light = 1e20;  // e⁻/s, as Transient has it

[[noreturn]] void refuse(const std::string& where, const std::string& what, const std::string& more,
                         ErrorKind kind = ErrorKind::bad_input) {
  throw Error(kind, fmt::format("{}: error: {}\n  {}", base::printable(where), what, more));
}

bool has_axes_of_histograms(const NamedArray& one) { return one.array.shape.size() == 3 || one.array.shape.size() == 4; }

/// The histograms, and what goes with them where tofray wrote the file.
struct Found {
  NamedArray histograms, ambient;
  std::string meta;
};

Found arrays_of(std::string_view file, const std::string& where) {
  Found out;
  if (where.ends_with(".npy")) {
    out.histograms = {"array", files::parse_npy(file, where)};
    return out;
  }
  for (NamedArray& one : files::parse_npz(file, where, {own_name, "gt_ambient_e_per_s", "meta"})) {
    if (one.name == own_name)
      out.histograms = std::move(one);
    else if (one.name == "meta")
      out.meta = one.array.type.kind == 'U' ? one.array.text() : "";
    else
      out.ambient = std::move(one);
  }
  if (!out.histograms.name.empty()) return out;
  std::vector<NamedArray> all = files::parse_npz(file, where);
  const auto first = std::find_if(all.begin(), all.end(), has_axes_of_histograms);
  if (first == all.end())
    refuse(where, "there are no histograms of light by path length",
           "expected transient_e_per_s (render a scene with transport.transient.bins), or an array (bin, height, width) or (height, width, "
           "bin)");
  if (const auto next = std::find_if(first + 1, all.end(), has_axes_of_histograms); next != all.end())
    refuse(where, fmt::format("arrays {} and {} might both be histograms", base::in_quotes(first->name), base::in_quotes(next->name)),
           "expected one array of three axes or four; save the one you mean alone, as with numpy.save");
  return {std::move(*first), {}, ""};
}

/// How an array's values lie.
struct Layout {
  std::size_t bins = 0;
  bool bins_last = false;
};

Layout layout_of(const NamedArray& one, const std::string& where, const camera::ImageCamera& camera) {
  const auto height = static_cast<std::size_t>(camera.sensor.height), width = static_cast<std::size_t>(camera.sensor.width);
  NpyShape shape = one.array.shape;
  const std::string name = base::in_quotes(one.name);
  if (shape.size() == 4 && shape[3] == 1) shape.pop_back();
  if (shape.size() == 4)
    refuse(where, fmt::format("array {} has {} channels", name, shape[3]),
           fmt::format("got {}; choose one, or their mean: numpy.save(\"one.npy\", array.mean(-1))", files::shape_text(one.array.shape)));
  const bool last = shape.size() == 3 && shape[0] == height && shape[1] == width;
  const bool first = shape.size() == 3 && shape[1] == height && shape[2] == width;
  if (!last && !first)
    refuse(where, fmt::format("array {} is not of the camera's size", name),
           fmt::format("got {}, expected (bins, {}, {}), ({}, {}, bins) or ({}, {}, bins, 1)\n  --set sensor.width=… and "
                       "sensor.height=… change the camera's",
                       files::shape_text(one.array.shape), height, width, height, width, height, width));
  const bool bins_last = last && !(first && one.name == own_name);
  const std::size_t bins = bins_last ? shape[2] : shape[0];
  if (bins == 0) refuse(where, fmt::format("array {} has no bins", name), fmt::format("got {}", files::shape_text(one.array.shape)));
  const auto values = static_cast<std::int64_t>(one.array.count()), most = base::limit::transient_values.value;
  if (values > most)
    refuse(where, fmt::format("array {} has too many values", name),
           fmt::format("got {}, {} values, at most {}\n  take fewer bins, each of them wider", files::shape_text(one.array.shape), values,
                       most),
           ErrorKind::limit);
  return {bins, bins_last};
}

/// A value as electrons per second.
float light_of(const NamedArray& one, const std::string& where, std::size_t i, double factor) {
  const double value = one.array.number(i), light = value * factor;
  if (light >= 0 && light <= most_light) return static_cast<float>(light);
  std::string at;
  std::size_t rest = i;
  for (std::size_t axis = one.array.shape.size(); axis-- > 0; rest /= one.array.shape[axis])
    at = fmt::format("{}{}{}", rest % one.array.shape[axis], at.empty() ? "" : ", ", at);
  refuse(where, fmt::format("array {} has a value that makes no sense", base::in_quotes(one.name)),
         fmt::format("got {} at [{}], expected light of 0 to {} electrons per second{}", value, at, most_light,
                     factor == 1 ? "" : fmt::format(" (with --factor {})", factor)));
}

void check_kind(const NamedArray& one, const std::string& where) {
  const char kind = one.array.type.kind;
  if (kind == 'f' || kind == 'i' || kind == 'u') return;
  refuse(where, fmt::format("array {} has the wrong type", base::in_quotes(one.name)),
         fmt::format("got {}, expected float32", one.array.type.name()));
}

/// A number of the bins that `meta` says.
std::optional<double> from_meta(const files::Json& meta, const char* name) {
  const files::Json* at = &meta;
  for (const char* key : {"scene", "transport", "transient", name})
    if (at = at->find(key); at == nullptr) return {};
  double value = 0;
  return at->number(value) ? std::optional(value) : std::nullopt;
}

}  // namespace

std::optional<TransientBins> transient_of_meta(const std::string& text, const std::string& where) {
  if (text.empty()) return {};
  const files::Json meta = files::parse_json(text, where + ": meta");
  const auto bins = from_meta(meta, "bins"), first = from_meta(meta, "first_m"), width = from_meta(meta, "width_m");
  if (!bins || !first || !width || !(*bins >= 1 && *bins <= 1e9)) return {};
  return TransientBins{static_cast<int>(*bins), *first, *width};
}

Transient parse_transient(std::string_view file, const std::string& where, const Camera& profile, const TransientHints& hints) {
  const camera::ImageCamera camera(profile);
  const Found found = arrays_of(file, where);
  check_kind(found.histograms, where);
  const Layout layout = layout_of(found.histograms, where, camera);
  std::optional<TransientBins> said = transient_of_meta(found.meta, where);
  if (said && said->bins != static_cast<int>(layout.bins)) said.reset();  // of other histograms
  if (!hints.width_m && !said)
    refuse(where, "the file does not say how wide the bins are",
           "say it by --width, and by --first where the first one begins: whole paths from light to camera, as in --first 2m --width 3mm");
  Transient out;
  out.width = camera.sensor.width, out.height = camera.sensor.height, out.bins = static_cast<int>(layout.bins);
  out.bin_width_m = hints.width_m ? *hints.width_m : said->width_m;
  out.first_m = hints.first_m ? *hints.first_m : said ? said->first_m : 0;
  const std::size_t values = found.histograms.array.count(), pixels = values / layout.bins;
  out.e_per_s.resize(values);
  for (std::size_t i = 0; i < values; ++i)
    out.e_per_s[layout.bins_last ? i % layout.bins * pixels + i / layout.bins : i] = light_of(found.histograms, where, i, hints.factor);
  if (const NpyShape image{static_cast<std::size_t>(out.height), static_cast<std::size_t>(out.width)};
      !found.ambient.name.empty() && found.ambient.array.shape == image) {
    check_kind(found.ambient, where);
    for (std::size_t i = 0; i < pixels; ++i) out.ambient_e_per_s.push_back(light_of(found.ambient, where, i, 1));
  }
  return out;
}

}  // namespace tofray::results
