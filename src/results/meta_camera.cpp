// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/meta_camera.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "files/json.h"
#include "model/check.h"
#include "tofray/error.h"

namespace tofray::results {

using files::json_text;
using files::parse_json;
using load::camera_from_text;
using load::Settings;

namespace {

using SortedTree = nlohmann::json;  // sorted: it finds its keys in logarithmic time, however many there are
using model::Row;
using model::Table;
using model::ValueForm;

const SortedTree nothing;

const SortedTree& member(const SortedTree& from, const std::string& name) {
  if (!from.is_object()) return nothing;
  const auto found = from.find(name);
  return found == from.end() ? nothing : *found;
}

/// A number with its SI unit, as people write it; a list of such; what is no number as it is, for the reader to complain.
SortedTree quantity(const SortedTree& value, const ValueForm& form) {
  if (value.is_array()) {
    SortedTree list = SortedTree::array();
    for (const SortedTree& one : value) list.push_back(quantity(one, form));
    return list;
  }
  const std::string unit = base::si_unit(form.dimension);
  return value.is_number() && !unit.empty() ? SortedTree(base::number_text(value.get<double>()) + " " + unit) : value;
}

const ValueForm& number_form(const ValueForm& form) { return form.forms.empty() ? form : number_form(form.forms[0]); }

/// Whether a member that may be missing in files is at a value that no file can say.
bool left_out(const Row& row, const SortedTree& value) {
  if (row.presence != model::Presence::absent || !value.is_number()) return false;
  const ValueForm& form = number_form(row.form);
  return !(value.get<double>() >= form.low && value.get<double>() <= form.high);
}

/// From what `meta` says of a struct to what a file says of it.
class Writer {
 public:
  Writer(const SortedTree& meta, const Table& table) : meta_(meta), table_(table) {}

  SortedTree file() {
    for (const Row& row : table_.rows) {
      const SortedTree& value = member(meta_, row.name());
      if (value.is_null() || !applies(row) || left_out(row, value)) continue;
      if (!row.key.empty())
        out_[pointer(row.key)] = written(row, value);
      else if (!row.x_key.empty())
        out_.update(curve(row, value));
    }
    return std::move(out_);
  }

 private:
  /// "patterns.prnu" as a place in JSON.
  static SortedTree::json_pointer pointer(std::string key) {
    for (char& c : key)
      if (c == '.') c = '/';
    return SortedTree::json_pointer("/" + key);
  }

  [[nodiscard]] bool applies(const Row& row) const {
    if (row.tag == nullptr) return true;
    const void* tag = model::address(row.tag(const_cast<void*>(table_.fresh)));
    const Row* kind = model::Complaints::row_of(table_, table_.fresh, tag);
    const SortedTree& said = member(meta_, kind->name());
    if (said.is_null()) return model::applies(row, table_.fresh);  // as in files: what they do not say is as it is in a new struct
    const std::vector<std::string>& names = kind->form.names;      // none where the kind is yes or no
    const auto is = [&](int index) {
      return names.empty() ? said == SortedTree(index != 0) : said == names[static_cast<std::size_t>(index)];
    };
    return std::any_of(row.kinds.begin(), row.kinds.end(), is);
  }

  [[nodiscard]] SortedTree written(const Row& row, const SortedTree& value) const {
    const model::Slot slot = slot_of(row, table_.fresh);
    if (const auto* record = std::get_if<model::RecordSlot>(&slot)) return Writer(value, record->table()).file();
    if (const auto* records = std::get_if<model::ListSlot>(&slot)) {
      SortedTree list = SortedTree::array();
      for (const SortedTree& one : value) list.push_back(Writer(one, records->table()).file());
      return list;
    }
    if (std::holds_alternative<model::CurveSlot>(slot)) return curve(row, value);
    if (std::holds_alternative<model::GridSlot>(slot)) return grid(value);
    return quantity(value, number_form(row.form));
  }

  /// One sample is a constant.
  static SortedTree curve(const Row& row, const SortedTree& value) {
    const SortedTree &x = member(value, "x"), &y = member(value, "y");
    if (row.form.kind == ValueForm::Kind::either && y.is_array() && y.size() == 1) return y[0];
    return {{row.x_key, quantity(x, row.x)}, {row.y_key, quantity(y, row.y)}};
  }

  [[nodiscard]] SortedTree grid(const SortedTree& samples) const {
    const SortedTree& columns = member(meta_, "columns");
    SortedTree rows = SortedTree::array();
    if (!samples.is_array() || !columns.is_number_unsigned() || columns == 0U) return rows;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (i % columns.get<std::size_t>() == 0) rows.push_back(SortedTree::array());
      rows.back().push_back(samples[i]);
    }
    return rows;
  }

  const SortedTree& meta_;
  const Table& table_;
  SortedTree out_ = SortedTree::object();
};

/// The camera that `meta` tells of, as a profile with one mode.
std::string profile_text(const SortedTree& camera, int indent) {
  SortedTree profile = Writer(camera, model::table_of<Camera>()).file();
  const SortedTree& mode = member(camera, "mode");
  const SortedTree& name = member(mode, "name");
  profile["modes"][name.is_string() && name != "" ? name.get<std::string>() : "mode"] = Writer(mode, model::table_of<Mode>()).file();
  return profile.dump(indent, ' ', false, SortedTree::error_handler_t::replace);
}

}  // namespace

namespace {

SortedTree camera_in(const std::string& meta, const std::string& where) {
  SortedTree document = SortedTree::parse(json_text(parse_json(meta, where + ": meta")));
  SortedTree camera = member(document, "camera");
  if (!camera.is_object())
    throw Error(ErrorKind::bad_input, where + ": error: meta does not say which camera made it\n  name its profile with --camera");
  return camera;
}

}  // namespace

std::string profile_of_meta(const std::string& meta, const std::string& where) { return profile_text(camera_in(meta, where), 2) + "\n"; }

Camera camera_of_meta(const std::string& meta, const std::string& where, const Settings& settings) {
  const SortedTree camera = camera_in(meta, where);
  CameraOptions options;
  options.set = settings;
  return camera_from_text(profile_text(camera, -1), where + ": meta", "", options);
}

}  // namespace tofray::results
