// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What goes to a GPU points to nothing of the host's: meshes are pointed to by bodies, by forms and by facets.
#include "backend/cuda/pack.h"

#include <gtest/gtest.h>

#include "support/meshes.h"
#include "support/pixels.h"

using namespace tofray;
using namespace tofray::test;

namespace {

struct Piece {
  std::vector<unsigned char> bytes;
  template <class T>
  [[nodiscard]] bool holds(const T* array) const {
    const auto* at = reinterpret_cast<const unsigned char*>(array);
    return at >= bytes.data() && at < bytes.data() + bytes.size();
  }
};

}  // namespace

TEST(packed_scene, points_into_its_own_memory) {
  Scene scene = wall(2);
  TriangleMesh detailed = single(icosphere(2));
  detailed.normals = detailed.vertices;
  detailed.texcoords.resize(detailed.vertices.size());
  const Mesh ball = shared(std::move(detailed));
  scene.materials[0].map = std::make_shared<ReflectivityMap>(ReflectivityMap{1, 2, {0.5F, 1}});
  const auto vectors = [](std::vector<std::array<float, 3>> values) {
    return std::make_shared<VectorMap>(VectorMap{1, static_cast<int>(values.size()), std::move(values)});
  };
  scene.materials[0].brdf = Material::Brdf::ggx;
  scene.materials[0].normals = vectors({{0, 0, 1}}), scene.materials[0].finish = vectors({{0, 1, 1}, {0, 1, 1}});
  scene.materials[0].opacity = std::make_shared<ReflectivityMap>(ReflectivityMap{1, 2, {0, 1}});
  scene.objects.push_back(object(ball));
  scene.objects.push_back(object(ball));
  scene.objects.push_back(object(shared(single(icosphere(1)))));
  scene.objects.push_back(object(ball));
  scene.objects.back().velocity_m_per_s = {1, 0, 0};
  scene.ambient.direction = Vec3{0, 1, 1};
  const scene::FrozenScene frozen(scene, {{0.1, 0, 0}, {-0.1, 0, 0}}, 3);
  scene::SceneView packed = frozen.view();
  backend::gpu::Packer measure;
  backend::gpu::pack_scene(measure, frozen.view(), packed);
  Piece device{std::vector<unsigned char>(measure.used())};
  backend::gpu::Packer packer(device.bytes.data(), device.bytes.data());
  packed = frozen.view();
  backend::gpu::pack_scene(packer, frozen.view(), packed);
  EXPECT_EQ(packer.used(), measure.used());

  const scene::BodiesOf<shape::Mesh>&still = packed.still.bodies.of<shape::Mesh>(), &moving = packed.moving.bodies.of<shape::Mesh>();
  ASSERT_EQ(still.count, 3);
  for (const auto* bodies : {&still, &moving}) {
    ASSERT_TRUE(device.holds(bodies->first));
    for (int i = 0; i < bodies->count; ++i) {
      EXPECT_TRUE(device.holds(bodies->first[i].shape.nodes));
      EXPECT_TRUE(device.holds(bodies->first[i].shape.triangles));
      if (bodies == &moving || i < 2) {
        EXPECT_TRUE(device.holds(bodies->first[i].shape.details));
        EXPECT_TRUE(device.holds(bodies->first[i].shape.cut));
      } else {
        EXPECT_EQ(bodies->first[i].shape.details, nullptr);
        EXPECT_EQ(bodies->first[i].shape.cut, nullptr);
      }
    }
  }
  EXPECT_EQ(still.first[0].shape.nodes, still.first[1].shape.nodes);
  EXPECT_NE(still.first[0].shape.nodes, still.first[2].shape.nodes);
  EXPECT_EQ(still.first[0].shape.nodes, moving.first[0].shape.nodes);
  for (int eye = 0; eye < 3; ++eye) {
    const auto forms = packed.still.seen_from(0, eye, 3).of<shape::Mesh>();
    for (int i = 0; i < forms.count; ++i) {
      EXPECT_EQ(forms.at[i].nodes, still.first[i].shape.nodes);
      EXPECT_EQ(forms.at[i].triangles, still.first[i].shape.triangles);
      EXPECT_EQ(forms.at[i].details, still.first[i].shape.details);
      EXPECT_EQ(forms.at[i].cut, still.first[i].shape.cut);
    }
  }
  const auto along = packed.still.seen_along(0).of<shape::Mesh>();
  for (int i = 0; i < along.count; ++i) EXPECT_EQ(along.at[i].nodes, still.first[i].shape.nodes);
  for (int i = 0; i < still.count; ++i) {
    EXPECT_EQ(packed.facets[still.first[i].facet].triangles, still.first[i].shape.triangles);
    EXPECT_EQ(packed.facets[still.first[i].facet].details, still.first[i].shape.details);
  }
  ASSERT_EQ(packed.map_count, 1 + 3 + 5 + 1);
  ASSERT_TRUE(device.holds(packed.maps));
  for (int i = 0; i < packed.map_count; ++i) EXPECT_TRUE(device.holds(packed.maps[i].texels));
  EXPECT_EQ(packed.maps[0].texel_count, 3);
}
