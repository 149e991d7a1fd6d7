// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/pack.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

#include "backend/cuda/pixel.h"

namespace tofray::backend::gpu {

namespace {

std::size_t count_of(std::int32_t number) { return static_cast<std::size_t>(number); }

/// Hierarchies of meshes: each is put there once, and all that points to it is told where.
class Meshes {
 public:
  /// @param here, there  the pictures of the scene, and as the device has them
  Meshes(Packer& packer, const brdf::MapView* here, const brdf::MapView* there) : packer_(packer), maps_here_(here), maps_there_(there) {}

  /// Puts the hierarchies of these meshes.
  void put(const scene::BodiesOf<shape::Mesh>& bodies, std::int32_t rows) {
    for (int i = 0; i < rows; ++i) {
      const shape::Mesh& mesh = bodies.first[i].shape;
      if (there(&Place::nodes, mesh.nodes) != nullptr) continue;
      places_.push_back({{mesh.nodes, packer_.put(mesh.nodes, count_of(mesh.node_count))},
                         {mesh.triangles, packer_.put(mesh.triangles, count_of(mesh.block_count))},
                         {mesh.details, packer_.put(mesh.details, count_of(mesh.details == nullptr ? 0 : mesh.block_count))},
                         {mesh.steps, packer_.put(mesh.steps, count_of(mesh.steps == nullptr ? 0 : mesh.block_count))}});
    }
  }
  template <class T>
  void move(T& one) const {
    if constexpr (requires { one.nodes; }) one.nodes = there(&Place::nodes, one.nodes);
    if constexpr (requires { one.triangles; }) one.triangles = there(&Place::triangles, one.triangles);
    if constexpr (requires { one.details; }) one.details = there(&Place::details, one.details);
    if constexpr (requires {
                    one.steps;
                    one.nodes;
                  })
      one.steps = there(&Place::steps, one.steps);
    if constexpr (requires { one.cut; })
      if (one.cut != nullptr) one.cut = maps_there_ + (one.cut - maps_here_);
    if constexpr (requires { one.shape; }) move(one.shape);
  }
  /// Puts an array that may point to them.
  template <class T>
  const T* put(const T* array, std::size_t count) const {
    if constexpr (
        requires(T one) { one.triangles; } || requires(T one) { one.shape.triangles; }) {
      if (array == nullptr) return nullptr;
      std::vector<T> moved(array, array + count);
      for (T& one : moved) move(one);
      return packer_.put(static_cast<const T*>(moved.data()), count);
    } else {
      return packer_.put(array, count);
    }
  }

 private:
  template <class T>
  struct Pair {
    const T *here = nullptr, *there = nullptr;
  };
  struct Place {
    Pair<shape::MeshNode> nodes;
    Pair<shape::MeshTriangles> triangles;
    Pair<shape::MeshDetails> details;
    Pair<shape::MeshSteps> steps;
  };

  template <class T>
  const T* there(Pair<T> Place::*pair, const T* here) const {
    for (const Place& place : places_)
      if ((place.*pair).here == here) return (place.*pair).there;
    return nullptr;
  }

  Packer& packer_;
  const brdf::MapView *maps_here_, *maps_there_;
  std::vector<Place> places_;
};

template <class... T>
void pack_bodies(shape::List<T...>, const Meshes& meshes, const scene::Group& from, scene::Group& to) {
  // Those that change are packed with each frame.
  const auto rows = [](const auto& bodies) { return count_of(bodies.per_moment > 0 ? 0 : bodies.count); };
  ((to.bodies.of<T>().first = meshes.put(from.bodies.of<T>().first, rows(from.bodies.of<T>()))), ...);
}

void pack_scatter(Packer& packer, const camera::ScatterView& from, camera::ScatterView& to) {
  std::vector<camera::ScatterTerm> terms(from.term, from.term + from.terms);
  for (camera::ScatterTerm& term : terms) {
    const std::size_t side = 2 * count_of(term.radius) + 1, stride = side + 2 * camera::ScatterTerm::pad;
    term.weights = packer.put(term.weights, term.column != nullptr ? stride : stride * side);
    term.column = packer.put(term.column, side);
  }
  to.term = packer.put(static_cast<const camera::ScatterTerm*>(terms.data()), terms.size());
}

void pack_phasors(Packer& packer, std::int32_t lights, const camera::PhasorView& from, camera::PhasorView& to) {
  std::vector<camera::ModulationView> modulations(from.modulation, from.modulation + from.modulations);
  for (camera::ModulationView& m : modulations) m.source = packer.put(m.source, 2 * count_of(lights) * count_of(from.orders));
  to.modulation = packer.put(static_cast<const camera::ModulationView*>(modulations.data()), modulations.size());
}

/// Delays of each pixel, or of each pixel and modulation frequency: those that the sensor has, or the decoder knows.
template <class View>
std::size_t delays_of(const View& has, std::int32_t modulations, std::size_t pixels) {
  return has.delay_stride == 0 ? pixels : pixels * count_of(modulations);
}

/// @return the modulations, as the device sees them
std::vector<camera::DecodeModulation> pack_decoder(Packer& packer, const pipeline::Setup& setup, std::size_t pixels,
                                                   camera::DecoderView& to) {
  const camera::DecoderView& from = setup.decoder;
  std::vector<camera::DecodeModulation> modulations(from.modulation, from.modulation + from.modulations);
  for (camera::DecodeModulation& m : modulations) {
    m.raw_frame = packer.put(m.raw_frame, count_of(m.count)), m.pair = packer.put(m.pair, 2 * count_of(m.pairs));
    m.wiggling = packer.put(m.wiggling, 4 * count_of(from.wiggling_nodes));
  }
  to.modulation = packer.put(static_cast<const camera::DecodeModulation*>(modulations.data()), modulations.size());
  to.frame = packer.put(from.frame, count_of(setup.sensor.raw_frames)),
  to.grey_frame = packer.put(from.grey_frame, count_of(from.grey_frames));
  to.delay = packer.put(from.delay, delays_of(from, from.modulations, pixels)),
  to.read.cell = packer.put(from.read.cell, 2 * count_of(from.read.cells));
  return modulations;
}

/// What each patch of pixels sees.
std::vector<flow::Bounds> patch_bounds(const camera::LensView& lens) {
  constexpr float far = std::numeric_limits<float>::max();
  std::vector<flow::Bounds> out(count_of(patch_count(lens)), flow::Bounds{far, -far, far, -far});
  for (int y = 0; y < lens.height; ++y) {
    for (int x = 0; x < lens.width; ++x) {
      flow::Bounds& b = out[count_of(y / patch_height * patches_across(lens) + x / patch_width)];
      const std::size_t i = count_of(y) * count_of(lens.width) + count_of(x);
      b = {std::min(b.x_min, lens.ray_x[i]), std::max(b.x_max, lens.ray_x[i]), std::min(b.y_min, lens.ray_y[i]),
           std::max(b.y_max, lens.ray_y[i])};
    }
  }
  return out;
}

void pack_lens(Packer& packer, const camera::LensView& from, camera::LensView& to) {
  const std::size_t pixels = count_of(from.width) * count_of(from.height);
  to.ray_x = packer.put(from.ray_x, pixels), to.ray_y = packer.put(from.ray_y, pixels);
  to.inverse_length = packer.put(from.inverse_length, pixels);
  to.vignetting = packer.put(from.vignetting, pixels);
  const std::vector<flow::Bounds> patches = patch_bounds(from);
  to.tile = packer.put(patches.data(), patches.size());
}

}  // namespace

std::vector<camera::LensView> pack_lenses(Packer& packer, const pipeline::Setup& from, pipeline::Setup& to) {
  std::vector<camera::LensView> samples;
  for (int i = 0; i < from.subpixel.count && from.subpixel.lens != nullptr; ++i) {
    samples.push_back(from.subpixel.lens[i]);
    pack_lens(packer, from.subpixel.lens[i], samples.back());
  }
  to.subpixel.lens = packer.put(static_cast<const camera::LensView*>(samples.data()), samples.size());
  to.subpixel.share = packer.put(from.subpixel.share, samples.size());
  pack_lens(packer, from.lens, to.lens);
  return samples;
}

std::vector<camera::DecodeModulation> pack_camera(Packer& packer, const pipeline::Setup& from, pipeline::Setup& to) {
  const std::size_t pixels = count_of(from.lens.width) * count_of(from.lens.height);
  pack_scatter(packer, from.scatter, to.scatter);
  std::vector<camera::LightView> lights(from.lights, from.lights + from.scene.lights);
  for (camera::LightView& light : lights) {
    light.pattern.samples = packer.put(light.pattern.samples, count_of(light.pattern.columns) * count_of(light.pattern.rows));
  }
  to.lights = packer.put(static_cast<const camera::LightView*>(lights.data()), lights.size());
  pack_phasors(packer, from.scene.lights, from.phasors, to.phasors);
  pack_raw_frames(packer, from, to.sensor);
  to.sensor.gain = packer.put(from.sensor.gain, pixels), to.sensor.offset = packer.put(from.sensor.offset, pixels);
  to.sensor.delay = packer.put(from.sensor.delay, delays_of(from.sensor, from.decoder.modulations, pixels));
  to.sensor.read.cell = packer.put(from.sensor.read.cell, 2 * count_of(from.sensor.read.cells));
  return pack_decoder(packer, from, pixels, to.decoder);
}

void pack_exposures(Packer& packer, std::vector<camera::DecodeModulation> there, const camera::DecoderView& from, camera::DecoderView& to) {
  for (std::size_t i = 0; i < there.size(); ++i) {
    there[i].integration_time = from.modulation[i].integration_time, there[i].ambient_scale = from.modulation[i].ambient_scale;
  }
  to.modulation = packer.put(static_cast<const camera::DecodeModulation*>(there.data()), there.size());
}

void pack_raw_frames(Packer& packer, const pipeline::Setup& from, camera::SensorView& to) {
  std::vector<camera::RawFrameView> frames(from.sensor.frame, from.sensor.frame + from.sensor.raw_frames);
  const std::size_t values = 2 * count_of(from.phasors.orders);
  for (camera::RawFrameView& frame : frames) frame.gate = packer.put(frame.gate, values), frame.other = packer.put(frame.other, values);
  to.frame = packer.put(static_cast<const camera::RawFrameView*>(frames.data()), frames.size());
}

void pack_motion(Packer& packer, const scene::SceneView& from, scene::SceneView& to) {
  const std::size_t moments = std::max<std::size_t>(count_of(from.moments), 1);
  to.motions = packer.put(from.motions, 1 + count_of(from.movers));
  to.to_truth = packer.put(from.to_truth, from.to_truth == nullptr ? 0 : moments * (1 + count_of(from.movers)));
  to.frames = packer.put(from.frames, moments * count_of(from.movers));
  if (const auto& changing = from.moving.bodies.of<shape::Mesh>(); changing.per_moment > 0) {
    Meshes meshes(packer, from.maps, to.maps);
    const std::int32_t rows = changing.per_moment * from.moments;
    meshes.put(changing, rows);
    to.moving.bodies.of<shape::Mesh>().first = meshes.put(changing.first, count_of(rows));
  }
  to.toward_sun = packer.put(from.toward_sun, moments), to.sun_directions = packer.put(from.sun_directions, 3 * moments);
}

void pack_scene(Packer& packer, const scene::SceneView& from, scene::SceneView& to) {
  std::vector<brdf::MapView> maps(from.maps, from.maps + from.map_count);
  for (brdf::MapView& map : maps) map.texels = packer.put(map.texels, count_of(map.texel_count));
  to.maps = packer.put(static_cast<const brdf::MapView*>(maps.data()), maps.size());
  Meshes meshes(packer, from.maps, to.maps);
  for (const scene::Group* group : {&from.still, &from.moving})
    if (const auto& bodies = group->bodies.of<shape::Mesh>(); bodies.per_moment == 0) meshes.put(bodies, bodies.count);
  pack_bodies(shape::Shapes{}, meshes, from.still, to.still);
  pack_bodies(shape::Shapes{}, meshes, from.moving, to.moving);
  to.materials = packer.put(from.materials, count_of(from.material_count));
  pack_motion(packer, from, to);
  to.motion_of = packer.put(from.motion_of, count_of(from.object_count));
  to.class_of = packer.put(from.class_of, count_of(from.object_count));
  to.light_positions = packer.put(from.light_positions, count_of(from.lights));
  scene::SceneView still = from;
  still.moments = 0;  // what moves is derived there for each frame, and with it the facets of all
  scene::each_derived(still, scene::Derive::all, [&](auto*& array, std::size_t count) {
    array = const_cast<std::remove_reference_t<decltype(array)>>(meshes.put(array, count));
  });
  to.still.derived = still.still.derived;
  to.facets = still.facets;
  to.moving.derived = {};
  to.still.clusters = {}, to.moving.clusters = {};  // a warp looks at 32 forms at once as it is
}

}  // namespace tofray::backend::gpu
