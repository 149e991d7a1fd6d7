// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/fill.h"

#include <algorithm>

#include "base/text.h"
#include "base/units.h"
#include "files/text_file.h"
#include "load/convert.h"
#include "load/rotation_load.h"
#include "load/specimen.h"

namespace tofray::load {

using files::read_reference;
using model::CurveSlot;
using model::Row;
using model::Table;
using model::ValueForm;
using yaml::Value;

const Value& at(const Value& map, std::string_view key) {
  const std::size_t dot = key.find('.');
  const Value& value = map[key.substr(0, dot)];
  return dot == std::string_view::npos || !value ? value : at(value, key.substr(dot + 1));
}

namespace {

/// Whether the map says a member of the struct, or of a struct in it.
bool says(const Value& map, const Table& table, const void* record, const void* member) {
  return std::any_of(table.rows.begin(), table.rows.end(), [&](const Row& row) {
    if (row.key.empty()) return false;
    const model::Slot slot = slot_of(row, record);
    const Value& value = at(map, row.key);
    if (const auto* below = std::get_if<model::RecordSlot>(&slot)) return value && says(value, below->table(), below->at, member);
    return model::address(slot) == member && value;
  });
}

/// What a row of the struct says of its kind: a curve or an amount that is written makes it that kind.
void set_kind(const Row& row, void* record) {
  if (row.tag == nullptr || applies(row, record)) return;
  const model::Slot tag = row.tag(record);
  if (const auto* choice = std::get_if<model::ChoiceSlot>(&tag)) choice->set(choice->at, row.kinds[0]);
}

int index_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// The plain types of members.
struct Plain {
  const Value& value;

  void operator()(double* member) const { *member = value.number; }
  void operator()(int* member) const { *member = static_cast<int>(value.number); }
  void operator()(unsigned long long* member) const { *member = static_cast<unsigned long long>(value.number); }
  void operator()(bool* member) const { *member = value.flag; }
  void operator()(std::string* member) const { *member = value.text; }
  void operator()(Vec3* member) const { *member = vector(value); }
  void operator()(std::array<double, 2>* member) const { *member = {value.items[0].number, value.items[1].number}; }
  void operator()(std::optional<double>* member) const { *member = value.number; }
  void operator()(std::optional<Vec3>* member) const { *member = vector(value); }
  void operator()(std::optional<Quaternion>* member) const {
    *member = {value.items[0].number, value.items[1].number, value.items[2].number, value.items[3].number};
  }
  void operator()(std::array<Vec3, 3>* member) const {
    for (std::size_t k = 0; k < 3; ++k) (*member)[k] = vector(value.items[k]);
  }
  void operator()(std::vector<double>* member) const { *member = numbers(value); }
  template <class Other>
  void operator()(const Other&) const {}
};

}  // namespace

void Filler::fill(const Value& map, const Table& table, void* record) {
  if (!map) return;
  from_[{record, &table}] = &map;
  if (&table == &model::table_of<Pose>()) *static_cast<Pose*>(record) = pose_in(world_up_);
  if (&table == &model::table_of<CameraKeyframe>()) static_cast<CameraKeyframe*>(record)->pose = pose_in(world_up_);
  for (const Row& row : table.rows) {
    if (!table.tag.empty() && row.key == table.tag) {
      const model::Slot slot = row.slot(record);
      const auto& choice = std::get<model::ChoiceSlot>(slot);
      if (!map.text.empty()) choice.set(choice.at, index_of(row.form.names, map.text));
    } else if (table.tag.empty() || applies(row, record)) {
      member(map, row, record);
    }
  }
  if (&table == &model::table_of<Pose>()) complete_pose(map, *static_cast<Pose*>(record), faults_);
  if (&table == &model::table_of<FrequencyCalibration>()) pixel_phases(map["pixel_phase"], *static_cast<FrequencyCalibration*>(record));
  if (&table == &model::table_of<Rotation>()) complete_rotation(map, *static_cast<Rotation*>(record), faults_);
  if (map.good && table.complete) table.complete(record, [&](const void* member) { return says(map, table, record, member); });
}

void Filler::member(const Value& map, const Row& row, void* record) {
  if (row.key.empty() && row.x_key.empty()) return;
  const model::Slot slot = row.slot(record);
  const Value& value = row.key.empty() ? map : at(map, row.key);
  if (const auto* below = std::get_if<model::RecordSlot>(&slot)) return fill(value, below->table(), below->at);
  if (const auto* list_of = std::get_if<model::ListSlot>(&slot)) return list(value, *list_of);
  if (const Value& file = map["file"]; !row.file.empty() && file && file.good) {
    const auto rows = number_file(file);
    if (const auto* samples = std::get_if<model::GridSlot>(&slot)) return grid(file, rows, *samples);
    for (const auto& one : rows) {
      auto& all = *std::get<std::vector<double>*>(slot);
      all.insert(all.end(), one.begin(), one.end());
    }
    return;
  }
  if (!value || !value.good) return;
  if (const auto* samples = std::get_if<CurveSlot>(&slot)) {
    curve(map, value, row, *samples);
    if (!samples->y->empty() && value.is_map()) set_kind(row, record);
  } else if (const auto* samples_of = std::get_if<model::GridSlot>(&slot)) {
    std::vector<std::vector<double>> rows;
    for (const Value& one : value.items) rows.push_back(numbers(one));
    grid(value, rows, *samples_of);
  } else if (const auto* choice = std::get_if<model::ChoiceSlot>(&slot)) {
    if (!value.is_map()) choice->set(choice->at, index_of(row.form.names, value.text));
  } else if (row.form.kind != ValueForm::Kind::either || value.either == 0) {
    std::visit(Plain{value}, slot);
    set_kind(row, record);
  }
}

void Filler::curve(const Value& map, const Value& value, const Row& row, const CurveSlot& slot) {
  if (row.key.empty()) {  // its lists stand among the other keys
    const bool x = static_cast<bool>(map[row.x_key]), y = static_cast<bool>(map[row.y_key]);
    if (x != y)
      faults_.add(map.place(), (x ? row.x_key : row.y_key) + " stands alone",
                  "expected " + row.x_key + " and " + row.y_key + ", as long as each other");
    if (!x || !y) return;
  } else if (!value.is_map()) {
    if (row.form.kind == ValueForm::Kind::either) *slot.x = {0}, *slot.y = {value.number};
    return;
  }
  *slot.x = numbers(value[row.x_key]);
  *slot.y = numbers(value[row.y_key]);
}

void Filler::grid(const Value& value, const std::vector<std::vector<double>>& rows, const model::GridSlot& slot) {
  for (const auto& row : rows) {
    if (row.size() != rows[0].size())
      return faults_.add(value.place(), "the rows are not as long as each other",
                         "got rows of " + std::to_string(rows[0].size()) + " and of " + std::to_string(row.size()));
    slot.samples->insert(slot.samples->end(), row.begin(), row.end());
  }
  *slot.rows = static_cast<int>(rows.size());
  *slot.columns = rows.empty() ? 0 : static_cast<int>(rows[0].size());
}

void Filler::list(const Value& value, const model::ListSlot& slot) {
  if (value.is_map()) return;  // Row::otherwise
  slot.resize(slot.at, value.items.size());
  for (std::size_t i = 0; i < value.items.size(); ++i) fill(value.items[i], slot.table(), slot.element(slot.at, i));
}

std::vector<std::vector<double>> Filler::number_file(const Value& name) {
  std::vector<std::vector<double>> rows;
  std::string path, content;
  try {
    if (folder_.empty())
      base::fail(name.place(), "this profile cannot name files",
                 "got " + base::in_quotes(name.text) + "; write the numbers into the profile");
    content = read_reference(name.text, folder_, {}, name.place(), path);
  } catch (const Error&) {
    if (faults_.empty()) throw;  // else the file's other faults are reported first
    return rows;
  }
  return rows_of_numbers(content, path, faults_);
}

void Filler::pixel_phases(const Value& name, FrequencyCalibration& out) {
  if (!name || !name.good || name.text.empty()) return;
  const base::Place place = name.place();
  const auto beside = place.source == nullptr ? calibration_folders_.end() : calibration_folders_.find(*place.source);
  const std::string& folder = beside == calibration_folders_.end() ? folder_ : beside->second;
  if (folder.empty()) {
    out.pixel_phase_file.clear();  // said once
    return faults_.add(place, "the pixels' phases are not here",
                       "got the name of their file alone, " + base::in_quotes(name.text) +
                           "; name the calibration's file: --set camera.decoding.calibration=FILE, or --camera PROFILE");
  }
  out.pixel_phase_rad = read_pixel_phases(name.text, folder, place);
}

bool Filler::is_sound(const void* record, const Table& table) const {
  const auto found = from_.find({record, &table});
  return found != from_.end() && found->second->good;
}

base::Place Filler::place(const model::Spot& spot) const {
  const Value* value = from_.at({spot.record, spot.table});
  const auto go = [&](const Value& next) { value = next ? &next : value; };
  if (spot.row == nullptr) return value->place();
  if (!spot.row->key.empty()) go(at(*value, spot.row->key) || spot.row->file.empty() ? at(*value, spot.row->key) : (*value)["file"]);
  if (spot.part != model::Spot::whole) go((*value)[spot.part == model::Spot::x ? spot.row->x_key : spot.row->y_key]);
  if (spot.index >= 0 && static_cast<std::size_t>(spot.index) < value->items.size()) go(value->items[static_cast<std::size_t>(spot.index)]);
  return value->place();
}

void Filler::add(const model::Spot& spot, const std::string& what, const std::string& more, ErrorKind kind) {
  faults_.add(place(spot), what, more, kind);
}

void Filler::add_named(const model::Spot& spot, const std::string& what, const std::string& more, ErrorKind kind) {
  const std::string& key = spot.row->key;
  add(spot, key.substr(key.rfind('.') + 1) + what, more, kind);
}

}  // namespace tofray::load
