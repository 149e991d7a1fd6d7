// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "gltf/read.h"

#include <fmt/core.h>

#include "base/faults.h"
#include "base/limits.h"
#include "gltf/container.h"
#include "gltf/reading.h"

namespace tofray::gltf {

Model read(const std::string& name, std::string_view bytes, const Resources& other_files) {
  const Container container = split(bytes, name);
  if (container.json.size() > static_cast<std::size_t>(base::limit::gltf_json_bytes.value))
    base::fail(base::whole(name), "there are too many bytes of JSON",
               fmt::format("got {}, at most {} (`tofray --limits`): export it as binary glTF", container.json.size(),
                           base::limit::gltf_json_bytes.value),
               ErrorKind::limit);
  const files::Json json = files::parse_json(container.json, name, static_cast<std::size_t>(base::limit::gltf_json_values.value));
  const Item root(json, name);
  Notices notices;
  check_version_and_extensions(root, notices);
  check_lists(root);
  const Buffers buffers(root, container.binary, other_files);
  Accessors accessors(root, buffers);
  Reading reading{root, buffers, accessors, other_files, std::move(notices), {}};
  read_materials(reading);
  read_meshes(reading);
  read_cameras(reading);
  read_skins(reading);
  read_nodes(reading);
  read_animations(reading);
  check_totals(reading);
  reading.model.notices = reading.notices.sentences();
  return std::move(reading.model);
}

}  // namespace tofray::gltf
