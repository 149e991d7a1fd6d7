// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "base/rotation.h"
#include "view/fields.h"

namespace tofray::view::fields {

namespace {

constexpr double most_coordinate_m = 1e6;
constexpr std::uint64_t most_objects = 1'000'000, least_frames = 2, most_frames = 10'000;

template <class T>
T begun(const Json& message) {
  T out;
  out.id = id_of(message), out.side = side_of(message);
  return out;
}

/// @return false where it is no list of so many finite numbers of that size at most
template <std::size_t n>
bool take_numbers(const Json& list, double most, std::array<double, n>& out) {
  if (!list.is_array() || list.items()->size() != n) return false;
  for (std::size_t i = 0; i < n; ++i)
    if (!(*list.items())[i].number(out[i]) || !(std::abs(out[i]) <= most)) return false;
  return true;
}

/// A pixel of the image.
std::array<int, 2> pixel_at(const Json& message, const char* name) {
  std::array<int, 2> out{};
  const Json& list = member(message, name);
  bool good = list.is_array() && list.items()->size() == 2;
  for (std::size_t i = 0; good && i < 2; ++i) {
    std::uint64_t number = 0;
    good = (*list.items())[i].unsigned_integer(number) && number <= most_pixel;
    out[i] = static_cast<int>(number);
  }
  if (!good) throw Fault{base::in_quotes(name) + " is no pixel", "expected [u, v], whole numbers of 0 to 16384"};
  return out;
}

std::optional<std::uint32_t> base_of(const Json& message) {
  if (message.find("base") == nullptr) return {};
  return static_cast<std::uint32_t>(whole(message, "base", UINT32_MAX));
}

Drag::How how_of(const Json& message) {
  const std::string how = text_of(message, "how");
  if (how == "parallel") return Drag::How::parallel;
  if (how == "along") return Drag::How::along;
  if (how == "turn") return Drag::How::turn;
  if (how == "scale") return Drag::How::scale;
  throw Fault{"\"how\" cannot be " + base::in_quotes(how), "expected parallel, along, turn or scale"};
}

Drag drag_of(const Json& message) {
  Drag out = begun<Drag>(message);
  out.object = static_cast<int>(whole(message, "object", most_objects)), out.how = how_of(message), out.base = base_of(message);
  const std::array<int, 2> from = pixel_at(message, "from");
  out.from_u = from[0], out.from_v = from[1];
  std::array<double, 2> to{};
  if (!take_numbers(member(message, "to"), static_cast<double>(most_pixel), to))
    throw Fault{"\"to\" is no place in the image or beside it", "expected [u, v], numbers of -16384 to 16384"};
  out.to_u = to[0], out.to_v = to[1];
  return out;
}

std::optional<Vec3> position_of(const Json& message) {
  const Json& found = member(message, "position");
  if (found.is_null()) return {};
  Vec3 out{};
  if (!take_numbers(found, most_coordinate_m, out))
    throw Fault{"\"position\" is no place in the world", "expected [x, y, z] in metres, each of -1e6 to 1e6"};
  return out;
}

std::optional<std::array<Vec3, 3>> rotation_of(const Json& message) {
  const Json& found = member(message, "rotation");
  if (found.is_null()) return {};
  std::array<Vec3, 3> out{};
  bool good = found.is_array() && found.items()->size() == 3;
  for (std::size_t i = 0; good && i < 3; ++i) good = take_numbers((*found.items())[i], 1.1, out[i]);
  if (!good) throw Fault{"\"rotation\" is no rotation", "expected three rows of three numbers of -1 to 1"};
  if (const base::NoRotation why = base::why_no_rotation(out); !why.what.empty()) throw Fault{"\"rotation\": " + why.what, why.more};
  return out;
}

Place place_of(const Json& message, bool camera) {
  Place out = begun<Place>(message);
  if (!camera) out.object = static_cast<int>(whole(message, "object", most_objects));
  out.position = position_of(message), out.rotation = rotation_of(message), out.base = base_of(message);
  if (!out.position && !out.rotation)
    throw Fault{"the message says neither a position nor a rotation", "expected one of them at least; null: as it is"};
  return out;
}

Measure measure_of(const Json& message) {
  Measure out = begun<Measure>(message);
  const char* const names[] = {"a", "b"};
  for (std::size_t i = 0; i < 2; ++i) {
    const std::array<int, 2> pixel = pixel_at(message, names[i]);
    out.u[i] = pixel[0], out.v[i] = pixel[1];
  }
  return out;
}

RegionQuestion region_of(const Json& message) {
  RegionQuestion out = begun<RegionQuestion>(message);
  const std::array<int, 4> corners = corners_of(member(message, "region"));
  out.u0 = corners[0], out.v0 = corners[1], out.u1 = corners[2], out.v1 = corners[3];
  return out;
}

Temporal temporal_of(const Json& message) {
  Temporal out = begun<Temporal>(message);
  if (message.find("frames") == nullptr) return out;
  const std::uint64_t frames = whole(message, "frames", most_frames);
  if (frames < least_frames) throw Fault{"noise over time needs two frames", "expected \"frames\" of 2 to 10000"};
  out.frames = static_cast<int>(frames);
  return out;
}

Restore restore_of(const Json& message) {
  constexpr std::size_t most_text = 49'152;
  Restore out;
  out.id = id_of(message), out.text = text_of(message, "text");
  if (out.text.size() > most_text) throw Fault{"\"text\" is longer than 48 kB", "expected the text of a picture that `tofray view` made"};
  return out;
}

}  // namespace

std::optional<Inquiry> inquiry_of(std::string_view type, const Json& message) {
  if (type == "view3d") return begun<SceneQuestion>(message);
  if (type == "drag") return drag_of(message);
  if (type == "place" || type == "camera") return place_of(message, type == "camera");
  if (type == "measure") return measure_of(message);
  if (type == "region") return region_of(message);
  if (type == "temporal") return temporal_of(message);
  if (type == "screenshot") return begun<Screenshot>(message);
  if (type == "restore") return restore_of(message);
  return {};
}

}  // namespace tofray::view::fields
