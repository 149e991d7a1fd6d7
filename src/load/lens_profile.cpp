// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// A calibration as text of a profile.
#include <fmt/core.h>

#include <utility>
#include <vector>

#include "base/text.h"
#include "files/text_file.h"
#include "load/builtin.h"
#include "load/convert.h"
#include "load/lens_calibration.h"
#include "load/load.h"

namespace tofray::load {

namespace {

using yaml::Node;

Node scalar(const std::string& text) {
  Node node;
  node.kind = Node::Kind::scalar;
  node.text = text;
  return node;
}

void put(Node& map, const std::string& key, Node value) {
  map.keys.push_back({key, {}});
  map.items.push_back(std::move(value));
}

Node empty_map() {
  Node node;
  node.kind = Node::Kind::map;
  return node;
}

void remove(Node& map, const std::string& key) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    if (map.keys[i].text != key) continue;
    map.keys.erase(map.keys.begin() + static_cast<std::ptrdiff_t>(i));
    map.items.erase(map.items.begin() + static_cast<std::ptrdiff_t>(i));
    return;
  }
}

/// fx, fy, cx, cy and distortion, each with where it comes from.
Node lens_keys(const LensCalibration& calibration, const std::string& source) {
  const Lens& lens = calibration.lens;
  const std::string from = fmt::format("{}, {}", source, calibration.format);
  Node out = empty_map();
  const std::pair<const char*, double> pixels[] = {{"fx", lens.fx_px}, {"fy", lens.fy_px}, {"cx", lens.cx_px}, {"cy", lens.cy_px}};
  for (const auto& [key, value] : pixels) {
    Node number = empty_map();
    put(number, "value", scalar(fmt::format("{} px", value)));
    put(number, "source", scalar(from));
    put(out, key, std::move(number));
  }
  const bool fisheye = lens.distortion == Lens::Distortion::fisheye;
  Node distortion = empty_map();
  put(distortion, "source", scalar(from));
  put(distortion, "model", scalar(fisheye ? "fisheye" : "brown_conrady"));
  std::vector<std::pair<const char*, double>> coefficients = {{"k1", lens.k1}, {"k2", lens.k2}};
  if (!fisheye) coefficients.insert(coefficients.end(), {{"p1", lens.p1}, {"p2", lens.p2}});
  coefficients.insert(coefficients.end(), {{"k3", lens.k3}, {"k4", lens.k4}});
  if (!fisheye) coefficients.insert(coefficients.end(), {{"k5", lens.k5}, {"k6", lens.k6}});
  for (const auto& [key, value] : coefficients) put(distortion, key, scalar(fmt::format("{}", value)));
  put(out, "distortion", std::move(distortion));
  return out;
}

/// A node on lines of its own where it is long: maps and lists to two levels below.
std::string block_text(const Node& node, int indent, int levels) {
  constexpr std::size_t widest = 110;
  const std::string flow = yaml::flow_text(node);
  if (node.items.empty() || levels == 0 || flow.size() + static_cast<std::size_t>(indent) < widest) return " " + flow + "\n";
  std::string out = "\n";
  const bool map = node.kind == Node::Kind::map;
  for (std::size_t i = 0; i < node.items.size(); ++i) {
    out += std::string(static_cast<std::size_t>(indent), ' ');
    if (map) {
      const std::string key = yaml::flow_text(scalar(node.keys[i].text));
      out += key + ":" + block_text(node.items[i], indent + 2, levels - 1);
    } else {
      out += "- " + yaml::flow_text(node.items[i]) + "\n";
    }
  }
  return out;
}

struct ProfileText {
  std::string text, source, folder;
};

ProfileText profile_text(const std::string& file_or_name) {
  if (const Builtin* builtin = find_builtin(builtin_profiles(), file_or_name))
    return {std::string(builtin->text), "<" + builtin->name + ">", {}};
  return {read_named("camera", file_or_name, builtin_profiles()), file_or_name, files::folder_of(file_or_name)};
}

}  // namespace

PixelGrid sensor_of(const std::string& file_or_name) {
  const Camera camera = load_camera(file_or_name);
  return {camera.sensor.width, camera.sensor.height};
}

std::string lens_block(const LensCalibration& calibration, const std::string& source) {
  return "lens:" + block_text(lens_keys(calibration, source), 2, 2);
}

std::string profile_with_lens(const std::string& file_or_name, const LensCalibration& calibration, const std::string& source) {
  const ProfileText from = profile_text(file_or_name);
  Node root = yaml::parse_tree(from.text, from.source);
  Node* lens = root.find("lens");
  if (lens == nullptr || lens->kind != Node::Kind::map)
    base::fail(base::whole(from.source), "the profile has no lens", "expected a map `lens`");
  for (const char* key : {"fx", "fy", "cx", "cy", "distortion"}) remove(*lens, key);
  Node keys = lens_keys(calibration, source);
  for (std::size_t i = 0; i < keys.keys.size(); ++i) put(*lens, keys.keys[i].text, std::move(keys.items[i]));
  std::string text = fmt::format("# {}, its lens out of {}\n", file_or_name, source);
  for (std::size_t i = 0; i < root.keys.size(); ++i)
    text += yaml::flow_text(scalar(root.keys[i].text)) + ":" + block_text(root.items[i], 2, 2);
  (void)camera_from_text(text, source + " in " + file_or_name, from.folder);  // is refused where it cannot be a lens of ours
  return text;
}

}  // namespace tofray::load
