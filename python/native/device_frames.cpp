// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "device_frames.h"

#include <algorithm>

#include "arrays.h"

namespace tofray::python {

namespace {

/// The structs of DLPack's binary interface (version 0.x), which other libraries read.
struct DlDevice {
  std::int32_t type, number;
};
struct DlType {
  std::uint8_t code, bits;
  std::uint16_t lanes;
};
struct DlTensor {
  void* data;
  DlDevice device;
  std::int32_t axes;
  DlType type;
  std::int64_t* shape;
  std::int64_t* strides;
  std::uint64_t byte_offset;
};
struct DlManagedTensor {
  DlTensor tensor;
  void* owner;
  void (*give_back)(DlManagedTensor*);
};
constexpr std::int32_t dl_cuda = 2;
constexpr const char* dl_new = "dltensor";  ///< the capsule's name until somebody takes the tensor

/// One array of all frames of a batch: [frame, …], the frames some bytes apart.
struct DeviceArray {
  DeviceBatch batch;
  std::string name;
  void* first = nullptr;
  py::ssize_t item_bytes = 0;
  std::string type_text;  ///< "<f4": of numpy's array interface
  std::string dtype;      ///< "float32"
  DlType type{};
  std::vector<std::int64_t> shape, strides;  ///< strides in values
};

template <class T>
constexpr DlType dl_type() {
  constexpr std::uint8_t integer = 0, natural = 1, real = 2;
  return {std::is_floating_point_v<T> ? real : (std::is_signed_v<T> ? integer : natural), 8 * sizeof(T), 1};
}

std::vector<std::int64_t> batch_shape(ArrayShape shape, std::int64_t frames, const FrameArrays& of) {
  switch (shape) {
    case ArrayShape::image: return {frames, of.height, of.width};
    case ArrayShape::pairs: return {frames, of.height, of.width, 2};
    case ArrayShape::vectors: return {frames, of.height, of.width, 3};
    case ArrayShape::stack: return {frames, of.phases, of.height, of.width};
    case ArrayShape::moved: return {frames, of.phases, of.height, of.width, 2};
    case ArrayShape::by_frequency: return {frames, of.modulations, of.height, of.width};
    case ArrayShape::bins: return {frames, of.bins, of.height, of.width};
    case ArrayShape::list: return {frames, of.phases};
  }
  return {};
}

template <class T>
DeviceArray batch_array(const DeviceBatch& batch, const char* name, ArrayShape shape, const T* first, const T* second) {
  const DeviceFrames& frames = *batch.frames;
  DeviceArray out{batch,
                  name,
                  const_cast<T*>(first),
                  sizeof(T),
                  py::str(dtype_of<T>().attr("str")),
                  py::str(dtype_of<T>().attr("name")),
                  dl_type<T>(),
                  batch_shape(shape, static_cast<std::int64_t>(frames.size()), frames[0]),
                  {}};
  out.strides.assign(out.shape.size(), 1);
  for (std::size_t i = out.shape.size() - 1; i > 1; --i) out.strides[i - 1] = out.strides[i] * out.shape[i];
  // Of one frame the first axis has no step: any will do, and this one says that nothing lies between.
  out.strides[0] = second != nullptr ? second - first : out.strides[1] * out.shape[1];
  return out;
}

std::vector<std::string> batch_names(const DeviceBatch& batch) {
  std::vector<std::string> out;
  const FrameArrays arrays = (*batch.frames)[0];
#define TOFRAY_NAME(name, ...) \
  if (arrays.name != nullptr) out.emplace_back(#name);
  TOFRAY_IMAGE_ARRAYS(TOFRAY_NAME)
#undef TOFRAY_NAME
  return out;
}

DeviceArray get_array(const DeviceBatch& batch, const py::object& wanted) {
  const FrameArrays first = (*batch.frames)[0], second = batch.frames->size() > 1 ? (*batch.frames)[1] : FrameArrays{};
  const std::string name = py::isinstance<py::str>(wanted) ? wanted.cast<std::string>() : std::string();
#define TOFRAY_GET(own_name, part, member, element, shape, ...) \
  if (name == #own_name && first.own_name != nullptr)           \
    return batch_array<element>(batch, #own_name, ArrayShape::shape, first.own_name, second.own_name);
  TOFRAY_IMAGE_ARRAYS(TOFRAY_GET)
#undef TOFRAY_GET
  std::string all;
  for (const std::string& one : batch_names(batch)) all += (all.empty() ? "" : ", ") + one;
  throw py::key_error("got " + shown(wanted) + ", expected the name of an array: " + all);
}

py::tuple tuple_of(const std::vector<std::int64_t>& values, std::int64_t factor = 1) {
  py::tuple out(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) out[i] = values[i] * factor;
  return out;
}

int device_of(const DeviceBatch& batch) { return (*batch.frames)[0].device; }

/// https://numba.readthedocs.io/en/stable/cuda/cuda_array_interface.html. No stream: all has been computed.
py::dict cuda_array_interface(const DeviceArray& self) {
  return py::dict(py::arg("shape") = tuple_of(self.shape), py::arg("typestr") = self.type_text,
                  py::arg("data") = py::make_tuple(reinterpret_cast<std::uintptr_t>(self.first), false),
                  py::arg("strides") = tuple_of(self.strides, self.item_bytes), py::arg("version") = 3, py::arg("stream") = py::none());
}

/// What a capsule holds: the array, and the tensor that points into it.
struct Lent {
  DeviceArray array;
  DlManagedTensor managed;
};

void give_back(DlManagedTensor* managed) { delete static_cast<Lent*>(managed->owner); }

/// Of a capsule that nobody took the tensor out of: whoever does renames it.
void drop(PyObject* capsule) {
  if (PyCapsule_IsValid(capsule, dl_new) != 0) give_back(static_cast<DlManagedTensor*>(PyCapsule_GetPointer(capsule, dl_new)));
}

[[noreturn]] void refuse_lending(const std::string& text) {
  PyErr_SetString(PyExc_BufferError, ("__dlpack__: " + text).c_str());
  throw py::error_already_set();
}

/// https://dmlc.github.io/dlpack/latest/python_spec.html. Whatever the stream, there is nothing to wait for.
py::object dlpack(const DeviceArray& self, const py::object& /*stream*/, const py::object& /*max_version*/, const py::object& dl_device,
                  const py::object& copy) {
  if (!dl_device.is_none() && !dl_device.equal(py::make_tuple(dl_cuda, device_of(self.batch))))
    refuse_lending("got dl_device " + shown(dl_device) + ", expected None: the array stays on GPU " +
                   std::to_string(device_of(self.batch)));
  if (!copy.is_none() && copy.cast<bool>()) refuse_lending("got copy=True, expected None or False: copy what this gives");
  auto lent = std::make_unique<Lent>(Lent{self, {}});
  DeviceArray& array = lent->array;
  lent->managed = {{array.first,
                    {dl_cuda, device_of(array.batch)},
                    static_cast<std::int32_t>(array.shape.size()),
                    array.type,
                    array.shape.data(),
                    array.strides.data(),
                    0},
                   lent.get(),
                   &give_back};
  PyObject* const capsule = PyCapsule_New(&lent->managed, dl_new, &drop);
  if (capsule == nullptr) throw py::error_already_set();
  static_cast<void>(lent.release());  // the capsule's now
  return py::reinterpret_steal<py::object>(capsule);
}

std::string array_text(const DeviceArray& self) {
  return "<tofray.DeviceArray " + self.name + ": " + self.dtype + " " + std::string(py::str(tuple_of(self.shape))) + " on GPU " +
         std::to_string(device_of(self.batch)) + ">";
}

std::string frames_text(const DeviceBatch& self) {
  const FrameArrays first = (*self.frames)[0];
  return "<tofray.DeviceFrames: " + std::to_string(self.frames->size()) + " of " + std::to_string(first.width) + " x " +
         std::to_string(first.height) + " pixels on GPU " + std::to_string(first.device) + ">";
}

py::list indices_of(const DeviceBatch& self) {
  py::list out;
  for (std::uint64_t i = 0; i < self.frames->size(); ++i) out.append((*self.frames)[i].index);
  return out;
}

py::list list_of(const std::vector<std::string>& names) {
  py::list out;
  for (const std::string& name : names) out.append(name);
  return out;
}

constexpr const char* array_doc = R"(One array of all frames of a DeviceFrames, in a GPU's memory: [frame, ...].

It is no copy: ``torch.from_dlpack(array)``, ``jax.dlpack.from_dlpack(array)`` and ``cupy.asarray(array)`` see the same memory, which they keep
alive. It is computed already; frames lie some bytes apart, so it is not contiguous.)";

constexpr const char* frames_doc = R"(Frames that stay in a GPU's memory: ``frames["z_m"]`` is that array of all of them.

From ``Simulator.frames_on_device``. Names are those of files (docs/reference/arrays.md): z_m, raw, gt_range_m. The memory goes back when the
frames and all arrays that were taken of them are gone.)";

}  // namespace

void bind_device_frames(py::module_& module) {
  py::class_<DeviceArray>(module, "DeviceArray", array_doc)
      .def_readonly("name", &DeviceArray::name, "As in files: \"z_m\".")
      .def_readonly("dtype", &DeviceArray::dtype, "numpy's name of the type: \"float32\".")
      .def_property_readonly(
          "shape", [](const DeviceArray& self) { return tuple_of(self.shape); }, "Of frames, then as the array of one frame.")
      .def_property_readonly(
          "device", [](const DeviceArray& self) { return device_of(self.batch); }, "Which GPU, from 0 on.")
      .def_property_readonly("__cuda_array_interface__", &cuda_array_interface)
      .def("__dlpack__", &dlpack, py::kw_only(), py::arg("stream") = py::none(), py::arg("max_version") = py::none(),
           py::arg("dl_device") = py::none(), py::arg("copy") = py::none())
      .def("__dlpack_device__", [](const DeviceArray& self) { return py::make_tuple(dl_cuda, device_of(self.batch)); })
      .def("__len__", [](const DeviceArray& self) { return self.shape[0]; })
      .def("__repr__", &array_text);
  py::class_<DeviceBatch> frames(module, "DeviceFrames", frames_doc);
  frames.def("__getitem__", &get_array)
      .def("__contains__",
           [](const DeviceBatch& self, const std::string& name) {
             const std::vector<std::string> names = batch_names(self);
             return std::find(names.begin(), names.end(), name) != names.end();
           })
      .def("__len__", [](const DeviceBatch& self) { return self.frames->size(); })
      .def("__repr__", &frames_text)
      .def_property_readonly(
          "names", [](const DeviceBatch& self) { return list_of(batch_names(self)); }, "The arrays that there are.")
      .def_property_readonly("indices", &indices_of, "Each frame's own: it starts at index / frame_rate.")
      .def_property_readonly("device", &device_of, "Which GPU, from 0 on.")
      .def_property_readonly(
          "seconds", [](const DeviceBatch& self) { return self.frames->seconds(); },
          "How long the GPU computed, by its own clock, in seconds.");
  frames.attr("__iter__") = py::none();  // neither of names nor of frames
}

}  // namespace tofray::python
