// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/input_kind.h"

#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "base/text.h"
#include "files/text_file.h"
#include "load/builtin.h"
#include "load/convert.h"
#include "mesh/other_formats.h"
#include "tofray/error.h"
#include "yaml/tree.h"

namespace tofray::run {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const std::string& path, const std::string& what, const std::string& fitting) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: error: this is {}\n  {}", base::printable(path), what, fitting));
}

/// Whether the first line that is no comment is one of an OBJ file's.
bool looks_like_obj(std::string_view bytes) {
  while (bytes.starts_with('#') || bytes.starts_with('\n') || bytes.starts_with('\r'))
    bytes.remove_prefix(std::min(bytes.find('\n'), bytes.size() - 1) + 1);
  return bytes.starts_with("v ") || bytes.starts_with("mtllib ");
}

constexpr std::size_t enough_names = 10'000;  // for a message

/// "it holds a.npz", "it holds a.npz … z.npz (26 files)", or that there is nothing.
std::string held(const std::vector<std::string>& names, const char* none) {
  if (names.empty()) return none;
  if (names.size() == 1) return "it holds " + base::printable(names[0]);
  return fmt::format("it holds {} … {} ({} files)", base::printable(names.front()), base::printable(names.back()), names.size());
}

}  // namespace

NamedText named_text(const std::string& name) {
  if (name != "-") return {load::read_named("scene", name, load::builtin_scenes()), name};
  static const std::string typed = files::read_standard_input();
  return {typed, "<stdin>"};
}

void refuse_missing(const std::string& path) {
  std::error_code ignored;
  if (fs::exists(path, ignored)) return;
  const fs::path folder = fs::path(path).parent_path();
  const std::string shown = folder.empty() ? "." : folder.native();
  if (!is_folder(shown)) return;  // who reads it says what is wrong
  const std::string ending = fs::path(path).extension().native();
  const std::string others = held(names_in(shown, {ending}, enough_names), ("it holds no " + base::printable(ending) + " file").c_str());
  throw Error(ErrorKind::io, fmt::format("{}: error: there is no such file\n  {} {}", base::printable(path),
                                         folder.empty() ? "this folder" : "the folder " + base::in_quotes(shown), others.substr(3)));
}

bool is_folder(const std::string& path) {
  std::error_code ignored;
  return fs::is_directory(path, ignored);
}

std::vector<std::string> names_in(const std::string& folder, const std::vector<std::string>& endings, std::size_t most) {
  std::vector<std::string> names;
  std::error_code error;
  std::size_t looked_at = 0;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end && looked_at < most; entry.increment(error), ++looked_at) {
    if (std::find(endings.begin(), endings.end(), entry->path().extension().native()) != endings.end())
      names.push_back(entry->path().filename().native());
  }
  std::sort(names.begin(), names.end());
  return names;
}

void refuse_other_mesh(const std::string& path) {
  const auto other = mesh::other_format_of(path);
  std::error_code ignored;
  if (!other || !fs::is_regular_file(path, ignored)) return;
  refuse(path, other->what + ", which is not read", fmt::format("expected a mesh, {}, or a scene: {}", mesh::formats_read, other->way));
}

void refuse_data(std::string_view bytes, const std::string& path) {
  const std::string file = base::printable(path);
  if (bytes.starts_with("PK\x03\x04"))
    refuse(path, "an archive of arrays (.npz), not a scene",
           fmt::format("`tofray inspect {0}` shows what is in it, `tofray process {0}` makes depth of its raw frames", file));
  if (bytes.starts_with("\x93NUMPY"))
    refuse(path, "an array (.npy), not a scene", fmt::format("`tofray inspect {}` shows what is in it", file));
  if (bytes.starts_with("\x89MCAP0"))
    refuse(path, "a film (MCAP), not a scene",
           fmt::format("`tofray inspect {0}` shows what is in it, `tofray process {0}` makes depth of its raw frames", file));
  if (bytes.starts_with("\x89PNG"))
    refuse(path, "a picture (PNG), not a scene", "it cannot be simulated again; the manifest.json beside it can: `tofray render --from`");
  if (bytes.starts_with("glTF"))
    refuse(path, "a binary glTF file, not a scene", "expected a scene, a YAML or JSON file; a mesh is read where its name ends in .glb");
  if (bytes.starts_with("solid ") || bytes.starts_with("solid\n"))
    refuse(path, "an STL file, not a scene", "expected a scene, a YAML or JSON file; a mesh is read where its name ends in .stl");
  if (const auto other = mesh::other_format_in(bytes))
    refuse(path, other->what + ", not a scene",
           fmt::format("expected a scene, a YAML or JSON file, or a mesh, {}: {}", mesh::formats_read, other->way));
  if (looks_like_obj(bytes))
    refuse(path, "an OBJ file, not a scene", "expected a scene, a YAML or JSON file; a mesh is read where its name ends in .obj");
  if (bytes.starts_with("ply\n"))
    refuse(path, "a PLY file, not a scene", "expected a scene, a YAML or JSON file; a mesh is read where its name ends in .ply");
}

bool looks_like_a_profile(const std::string& text, const std::string& name) {
  const yaml::Node root = yaml::parse_tree(text, name);
  return root.find("objects") == nullptr &&
         (root.find("modes") != nullptr || root.find("sensor") != nullptr || root.find("lens") != nullptr);
}

void refuse_other_document(const std::string& text, const std::string& path) {
  const std::string file = base::printable(path);
  if (looks_like_a_profile(text, path))
    refuse(path, "a camera profile, not a scene",
           fmt::format("a scene takes it as `camera: {{profile: {0}}}`; `tofray check {0}` reads it alone", file));
  const yaml::Node root = yaml::parse_tree(text, path);
  if (root.find("tofray") != nullptr && root.find("inputs") != nullptr)
    refuse(path, "a manifest, not a scene", fmt::format("`tofray render --from {}` makes its files again", file));
}

void refuse_folder(const std::string& path, const char* command) {
  if (!is_folder(path)) return;
  const std::vector<std::string> scenes = names_in(path, {".yaml", ".yml"}, enough_names);
  throw Error(ErrorKind::io, fmt::format("{}: error: this is a folder, not a scene\n  {}; name one, as in `tofray {} {}`",
                                         base::printable(path), held(scenes, "it holds no .yaml file"), command,
                                         scenes.empty() ? "room" : base::printable((fs::path(path) / scenes[0]).native())));
}

std::string frame_in(const std::string& path, const char* command) {
  if (!is_folder(path)) return path;
  const fs::path frame = fs::path(path) / "frame.npz";
  std::error_code ignored;
  if (fs::exists(frame, ignored)) return frame.native();
  const std::vector<std::string> all = names_in(path, {".npz", ".npy", ".mcap"}, enough_names);
  refuse(path, "a folder without frame.npz",
         held(all, "it holds no .npz, .npy or .mcap file") +
             (all.empty() ? ""
                          : fmt::format("; name one, as in `tofray {} {}`", command, base::printable((fs::path(path) / all[0]).native()))));
}

NameChoice frame_or_scene(const std::string& typed, const char* command) {
  if (!is_folder(typed)) return choose_scene(typed);
  const std::string file = frame_in(typed, command);
  if (load::find_builtin(load::builtin_scenes(), typed) == nullptr) return {file, {}};
  return {file, fmt::format("{} is taken, not the built-in scene {}\n  the built-in one is taken where there is no folder of its name",
                            file, typed)};
}

std::string note_of(const NameChoice& choice) { return choice.note.empty() ? "" : "note: " + choice.note + "\n"; }

}  // namespace tofray::run
