// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/mesh_cache.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "base/shared.h"

namespace tofray::assets {

namespace {

struct Entry {
  MeshKey key;
  std::vector<NamedRead> named;  ///< files that were looked for while it was made
  std::weak_ptr<const LoadedMesh> mesh;
};

/// All meshes that were made and still live. Never destroyed: scenes may outlive what is static.
struct Cache {
  std::mutex mutex;
  std::vector<Entry> entries;  ///< guarded by it
};
Cache& cache() {
  static auto* const all = new Cache;
  return *all;
}

/// Entries of a key; files are looked at without the lock.
std::vector<Entry> entries_of(const MeshKey& key) {
  const std::lock_guard lock(cache().mutex);
  std::vector<Entry> out;
  for (const Entry& one : cache().entries)
    if (one.key == key && !one.mesh.expired()) out.push_back(one);
  return out;
}

template <class T>
std::size_t bytes_of(const std::vector<T>& values) {
  return values.size() * sizeof(T);
}

std::size_t bytes_of(const LoadedMesh& mesh) {
  std::size_t bytes = sizeof(mesh);
  for (const LoadedMesh::Piece& piece : mesh.pieces) {
    const TriangleMesh& one = *piece.triangles;
    bytes += bytes_of(one.vertices) + bytes_of(one.triangles) + bytes_of(one.normals) + bytes_of(one.texcoords) + bytes_of(one.shades);
    std::size_t texels = 0;
    count_pictures(piece.of.material, {}, texels);
    bytes += texels * sizeof(float);
  }
  return bytes;
}

}  // namespace

std::shared_ptr<const LoadedMesh> cached_mesh(const MeshKey& key, const std::function<LoadedMesh()>& make) {
  for (const Entry& one : entries_of(key)) {
    auto mesh = one.mesh.lock();
    if (mesh == nullptr || !std::all_of(one.named.begin(), one.named.end(), [](const NamedRead& read) { return read.is_unchanged(); }))
      continue;
    base::keep(mesh, bytes_of(*mesh));
    return mesh;
  }
  const NamedReads reads;
  const auto mesh = std::make_shared<const LoadedMesh>(make());
  base::keep(mesh, bytes_of(*mesh));
  const std::lock_guard lock(cache().mutex);
  std::erase_if(cache().entries, [](const Entry& one) { return one.mesh.expired(); });
  cache().entries.push_back({key, reads.all(), mesh});
  return mesh;
}

}  // namespace tofray::assets
