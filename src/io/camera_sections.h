// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

#include "base/faults.h"
#include "io/reader.h"
#include "tofray/camera.h"

/// From the values of a profile to tofray::Camera, section by section, with the checks that a table cannot say.
namespace tofray::io {

class CameraReader {
 public:
  /// @param folder   where the profile's table files lie; empty: it may name none
  CameraReader(std::string folder, base::Faults& faults) : folder_(std::move(folder)), faults_(faults) {}
  Camera camera(const Value& root);

 private:
  void sensor(const Value& value, Sensor& out);
  void lens(const Value& value, Lens& out);
  void filter(const Value& value, const Camera& camera, Filter& out);
  Illumination light(const Value& value);
  void pattern(const Value& value, Pattern& out);
  void waveform(const Value& value, Waveform& out);
  void pixel(const Value& value, Pixel& out);
  void adc(const Value& value, Adc& out);
  void decoding(const Value& value, Decoding& out);
  void temperature(const Value& value, Temperature& out);
  void curve(const Value& value, const char* x_key, Curve& out);
  /// Rows of numbers out of a text file beside the profile.
  std::vector<std::vector<double>> number_file(const Value& name);

  void modes(const Value& root, Camera& out);
  Mode mode(const Value& value, const std::string& name);
  void check_phases(const Value& sequence, const Mode& mode);
  void check_mode(const Value& root, const Value& chosen, Camera& camera);
  void check_edges(const Value& root, const Camera& camera);

  std::string folder_;
  base::Faults& faults_;
};

}  // namespace tofray::io
