// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// tofray._native: what the Python files of the package stand on.
#include <pybind11/pybind11.h>

#include <algorithm>
#include <optional>

#include "arrays.h"
#include "base/text.h"
#include "budget.h"
#include "convert.h"
#include "datasets.h"
#include "device_frames.h"
#include "films.h"
#include "frames.h"
#include "meshes.h"
#include "pictures/pictures.h"
#include "profiles.h"
#include "quality.h"
#include "rendered.h"
#include "runs.h"
#include "simulator.h"
#include "sweep.h"
#include "tofray/tofray.h"

namespace tofray::python {

namespace {

const char* kind_name(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::bad_input: return "bad_input";
    case ErrorKind::io: return "io";
    case ErrorKind::limit: return "limit";
    case ErrorKind::device: return "device";
    case ErrorKind::bug: return "bug";
  }
  return "bug";
}

/// tofray.Error, whose subclasses are ValueError, OSError, MemoryError and RuntimeError, too.
void raise(const Error& error) {
  const py::object made = py::module_::import("tofray._errors").attr("error_of")(kind_name(error.kind()), std::string(error.what()));
  PyErr_SetObject(py::type::of(made).ptr(), made.ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const Error& error) {
    try {
      raise(error);
    } catch (py::error_already_set& fault) {
      fault.restore();
    }
  }
}

CameraOptions camera_options(const py::object& mode, const py::dict& set, const py::object& root) {
  CameraOptions out;
  from_python(mode, out.mode, {nullptr, "mode"});
  from_python(root, out.root, {nullptr, "root"});
  for (const auto& [key, value] : set) out.set.emplace_back(from_text(key, {nullptr, "set"}), from_text(value, {nullptr, "set"}));
  return out;
}

Scene scene_of(const py::object& scene) {
  Scene out;
  from_python(scene, out, {nullptr, "scene"});
  return out;
}

py::array_t<double> matrix_array(const std::array<double, 16>& matrix) {
  py::array_t<double> out({4, 4});
  std::copy(matrix.begin(), matrix.end(), out.mutable_data());
  return out;
}

/// Runs without the interpreter's lock: files may be long.
template <class Call>
auto freely(const Call& call) {
  const py::gil_scoped_release free;
  return call();
}

void bind_files(py::module_& module) {
  module.def("load_scene", [](const py::object& file, const py::object& root) {
    const std::string name = from_text(file, {nullptr, "file"}), folder = from_text(root, {nullptr, "root"});
    return to_python(freely([&] { return load_scene(name, folder); }));
  });
  // What is meant by a word, and a note where it is a file of a built-in name.
  module.def("choose_scene", [](const py::object& file) {
    const NameChoice chosen = choose_scene(from_text(file, {nullptr, "file"}));
    return py::make_tuple(chosen.name, chosen.note);
  });
  module.def("choose_camera", [](const py::object& file) {
    const NameChoice chosen = choose_camera(from_text(file, {nullptr, "file"}));
    return py::make_tuple(chosen.name, chosen.note);
  });
  module.def("load_scene_text", [](const py::object& text, const py::object& source, const py::object& root) {
    const std::string all = from_text(text, {nullptr, "text"}), name = from_text(source, {nullptr, "source"});
    const std::string folder = from_text(root, {nullptr, "root"});
    return to_python(freely([&] { return load_scene_text(all, name, folder); }));
  });
  module.def("load_camera", [](const py::object& file, const py::object& mode, const py::dict& set, const py::object& root) {
    const std::string name = from_text(file, {nullptr, "file"});
    const CameraOptions options = camera_options(mode, set, root);
    return to_python(freely([&] { return load_camera(name, options); }));
  });
  module.def("load_camera_of", [](const py::object& scene, const py::object& mode, const py::dict& set, const py::object& root) {
    const Scene one = scene_of(scene);
    const CameraOptions options = camera_options(mode, set, root);
    return to_python(freely([&] { return load_camera(one, options); }));
  });
  module.def("load_camera_text", [](const py::object& text, const py::object& source, const py::object& mode, const py::dict& set) {
    const std::string all = from_text(text, {nullptr, "text"}), name = from_text(source, {nullptr, "source"});
    const CameraOptions options = camera_options(mode, set, py::str(""));
    return to_python(freely([&] { return load_camera_text(all, name, options); }));
  });
  module.def("frame_npz",
             [](const py::object& frame, const py::object& scene, const py::object& camera, const py::dict& words, bool compress) {
               const std::shared_ptr<Frame> one = frame_from_python(frame);
               const Scene seen = scene_of(scene);
               Camera seen_by;
               from_python(camera, seen_by, {nullptr, "camera"});
               const SimulatorOptions options = options_from_python(words);
               return py::bytes(freely([&] { return frame_npz(*one, seen, seen_by, options, compress); }));
             });
  module.def("camera_pose", [](const py::object& scene, double time_s) { return matrix_array(camera_pose(scene_of(scene), time_s)); });
  module.def("pose_from_matrix", [](const py::object& matrix) {
    std::array<double, 16> given{};
    from_python(matrix, given, {nullptr, "matrix"});
    return to_python(pose_from_matrix(given));
  });
  module.def("pose_matrix", [](const py::object& pose) {
    Pose one;
    from_python(pose, one, {nullptr, "pose"});
    return matrix_array(tofray::pose_matrix(one));
  });
  module.def("version", &version);
}

pictures::Theme theme_of(const std::string& name) {
  if (name == "dark") return pictures::Theme::dark;
  if (name == "light") return pictures::Theme::light;
  throw Error(ErrorKind::bad_input, "theme: error: got '" + name + "'\n  expected dark or light");
}

/// The arrays that a picture is made of and the frame does not have; those that it has are of its size.
std::vector<std::string> lacking(const Frame& frame, const std::string& what) {
  const auto& [index, raw, depth, truth] = frame;
  std::vector<std::string> out;
  const auto need = [&](const auto& array, const char* name) {
    if (array.empty()) out.emplace_back(name);
  };
  if (what == "raw") {
    const bool taps = raw.raw.empty() && !(raw.tap_a.empty() && raw.tap_b.empty());
    if (taps)
      need(raw.tap_a, "raw.tap_a"), need(raw.tap_b, "raw.tap_b");
    else
      need(raw.raw, "raw.raw");
    need(raw.modulation_frequency_hz, "raw.modulation_frequency_hz"), need(raw.reference_phase_rad, "raw.reference_phase_rad");
    need(raw.integration_time_s, "raw.integration_time_s"), need(raw.lit, "raw.lit");
    return out;
  }
  if (what != "amplitude") need(depth.z_m, "depth.z_m");
  if (what != "depth") need(depth.amplitude_e, "depth.amplitude_e");
  if (what != "preview") return out;
  need(depth.flags, "depth.flags");
  if (truth.z_m.empty()) need(depth.noise_m, "depth.noise_m");
  if (!truth.multipath_m.empty() && !raw.lit.empty()) need(raw.modulation_frequency_hz, "raw.modulation_frequency_hz");
  return out;
}

std::string picture_bytes(const Frame& frame, const std::string& what, const std::string& caption, const pictures::Style& style) {
  if (what == "preview") return pictures::preview_picture(frame.depth, frame.truth, frame.raw, caption, style);
  if (what == "raw") return pictures::raw_picture(frame.raw, style);
  return what == "depth" ? pictures::depth_png(frame.depth) : pictures::amplitude_png(frame.depth);
}

/// @param file    a name that ends as the format does; of pictures for programs always ".png"
/// @param needed  whether it is an error that an array is not there; else there is None then
py::object picture(const py::object& frame, const std::string& what, const std::string& caption, const std::string& theme,
                   const py::object& scale, const std::string& file, bool needed) {
  const std::shared_ptr<Frame> one = frame_from_python(frame);
  pictures::Style style{theme_of(theme), 1, pictures::Format::png};
  from_python(scale, style.scale, {nullptr, "scale"});
  if (style.scale < 1 || style.scale > 8)
    throw Error(ErrorKind::bad_input, "scale: error: got " + std::to_string(style.scale) + "\n  expected a whole number of 1 to 8");
  const std::optional<pictures::Format> format = pictures::format_of(file);
  if (!format)
    throw Error(ErrorKind::bad_input, "file: error: got " + base::in_quotes(file) + "\n  expected a name that ends in .png, .svg or .pdf");
  style.format = *format;
  const std::vector<std::string> missing = lacking(*one, what);
  if (!missing.empty() && !needed) return py::none();
  std::string names;
  for (const std::string& name : missing) names += (names.empty() ? "" : ", ") + name;
  if (!missing.empty())
    throw Error(ErrorKind::bad_input, "frame: error: has no " + names + "\n  expected what the picture \"" + what + "\" is made of");
  return py::bytes(freely([&] { return picture_bytes(*one, what, caption, style); }));
}

/// The structs that Python sees as classes of its own: those that a user makes or gets, and what they are made of.
using Records = WithParts<Camera, Scene, RanOn, PlanStep, Pinhole, PlacedObject, FrameRequest, ObjectPlace, SceneReport, InvalidPixels,
                          CameraQuestion, CameraReport, PixelChain, PixelBounces, Validity, Inputs, RunResult>;

/// Calls with a null pointer of each of them.
template <class Call>
void each_record(const Call& call) {
  [&]<class... T>(Types<T...>) { (call(static_cast<T*>(nullptr)), ...); }(Records{});
}

/// Name, members with type and value of a fresh one, for each struct: tofray._model is written from it.
py::list structs() {
  py::list all;
  each_record([&]<class T>(T*) {
    py::list members;
    const T fresh{};
    each_member(fresh, [&]<class Member>(std::string_view name, const Member& member) {
      py::object value = py::none();
      if constexpr (!Record<Member> && !std::is_same_v<Member, decltype(Object::shape)>) value = to_python(member);
      members.append(py::make_tuple(std::string(name), As<Member>::type(), value));
    });
    all.append(py::make_tuple(record_name<T>(), members));
  });
  return all;
}

/// A struct as C++ makes it, and a round trip through C++: for tests.
py::object fresh(const std::string& wanted) {
  py::object out = py::none();
  each_record([&]<class T>(T*) {
    if (wanted == record_name<T>()) out = to_python(T{});
  });
  return out;
}

py::object round_trip(const py::object& value) {
  py::object out = py::none();
  each_record([&]<class T>(T*) {
    if (!py::type::of(value).is(model_class(record_name<T>().c_str()))) return;
    T one{};
    from_python(value, one, {nullptr, record_name<T>()});
    out = to_python(one);
  });
  return out;
}

py::dict flags() {
  py::dict out;
#define TOFRAY_FLAG_OF(name, bit, ...) out[#name] = bit;
  TOFRAY_FLAGS(TOFRAY_FLAG_OF)
#undef TOFRAY_FLAG_OF
  out["invalid"] = static_cast<int>(flags_invalid);
  return out;
}

py::list options() {
  py::list out;
  const SimulatorOptions fresh_options{};
  each_member(fresh_options, [&]<class Member>(std::string_view name, const Member& member) {
    if (name != "progress") out.append(py::make_tuple(std::string(name), As<Member>::type(), to_python(member)));
  });
  return out;
}

}  // namespace

PYBIND11_MODULE(_native, module) {
  py::register_exception_translator(&translate);
  bind_frames(module);
  bind_device_frames(module);
  bind_meshes(module);
  bind_simulator(module);
  bind_rendered(module);
  bind_budget(module);
  bind_datasets(module);
  bind_films(module);
  bind_profiles(module);
  bind_quality(module);
  bind_sweep(module);
  bind_runs(module);
  bind_files(module);
  module.def("picture", &picture);
  module.def("structs", &structs);
  module.def("options", &options);
  module.def("fresh", &fresh);
  module.def("round_trip", &round_trip);
  module.def("flags", &flags);
}

}  // namespace tofray::python
