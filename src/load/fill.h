// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "base/faults.h"
#include "model/check.h"
#include "yaml/reader.h"

/// From the values of a file to the public structs, by their tables, with the checks that a single value cannot say.
namespace tofray::load {

class Filler : public model::Complaints {
 public:
  /// @param folder   where the file's table files lie; empty: it may name none
  Filler(std::string folder, base::Faults& faults) : folder_(std::move(folder)), faults_(faults) {}

  /// Sets what the map says of a struct, and completes it. Where the map is absent the struct stays as it is.
  template <class T>
  void fill(const yaml::Value& map, T& record) {
    fill(map, model::table_of<T>(), &record);
  }
  void fill(const yaml::Value& map, const model::Table& table, void* record);

  /// What poses are where nothing is said.
  void set_world_up(Scene::Up up) { world_up_ = up; }

  /// Where the files lie that calibrations name, by the calibration's file.
  void set_calibration_folders(std::map<std::string, std::string> folders) { calibration_folders_ = std::move(folders); }

  /// The struct stands for that map: faults of its members are reported there.
  template <class T>
  void remember(const yaml::Value& map, const T& record) {
    from_[{&record, &model::table_of<T>()}] = &map;
  }

  /// Reports what is wrong with a struct and all below it, as far as it came from the file. The structs have to stay where they were
  /// filled.
  template <class T>
  void check(const T& record) {
    model::check(model::table_of<T>(), &record, *this);
  }

 private:
  using model::Complaints::add;
  [[nodiscard]] bool is_sound(const void* record, const model::Table& table) const override;
  void add(const model::Spot& spot, const std::string& what, const std::string& more, ErrorKind kind) override;
  void add_named(const model::Spot& spot, const std::string& what, const std::string& more, ErrorKind kind) override;
  [[nodiscard]] base::Place place(const model::Spot& spot) const;

  void member(const yaml::Value& map, const model::Row& row, void* record);
  void curve(const yaml::Value& map, const yaml::Value& value, const model::Row& row, const model::CurveSlot& slot);
  void grid(const yaml::Value& value, const std::vector<std::vector<double>>& rows, const model::GridSlot& slot);
  void list(const yaml::Value& value, const model::ListSlot& slot);
  /// Rows of numbers out of a text file beside the profile.
  std::vector<std::vector<double>> number_file(const yaml::Value& name);

  void pixel_phases(const yaml::Value& name, FrequencyCalibration& out);

  std::string folder_;
  std::map<std::string, std::string> calibration_folders_;
  base::Faults& faults_;
  Scene::Up world_up_ = Scene::Up::minus_y;
  std::map<std::pair<const void*, const model::Table*>, const yaml::Value*> from_;
};

/// The value under a dotted key; an absent one where there is none.
const yaml::Value& at(const yaml::Value& map, std::string_view key);

}  // namespace tofray::load
