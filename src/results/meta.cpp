// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/meta.h"

#include <nlohmann/json.hpp>

#include "base/version.h"
#include "files/json.h"
#include "model/tables.h"
#include "results/array_table.h"

namespace tofray::results {
namespace {

using Tree = nlohmann::ordered_json;
using model::Row;
using model::Table;

Tree units_tree() {
  Tree units = Tree::object();
  for (const ArrayRow& row : array_table()) units[row.name] = row.unit;
  return units;
}

Tree tree_of(const Table& table, const void* record);

/// A member as JSON; null where there is nothing in it.
struct MemberTree {
  const Row& row;

  template <class T>
  Tree operator()(T* member) const {
    return *member;
  }
  Tree operator()(std::string* member) const { return *member; }
  Tree operator()(std::optional<double>* member) const { return member->has_value() ? Tree(**member) : Tree(); }
  Tree operator()(std::optional<Vec3>* member) const { return member->has_value() ? Tree(**member) : Tree(); }
  Tree operator()(std::optional<Quaternion>* member) const { return member->has_value() ? Tree(**member) : Tree(); }
  Tree operator()(std::vector<double>* member) const { return member->empty() ? Tree() : Tree(*member); }
  Tree operator()(const model::CurveSlot& curve) const { return curve.y->empty() ? Tree() : Tree{{"x", *curve.x}, {"y", *curve.y}}; }
  Tree operator()(const model::GridSlot& grid) const { return (*this)(grid.samples); }
  Tree operator()(const model::ChoiceSlot& choice) const { return row.form.names.at(static_cast<std::size_t>(choice.get(choice.at))); }
  Tree operator()(const model::RecordSlot& record) const { return tree_of(record.table(), record.at); }
  Tree operator()(const model::VariantSlot& one) const { return row.form.names.at(one.index(one.at)); }
  Tree operator()(const model::ListSlot& list) const {
    Tree out = Tree::array();
    for (std::size_t i = 0; i < list.size(list.at); ++i) out.push_back(tree_of(list.table(), list.element(list.at, i)));
    return out;
  }
};

/// Every member of a struct under its name; lists and curves that are empty are left out.
Tree tree_of(const Table& table, const void* record) {
  Tree out = Tree::object();
  for (const Row& row : table.rows) {
    if (!row.in_meta || out.contains(row.name())) continue;  // a second row of the same member
    const model::Slot slot = slot_of(row, record);
    Tree value = std::visit(MemberTree{row}, slot);
    if (value.is_null() || (row.meta_if_set && value == std::visit(MemberTree{row}, slot_of(row, table.fresh)))) continue;
    for (const std::string& idle : row.in_place_of) out.erase(idle);
    if (row.second.empty()) {
      out[row.name()] = std::move(value);
    } else {
      out[row.name()] = std::move(value["x"]);
      out[row.second.substr(row.second.rfind(':') + 1)] = std::move(value["y"]);
    }
    if (const auto* one = std::get_if<model::VariantSlot>(&slot))
      out.update(tree_of(one->tables[one->index(one->at)](), one->held(one->at)));
  }
  return out;
}

}  // namespace

const char* noise_name(Noise noise) { return noise == Noise::off ? "off" : "exact"; }

bool is_noise_free(const files::Json& meta) {
  const files::Json* noise = meta.find("noise");
  return noise != nullptr && noise->is_string() && *noise->string() == noise_name(Noise::off);
}

FrameMeta::FrameMeta(const Scene& scene, const Camera& camera, const SimulatorOptions& options) {
  Tree what = tree_of(model::table_of<Scene>(), &scene);
  if (scene.camera.keyframes.empty()) {
    what["camera_pose"] = tree_of(model::table_of<Pose>(), &scene.camera.pose);
  } else {
    Tree& keyframes = what["camera_keyframes"] = Tree::array();
    for (const CameraKeyframe& key : scene.camera.keyframes) keyframes.push_back(tree_of(model::table_of<CameraKeyframe>(), &key));
  }
  if (!scene.classes.empty()) what["classes"] = scene.classes;
  const Tree how{{"tofray", base::version()},
                 {"seed", options.seed},
                 {"noise", noise_name(options.noise)},
                 {"exposure_samples", options.exposure_samples},
                 {"subpixel", options.subpixel}};
  const Tree rest{{"units", units_tree()}, {"camera", tree_of(model::table_of<Camera>(), &camera)}, {"scene", std::move(what)}};
  before_ = how.dump(), after_ = rest.dump(-1, ' ', false, Tree::error_handler_t::replace);
  before_.back() = ',', after_.front() = ',';  // two objects become one, around the index
  before_ += "\"frame\":";
}

std::string FrameMeta::of(std::uint64_t frame_index) const { return before_ + std::to_string(frame_index) + after_; }

std::string frame_meta(const Scene& scene, const Camera& camera, const SimulatorOptions& options, std::uint64_t frame_index) {
  return FrameMeta(scene, camera, options).of(frame_index);
}

}  // namespace tofray::results
