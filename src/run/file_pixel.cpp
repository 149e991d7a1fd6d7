// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/file_pixel.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "base/version.h"
#include "files/data_limits.h"
#include "files/read_bytes.h"
#include "files/sha256.h"
#include "results/meta.h"
#include "results/meta_camera.h"
#include "run/manifest.h"
#include "tofray/error.h"

namespace tofray::run {

namespace {

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// Whether a manifest lists a file with these bytes.
bool lists(const results::Manifest& manifest, const std::filesystem::path& path) {
  const std::string name = path.filename().native();
  const auto record = std::find_if(manifest.files.begin(), manifest.files.end(), [&](const auto& one) { return one.name == name; });
  return record != manifest.files.end() && record->sha256 == files::sha256_hex(files::read_bytes(path, files::max_data_file_bytes));
}

/// Which frame of its scene it is.
std::uint64_t index_of(const results::Arrays& arrays) {
  const files::Json* found = arrays.meta().find("frame");
  double index = 0;
  if (found != nullptr) found->number(index);
  return index >= 0 && index < 9e15 ? static_cast<std::uint64_t>(index) : 0;
}

/// The camera in `meta`; none where there is none, or none that is needed and can be read.
std::optional<Camera> camera_in(const results::Arrays& arrays) {
  if (arrays.meta().find("camera") == nullptr) return {};
  try {
    return results::camera_of_meta(arrays.meta_text(), arrays.where());
  } catch (const Error&) {
    if (arrays.phases() > 0) throw;
    return {};
  }
}

}  // namespace

PixelArrays pixel_arrays(const results::Arrays& arrays) {
  const auto side = [](std::size_t size) { return static_cast<int>(std::min<std::size_t>(size, 1'000'000)); };
  PixelArrays out{side(arrays.width()), side(arrays.height()), side(arrays.phases()), {}};
  out.at = [&arrays](std::string_view name, std::size_t i) { return arrays.at(name, i); };
  return out;
}

PixelChain pixel_chain(const results::Arrays& arrays, int u, int v) {
  const std::optional<Camera> camera = camera_in(arrays);
  return tofray::pixel_chain(pixel_arrays(arrays), camera ? &*camera : nullptr, results::is_noise_free(arrays.meta()), u, v,
                             arrays.where());
}

std::string object_name(const files::Json& meta, std::int64_t object) {
  const files::Json* scene = meta.find("scene");
  const files::Json* objects = scene == nullptr ? nullptr : scene->find("objects");
  if (objects == nullptr || !objects->is_array() || object < 0 || static_cast<std::size_t>(object) >= objects->items()->size()) return {};
  for (const char* key : {"name", "shape"}) {
    const files::Json* found = (*objects->items())[static_cast<std::size_t>(object)].find(key);
    if (found != nullptr && found->is_string() && !found->string()->empty()) return *found->string();
  }
  return {};
}

FrameOrigin origin_of_file(const std::string& path, const std::string& root, const SimulatorOptions& simulated) {
  FrameOrigin out;
  const std::string file = std::filesystem::path(path).replace_filename("manifest.json").native();
  try {
    if (!std::filesystem::exists(file)) {
      out.unknown = fmt::format("the scene is in manifest.json, which is not beside {}", path);
      return out;
    }
    const results::Manifest manifest = results::read_manifest(file);
    if (!lists(manifest, path)) {
      out.unknown = fmt::format("{} does not list {} with the bytes that it has", file, path);
    } else if (manifest.tofray_version != base::version()) {
      out.unknown = fmt::format("tofray {} made {}, this is {}", manifest.tofray_version, path, base::version());
    } else {
      RunRequest request = request_of(manifest, file);
      request.inputs.root = root;
      out.in = load_of_manifest(manifest, request.inputs);
      out.simulated = request.simulator;
      out.simulated.threads = simulated.threads, out.simulated.backend = simulated.backend, out.simulated.device = simulated.device;
      out.simulated.progress = simulated.progress;
    }
  } catch (const Error& error) {
    out.unknown = first_line(error.what());
  }
  return out;
}

PixelBounces pixel_bounces(const results::Arrays& arrays, const FrameOrigin& origin, int u, int v, const std::function<void()>& each_done) {
  const PixelArrays values = pixel_arrays(arrays);
  if (!has_bounces(values, u, v)) return {};
  if (!origin.in) return {{}, origin.unknown};
  return tofray::pixel_bounces(values, index_of(arrays), origin.in->scene, origin.in->camera, origin.simulated, u, v, each_done);
}

}  // namespace tofray::run
