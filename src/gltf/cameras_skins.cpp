// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Cameras and skins.
#include <fmt/core.h>

#include <cmath>
#include <limits>

#include "base/text.h"
#include "gltf/reading.h"

namespace tofray::gltf {
namespace {

constexpr double smallest = std::numeric_limits<double>::min(), largest = std::numeric_limits<double>::max();
constexpr double pi = 3.141592653589793;

/// A number that has to be there and above 0.
double positive(const Item& item, std::string_view key, double most = largest) {
  if (!item.has(key)) item.fail_at(key, "is missing", "expected a number above 0");
  return item.number_within(key, smallest, most, 0);
}

void read_far(const Item& item, Camera& camera) {
  camera.zfar_m = item.number("zfar");
  if (camera.zfar_m && !(*camera.zfar_m > camera.znear_m))
    item.fail_at("zfar", "is not beyond znear",
                 "got " + base::number_text(*camera.zfar_m) + ", and znear is " + base::number_text(camera.znear_m));
}

void read_perspective(const Item& item, Camera& camera, Notices& notices) {
  camera.yfov_rad = positive(item, "yfov");
  if (camera.yfov_rad >= pi)
    notices.add("cameras whose yfov is half a turn or more (in degrees?) are taken for where they stand: the lens is that of the sensor");
  if (item.has("aspectRatio")) camera.aspect_ratio = positive(item, "aspectRatio");
  camera.znear_m = positive(item, "znear");
  read_far(item, camera);
}

void read_orthographic(const Item& item, Camera& camera) {
  camera.xmag = positive(item, "xmag");
  camera.ymag = positive(item, "ymag");
  if (!item.has("znear")) item.fail_at("znear", "is missing", "expected a number of 0 or more");
  camera.znear_m = item.number_within("znear", 0, largest, 0);
  if (!item.has("zfar")) item.fail_at("zfar", "is missing", "expected a number above znear");
  read_far(item, camera);
}

constexpr Wanted wanted_matrices{"MAT4", nullptr, written::real, "MAT4 of floats"};

/// Numbers of a column-major 4 × 4 matrix whose last row is 0 0 0 1, but for what rounding does to it.
Matrix affine(const Item& user, std::string_view key, const float* columns, std::size_t joint) {
  constexpr float rounding = 1e-4F;
  for (std::size_t column = 0; column < 4; ++column)
    if (!(std::abs(columns[4 * column + 3] - (column == 3 ? 1.F : 0.F)) <= rounding))
      user.fail_at(key, "has a matrix whose last row is not 0 0 0 1", fmt::format("it is that of joint {}", joint));
  Matrix out{};
  for (std::size_t row = 0; row < 3; ++row)
    for (std::size_t column = 0; column < 4; ++column) out[row][column] = columns[4 * column + row];
  return out;
}

Skin read_skin(Reading& reading, const Item& item, std::size_t nodes) {
  Skin skin;
  skin.name = item.name();
  skin.joints = item.indices("joints", nodes, "nodes");
  if (skin.joints.empty()) item.fail_at("joints", "are missing", "expected at least one node");
  skin.skeleton = item.index("skeleton", nodes, "nodes");
  skin.inverse_bind.assign(skin.joints.size(), identity);
  constexpr std::string_view key = "inverseBindMatrices";
  const int accessor = item.index(key, reading.accessors.size(), "accessors");
  if (accessor == none) return skin;
  if (reading.accessors[accessor].count < skin.joints.size())
    item.fail_at(key, "has too few matrices",
                 fmt::format("got {}, and there are {} joints", reading.accessors[accessor].count, skin.joints.size()));
  const Floats all = reading.accessors.finite_floats(accessor, wanted_matrices, item);
  for (std::size_t i = 0; i < skin.joints.size(); ++i) skin.inverse_bind[i] = affine(item, key, all->data() + 16 * i, i);
  return skin;
}

}  // namespace

void read_cameras(Reading& reading) {
  for (const Item& item : reading.root.objects("cameras")) {
    Camera& camera = reading.model.cameras.emplace_back();
    camera.name = item.name();
    const std::string_view type = item.required_text("type");
    camera.perspective = type == "perspective";
    if (!camera.perspective && type != "orthographic")
      item.fail_at("type", "is none of a camera", "got " + base::in_quotes(type) + ", expected perspective or orthographic");
    if (camera.perspective)
      read_perspective(item.required_object("perspective"), camera, reading.notices);
    else
      read_orthographic(item.required_object("orthographic"), camera);
  }
}

void read_skins(Reading& reading) {
  const std::size_t nodes = reading.root.size("nodes");
  for (const Item& item : reading.root.objects("skins")) reading.model.skins.push_back(read_skin(reading, item, nodes));
}

}  // namespace tofray::gltf
