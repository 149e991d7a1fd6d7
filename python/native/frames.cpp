// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "frames.h"

#include <algorithm>

#include "arrays.h"

namespace tofray::python {

namespace {

struct Sizes {
  py::ssize_t phases, bins, modulations, height, width;
};

std::vector<Extent> extents(ArrayShape shape, const Sizes& of) {
  const Extent phases{of.phases, "phases"}, bins{of.bins, "bins"}, modulations{of.modulations, "modulations"}, height{of.height, "height"},
      width{of.width, "width"};
  switch (shape) {
    case ArrayShape::image: return {height, width};
    case ArrayShape::pairs: return {height, width, {2, ""}};
    case ArrayShape::vectors: return {height, width, {3, ""}};
    case ArrayShape::stack: return {phases, height, width};
    case ArrayShape::moved: return {phases, height, width, {2, ""}};
    case ArrayShape::by_frequency: return {modulations, height, width};
    case ArrayShape::bins: return {bins, height, width};
    case ArrayShape::list: return {phases};
  }
  return {};
}

Shape shape_of(ArrayShape shape, const Sizes& of) {
  Shape out;
  for (const Extent& one : extents(shape, of)) out.push_back(one.size);
  return out;
}

Sizes sizes_of(const Frame& frame) {
  // Arrays of one's own leave a part empty, and its size 0.
  const int height = std::max({frame.raw.height, frame.depth.height, frame.truth.height});
  const int width = std::max({frame.raw.width, frame.depth.width, frame.truth.width});
  return {std::max(frame.raw.phases, frame.truth.phases), frame.truth.bins, frame.depth.modulations, height, width};
}

/// The array of that name as Frame::part calls it ("depth", "z_m"); None where the frame has none.
py::object array_of(py::object self, const std::string& part_name, const std::string& member_name) {
  const Frame& frame = *self.cast<const FrameMemory&>().frame;
  const Sizes sizes = sizes_of(frame);
#define TOFRAY_VIEW(name, part, member, element, shape, ...) \
  if (part_name == #part && member_name == #member)          \
    return frame.part.member.empty()                         \
               ? py::none()                                  \
               : py::object(view<element>(frame.part.member.data(), shape_of(ArrayShape::shape, sizes), self, true));
  TOFRAY_FRAME_ARRAYS(TOFRAY_VIEW)
#undef TOFRAY_VIEW
  return py::none();
}

/// One row for each array: name in files, part, member, dtype, shape, stage, unit, what it is.
py::list array_table() {
  py::list rows;
  const char* const shapes[] = {"[height, width]",           "[height, width, 2]",         "[height, width, 3]",   "[phase, height, width]",
                                "[phase, height, width, 2]", "[frequency, height, width]", "[bin, height, width]", "[phase]"};
  const char* const stages[] = {"trace", "power", "raw", "depth"};
#define TOFRAY_ROW(name, part, member, element, shape, stage, when, unit, what)                \
  rows.append(py::make_tuple(#name, #part, #member, py::str(dtype_of<element>().attr("name")), \
                             shapes[static_cast<int>(ArrayShape::shape)], stages[static_cast<int>(Stage::stage)], unit, what));
  TOFRAY_FRAME_ARRAYS(TOFRAY_ROW)
#undef TOFRAY_ROW
  return rows;
}

py::dict sizes_dict(const FrameMemory& self) {
  const Sizes sizes = sizes_of(*self.frame);
  return py::dict(py::arg("width") = sizes.width, py::arg("height") = sizes.height, py::arg("phases") = sizes.phases,
                  py::arg("bins") = sizes.bins, py::arg("modulations") = sizes.modulations, py::arg("time_s") = self.frame->truth.time_s);
}

/// What a part of a tofray.Frame has of an array: an array or, where it has none, nothing.
py::object held(py::handle part, const char* name) {
  py::object value = part.attr("get")(name);
  return value.is_none() ? py::object() : value;
}

int whole_of(py::handle part, const char* name) {
  int out = 0;
  from_python(part.attr(name), out, {nullptr, name});
  if (out < 0) throw Error(ErrorKind::bad_input, std::string(name) + ": error: got " + std::to_string(out) + "\n  expected 0 or more");
  return out;
}

/// Copies the arrays of one part, of the sizes that the part says.
#define TOFRAY_TAKE(name, part, member, element, shape, ...) \
  if (const py::object array = held(from, #member))          \
    into.member = take<element>(array, extents(ArrayShape::shape, sizes), Place{nullptr, #part "." #member});

/// How many raw frames all arrays agree on that have one value for each; 0 where they do not, or there are none.
py::ssize_t agreed_phases(py::handle raw) {
  py::ssize_t count = 0;
  for (const char* name : {"modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "lit"}) {
    const py::object value = held(raw, name);
    if (!value) continue;
    const bool flat = py::isinstance<py::array>(value) && py::reinterpret_borrow<py::array>(value).ndim() == 1;
    const py::ssize_t size = flat ? py::reinterpret_borrow<py::array>(value).shape(0) : 0;
    if (size == 0 || (count != 0 && size != count)) return 0;
    count = size;
  }
  return count;
}

/// Raw frames along another axis than the first, and differences A−B in the place of codes: what recordings of other programs often have.
void refuse_other_recordings(py::handle raw) {
  const py::ssize_t phases = agreed_phases(raw);
  for (const char* name : {"raw", "tap_a", "tap_b"}) {
    const py::object value = held(raw, name);
    if (!value || !py::isinstance<py::array>(value)) continue;
    const auto array = py::reinterpret_borrow<py::array>(value);
    if (phases > 0 && array.ndim() == 3 && array.shape(0) != phases && (array.shape(1) == phases || array.shape(2) == phases)) {
      const bool last = array.shape(2) == phases;
      throw Error(ErrorKind::bad_input, std::string("raw.") + name + ": error: got " + shown(value) + "; its " +
                                            (last ? "last" : "middle") + " axis are the " + std::to_string(phases) +
                                            " raw frames: np.ascontiguousarray(np.moveaxis(" + name + ", " + (last ? "-1" : "1") +
                                            ", 0))\n  expected [phase, height, width]");
    }
    if (std::string_view(name) == "raw" && (array.dtype().kind() == 'i' || array.dtype().kind() == 'f'))
      throw Error(ErrorKind::bad_input,
                  "raw.raw: error: got " + shown(value) +
                      ", expected uint16 codes of the ADC\n  differences A-B of the taps? Add mid_code (camera.adc.mid_code) and write "
                      "uint16, or give tap_a and tap_b");
  }
}

void take_raw(py::handle from, Raw& into) {
  refuse_other_recordings(from);
  into.width = whole_of(from, "width"), into.height = whole_of(from, "height"), into.phases = whole_of(from, "phases");
  const Sizes sizes{into.phases, 0, 0, into.height, into.width};
  TOFRAY_RAW_ARRAYS(TOFRAY_TAKE)
  TOFRAY_EXPOSURE_ARRAYS(TOFRAY_TAKE)
}

void take_depth(py::handle from, Depth& into) {
  into.width = whole_of(from, "width"), into.height = whole_of(from, "height"), into.modulations = whole_of(from, "modulations");
  const Sizes sizes{0, 0, into.modulations, into.height, into.width};
  TOFRAY_DEPTH_ARRAYS(TOFRAY_TAKE)
}

void take_truth(py::handle from, Truth& into) {
  into.width = whole_of(from, "width"), into.height = whole_of(from, "height"), into.phases = whole_of(from, "phases");
  into.bins = whole_of(from, "bins");
  from_python(from.attr("time_s"), into.time_s, {nullptr, "truth.time_s"});
  const Sizes sizes{into.phases, into.bins, 0, into.height, into.width};
  TOFRAY_TRUTH_ARRAYS(TOFRAY_TAKE)
}
#undef TOFRAY_TAKE

/// One size of all parts; 0 where none says one. @param what  "width"
int common_size(const char* what, int raw, int depth, int truth) {
  int common = 0;
  const char* whose = "";
  const std::pair<const char*, int> parts[] = {{"raw", raw}, {"depth", depth}, {"truth", truth}};
  for (const auto& [name, size] : parts) {
    if (size == 0) continue;
    if (common != 0 && size != common)
      throw Error(ErrorKind::bad_input, std::string("frame: error: ") + name + "." + what + " is " + std::to_string(size) + ", " + whose +
                                            "." + what + " is " + std::to_string(common) + "\n  expected one size of all parts");
    common = size, whose = name;
  }
  return common;
}

}  // namespace

void leave_out_after(Stage last, Frame& frame) {
#define TOFRAY_DROP(name, part, member, element, shape, stage, ...) \
  if (Stage::stage > last) frame.part.member = {};
  TOFRAY_IMAGE_ARRAYS(TOFRAY_DROP)
#undef TOFRAY_DROP
}

Raw raw_from_python(py::handle value) {
  Raw out;
  take_raw(value, out);
  return out;
}

std::shared_ptr<Frame> frame_from_python(py::handle value) {
  const py::object memory = value.attr("_memory");
  if (!memory.is_none()) return memory.cast<const FrameMemory&>().frame;
  auto out = std::make_shared<Frame>();
  from_python(value.attr("index"), out->index, {nullptr, "index"});
  take_raw(value.attr("raw"), out->raw);
  take_depth(value.attr("depth"), out->depth);
  take_truth(value.attr("truth"), out->truth);
  // What stands by pixel or by phase in another part says the size of raw, too, which may have neither.
  out->raw.width = common_size("width", out->raw.width, out->depth.width, out->truth.width);
  out->raw.height = common_size("height", out->raw.height, out->depth.height, out->truth.height);
  out->raw.phases = common_size("phases", out->raw.phases, 0, out->truth.phases);
  return out;
}

void bind_frames(py::module_& module) {
  py::class_<FrameMemory>(module, "FrameMemory")
      .def("array", &array_of)
      .def("sizes", &sizes_dict)
      .def_property_readonly("index", [](const FrameMemory& self) { return self.frame->index; });
  module.def("array_table", &array_table);
}

}  // namespace tofray::python
