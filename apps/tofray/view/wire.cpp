// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/wire.h"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

#include "tofray/error.h"

namespace tofray::view {

namespace {

struct Type {
  const char* name;
  std::uint8_t number;
};

template <class T>
constexpr Type type_of() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return {"u8", 1};
  if constexpr (std::is_same_v<T, std::uint16_t>) return {"u16", 2};
  if constexpr (std::is_same_v<T, std::int16_t>) return {"i16", 3};
  if constexpr (std::is_same_v<T, std::uint32_t>) return {"u32", 4};
  if constexpr (std::is_same_v<T, float>) return {"f32", 5};
  if constexpr (std::is_same_v<T, std::int32_t>) return {"i32", 6};
  if constexpr (std::is_same_v<T, double>) return {"f64", 7};
}

/// Appends numbers, little endian.
class Writer {
 public:
  explicit Writer(std::string& out) : out_(out) {}
  template <class T>
  Writer& put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));  // every machine that tofray runs on is little endian
    out_.append(bytes, sizeof(T));
    return *this;
  }

 private:
  std::string& out_;
};

constexpr std::size_t head_bytes = 64, row_bytes = 32, alignment = 8;
constexpr std::size_t most_bytes = 1'000'000'000;

std::size_t aligned(std::size_t place) { return (place + alignment - 1) / alignment * alignment; }

/// Calls `take(vector, shape)` with the array of a number.
template <class Take>
void with_array(const Frame& frame, std::uint16_t array, const Take& take) {
  std::uint16_t number = 0;
#define TOFRAY_TAKE(label, part, member, element, axes, ...) \
  if (number++ == array) return take(frame.part.member, ArrayShape::axes);
  TOFRAY_FRAME_ARRAYS(TOFRAY_TAKE)
#undef TOFRAY_TAKE
}

std::size_t pixels_of(const Frame& frame) {
  const auto area = [](int width, int height) { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); };
  return std::max(
      {area(frame.raw.width, frame.raw.height), area(frame.depth.width, frame.depth.height), area(frame.truth.width, frame.truth.height)});
}

bool is_error(std::uint16_t array) { return array + 1u == wire_arrays().size(); }
bool has_error(const Frame& frame) { return !frame.depth.z_m.empty() && frame.truth.z_m.size() == frame.depth.z_m.size(); }
float error_at(const Frame& frame, std::size_t pixel) {
  return static_cast<float>(static_cast<double>(frame.depth.z_m[pixel]) - static_cast<double>(frame.truth.z_m[pixel]));
}

std::uint32_t width_of(const Frame& frame) {
  return static_cast<std::uint32_t>(std::max({frame.raw.width, frame.depth.width, frame.truth.width}));
}

}  // namespace

const std::vector<WireArray>& wire_arrays() {
#define TOFRAY_ROW(label, part, member, element, axes, stage, when, unit, what) \
  {#label, unit, what, type_of<element>().name, type_of<element>().number, ArrayShape::axes},
  static const std::vector<WireArray> all = {
      TOFRAY_FRAME_ARRAYS(TOFRAY_ROW){"z_error_m", "m", "error of z: z_m - gt_z_m", "f32", 5, ArrayShape::image}};
#undef TOFRAY_ROW
  return all;
}

std::optional<std::uint16_t> find_wire_array(std::string_view name) {
  for (std::size_t i = 0; i < wire_arrays().size(); ++i)
    if (name == wire_arrays()[i].name) return static_cast<std::uint16_t>(i);
  return {};
}

const char* shape_name(ArrayShape shape) {
  switch (shape) {
    case ArrayShape::image: return "image";
    case ArrayShape::pairs: return "pairs";
    case ArrayShape::vectors: return "vectors";
    case ArrayShape::stack: return "stack";
    case ArrayShape::moved: return "moved";
    case ArrayShape::by_frequency: return "by_frequency";
    case ArrayShape::bins: return "bins";
    case ArrayShape::list: return "list";
  }
  return "";
}

bool has_array(const Frame& frame, std::uint16_t array) {
  if (is_error(array)) return has_error(frame);
  bool has = false;
  with_array(frame, array, [&](const auto& values, ArrayShape) { has = !values.empty(); });
  return has;
}

std::vector<std::string> sources_of(std::span<const std::uint16_t> arrays) {
  std::vector<std::string> out;
  const auto add = [&out](const char* name) {
    if (std::find(out.begin(), out.end(), name) == out.end()) out.emplace_back(name);
  };
  for (const std::uint16_t one : arrays) {
    if (is_error(one))
      add("z_m"), add("gt_z_m");
    else if (wire_arrays()[one].shape != ArrayShape::list)  // lists by raw frame come along
      add(wire_arrays()[one].name);
  }
  if (out.empty() && !arrays.empty()) out.emplace_back("flags");
  return out;
}

ArrayView view_of(const Frame& frame, std::uint16_t array, std::vector<float>& made) {
  ArrayView out;
  const std::size_t pixels = pixels_of(frame);
  const std::uint32_t width = width_of(frame), height = width == 0 ? 0 : static_cast<std::uint32_t>(pixels / width);
  const auto take = [&](const auto& values, ArrayShape shape) {
    if (values.empty()) return;
    out.data = values.data(), out.bytes = values.size() * sizeof(values[0]);
    const auto extents = [&](std::uint8_t rank, std::uint32_t a, std::uint32_t b = 0, std::uint32_t c = 0) {
      out.rank = rank, out.extents[0] = a, out.extents[1] = b, out.extents[2] = c;
    };
    const auto layers = static_cast<std::uint32_t>(pixels == 0 ? 0 : values.size() / pixels);
    switch (shape) {
      case ArrayShape::image: return extents(2, height, width);
      case ArrayShape::pairs: return extents(3, height, width, 2);
      case ArrayShape::vectors: return extents(3, height, width, 3);
      case ArrayShape::moved: return extents(3, layers / 2, height, 2 * width);
      case ArrayShape::stack:
      case ArrayShape::by_frequency:
      case ArrayShape::bins: return extents(3, layers, height, width);
      case ArrayShape::list: return extents(1, static_cast<std::uint32_t>(values.size()));
    }
  };
  if (is_error(array) && has_error(frame)) {
    made.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) made[i] = error_at(frame, i);
    take(made, ArrayShape::image);
  } else {
    with_array(frame, array, take);
  }
  return out;
}

std::vector<double> pixel_values(const Frame& frame, std::uint16_t array, std::size_t pixel) {
  std::vector<double> out;
  const std::size_t pixels = pixels_of(frame);
  if (is_error(array) && has_error(frame) && pixel < pixels) out.push_back(static_cast<double>(error_at(frame, pixel)));
  with_array(frame, array, [&](const auto& values, ArrayShape shape) {
    if (values.empty() || pixel >= pixels || shape == ArrayShape::list) return;
    const std::size_t count = values.size() / pixels;
    const bool layers = shape == ArrayShape::stack || shape == ArrayShape::bins || shape == ArrayShape::by_frequency;
    const auto place = [&](std::size_t k) {
      if (shape == ArrayShape::moved) return (k / 2 * pixels + pixel) * 2 + k % 2;
      return layers ? k * pixels + pixel : pixel * count + k;
    };
    for (std::size_t k = 0; k < count; ++k) out.push_back(static_cast<double>(values[place(k)]));
  });
  return out;
}

namespace {

struct Part {
  std::uint16_t number;
  std::uint8_t type_number;
  ArrayView view;
  std::size_t place = 0;
};

/// What of a message's head is of the frame.
struct OfFrame {
  std::uint64_t index;
  std::uint32_t width, height;
  std::uint16_t phases;
};

std::string message_of(const WireHead& head, const OfFrame& frame, std::vector<Part> parts) {
  std::size_t end = head_bytes + row_bytes * parts.size();
  for (Part& part : parts) part.place = aligned(end), end = part.place + part.view.bytes;
  if (end > most_bytes)
    throw Error(ErrorKind::limit, "error: these arrays together are longer than 1 GB\n  expected fewer of them in one view");
  std::string out;
  out.reserve(end);
  Writer writer(out);
  out += "TFV1";
  writer.put<std::uint16_t>(head_bytes).put(head.channel).put(head.flags).put(head.generation).put(head.sequence);
  writer.put(frame.index).put(head.time_s).put(frame.width).put(frame.height).put(frame.phases);
  writer.put<std::uint16_t>(1).put(static_cast<std::uint16_t>(parts.size())).put<std::uint16_t>(0).put(head.compute_ms);
  writer.put(0.0f).put<std::uint64_t>(0);
  for (const Part& part : parts) {
    const ArrayView& view = part.view;
    writer.put(part.number).put(part.type_number).put(view.rank);
    writer.put(static_cast<std::uint32_t>(part.place)).put(static_cast<std::uint32_t>(view.bytes));
    writer.put(view.extents[0]).put(view.extents[1]).put(view.extents[2]).put<std::uint64_t>(0);
  }
  for (const Part& part : parts) {
    out.resize(part.place, '\0');
    if (part.view.bytes > 0) out.append(static_cast<const char*>(part.view.data), part.view.bytes);
  }
  return out;
}

}  // namespace

std::string encoded(const WireHead& head, const Frame& frame, std::span<const std::uint16_t> arrays) {
  std::vector<Part> parts;
  std::vector<float> made;
  for (const std::uint16_t one : arrays)
    if (const ArrayView view = view_of(frame, one, made); view.data != nullptr)
      parts.push_back({one, wire_arrays()[one].type_number, view});
  const std::uint32_t width = width_of(frame), height = width == 0 ? 0u : static_cast<std::uint32_t>(pixels_of(frame) / width);
  const int phases = std::max({frame.raw.phases, frame.truth.phases, static_cast<int>(frame.raw.lit.size())});
  return message_of(head, {frame.index, width, height, static_cast<std::uint16_t>(phases)}, std::move(parts));
}

std::string encoded(const WireHead& head, std::uint64_t frame, std::uint32_t width, std::uint32_t height,
                    std::span<const StaticArray> arrays) {
  std::vector<Part> parts;
  for (const StaticArray& one : arrays) parts.push_back({static_cast<std::uint16_t>(parts.size()), one.type_number, one.view});
  return message_of(head, {frame, width, height, 0}, std::move(parts));
}

}  // namespace tofray::view
