// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/depth_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>

#include "base/limits.h"
#include "base/text.h"
#include "files/read_bytes.h"
#include "image/formats.h"
#include "image/read_image.h"
#include "results/file_arrays.h"
#include "run/input_kind.h"
#include "tofray/error.h"

namespace tofray {

namespace run {

namespace {

namespace fs = std::filesystem;

constexpr float no_depth = std::numeric_limits<float>::quiet_NaN();
constexpr int largest_side = 65535;

[[noreturn]] void refuse_depth(const std::string& file, const std::string& what, const std::string& more) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: error: {}\n  {}", base::printable(file), what, more));
}

std::string ending_of(const std::string& file) {
  std::string ending = fs::path(file).extension().native();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
  return ending;
}

/// A file's number as z in metres; NaN: invalid.
float z_of(double number, double unit_m) { return std::isfinite(number) && number > 0 ? static_cast<float>(number * unit_m) : no_depth; }

void set_size(DepthFile& out, std::size_t width, std::size_t height) {
  if (width == 0 || height == 0 || width > static_cast<std::size_t>(largest_side) || height > static_cast<std::size_t>(largest_side))
    refuse_depth(out.file, fmt::format("an image of {} x {} pixels is none", width, height), "expected 1 to 65535 along each side");
  out.depth.width = static_cast<int>(width), out.depth.height = static_cast<int>(height);
}

template <class T>
void take_array(const results::Arrays& arrays, const char* name, const DepthFile& of, std::size_t each, std::vector<T>& into) {
  const files::NpyArray* array = arrays.find(name);
  if (array == nullptr) return;
  files::NpyShape wanted = {static_cast<std::size_t>(of.depth.height), static_cast<std::size_t>(of.depth.width)};
  if (each > 1) wanted.push_back(each);
  if (array->type.kind == 'U' || array->shape != wanted)
    refuse_depth(of.file, fmt::format("array {} has another shape than the image", base::in_quotes(name)),
                 fmt::format("got {}, expected {}", files::shape_text(array->shape), files::shape_text(wanted)));
  into.resize(array->count());
  for (std::size_t i = 0; i < into.size(); ++i) {
    const double number = array->number(i);
    if constexpr (std::is_same_v<T, float>)
      into[i] = static_cast<float>(number);
    else
      into[i] = static_cast<T>(results::flag_bits(number));
  }
}

/// fx, fy, cx, cy of a file whose lens has no distortion.
std::optional<std::array<double, 4>> pinhole_of(const results::Arrays& arrays) {
  const files::NpyArray *matrix = arrays.find("camera_matrix"), *distortion = arrays.find("distortion");
  if (matrix == nullptr || matrix->type.kind == 'U' || matrix->count() != 9) return std::nullopt;
  for (std::size_t i = 0; distortion != nullptr && i < distortion->count(); ++i)
    if (distortion->type.kind == 'U' || distortion->number(i) != 0) return std::nullopt;
  return std::array<double, 4>{matrix->number(0), matrix->number(4), matrix->number(2), matrix->number(5)};
}

/// Points of an image of z, and the range with them, where they are not there.
void take_points(Depth& depth, const std::optional<std::array<double, 4>>& intrinsics) {
  if (!intrinsics || depth.z_m.empty() || !depth.points_m.empty()) return;
  const auto& [fx, fy, cx, cy] = *intrinsics;
  depth.points_m.resize(3 * depth.z_m.size());
  const bool ranges = depth.range_m.empty();
  if (ranges) depth.range_m.resize(depth.z_m.size());
  for (std::size_t i = 0; i < depth.z_m.size(); ++i) {
    const auto width = static_cast<std::size_t>(depth.width);
    const double z = depth.z_m[i], x = (static_cast<double>(i % width) - cx) / fx * z, y = (static_cast<double>(i / width) - cy) / fy * z;
    depth.points_m[3 * i] = static_cast<float>(x), depth.points_m[3 * i + 1] = static_cast<float>(y);
    depth.points_m[3 * i + 2] = depth.z_m[i];
    if (ranges) depth.range_m[i] = static_cast<float>(std::sqrt(x * x + y * y + z * z));
  }
}

void read_frame(DepthFile& out, const DepthFileOptions& options) {
  const results::Arrays arrays(files::read_npz(out.file), out.file);
  const files::NpyArray* z = arrays.find("z_m");
  const files::NpyArray* of_size = z != nullptr ? z : arrays.find("gt_z_m");
  if (of_size == nullptr)
    refuse_depth(
        out.file, "there is no depth in it",
        arrays.find("raw") != nullptr || arrays.find("tap_a") != nullptr
            ? fmt::format("it has raw frames; `tofray process {} -o out` makes out/frame.npz with their depth", base::printable(out.file))
            : std::string("expected z_m or gt_z_m, [height, width] in metres"));
  if (of_size->shape.size() != 2)
    refuse_depth(out.file, fmt::format("array \"{}\" is no image", z != nullptr ? "z_m" : "gt_z_m"),
                 fmt::format("got {}, expected (height, width)", files::shape_text(of_size->shape)));
  set_size(out, of_size->shape[1], of_size->shape[0]);
  Depth& depth = out.depth;
  Truth& truth = out.truth;
  take_array(arrays, "z_m", out, 1, depth.z_m), take_array(arrays, "range_m", out, 1, depth.range_m);
  take_array(arrays, "points_m", out, 3, depth.points_m), take_array(arrays, "amplitude_e", out, 1, depth.amplitude_e);
  take_array(arrays, "ambient_e", out, 1, depth.ambient_e), take_array(arrays, "noise_m", out, 1, depth.noise_m);
  take_array(arrays, "flags", out, 1, depth.flags);
  take_array(arrays, "gt_z_m", out, 1, truth.z_m), take_array(arrays, "gt_range_m", out, 1, truth.range_m);
  take_array(arrays, "gt_position_m", out, 3, truth.position_m);
  if (!truth.z_m.empty()) truth.width = depth.width, truth.height = depth.height;
  if (options.unit_m != 0 && options.unit_m != 1)
    for (float& one : depth.z_m) one = z_of(one, options.unit_m);
  take_points(depth, options.intrinsics ? options.intrinsics : pinhole_of(arrays));
}

void read_array(DepthFile& out, const DepthFileOptions& options) {
  const files::NpyArray array = files::read_npy(out.file);
  if (array.shape.size() != 2 || array.type.kind == 'U')
    refuse_depth(out.file, "this array is no image",
                 fmt::format("got {} {}, expected numbers (height, width)", array.type.name(), files::shape_text(array.shape)));
  set_size(out, array.shape[1], array.shape[0]);
  for (std::size_t i = 0; i < array.count(); ++i) out.depth.z_m.push_back(z_of(array.number(i), options.unit_m != 0 ? options.unit_m : 1));
}

void read_picture(DepthFile& out, const DepthFileOptions& options) {
  const std::string bytes = files::read_bytes(out.file, base::limit::image_bytes.value);
  if (!bytes.starts_with(image::png_signature))
    refuse_depth(out.file, "this is no PNG picture", "expected grey of 16 bits, as depth.png of `tofray render`");
  const image::Image picture = image::read(bytes, out.file);
  if (picture.channels != 1 || picture.bits != 16)
    refuse_depth(
        out.file, "this picture has no depth in it",
        fmt::format("got {} channel{} of {} bits, expected grey of 16 bits, as depth.png of `tofray render`; preview.png is for people",
                    picture.channels, picture.channels == 1 ? "" : "s", picture.bits));
  set_size(out, static_cast<std::size_t>(picture.width), static_cast<std::size_t>(picture.height));
  for (const std::uint16_t sample : picture.samples) out.depth.z_m.push_back(z_of(sample, options.unit_m != 0 ? options.unit_m : 1e-3));
}

/// A matrix: a line for each row, numbers with commas, semicolons, tabs or spaces between.
void read_matrix(DepthFile& out, const DepthFileOptions& options) {
  const std::string text = files::read_bytes(out.file, base::limit::image_bytes.value);
  const double unit_m = options.unit_m != 0 ? options.unit_m : 1;
  std::size_t width = 0, height = 0, number = 0;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string_view line(text.data() + begin, end - begin);
    begin = end + 1, ++number;
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.empty() || line.front() == '#') continue;
    const bool spaces = line.find_first_of(",;\t") == std::string_view::npos;
    std::size_t cells = 0;
    for (std::size_t at = 0; at <= line.size(); ++cells) {
      if (spaces) at = std::min(line.find_first_not_of(' ', at), line.size());
      if (spaces && at == line.size()) break;
      const std::size_t stop = std::min(line.find_first_of(spaces ? " " : ",;\t", at), line.size());
      std::string_view cell = line.substr(at, stop - at);
      while (!cell.empty() && cell.front() == ' ') cell.remove_prefix(1);
      while (!cell.empty() && cell.back() == ' ') cell.remove_suffix(1);
      double value = 0;
      const auto read = std::from_chars(cell.data(), cell.data() + cell.size(), value);
      if (!cell.empty() && (read.ec != std::errc() || read.ptr != cell.data() + cell.size()))
        throw Error(ErrorKind::bad_input,
                    fmt::format("{}:{}: error: {} is no number\n  expected a matrix of z, a line for each row of pixels, without a heading",
                                base::printable(out.file), number, base::in_quotes(cell)));
      out.depth.z_m.push_back(z_of(value, unit_m));
      at = stop + 1;
    }
    if (width == 0) width = cells;
    if (cells != width)
      throw Error(ErrorKind::bad_input, fmt::format("{}:{}: error: this row has {} numbers\n  expected {}, as many as the first one",
                                                    base::printable(out.file), number, cells, width));
    ++height;
  }
  set_size(out, width, height);
}

}  // namespace

}  // namespace run

DepthFile load_depth(const std::string& file, const DepthFileOptions& options) {
  if (!(options.unit_m >= 0 && std::isfinite(options.unit_m)))
    throw Error(ErrorKind::bad_input,
                fmt::format("error: the unit of a file cannot be {:g} m\n  expected a length above 0", options.unit_m));
  if (options.intrinsics && !((*options.intrinsics)[0] > 0 && (*options.intrinsics)[1] > 0))
    throw Error(ErrorKind::bad_input, "error: a focal length is not above 0\n  expected fx, fy, cx, cy in pixels");
  DepthFile out;
  out.file = file;
  run::refuse_missing(file);
  const std::string ending = run::ending_of(file);
  if (ending == ".npz")
    run::read_frame(out, options);
  else if (ending == ".npy")
    run::read_array(out, options);
  else if (ending == ".png")
    run::read_picture(out, options);
  else if (ending == ".csv" || ending == ".txt")
    run::read_matrix(out, options);
  else
    run::refuse_depth(file, "depth is not read of this kind of file",
                      ending == ".mcap" ? fmt::format("expected .npz, .npy, .csv, or .png of 16 bits; `tofray process {} -o out` makes "
                                                      "out/frame_0000.npz and so on of the raw frames of a film of tofray's",
                                                      base::printable(file))
                      : ending == ".ply" || ending == ".pcd"
                          ? "the points of a cloud have no pixels; expected .npz, .npy, .csv, or .png of "
                            "16 bits: frame.npz beside a cloud.ply has the same depth"
                          : "expected .npz, .npy, .csv, or .png of 16 bits");
  if (!out.depth.z_m.empty()) run::take_points(out.depth, options.intrinsics);
  return out;
}

std::vector<DepthFile> load_depths(const std::string& file_or_folder, const DepthFileOptions& options) {
  if (!run::is_folder(file_or_folder)) return {load_depth(file_or_folder, options)};
  constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
  for (const char* ending : {".npz", ".npy", ".png", ".csv"}) {
    std::vector<std::string> names = run::names_in(file_or_folder, {ending}, all);
    if (std::string(ending) == ".png")  // pictures for people and of amplitudes lie beside those of depth
      std::erase_if(names, [](const std::string& name) { return !name.starts_with("depth"); });
    if (names.empty()) continue;
    std::vector<DepthFile> out;
    for (const std::string& name : names) out.push_back(load_depth((std::filesystem::path(file_or_folder) / name).native(), options));
    return out;
  }
  run::refuse_depth(file_or_folder, "there are no frames in this folder",
                    "expected .npz, .npy, .csv, or depth*.png of 16 bits, as of `tofray render --frames 40`");
}

}  // namespace tofray
