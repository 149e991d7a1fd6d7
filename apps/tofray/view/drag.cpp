// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/drag.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <variant>

#include "analysis/image_geometry.h"
#include "analysis/stand.h"
#include "analysis/tessellation.h"
#include "base/constants.h"
#include "base/readout.h"
#include "base/rotation.h"
#include "base/text.h"
#include "base/units.h"
#include "model/row.h"
#include "tofray/error.h"
#include "tofray/simulator.h"

namespace tofray::view {

namespace {

using base::Mat3;
using base::operator+, base::operator-, base::operator*;

[[noreturn]] void refuse(const std::string& what, const std::string& more) {
  throw Error(ErrorKind::bad_input, "error: " + what + "\n  " + more);
}

Vec3 vec3(const analysis::Vec& a) { return {a.x, a.y, a.z}; }
Mat3 mat3(const shape::Mat& m) { return {vec3(m.row[0]), vec3(m.row[1]), vec3(m.row[2])}; }
Mat3 product(const Mat3& a, const Mat3& b) {
  const Mat3 columns = base::transposed(b);
  Mat3 out{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) out[i][k] = base::dot(a[i], columns[k]);
  return out;
}

/// What people type rather than all digits of a double.
double to_micrometre(double m) { return std::round(m * 1e6) / 1e6 + 0.0; }
Vec3 to_micrometre(const Vec3& a) { return {to_micrometre(a[0]), to_micrometre(a[1]), to_micrometre(a[2])}; }
double to_nine_digits(double value) {
  const std::string text = fmt::format("{:.9g}", value);
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}
Quaternion to_nine_digits(const Quaternion& q) {
  Quaternion out{};
  for (std::size_t i = 0; i < 4; ++i) out[i] = std::round(q[i] * 1e9) / 1e9 + 0.0;
  return out;
}

template <std::size_t n>
std::string list_text(const std::array<double, n>& values) {
  std::string out = "[";
  for (std::size_t i = 0; i < n; ++i) out += (i == 0 ? "" : ", ") + base::number_text(values[i] + 0.0);
  return out + "]";
}
std::string metres(double value) { return base::number_text(value) + " m"; }
std::string short_text(const Vec3& m) { return fmt::format("{:.6g} {:.6g} {:.6g}", m[0] + 0.0, m[1] + 0.0, m[2] + 0.0); }
std::string short_text(const Quaternion& q) {
  const double sine = std::hypot(q[0], q[1], q[2]), angle = 2 * std::atan2(sine, q[3]) * 360 / base::two_pi;
  if (!(sine > 0)) return "rotation 0 deg";
  return fmt::format("rotation {:.4g} deg about {:.3g} {:.3g} {:.3g}", angle, q[0] / sine + 0.0, q[1] / sine + 0.0, q[2] / sine + 0.0);
}

/// Adds a key to what is set, so that it holds whatever else the list has.
void add(Moved& to, const Overrides& set, const std::string& key, std::string text) {
  const auto within = [](const std::string& one, const std::string& of) { return one.size() > of.size() && one.starts_with(of + "."); };
  bool there = false, covered = false;
  for (const auto& [one, value] : set) {
    if (one == key) there = true, covered = false;
    if (within(one, key)) to.unsets.push_back(one);
    if (there && within(key, one)) covered = true;
  }
  if (covered) to.unsets.push_back(key);
  to.sets.emplace_back(key, std::move(text));
}

std::string called(const Object& object) { return object.name.empty() ? object.key : base::in_quotes(object.name); }
std::string key_of(const Object& object, const char* key) { return object.key + "." + analysis::kind_of(object) + "." + key; }

const Object& object_of(const SceneAt& at, int index) {
  if (index < 0 || static_cast<std::size_t>(index) >= at.scene.objects.size())
    refuse("the scene has no object " + std::to_string(index),
           "expected 0 to " + std::to_string(static_cast<long>(at.scene.objects.size()) - 1) + ", as gt_object_id and view3d number them");
  return at.scene.objects[static_cast<std::size_t>(index)];
}

const Object& movable_of(const SceneAt& at, int index) {
  const Object& object = object_of(at, index);
  if (const std::string why = why_fixed(object); !why.empty()) refuse(called(object) + " cannot be moved by hand", why);
  return object;
}

void set_position(Moved& to, const SceneAt& at, const Object& object, const Vec3& position) {
  add(to, at.set, key_of(object, "position"), list_text(position));
  to.what = fmt::format("position {} m", short_text(position));
}
void set_rotation(Moved& to, const SceneAt& at, const Object& object, const Quaternion& rotation) {
  add(to, at.set, key_of(object, "rotation"), "{quaternion: " + list_text(rotation) + "}");
  to.what += (to.what.empty() ? "" : ", ") + short_text(rotation);
}

/// The rotation that the file has to say, so that the object is turned like this at the time.
Quaternion rotation_before(const Object& object, double time_s, const Mat3& turned) {
  return base::quaternion_of(product(base::transposed(mat3(analysis::gone_by(object, time_s).turn)), turned));
}

/// The camera's axes in the world, as columns.
Mat3 camera_axes(const SceneAt& at) {
  const auto m = camera_pose(at.scene, at.time_s);
  return {{{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}}};
}

/// The ray of a place in the image: x, y, 1 in the camera's frame.
Vec3 ray_of(const Camera& camera, double u, double v) {
  const auto direction = analysis::direction_through(camera, u, v);
  if (!direction)
    refuse(fmt::format("the lens sees nothing at pixel {:g},{:g}", u, v), "the cursor has to be where the picture is not empty");
  return {(*direction)[0], (*direction)[1], 1};
}

/// The point in the camera's frame that the drag took.
Vec3 taken_at(const SceneAt& at, const Truth& truth, const Drag& drag, const Object& object) {
  if (drag.from_u >= truth.width || drag.from_v >= truth.height)
    refuse(fmt::format("pixel {},{} is outside the image", drag.from_u, drag.from_v),
           fmt::format("expected columns of 0 to {} and rows of 0 to {}", truth.width - 1, truth.height - 1));
  const std::size_t pixel =
      static_cast<std::size_t>(drag.from_v) * static_cast<std::size_t>(truth.width) + static_cast<std::size_t>(drag.from_u);
  const std::int32_t shows = truth.object_id[pixel];
  const bool same = shows >= 0 && static_cast<std::size_t>(shows) < at.scene.objects.size() &&
                    (shows == drag.object || at.scene.objects[static_cast<std::size_t>(shows)].key == object.key);
  if (!same)
    refuse(fmt::format("pixel {},{} does not show {}", drag.from_u, drag.from_v, called(object)),
           shows < 0 ? "nothing is there" : "what is there is " + called(at.scene.objects[static_cast<std::size_t>(shows)]));
  return static_cast<double>(truth.z_m[pixel]) * ray_of(at.camera, drag.from_u, drag.from_v);
}

Moved shifted(const SceneAt& at, const Object& object, const Vec3& in_camera) {
  Moved out;
  set_position(out, at, object, to_micrometre(object.position + camera_axes(at) * in_camera));
  return out;
}

/// As if a ball about the object's origin followed the cursor: half a turn over the height of the image.
Moved turned(const SceneAt& at, const Object& object, const Drag& drag) {
  const double right = drag.to_u - drag.from_u, down = drag.to_v - drag.from_v, pixels = std::hypot(right, down);
  const double per_pixel = base::two_pi / 2 / base::image_extent(at.camera).height;
  const Vec3 axis = pixels > 0 ? camera_axes(at) * Vec3{down / pixels, -right / pixels, 0} : Vec3{0, 0, 1};
  const Mat3 turn = mat3(analysis::turn_about(axis, per_pixel * pixels));
  Moved out;
  const Mat3 before = mat3(analysis::pose_of(object, at.time_s).turn);
  set_rotation(out, at, object, to_nine_digits(rotation_before(object, at.time_s, product(turn, before))));
  return out;
}

/// Sizes of a shape times a factor, about what it turns about. What its members are, their rows say.
class Scaled {
 public:
  Scaled(Moved& out, const SceneAt& at, const Object& object, double factor)
      : out_(out), at_(at), object_(object), factor_(factor), middle_(vec3(analysis::center_of(object))) {}

  /// Lengths, points but for the one that it turns about, and what lengths are multiplied by. All else stays as it is.
  void member(const model::Row& row, const model::Slot& slot) const {
    const auto* number = std::get_if<double*>(&slot);
    if (number != nullptr && row.scales_lengths) set(row, base::number_text(scaled(**number)));
    if (!is_length(row.form)) return;
    if (number != nullptr) {
      set(row, metres(scaled(**number)));
      say(fmt::format("{} {:.4g} m", row.key, **number * factor_));
    }
    if (const auto* const two = std::get_if<std::array<double, 2>*>(&slot)) {
      const std::array<double, 2> sides{scaled((**two)[0]), scaled((**two)[1])};
      set(row, list_text(sides));
      say(fmt::format("{} {:.4g} x {:.4g} m", row.key, sides[0], sides[1]));
    }
    if (const auto* const point = std::get_if<Vec3*>(&slot); point != nullptr && **point != middle_) set(row, list_text(about(**point)));
    if (const auto* const points = std::get_if<std::array<Vec3, 3>*>(&slot)) {
      std::string text;
      for (const Vec3& point : **points) text += (text.empty() ? "[" : ", ") + list_text(about(point));
      set(row, text + "]");
    }
  }

 private:
  static bool is_length(const model::ValueForm& form) {
    return form.kind == model::ValueForm::Kind::list ? is_length(form.forms[0]) : form.dimension == base::Dimension::length;
  }
  [[nodiscard]] double scaled(double value) const { return to_nine_digits(value * factor_); }
  [[nodiscard]] Vec3 about(const Vec3& point) const { return to_micrometre(middle_ + factor_ * (point - middle_)); }
  void set(const model::Row& row, std::string text) const { add(out_, at_.set, key_of(object_, row.key.c_str()), std::move(text)); }
  void say(const std::string& what) const { out_.what += (out_.what.empty() ? "" : ", ") + what; }

  Moved& out_;
  const SceneAt& at_;
  const Object& object_;
  double factor_;
  Vec3 middle_;
};

Moved scaled(const SceneAt& at, const Object& object, double factor) {
  Moved out;
  const Scaled all(out, at, object, factor);
  const void* const shape = std::visit([](const auto& said) -> const void* { return &said; }, object.shape);
  for (const model::Row& row : model::tables_of_shapes()[object.shape.index()]().rows) all.member(row, model::slot_of(row, shape));
  if (out.sets.empty())
    refuse(called(object) + " is a " + analysis::kind_of(object) + ": it has no size", "planes are endless; a rectangle has a size");
  if (out.what.empty()) out.what = fmt::format("size x {:.4g}", factor);
  return out;
}

Moved placed_camera(const SceneAt& at, const Place& place) {
  if (const std::string why = why_fixed(at.scene.camera); !why.empty()) refuse("the camera cannot be moved by hand", why);
  const auto m = camera_pose(at.scene, at.time_s);
  const Vec3 position = place.position.value_or(Vec3{m[3], m[7], m[11]});
  const Quaternion turn = base::quaternion_of(place.rotation.value_or(camera_axes(at)));
  Moved out;
  add(out, at.set, "camera.pose", "{position: " + list_text(position) + ", quaternion: " + list_text(turn) + "}");
  out.what = fmt::format("camera at {} m, {}", short_text(position), short_text(turn));
  return out;
}

}  // namespace

std::string why_fixed(const Object& object) {
  if (object.keyframes.empty()) return {};
  return "its keyframes say where it is when: take " + key_of(object, "keyframes") + " out of the scene, and it stays where it is put";
}

std::string why_fixed(const CameraChoice& camera) {
  if (camera.keyframes.empty()) return {};
  return "its keyframes say where it is when: take camera.keyframes out of the scene, and it stays where it is put";
}

Moved dragged(const SceneAt& at, const Truth& truth, const Drag& drag) {
  constexpr double per_pixel = 0.01;
  const double up = drag.from_v - drag.to_v, factor = std::exp(per_pixel * up);
  if (drag.how == Drag::How::scale) return scaled(at, object_of(at, drag.object), factor);
  const Object& object = movable_of(at, drag.object);
  if (drag.how == Drag::How::turn) return turned(at, object, drag);
  const Vec3 taken = taken_at(at, truth, drag, object);
  if (drag.how == Drag::How::along) return shifted(at, object, (factor - 1) * taken);
  return shifted(at, object, taken[2] * ray_of(at.camera, drag.to_u, drag.to_v) - taken);
}

Moved placed(const SceneAt& at, const Place& place) {
  if (!place.object) return placed_camera(at, place);
  const Object& object = movable_of(at, *place.object);
  Moved out;
  if (place.position) {
    const Vec3 start = vec3(analysis::center_of(object)) + vec3(analysis::gone_by(object, at.time_s).origin);
    set_position(out, at, object, *place.position - start);
  }
  if (place.rotation) set_rotation(out, at, object, rotation_before(object, at.time_s, *place.rotation));
  return out;
}

}  // namespace tofray::view
