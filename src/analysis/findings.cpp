// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "analysis/findings.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include "analysis/stand.h"
#include "base/constants.h"
#include "base/text.h"
#include "base/units.h"

namespace tofray::analysis {

using Kind = SceneFinding::Kind;

namespace {

/// Farther than this is no room that an indirect time-of-flight camera looks at, and 100 mm written as metres is.
constexpr double very_far_m = 100;
/// Larger than this is no thing that one has a mesh of, and 50 mm written as metres is.
constexpr double very_large_m = 50;
constexpr double large_m = 10, very_small_m = 5e-3;
/// Less wide than this is no room for a camera to stand in.
constexpr double narrow_m = 1;
constexpr double one_percent = 0.01;

std::string metres(double m) {
  if (m < 0.1) return fmt::format("{:.3g} mm", 1e3 * m);
  return fmt::format("{:.{}f} m", m, m < 10 ? 2 : m < 1000 ? 1 : 0);
}

/// −0 becomes 0.
std::string point(const Vec& p) { return fmt::format("[{:.4g}, {:.4g}, {:.4g}]", p.x + 0.0, p.y + 0.0, p.z + 0.0); }

double distance_to_box(const Body& body, const Vec& p) {
  double square = 0;
  for (int k = 0; k < 3; ++k) {
    const double off = std::max({body.low[k] - p[k], p[k] - body.high[k], 0.0});
    square += off * off;
  }
  return std::sqrt(square);
}
double widest(const Vec& low, const Vec& high) { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }

/// Objects that end somewhere.
std::vector<int> things(const SceneReport& report) {
  std::vector<int> out;
  for (const ObjectInView& one : report.objects)
    if (!one.endless) out.push_back(one.object);
  return out;
}

const ObjectInView& in_view(const SceneReport& report, int object) { return report.objects[static_cast<std::size_t>(object)]; }
const Body& body_of(const Seen& seen, int object) { return seen.bodies[static_cast<std::size_t>(object)]; }

bool anything_moves(const Scene& scene) {
  return !scene.camera.keyframes.empty() || std::any_of(scene.objects.begin(), scene.objects.end(), scene::moves);
}

std::string camera_text(const Seen& seen) {
  return fmt::format("the camera stands at {} and looks along {}", point(seen.eye), point(seen.forward));
}

/// Where the nearest of them is, and how the camera would look at it.
std::string way_to(const Seen& seen, const std::vector<int>& objects) {
  const int nearest = *std::min_element(objects.begin(), objects.end(), [&](int a, int b) {
    return distance_to_box(body_of(seen, a), seen.eye) < distance_to_box(body_of(seen, b), seen.eye);
  });
  const Body& body = body_of(seen, nearest);
  const Vec middle = 0.5 * (body.low + body.high), way = middle - seen.eye;
  const double distance = shape::length(way);
  if (!(distance > 0)) return "";
  const double angle = std::acos(std::clamp(shape::dot(way, seen.forward) / distance, -1.0, 1.0)) * 180 / base::pi;
  return fmt::format("; {} is {} away, {:.0f} deg off its axis: camera.pose.look_at: {} looks at it", name_of(seen.scene, nearest),
                     metres(distance), angle, point(middle));
}

/// @return whether something is said
bool find_nothing(const Seen& seen, SceneReport& report) {
  const std::vector<int> all = things(report);
  const bool hits = report.no_surface + report.outside_lens < report.pixels;
  const auto is_seen = [&](int i) { return in_view(report, i).pixels > 0 || in_view(report, i).around_camera; };
  if (hits && (all.empty() || anything_moves(seen.scene) || std::any_of(all.begin(), all.end(), is_seen))) return false;
  if (all.empty()) {
    add(seen, report, Kind::nothing_in_view, true, {}, "no ray of the camera hits an object: they are planes that it does not look at",
        camera_text(seen));
    return true;
  }
  const bool behind = std::all_of(all.begin(), all.end(), [&](int i) { return in_view(report, i).behind_camera; });
  const std::string who = all.size() == 1 ? name_of(seen.scene, all[0]) : fmt::format("all {} objects that are no planes", all.size());
  const std::string but = hits ? ", which sees planes alone" : ", whose rays hit nothing";
  const std::string what = behind ? fmt::format("{} {} behind the camera{}", who, all.size() == 1 ? "is" : "are", but)
                           : hits ? fmt::format("the camera sees planes alone: {} {} out of view", who, all.size() == 1 ? "is" : "are")
                                  : fmt::format("no ray of the camera hits an object: it looks past {}", who);
  // Light that bounces comes round corners: who follows it may well look at a wall alone.
  const bool warning = !hits || seen.scene.transport.bounces == 0;
  add(seen, report, behind ? Kind::behind_camera : Kind::nothing_in_view, warning, all, what, camera_text(seen) + way_to(seen, all));
  return true;
}

/// @return whether something is said
bool find_millimetres(const Seen& seen, SceneReport& report) {
  std::vector<int> all = things(report);
  const bool hits = report.nearest_m.has_value();
  const bool far = std::all_of(all.begin(), all.end(), [&](int i) { return distance_to_box(body_of(seen, i), seen.eye) > very_far_m; });
  if (hits ? *report.nearest_m <= very_far_m : all.empty() || !far) return false;
  double nearest = report.nearest_m.value_or(std::numeric_limits<double>::infinity());
  for (const int i : all)
    if (!hits) nearest = std::min(nearest, distance_to_box(body_of(seen, i), seen.eye));
  for (const ObjectInView& one : report.objects)
    if (one.endless && one.pixels > 0) all.push_back(one.object);
  add(seen, report, Kind::millimetres, true, all, fmt::format("the nearest object is {} away from the camera", metres(nearest)),
      fmt::format("coordinates without a unit are metres: are these millimetres? Then this would be {}: write 1.5 or 1500 mm, not 1500",
                  metres(1e-3 * nearest)));
  return true;
}

/// A mesh's file, and all objects that show a part of it.
struct MeshFile {
  std::vector<int> objects;
  Body all;
  double nearest_m = std::numeric_limits<double>::infinity();
};
std::vector<MeshFile> mesh_files(const Seen& seen, const SceneReport& report) {
  std::map<std::string, std::size_t> place;
  std::vector<MeshFile> out;
  for (std::size_t i = 0; i < seen.scene.objects.size(); ++i) {
    const Object& object = seen.scene.objects[i];
    if (!std::holds_alternative<Mesh>(object.shape)) continue;
    const auto [found, fresh] = place.try_emplace(object.key.empty() ? std::to_string(i) : object.key, out.size());
    if (fresh) out.push_back({{}, seen.bodies[i]});
    MeshFile& file = out[found->second];
    file.objects.push_back(static_cast<int>(i));
    for (int k = 0; k < 3; ++k)
      file.all.low[k] = std::min(file.all.low[k], seen.bodies[i].low[k]),
      file.all.high[k] = std::max(file.all.high[k], seen.bodies[i].high[k]);
    file.nearest_m = std::min(file.nearest_m, report.objects[i].nearest_m.value_or(file.nearest_m));
  }
  return out;
}

/// How the command line says a mesh's scale.
std::string set_scale(const Object& object) { return object.key.empty() ? "" : fmt::format(" (--set {}.mesh.scale=0.001)", object.key); }

/// @return whether something is said
bool find_mesh_sizes(const Seen& seen, SceneReport& report) {
  bool said = false;
  for (const MeshFile& file : mesh_files(seen, report)) {
    const double size = widest(file.all.low, file.all.high),
                 scale = std::get<Mesh>(seen.scene.objects[static_cast<std::size_t>(file.objects[0])].shape).scale;
    const bool unseen = !(file.nearest_m <= report.ambiguity_range_m);
    const bool large = size >= very_large_m || (size >= large_m && unseen && report.ambiguity_range_m > 0);
    if (!large && !(scale < 1 && size > 0 && size < very_small_m)) continue;
    const std::string more =
        large && scale == 1 ? fmt::format("is its file in millimetres? Then say scale: 0.001 in its mesh{}",
                                          set_scale(seen.scene.objects[static_cast<std::size_t>(file.objects[0])]))
        : large             ? fmt::format("its mesh says scale: {}, which makes metres of the file's numbers", base::number_text(scale))
                            : fmt::format("is its file in metres? Then take scale: {} out of its mesh", base::number_text(scale));
    add(seen, report, Kind::mesh_size, true, file.objects,
        fmt::format("{} measures {}", name_of(seen.scene, file.objects[0]),
                    base::size_text({file.all.low.x, file.all.low.y, file.all.low.z}, {file.all.high.x, file.all.high.y, file.all.high.z})),
        more);
    said = true;
  }
  return said;
}

void find_around(const Seen& seen, SceneReport& report) {
  std::vector<int> around;
  std::set<std::string> entries;
  bool others = false, others_seen = false, narrow = false;
  std::int64_t pixels = 0;
  for (const ObjectInView& one : report.objects) {
    if (one.around_camera) {
      if (entries.insert(name_of(seen.scene, one.object)).second) around.push_back(one.object);
      pixels += one.pixels;
      narrow = narrow || widest({one.low[0], one.low[1], one.low[2]}, {one.high[0], one.high[1], one.high[2]}) < narrow_m;
    } else if (!one.endless) {
      others = true, others_seen = others_seen || one.pixels > 0;
    }
  }
  if (around.empty()) return;
  const bool hides = others && !others_seen && !anything_moves(seen.scene);
  add(seen, report, Kind::around_camera, hides || (narrow && 2 * pixels > report.pixels), around,
      fmt::format("the camera stands inside {}", names_of(seen.scene, around)),
      std::string("it sees the inner side, and nothing beyond") + (hides ? ": none of the other objects is in view" : ""));
}

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}
bool is_called(const Object& object, std::initializer_list<const char*> words) {
  const std::string name = lower(object.name);
  return std::any_of(words.begin(), words.end(), [&](const char* word) { return name.find(word) != std::string::npos; });
}

/// The normal of something flat, turned as the object is; nothing where it is not flat.
std::optional<Vec> normal_of(const Object& object) {
  const shape::Mat turn = scene::rotation_matrix(object.rotation);
  if (const auto* plane = std::get_if<Plane>(&object.shape)) return shape::normalized(turn * scene::vec(plane->normal));
  if (const auto* disk = std::get_if<Disk>(&object.shape)) return shape::normalized(turn * scene::vec(disk->normal));
  if (std::holds_alternative<Rectangle>(object.shape)) return turn * Vec{0, 0, 1};
  return {};
}

/// How far a floor or ceiling is above the camera [m]; nothing for what is not level.
std::optional<double> height_above(const Seen& seen, std::size_t i, const Vec& up) {
  const Object& object = seen.scene.objects[i];
  const std::optional<Vec> normal = normal_of(object);
  if (!normal || scene::moves(object) || !(std::abs(shape::dot(*normal, up)) > 0.9)) return {};
  const Body& body = seen.bodies[i];
  const Vec at =
      body.endless ? scene::vec(std::get<Plane>(object.shape).point) + scene::vec(object.position) : 0.5 * (body.low + body.high);
  return shape::dot(at - seen.eye, up);
}

/// Which way is up: what the scene says of its world; else the camera's up, and of a pose by quaternion, which has none, −y.
Vec up_of(const Seen& seen) {
  if (seen.scene.world_up == Scene::Up::z) return {0, 0, 1};
  if (seen.scene.world_up == Scene::Up::y) return {0, 1, 0};
  return seen.pose.quaternion ? Vec{0, -1, 0} : shape::normalized(scene::vec(seen.pose.up));
}

/// A floor that is above the camera by its name, or a plane above it where the scene has no other level plane and does not call it a
/// ceiling. A camera that looks up or down does not know which way is up.
void find_floors(const Seen& seen, SceneReport& report) {
  const Vec up = up_of(seen);
  if (std::abs(shape::dot(up, seen.forward)) > 0.8) return;
  // Else the camera lies on its side or hangs upside down.
  const bool said = seen.scene.world_up != Scene::Up::minus_y;
  if (!(said || up.y < -0.9 || up.z > 0.9)) return;
  std::vector<int> level, above;
  for (std::size_t i = 0; i < seen.scene.objects.size(); ++i) {
    const Object& object = seen.scene.objects[i];
    const std::optional<double> height = height_above(seen, i, up);
    if (!height) continue;
    if (std::holds_alternative<Plane>(object.shape)) level.push_back(static_cast<int>(i));
    if (*height > 0 && is_called(object, {"floor", "ground"})) above.push_back(static_cast<int>(i));
  }
  if (above.empty() && up.y < -0.9 && level.size() == 1 &&
      !is_called(seen.scene.objects[static_cast<std::size_t>(level[0])], {"ceiling", "roof", "sky", "lid"}) &&
      *height_above(seen, static_cast<std::size_t>(level[0]), up) > 0)
    above = level;
  if (above.empty()) return;
  const double height = *height_above(seen, static_cast<std::size_t>(above[0]), up);
  add(seen, report, Kind::floor_above, true, above,
      fmt::format("{} is level and {} above the camera: a ceiling, not a floor", name_of(seen.scene, above[0]), metres(height)),
      up.y < -0.9 ? "the world's y points down: a floor has a larger y than the camera, as in point: [0, 0.5, 0]; a ceiling is known by "
                    "its name, as in name: ceiling"
                  : fmt::format("up is {} by {}; a ceiling is known by its name, as in name: ceiling", point(up),
                                said ? "world_up" : "camera.pose.up"));
}

/// What is seen of them lies all beyond the ambiguity range.
void find_beyond(const Seen& seen, SceneReport& report) {
  if (!(report.ambiguity_range_m > 0)) return;
  std::vector<int> beyond;
  std::int64_t pixels = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (const ObjectInView& one : report.objects)
    if (one.nearest_m && *one.nearest_m > report.ambiguity_range_m)
      beyond.push_back(one.object), pixels += one.pixels, nearest = std::min(nearest, *one.nearest_m);
  if (!(static_cast<double>(pixels) >= one_percent * static_cast<double>(report.pixels))) return;
  std::stable_sort(beyond.begin(), beyond.end(), [&](int a, int b) { return in_view(report, a).pixels > in_view(report, b).pixels; });
  const std::string range = fmt::format("{:.3f} m", report.ambiguity_range_m);
  add(seen, report, Kind::beyond_reach, true, beyond,
      fmt::format("{} {} beyond the ambiguity range of {}: the nearest of it is {} away", names_of(seen.scene, beyond),
                  beyond.size() == 1 ? "is" : "are", range, metres(nearest)),
      fmt::format("where it has a depth, that is too small by {} or a multiple: move it nearer, or take a mode of a longer range", range));
}

}  // namespace

std::string name_of(const Scene& scene, int object) {
  const Object& one = scene.objects[static_cast<std::size_t>(object)];
  const std::string key = one.key.empty() ? fmt::format("objects.{}", object) : one.key;
  std::string name = one.name;
  if (const auto* mesh = std::get_if<Mesh>(&one.shape); mesh != nullptr && name.empty())
    name = std::filesystem::path(mesh->file).filename().string();
  if (name.empty()) name = kind_of(one);
  return fmt::format("{} ({})", key, base::printable(name.substr(0, 60)));
}

std::string names_of(const Scene& scene, const std::vector<int>& objects) {
  constexpr std::size_t most = 3;
  std::vector<std::string> names;
  for (const int one : objects) names.push_back(name_of(scene, one));
  if (names.size() > most + 1) {
    const std::size_t rest = names.size() - most;
    names.resize(most);
    names.push_back(fmt::format("{} more", rest));
  }
  return base::listed(names, "and");
}

void add(const Seen& seen, SceneReport& report, Kind kind, bool warning, const std::vector<int>& objects, const std::string& what,
         const std::string& more) {
  const std::string where = objects.empty() ? "" : seen.scene.objects[static_cast<std::size_t>(objects[0])].where;
  report.findings.push_back({kind, warning, objects, where, what, more});
}

void add_findings(const Seen& seen, SceneReport& report) {
  if (seen.scene.objects.empty())
    return add(seen, report, Kind::no_objects, true, {}, "the scene has no objects: objects is []",
               "no pixel gets any light back: what depth there is, is noise");
  const bool mesh = find_mesh_sizes(seen, report);
  const bool far = !mesh && find_millimetres(seen, report);
  const bool nothing = !far && find_nothing(seen, report);
  find_around(seen, report);
  find_floors(seen, report);
  find_overlaps(seen, report);
  if (!mesh && !far && !nothing) find_beyond(seen, report);
}

}  // namespace tofray::analysis
