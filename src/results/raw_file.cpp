// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/raw_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/faults.h"
#include "base/recording.h"
#include "files/data_limits.h"
#include "files/npz.h"
#include "files/read_bytes.h"

namespace tofray::results {

using files::max_data_file_bytes;
using files::max_image_side;
using files::max_phases;
using files::NamedArray;
using files::npy_type_of;
using files::NpyArray;
using files::NpyShape;
using files::parse_npz;
using files::read_bytes;
using files::shape_text;

namespace {

constexpr const char* stack_shape = "(phase, height, width)";
/// What recordings of signed or floating numbers often are, and what turns them into codes.
constexpr const char* differences_help =
    "differences A-B of the taps? Add mid_code (adc.mid_code of the camera) and write uint16, or give tap_a and tap_b";

/// Takes arrays out of a file and collects what is wrong with them, so that all faults are reported at once.
class RawReader {
 public:
  RawReader(std::vector<NamedArray> arrays, std::string path) : arrays_(std::move(arrays)), path_(std::move(path)) {}

  Raw read() {
    Raw raw;
    const bool codes = has("raw"), taps = has("tap_a") || has("tap_b");
    if (!codes && !taps) fault("array \"raw\" is missing", "expected raw, or tap_a and tap_b");
    if (codes) read_codes(raw);
    if (taps) {
      read_tap("tap_a", raw, raw.tap_a);
      read_tap("tap_b", raw, raw.tap_b);
    }
    read_by_phase("modulation_frequency_hz", raw, raw.modulation_frequency_hz, true);
    read_by_phase("reference_phase_rad", raw, raw.reference_phase_rad, false);
    read_by_phase("integration_time_s", raw, raw.integration_time_s, true);
    if (has("start_time_s")) read_by_phase("start_time_s", raw, raw.start_time_s, false);
    std::vector<double> lit;
    read_by_phase("lit", raw, lit, true);
    for (const double value : lit) raw.lit.push_back(value != 0 ? 1 : 0);
    if (faults_.empty()) check_exposures(raw);
    faults_.raise();
    return raw;
  }

 private:
  [[nodiscard]] const NpyArray* find(const char* name) const {
    for (const NamedArray& entry : arrays_)
      if (entry.name == name) return &entry.array;
    return nullptr;
  }
  [[nodiscard]] bool has(const char* name) const { return find(name) != nullptr; }

  void fault(const std::string& what, const std::string& more) { faults_.add(base::whole(path_), what, more); }

  /// The array, if it is there and has one of the kinds wanted.
  const NpyArray* wanted(const char* name, const char* kinds, const std::string& expected) {
    const NpyArray* array = find(name);
    if (array == nullptr) {
      fault(fmt::format("array \"{}\" is missing", name), fmt::format("expected {}", expected));
    } else if (std::strchr(kinds, array->type.kind) == nullptr) {
      fault(fmt::format("array \"{}\" has the wrong type", name), fmt::format("got {}, expected {}", array->type.name(), expected));
      return nullptr;
    }
    return array;
  }

  /// How many raw frames all arrays with one value for each agree on; 0 where they do not, or there are none.
  [[nodiscard]] std::size_t agreed_phases() const {
    std::size_t count = 0;
    for (const char* name : {"modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "lit"}) {
      const NpyArray* array = find(name);
      if (array == nullptr) continue;
      if (array->shape.size() != 1 || (count != 0 && array->shape[0] != count)) return 0;
      count = array->shape[0];
    }
    return count;
  }

  /// Raw frames that are not the first axis: all arrays with one value for each say how many there are.
  bool has_other_axes(const char* name, const NpyShape& shape) {
    const std::size_t phases = agreed_phases();
    if (phases == 0 || shape.size() != 3 || shape[0] == phases) return false;
    if (shape[1] != phases && shape[2] != phases) return false;
    const bool last = shape[2] == phases;
    fault(fmt::format("array \"{}\": got {}; its {} axis are the {} raw frames: np.moveaxis({}, {}, 0)", name, shape_text(shape),
                      last ? "last" : "middle", phases, name, last ? "-1" : "1"),
          fmt::format("expected {}; the arrays by raw frame have {} values each",
                      shape_text(last ? NpyShape{phases, shape[0], shape[1]} : NpyShape{phases, shape[0], shape[2]}), phases));
    return true;
  }

  /// Takes the sizes from the first stack and compares the others with them.
  bool fits_stack(const char* name, const NpyArray& array, Raw& raw) {
    const NpyShape& shape = array.shape;
    if (raw.phases == 0 && has_other_axes(name, shape)) return false;
    const bool sensible = shape.size() == 3 && shape[0] > 0 && shape[1] > 0 && shape[2] > 0 && shape[0] <= max_phases &&
                          shape[1] <= max_image_side && shape[2] <= max_image_side;
    if (!sensible) {
      fault(fmt::format("array \"{}\" has the wrong shape", name),
            fmt::format("got {}, expected {}, at most ({}, {}, {})", shape_text(shape), stack_shape, max_phases, max_image_side,
                        max_image_side));
      return false;
    }
    if (raw.phases == 0) {
      raw.phases = static_cast<int>(shape[0]);
      raw.height = static_cast<int>(shape[1]);
      raw.width = static_cast<int>(shape[2]);
    }
    const NpyShape expected = {static_cast<std::size_t>(raw.phases), static_cast<std::size_t>(raw.height),
                               static_cast<std::size_t>(raw.width)};
    if (shape == expected) return true;
    fault(fmt::format("array \"{}\" has the wrong shape", name),
          fmt::format("got {}, expected {} as the other raw data have", shape_text(shape), shape_text(expected)));
    return false;
  }

  void read_codes(Raw& raw) {
    const NpyArray* array = wanted("raw", "iu", fmt::format("uint16 codes of the ADC, (phase, height, width)\n{}", differences_help));
    if (array == nullptr || !fits_stack("raw", *array, raw)) return;
    raw.raw.resize(array->count());
    if (array->type == npy_type_of<std::uint16_t>()) {
      std::memcpy(raw.raw.data(), array->bytes.data(), array->bytes.size());
      return;
    }
    for (std::size_t i = 0; i < raw.raw.size(); ++i) {
      const double code = array->number(i);
      if (code < 0 || code > 65535)
        return fault("array \"raw\" has a code that is no uint16",
                     fmt::format("got {}, expected 0 to 65535{}{}", code, code < 0 ? "\n" : "", code < 0 ? differences_help : ""));
      raw.raw[i] = static_cast<std::uint16_t>(code);
    }
  }

  void read_tap(const char* name, Raw& raw, Array<float>& tap) {
    const NpyArray* array = wanted(name, "f", "float32 electrons, (phase, height, width)");
    if (array == nullptr || !fits_stack(name, *array, raw)) return;
    tap.resize(array->count());
    if (array->type == npy_type_of<float>()) {
      std::memcpy(tap.data(), array->bytes.data(), array->bytes.size());
      return;
    }
    for (std::size_t i = 0; i < tap.size(); ++i) tap[i] = static_cast<float>(array->number(i));
  }

  void read_by_phase(const char* name, const Raw& raw, std::vector<double>& values, bool not_negative) {
    const bool truth = std::strcmp(name, "lit") == 0;
    const NpyArray* array = wanted(name, truth ? "biu" : "fiu", truth ? "bool, one per raw frame" : "float64, one per raw frame");
    if (array == nullptr) return;
    // without raw data there is nothing to compare with, and that fault has been told
    if (array->shape.size() != 1 || (raw.phases > 0 && array->shape[0] != static_cast<std::size_t>(raw.phases))) {
      const std::string expected = raw.phases > 0 ? fmt::format("({},): one per raw frame", raw.phases) : "one per raw frame";
      return fault(fmt::format("array \"{}\" has the wrong shape", name),
                   fmt::format("got {}, expected {}", shape_text(array->shape), expected));
    }
    if (array->count() > max_phases) return;
    for (std::size_t i = 0; i < array->count(); ++i) {
      const double value = array->number(i);
      if (!std::isfinite(value) || (not_negative && value < 0))
        return fault(fmt::format("array \"{}\" has a value that makes no sense", name),
                     fmt::format("got {} for raw frame {}, expected a finite number{}", value, i, not_negative ? ", 0 or more" : ""));
      values.push_back(value);
    }
  }

  void check_exposures(const Raw& raw) {
    for (const base::RecordingFault& one : base::faults_of_recording(raw)) fault(one.what, one.more);
  }

  std::vector<NamedArray> arrays_;
  std::string path_;
  base::Faults faults_;
};

}  // namespace

Raw parse_raw_npz(std::string_view file, const std::string& where) {
  const std::vector<std::string> wanted = {
      "raw", "tap_a", "tap_b", "modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "start_time_s", "lit"};
  return RawReader(parse_npz(file, where, wanted), where).read();
}

Raw read_raw_npz(const std::string& path) { return parse_raw_npz(read_bytes(path, max_data_file_bytes), path); }

}  // namespace tofray::results
