// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Rays per second through meshes, one thread: camera rays and shadow rays of a pico flexx's image, in squares of 4 × 4 as the tiles of
// `tofray bench` are, each ray by itself, and by Embree's packets of sixteen where Embree is installed. And how long hierarchies take.
#if defined(__AVX512F__)
#include "num/avx512.h"
#else
#include "num/avx2.h"
#endif
#include "num/twin.h"
// The number type comes first.
#if defined(TOFRAY_HAS_EMBREE)
#include <embree3/rtcore.h>
#endif
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>

#include "assets/builtin_mesh.h"
#include "scene/hierarchy.h"
#include "shape/mesh_square.h"

using namespace tofray;

namespace {

#if defined(__AVX512F__)
constexpr const char* set = "AVX-512";
using F = num::Twin<num::F32x16>;
#else
constexpr const char* set = "AVX2";
using F = num::Twin<num::F32x8>;
#endif
using shape::TileRays;

constexpr int width = 224, height = 172, rounds = 41;
constexpr float light[3] = {0.02f, 0.0f, 0.0f};

double seconds() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

template <class Run>
double median_of(const Run& run) {
  std::array<double, rounds> times{};
  for (double& time : times) {
    const double before = seconds();
    run();
    time = seconds() - before;
  }
  std::sort(times.begin(), times.end());
  return times[rounds / 2];
}

/// The ball and the floor of the scene bench-mesh as one mesh of about `triangles`, before a camera at zero that looks along +z.
TriangleMesh world(double triangles) {
  const int cuts = std::max(0, static_cast<int>(std::lround(std::log(0.8 * triangles / 20) / std::log(4.0))));
  const int cells = std::max(1, static_cast<int>(std::lround(std::sqrt(0.1 * triangles))));
  TriangleMesh out = assets::bumpy_ball(cuts), floor = assets::wavy_floor(cells);
  for (auto& v : out.vertices) v[2] += 1.2f;
  const auto first = static_cast<std::int32_t>(out.vertices.size());
  for (auto& v : floor.vertices) out.vertices.push_back({v[0], v[1] + 0.5f, v[2] + 1.2f});
  for (auto& t : floor.triangles) out.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  return out;
}

/// Tiles of an image, in the order in which `tofray` goes through them.
struct Image {
  std::vector<TileRays> tiles = std::vector<TileRays>(static_cast<std::size_t>((width / 32) * ((height + 7) / 8)));

  template <class Each>
  void each(const Each& each_ray) {
    for (std::size_t i = 0; i < tiles.size(); ++i)
      for (int r = 0; r < TileRays::count; ++r) {
        const int x = static_cast<int>(i % (width / 32)) * 32 + r % 32, y = static_cast<int>(i / (width / 32)) * 8 + r / 32;
        each_ray(tiles[i], r, x, y);
      }
  }
  static void aim(TileRays& tile, int r, float x, float y, float z) { tile.given[0][r] = x, tile.given[1][r] = y, tile.given[2][r] = z; }
};

struct Rays {
  Image camera, shadow;
  int camera_count = 0, shadow_count = 0;
};

template <bool any>
void search(const shape::MeshForm& form, const Image& from, Image& work) {
  for (std::size_t i = 0; i < from.tiles.size(); ++i) {
    TileRays& tile = work.tiles[0];  // as in a frame, where one place in memory serves all tiles of a worker
    std::memcpy(static_cast<void*>(&tile), &from.tiles[i], offsetof(TileRays, t));
    shape::search_tile<any, F>(form, tile);
    std::memcpy(work.tiles[i].triangle, tile.triangle, sizeof tile.triangle), std::memcpy(work.tiles[i].t, tile.t, sizeof tile.t);
  }
}

template <bool any>
void search_one_by_one(const shape::MeshForm& form, const Image& from, Image& work) {
  for (std::size_t i = 0; i < from.tiles.size(); ++i) {
    const TileRays& tile = from.tiles[i];
    for (int r = 0; r < TileRays::count; ++r) {
      if (!(tile.far[r] > 0)) continue;
      shape::MeshRay<float> ray{
          {form.origin[0], form.origin[1], form.origin[2]}, {tile.given[0][r], tile.given[1][r], tile.given[2][r]}, form.slack};
      shape::MeshHit<float> hit{tile.far[r], 0x7fffffff, -1};
      shape::search_mesh<any>(form, ray, any ? 0.0f : shape::nearest_mesh, true, hit);
      work.tiles[i].t[r] = hit.t, std::memcpy(&work.tiles[i].triangle[r], &hit.triangle, 4);
    }
  }
}

std::int32_t triangle_of(const TileRays& tile, int r) {
  std::int32_t out = 0;
  std::memcpy(&out, &tile.triangle[r], 4);
  return out;
}

#if defined(TOFRAY_HAS_EMBREE)
struct Embree {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = rtcNewScene(device);

  explicit Embree(const TriangleMesh& mesh) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void* vertices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, mesh.vertices.size());
    std::memcpy(vertices, mesh.vertices.data(), 12 * mesh.vertices.size());
    void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, mesh.triangles.size());
    std::memcpy(indices, mesh.triangles.data(), 12 * mesh.triangles.size());
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);
  }
  Embree(const Embree&) = delete;
  Embree& operator=(const Embree&) = delete;
  ~Embree() { rtcReleaseScene(scene), rtcReleaseDevice(device); }

  template <bool any>
  void trace(const Image& from, const float* origin, Image& work) const {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (std::size_t i = 0; i < from.tiles.size(); ++i) {
      const TileRays& tile = from.tiles[i];
      for (int y = 0; y < 8; y += 4)
        for (int x = 0; x < 32; x += 4) {
          RTCRayHit16 rays;
          alignas(64) int valid[16];
          for (int k = 0; k < 16; ++k) {
            const int r = (y + k / 4) * 32 + x + k % 4;
            rays.ray.org_x[k] = origin[0], rays.ray.org_y[k] = origin[1], rays.ray.org_z[k] = origin[2];
            rays.ray.dir_x[k] = tile.given[0][r], rays.ray.dir_y[k] = tile.given[1][r], rays.ray.dir_z[k] = tile.given[2][r];
            rays.ray.tnear[k] = 0, rays.ray.tfar[k] = tile.far[r], rays.ray.mask[k] = ~0u, rays.ray.flags[k] = 0, rays.ray.time[k] = 0;
            rays.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID, rays.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;
            valid[k] = tile.far[r] > 0 ? -1 : 0;
          }
          if constexpr (any) {
            rtcOccluded16(valid, scene, &context, &rays.ray);
          } else {
            rtcIntersect16(valid, scene, &context, &rays);
          }
          for (int k = 0; k < 16; ++k) work.tiles[i].t[(y + k / 4) * 32 + x + k % 4] = rays.ray.tfar[k];
        }
    }
  }
};
#endif

void measure(double wanted) {
  const TriangleMesh mesh = world(wanted);
  scene::Hierarchy built;
  const double build = [&] {
    std::array<double, 3> times{};
    for (double& time : times) {
      const double before = seconds();
      built = scene::build_hierarchy(mesh);
      time = seconds() - before;
    }
    std::sort(times.begin(), times.end());
    return times[1];
  }();
  const auto triangles = static_cast<double>(mesh.triangles.size());
  const double bytes =
      static_cast<double>(built.nodes.size() * sizeof(shape::MeshNode) + built.triangles.size() * sizeof(shape::MeshTriangles));
  const shape::Mesh placed = shape::Mesh::placed(built, {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}});
  const shape::MeshForm eye = shape::seen_from(placed, {0, 0, 0});
  const shape::MeshForm lamp =
      shape::seen_from(placed, {static_cast<double>(light[0]), static_cast<double>(light[1]), static_cast<double>(light[2])});

  Rays rays;
  rays.camera.each([&](TileRays& tile, int r, int x, int y) {
    Image::aim(tile, r, (static_cast<float>(x) - 111.5f) / 212.0f, (static_cast<float>(y) - 85.5f) / 212.0f, 1.0f);
    tile.far[r] = x < width && y < height ? 3e38f : -1.0f, tile.shortest[r] = shape::nearest_mesh;
    rays.camera_count += tile.far[r] > 0;
  });
  Image work = rays.camera, other = work;
  search<false>(eye, rays.camera, work);
  rays.shadow = rays.camera;
  std::size_t at = 0;
  rays.shadow.each([&](TileRays& tile, int r, int, int) {
    const TileRays& hit = work.tiles[at++ / TileRays::count];
    const bool met = triangle_of(hit, r) >= 0 && tile.far[r] > 0;
    for (auto& given : tile.given) given[r] *= met ? hit.t[r] : 1.0f;
    for (int k = 0; k < 3; ++k) tile.given[k][r] -= light[k];
    tile.far[r] = met ? 0.9999f : -1.0f, tile.shortest[r] = 0;
    rays.shadow_count += met;
  });

  const auto rate = [&](int count, double time) { return fmt::format("{:7.2f}", count / time * 1e-6); };
  const std::string own = rate(rays.camera_count, median_of([&] { search<false>(eye, rays.camera, work); }));
  const std::string own_shadow = rate(rays.shadow_count, median_of([&] { search<true>(lamp, rays.shadow, work); }));
  const std::string single = rate(rays.camera_count, median_of([&] { search_one_by_one<false>(eye, rays.camera, other); }));
  const std::string single_shadow = rate(rays.shadow_count, median_of([&] { search_one_by_one<true>(lamp, rays.shadow, other); }));
  std::string embree = "   -   ", embree_shadow = embree;
#if defined(TOFRAY_HAS_EMBREE)
  const Embree peer(mesh);
  const float zero[3] = {0, 0, 0};
  embree = rate(rays.camera_count, median_of([&] { peer.trace<false>(rays.camera, zero, other); }));
  embree_shadow = rate(rays.shadow_count, median_of([&] { peer.trace<true>(rays.shadow, light, other); }));
#endif
  const double filled = triangles / static_cast<double>(shape::block_width * built.triangles.size());
  fmt::print("{:>10} {:>9.2f} {:>6.1f} {:>5.2f}  {} {} {}  {} {} {}\n", mesh.triangles.size(), triangles / build * 1e-6, bytes / triangles,
             filled, own, single, embree, own_shadow, single_shadow, embree_shadow);
}

}  // namespace

int main(int count, char** words) {
  fmt::print("one thread, {}; millions of rays per second (medians of {})\n", set, rounds);
  fmt::print("            hierarchy                  camera rays              shadow rays\n");
  fmt::print(" triangles  M/s build B each  full  squares  single  Embree  squares  single  Embree\n");
  if (count > 1) {
    for (int i = 1; i < count; ++i) measure(std::atof(words[i]));
  } else {
    for (const double triangles : {1e3, 1e4, 1e5, 1e6}) measure(triangles);
  }
}
