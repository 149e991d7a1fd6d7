// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Meshes: their primitives' corners, and what is given at each vertex.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "base/text.h"
#include "gltf/reading.h"

namespace tofray::gltf {
namespace {

constexpr unsigned any_whole = written::whole_unsigned | written::whole_signed;
constexpr unsigned any_normalized = written::normalized_unsigned | written::normalized_signed;
constexpr unsigned shares = written::real | written::normalized_unsigned;

constexpr Wanted wanted_positions{"VEC3", nullptr, written::real | any_whole | any_normalized, "VEC3 of floats (or quantized)"};
constexpr Wanted wanted_normals{"VEC3", nullptr, written::real | written::normalized_signed, "VEC3 of floats (or quantized)"};
constexpr Wanted wanted_texcoords{"VEC2", nullptr, written::real | any_whole | any_normalized, "VEC2 of floats (or quantized)"};
constexpr Wanted wanted_colors{"VEC3", "VEC4", shares, "VEC3 or VEC4 of floats or normalized unsigned numbers"};
constexpr Wanted wanted_joints{"VEC4", nullptr, written::whole_unsigned, "VEC4 of unsigned bytes or shorts"};
constexpr Wanted wanted_weights{"VEC4", nullptr, shares, "VEC4 of floats or normalized unsigned numbers"};
constexpr Wanted wanted_indices{"SCALAR", nullptr, written::whole_unsigned | written::whole_of_4_bytes, "SCALAR of unsigned whole numbers"};

constexpr double most_off = 0.02;  // of a sum of weights: four bytes, each rounded, are 4 · 0.5/255 off at most
constexpr auto most_vertices = std::uint64_t{1} << 31;

/// Reads one primitive.
class PrimitiveReader {
 public:
  /// @param checked  accessors whose weights are known to be good: many primitives may share one
  PrimitiveReader(Reading& reading, const Item& item, std::vector<bool>& checked)
      : reading_(reading), item_(item), attributes_(item.required_object("attributes")), checked_(checked) {}

  /// @return false where it has no triangles
  bool read(Primitive& out) {
    const std::uint64_t mode = item_.count("mode").value_or(4);
    if (mode > 6) item_.fail_at("mode", "is none of a primitive", fmt::format("got {}, expected 0 to 6", mode));
    if (mode < 4) return left_out("primitives of points or lines are left out");
    out.mode = mode == 4 ? Primitive::Mode::triangles : mode == 5 ? Primitive::Mode::strip : Primitive::Mode::fan;
    out.material = item_.index("material", reading_.model.materials.size(), "materials");
    if (!attributes_.has("POSITION")) return left_out("primitives without positions are left out");
    refuse_packed();
    const int positions = accessor(attributes_, "POSITION");
    count_ = reading_.accessors[positions].count;
    if (count_ >= most_vertices) too_many();
    out.positions = reading_.accessors.floats(positions, wanted_positions, attributes_);
    if (const int indices = accessor(item_, "indices"); indices != none)
      out.indices = reading_.accessors.wholes_below(indices, wanted_indices, item_, count_, "vertices");
    if (out.mode == Primitive::Mode::triangles && out.corners() % 3 != 0)
      reading_.notices.add("corners behind a primitive's last whole triangle are left out");
    read_attributes(out);
    for (const Item& target : item_.objects("targets")) out.targets.push_back(read_target(target));
    return out.triangles() > 0 || left_out("primitives without triangles are left out");
  }

  /// The largest that a vertex names.
  [[nodiscard]] std::uint32_t most_joint() const { return most_joint_; }

 private:
  bool left_out(const std::string& sentence) {
    reading_.notices.add(sentence);
    return false;
  }

  [[noreturn]] void too_many() const {
    attributes_.fail_at("POSITION", "has too many vertices", fmt::format("got {}", count_), ErrorKind::limit);
  }

  /// Where all that there is of a primitive is compressed.
  void refuse_packed() const {
    const auto extensions = item_.object("extensions");
    if (!extensions || !extensions->has("KHR_draco_mesh_compression")) return;
    const Accessor& positions = reading_.accessors[accessor(attributes_, "POSITION")];
    if (positions.view == none && !positions.sparse)
      item_.fail("is compressed by Draco, which cannot be read", "export without Draco compression");
  }

  [[nodiscard]] int accessor(const Item& item, std::string_view key) const {
    return item.index(key, reading_.accessors.size(), "accessors");
  }

  /// An attribute's accessor, which has as many elements as there are vertices; `none` where there is no such attribute.
  [[nodiscard]] int attribute(const Item& item, std::string_view key) const {
    const int found = accessor(item, key);
    if (found != none && reading_.accessors[found].count != count_)
      item.fail_at(key, "has not one element for each vertex",
                   fmt::format("got {}, and there are {} positions", reading_.accessors[found].count, count_));
    return found;
  }

  Floats mended(const Item& item, std::string_view key, const Wanted& wanted) {
    const int found = attribute(item, key);
    if (found == none) return nullptr;
    std::size_t count = 0;
    Floats out = reading_.accessors.mended_floats(found, wanted, item, count);
    if (count > 0) reading_.notices.add(fmt::format("numbers of {} that are not finite are taken as 0", key));
    return out;
  }

  void read_attributes(Primitive& out) {
    out.normals = mended(attributes_, "NORMAL", wanted_normals);
    out.texcoords = {mended(attributes_, "TEXCOORD_0", wanted_texcoords), mended(attributes_, "TEXCOORD_1", wanted_texcoords)};
    out.colors = mended(attributes_, "COLOR_0", wanted_colors);
    if (out.colors) out.color_width = reading_.accessors[accessor(attributes_, "COLOR_0")].width;
    read_joints(out);
    (void)attribute(attributes_, "TANGENT");  // which way they point follows from texture coordinates
    constexpr std::string_view known[] = {"POSITION", "NORMAL", "TEXCOORD_0", "TEXCOORD_1", "COLOR_0", "JOINTS_0", "WEIGHTS_0", "TANGENT"};
    for (const auto& [name, value] : attributes_.members()) {
      if (std::find(std::begin(known), std::end(known), name) != std::end(known)) continue;
      (void)attribute(attributes_, name);
      reading_.notices.add("the attribute " + base::in_quotes(name) + " is left out");
    }
  }

  void read_joints(Primitive& out) {
    const int joints = attribute(attributes_, "JOINTS_0"), weights = attribute(attributes_, "WEIGHTS_0");
    if ((joints == none) != (weights == none))
      attributes_.fail("has only one of JOINTS_0 and WEIGHTS_0", joints == none ? "got WEIGHTS_0" : "got JOINTS_0");
    if (joints == none) return;
    out.joints = reading_.accessors.wholes_below(joints, wanted_joints, attributes_, 65536, "joints");
    most_joint_ = reading_.accessors.largest(joints);
    out.joint_weights = reading_.accessors.finite_floats(weights, wanted_weights, attributes_);
    if (!checked_[static_cast<std::size_t>(weights)]) check_weights(*out.joint_weights);
    checked_[static_cast<std::size_t>(weights)] = true;
  }

  void check_weights(const std::vector<float>& weights) {
    bool without = false, scaled = false;
    for (std::size_t i = 0; i < weights.size(); i += 4) {
      const auto four = weights.begin() + static_cast<std::ptrdiff_t>(i);
      if (const auto negative = std::find_if(four, four + 4, [](float w) { return w < 0; }); negative != four + 4)
        attributes_.fail_at("WEIGHTS_0", "is negative", fmt::format("got {} at vertex {}", *negative, i / 4));
      const double sum = static_cast<double>(four[0]) + four[1] + four[2] + four[3];
      without = without || sum == 0;
      scaled = scaled || (sum > 0 && std::abs(sum - 1) > most_off);
    }
    if (without) reading_.notices.add("vertices without weights follow their first joint");
    if (scaled) reading_.notices.add("weights of vertices that do not add up to 1 are scaled");
  }

  MorphTarget read_target(const Item& item) {
    MorphTarget out{mended(item, "POSITION", wanted_positions), mended(item, "NORMAL", wanted_normals)};
    for (const auto& [name, value] : item.members()) {
      if (name == "POSITION" || name == "NORMAL") continue;
      (void)attribute(item, name);
      reading_.notices.add("the attribute " + base::in_quotes(name) + " of morph targets is left out");
    }
    return out;
  }

  Reading& reading_;
  const Item& item_;
  const Item attributes_;
  std::vector<bool>& checked_;
  std::uint64_t count_ = 0;
  std::uint32_t most_joint_ = 0;
};

void read_mesh(Reading& reading, const Item& item, std::vector<bool>& checked) {
  Mesh& mesh = reading.model.meshes.emplace_back();
  mesh.name = item.name();
  const std::vector<Item> primitives = item.objects("primitives");
  if (primitives.empty()) item.fail_at("primitives", "are missing", "expected at least one");
  std::size_t targets = 0;
  mesh.has_joints = true;
  for (const Item& one : primitives) {
    Primitive primitive;
    const std::size_t here = one.size("targets");
    if (&one == &primitives.front()) targets = here;
    if (here != targets)
      one.fail_at("targets", "are not as many as those of the first primitive", fmt::format("got {}, expected {}", here, targets));
    PrimitiveReader reader(reading, one, checked);
    if (!reader.read(primitive)) continue;
    mesh.has_joints = mesh.has_joints && primitive.joints;
    mesh.most_joint = std::max(mesh.most_joint, reader.most_joint());
    mesh.primitives.push_back(std::move(primitive));
  }
  mesh.weights = item.all_numbers("weights");
  if (!item.has("weights")) mesh.weights.assign(targets, 0);
  if (mesh.weights.size() != targets)
    item.fail_at("weights", "are not one for each morph target", fmt::format("got {}, and there are {}", mesh.weights.size(), targets));
}

}  // namespace

void read_meshes(Reading& reading) {
  std::vector<bool> checked(reading.accessors.size());
  for (const Item& item : reading.root.objects("meshes")) read_mesh(reading, item, checked);
}

}  // namespace tofray::gltf
