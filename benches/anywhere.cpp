// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Rays from anywhere through the mesh of the scene bench-mesh, one thread: those along which light goes on from what a pico flexx sees, each in a
// direction of its own, by themselves, as packs of neighbouring pixels, and by Embree's rtcIntersect1 where Embree is installed, in turn.
//     bench_anywhere [TRIANGLES...] [ways N]      N rays from what each pixel sees, in place of one: `ways 31` are a million
#include "num/avx2.h"
#include "num/twin.h"
// The number type comes first.
#if defined(TOFRAY_HAS_EMBREE)
#include <embree3/rtcore.h>
#endif
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <random>
#include <vector>

#include "assets/builtin_mesh.h"
#include "scene/hierarchy.h"
#include "shape/mesh_search.h"

using namespace tofray;

namespace {

using F = num::Twin<num::F32x8>;
constexpr int width = 224, height = 172, rounds = 21, lanes = num::lanes<F>;

/// Of this thread's processor: others may be busy on it, too.
double seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct OneRay {
  float from[3], way[3];
};

/// The ball and the floor of bench-mesh as one mesh of about `triangles`, before a camera at zero that looks along +z.
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

/// Half of a pack goes through the mesh together.
void search_together(const shape::MeshFree& form, const shape::MeshRay<F>& ray, shape::MeshHit<F>& hit) {
  using H = num::F32x8;
  const auto half = [&](auto of) {
    shape::MeshRay<H> one;
    for (int k = 0; k < 3; ++k) one.origin[k] = of(ray.origin[k]), one.direction[k] = of(ray.direction[k]);
    one.slack = of(ray.slack);
    shape::MeshHit<H> found{H(shape::never), num::I32x8(0x7fffffff), num::I32x8(-1)};
    shape::search_together<false>(form, one, H(0.0f), H(0.0f) < H(1.0f), found);
    return found;
  };
  const auto a = half([](auto twin) { return twin.a; }), b = half([](auto twin) { return twin.b; });
  hit = {{a.t, b.t}, {a.number, b.number}, {a.triangle, b.triangle}};
}

/// Distances that rays find, which come in packs.
/// \tparam together  as packs, else each by itself
template <bool together>
double search(const shape::MeshFree& form, const std::vector<OneRay>& rays, std::vector<float>& found) {
  const double before = seconds();
  for (std::size_t i = 0; i + lanes <= rays.size(); i += lanes) {
    float column[6][lanes];
    for (std::size_t l = 0; l < lanes; ++l)
      for (std::size_t k = 0; k < 3; ++k) column[k][l] = rays[i + l].from[k], column[3 + k][l] = rays[i + l].way[k];
    const auto load = [&](int k) { return num::load<F>(column[k], lanes); };
    const shape::FreeRay<F> ray{load(0), load(1), load(2), load(3), load(4), load(5)};
    num::Int<F> triangle;
    F t;
    if constexpr (together) {
      shape::MeshHit<F> hit;
      search_together(form, shape::in_mesh(form, ray), hit);
      t = hit.t;
    } else {
      t = shape::distance_to(form, ray, F(0.0f), F(shape::never), F(0.0f) < F(1.0f), triangle);
    }
    num::store(&found[i], t, lanes);
  }
  return seconds() - before;
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

  double search(const std::vector<OneRay>& rays, std::vector<float>& found) const {
    const double before = seconds();
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const OneRay& one = rays[i];
      RTCRayHit hit;
      hit.ray = {one.from[0], one.from[1], one.from[2], 0, one.way[0], one.way[1], one.way[2], 0, shape::never, ~0u, 0, 0};
      hit.hit.geomID = RTC_INVALID_GEOMETRY_ID, hit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &context, &hit);
      found[i] = hit.ray.tfar;
    }
    return seconds() - before;
  }
};
#endif

/// What a camera sees, and from there one of a matt surface's ways on for each pixel.
std::vector<OneRay> ways_on(const shape::MeshFree& form, const scene::Hierarchy& built, std::mt19937& random) {
  std::uniform_real_distribution<float> unit(0.0f, 1.0f);
  std::vector<OneRay> out;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float dx = (static_cast<float>(x) - 111.5f) / 212.0f, dy = (static_cast<float>(y) - 85.5f) / 212.0f;
      const float per = 1.0f / std::sqrt(dx * dx + dy * dy + 1.0f);
      const shape::FreeRay<float> ray{0, 0, 0, dx * per, dy * per, per};
      std::int32_t triangle = -1;
      const float t = shape::distance_to(form, ray, 0.0f, shape::never, true, triangle);
      if (triangle < 0) continue;
      const shape::MeshTriangles& block = built.triangles[static_cast<std::size_t>(triangle / shape::block_width)];
      const int at = triangle % shape::block_width;
      double a[3], b[3], n[3];
      for (int k = 0; k < 3; ++k) {
        a[k] = static_cast<double>(block.corner[1][k][at] - block.corner[0][k][at]);
        b[k] = static_cast<double>(block.corner[2][k][at] - block.corner[0][k][at]);
      }
      for (int k = 0; k < 3; ++k) n[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
      const double size = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
      const double side =
          n[0] * static_cast<double>(ray.dx) + n[1] * static_cast<double>(ray.dy) + n[2] * static_cast<double>(ray.dz) > 0 ? -1 : 1;
      // The normal and a direction that is even over the sphere: a cosine about the normal.
      const float up = 2 * unit(random) - 1, turn = 6.2831853f * unit(random), across = std::sqrt(1 - up * up);
      float way[3] = {across * std::cos(turn), across * std::sin(turn), up}, length = 0;
      for (int k = 0; k < 3; ++k) way[k] += static_cast<float>(side * n[k] / size), length += way[k] * way[k];
      OneRay one{};
      const float at_point[3] = {t * ray.dx, t * ray.dy, t * ray.dz};
      for (int k = 0; k < 3; ++k) {
        one.way[k] = way[k] / std::sqrt(length);
        one.from[k] = at_point[k] + 1e-5f * static_cast<float>(side * n[k] / size);
      }
      out.push_back(one);
    }
  out.resize(out.size() / lanes * lanes);
  return out;
}

/// Where a ray meets the mesh first, by each triangle in double precision: a ray whose volumes with all three edges have one sign passes inside.
double by_each_triangle(const TriangleMesh& mesh, const OneRay& ray) {
  using Vector = std::array<double, 3>;
  const auto dot = [](const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
  const auto cross = [](const Vector& a, const Vector& b) {
    return Vector{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  };
  const Vector way{static_cast<double>(ray.way[0]), static_cast<double>(ray.way[1]), static_cast<double>(ray.way[2])};
  double nearest = static_cast<double>(shape::never);
  for (const auto& triangle : mesh.triangles) {
    Vector corner[3];
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t k = 0; k < 3; ++k)
        corner[c][k] = static_cast<double>(mesh.vertices[static_cast<std::size_t>(triangle[c])][k]) - static_cast<double>(ray.from[k]);
    const double u = dot(way, cross(corner[2], corner[1])), v = dot(way, cross(corner[0], corner[2])),
                 w = dot(way, cross(corner[1], corner[0]));
    if (std::min({u, v, w}) < 0 && std::max({u, v, w}) > 0) continue;
    const double all = u + v + w, t = (u * dot(corner[0], way) + v * dot(corner[1], way) + w * dot(corner[2], way)) / all;
    if (all != 0 && t > 0 && t < nearest) nearest = t;
  }
  return nearest;
}

double median(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  return times[times.size() / 2];
}

void measure(double wanted, int ways) {
  const TriangleMesh mesh = world(wanted);
  const scene::Hierarchy built = scene::build_hierarchy(mesh);
  const shape::Mesh placed = shape::Mesh::placed(built, {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}});
  const shape::MeshFree form = shape::free_of(placed);
  std::mt19937 random(1);
  std::vector<OneRay> rays;
  for (int i = 0; i < ways; ++i) {
    const std::vector<OneRay> more = ways_on(form, built, random);
    rays.insert(rays.end(), more.begin(), more.end());
  }
  std::vector<float> own(rays.size()), packs(rays.size()), other(rays.size());
  std::vector<double> times, pack_times, other_times;
#if defined(TOFRAY_HAS_EMBREE)
  const Embree peer(mesh);
#endif
  for (int i = 0; i < rounds; ++i) {
    times.push_back(search<false>(form, rays, own));
    pack_times.push_back(search<true>(form, rays, packs));
#if defined(TOFRAY_HAS_EMBREE)
    other_times.push_back(peer.search(rays, other));
#endif
  }
  const auto count = static_cast<double>(rays.size());
  fmt::print("{} triangles, {} rays from anywhere, one thread, AVX2, medians of {}\n", mesh.triangles.size(), rays.size(), rounds);
  fmt::print("each by itself: {:.2f} M/s; packs of 8: {:.2f}, {} the same bits\n", count / median(times) * 1e-6,
             count / median(pack_times) * 1e-6, std::memcmp(own.data(), packs.data(), 4 * own.size()) == 0 ? "all" : "NOT all");
#if defined(TOFRAY_HAS_EMBREE)
  const auto alike = [](float a, float b) { return (a < shape::never) == (b < shape::never) && (a == b || std::abs(a - b) < 1e-4f); };
  int met = 0, same = 0, own_right = 0, other_right = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    met += other[i] < shape::never, same += alike(own[i], other[i]);
    if (alike(own[i], other[i])) continue;
    const auto right = static_cast<float>(by_each_triangle(mesh, rays[i]));
    own_right += alike(own[i], right), other_right += alike(other[i], right);
  }
  fmt::print("Embree's rtcIntersect1: {:.2f} M/s; ratio {:.2f}\n", count / median(other_times) * 1e-6, median(other_times) / median(times));
  fmt::print(
      "{} meet something; {} of all meet the same; of the other {}, each triangle in double precision says as this {}, as Embree {}\n", met,
      same, static_cast<int>(rays.size()) - same, own_right, other_right);
#endif
}

}  // namespace

int main(int count, char** words) {
  std::vector<double> sizes;
  int ways = 1;
  for (int i = 1; i < count; ++i) {
    const bool is_ways = std::strcmp(words[i], "ways") == 0;
    if (is_ways && i + 1 < count) {
      ways = std::max(1, std::atoi(words[++i]));
    } else if (std::atof(words[i]) >= 1 && !is_ways) {
      sizes.push_back(std::atof(words[i]));
    } else {
      fmt::print(stderr, "bench_anywhere: {}: expected numbers of triangles, and `ways N`\n", words[i]);
      return 2;
    }
  }
  if (sizes.empty()) sizes = {1e5, 1.5e6};
  for (const double triangles : sizes) measure(triangles, ways);
}
