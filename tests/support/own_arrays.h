// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <limits>

#include "flow/flow.h"
#include "support/cuda_cases.h"

/// What a user who brings arrays of his own would have, taken from a frame's truth.
namespace tofray::test {

/// The frame that this light makes in a camera, by one thread.
inline Frame frame_of_light(const Camera& camera, const PixelLight& light, Noise noise = Noise::off, Isa isa = Isa::best) {
  return Simulator({}, camera, {.seed = 3, .noise = noise, .threads = 1, .isa = isa}).frame(0, light);
}

/// What a frame of one light saw, at the time of its truth. A pixel that got no light is one in the shadow.
inline Geometry geometry_of(const Scene& scene, const Camera& camera, const Frame& frame) {
  const Truth& truth = frame.truth;
  Geometry out;
  out.width = camera.sensor.width, out.height = camera.sensor.height;
  out.z_m = truth.z_m, out.normal = truth.normal, out.object_id = truth.object_id;
  for (std::size_t i = 0; i < truth.z_m.size(); ++i) {
    const std::int32_t object = truth.object_id[i];
    const Material material =
        object < 0 ? Material{} : scene.materials[static_cast<std::size_t>(scene.objects[static_cast<std::size_t>(object)].material)];
    out.diffuse.push_back(static_cast<float>(material.diffuse));
    out.specular.push_back(static_cast<float>(material.specular));
    out.exponent.push_back(static_cast<float>(material.exponent));
    out.shadow.push_back(truth.irradiance_w_m2[i] > 0 ? 0 : 1);
  }
  return out;
}

/// The frame as geometry of one's own shows it: of materials, triangles and motion nothing is known.
inline Frame without_what_geometry_lacks(Frame frame) {
  Truth& truth = frame.truth;
  for (auto* ids : {&truth.material_id, &truth.triangle_id}) ids->assign(ids->size(), -1);
  for (auto* numbers : {&truth.texcoord, &truth.velocity_m_per_s, &truth.flow_px})
    numbers->assign(numbers->size(), std::numeric_limits<float>::quiet_NaN());
  return frame;
}

/// The light of a frame without ambient light: ℓ = |P − L| + |P|, as the pipeline rounds it.
inline PixelLight light_of(const Camera& camera, const Frame& frame) {
  const Truth& truth = frame.truth;
  PixelLight out;
  out.width = camera.sensor.width, out.height = camera.sensor.height;
  out.power_w = truth.power_w;
  const Vec3& at = camera.illumination[0].position;
  for (std::size_t i = 0; i < truth.z_m.size(); ++i) {
    const float* p = &truth.position_m[3 * i];
    const flow::Ray<float> way =
        flow::make_ray(p[0] - static_cast<float>(at[0]), p[1] - static_cast<float>(at[1]), p[2] - static_cast<float>(at[2]));
    out.path_length_m.push_back(truth.object_id[i] < 0 ? 0 : way.square * way.inverse_length + truth.range_m[i]);
  }
  return out;
}

/// A wall of reflectivity 0.5 that faces the camera.
inline Geometry wall(const Camera& camera, float z, int moments = 1) {
  const auto pixels =
      static_cast<std::size_t>(camera.sensor.width) * static_cast<std::size_t>(camera.sensor.height) * static_cast<std::size_t>(moments);
  Geometry out;
  out.width = camera.sensor.width, out.height = camera.sensor.height, out.moments = moments;
  out.z_m.assign(pixels, z), out.diffuse.assign(pixels, 0.5f);
  for (std::size_t i = 0; i < pixels; ++i) out.normal.insert(out.normal.end(), {0, 0, -1});
  return out;
}

inline PixelLight even_light(const Camera& camera, float power, float path_length) {
  const auto pixels = static_cast<std::size_t>(camera.sensor.width) * static_cast<std::size_t>(camera.sensor.height);
  PixelLight out;
  out.width = camera.sensor.width, out.height = camera.sensor.height;
  out.power_w.assign(pixels, power), out.path_length_m.assign(pixels, path_length);
  return out;
}

/// A sine, the light at the pupil, an ideal lens.
inline Camera pico() {
  Camera camera = load_camera("pico-flexx");
  camera.lens.k1 = camera.lens.k2 = camera.lens.p1 = camera.lens.p2 = camera.lens.k3 = 0;
  camera.illumination[0].position = {0, 0, 0};
  camera.illumination[0].waveform.kind = Waveform::Kind::sine;
  camera.pixel.bandwidth_hz = 0;
  camera.pixel.quantum_efficiency = {{850e-9}, {0.5}};
  return camera;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Image k of several.
template <class Vector>
std::vector<typename Vector::value_type> image(const Vector& array, std::size_t pixels, std::size_t k) {
  const auto at = array.begin() + static_cast<std::ptrdiff_t>(k * pixels);
  return {at, at + static_cast<std::ptrdiff_t>(pixels)};
}

/// Every array that can be given, for each light, of one moment or of each raw frame's own.
inline Geometry full_geometry(const Scene& scene, const Camera& camera, const Frame& frame, bool each_raw_frame) {
  const Geometry once = geometry_of(scene, camera, frame);
  Geometry out = once;
  const std::size_t moments = each_raw_frame ? camera.mode.sequence.size() : 1, pixels = once.z_m.size();
  out.moments = static_cast<int>(moments);
  for (std::size_t k = 1; k < moments; ++k) {
    append(out.z_m, once.z_m), append(out.normal, once.normal), append(out.object_id, once.object_id);
    append(out.diffuse, once.diffuse), append(out.specular, once.specular), append(out.exponent, once.exponent);
  }
  for (std::size_t i = 0; i < out.z_m.size(); ++i) out.z_m[i] *= 1 + 0.01f * static_cast<float>(i / pixels);
  out.shadow.resize(moments * pixels * camera.illumination.size());
  for (std::size_t i = 0; i < out.shadow.size(); ++i) out.shadow[i] = i % 11 == 0 ? 3 : 0;
  for (std::size_t i = 0; i < out.z_m.size(); ++i) out.sun_shadow.push_back(i % 7 == 0);
  return out;
}
inline PixelLight full_light(const Camera& camera, bool each_raw_frame) {
  const std::size_t pixels = static_cast<std::size_t>(camera.sensor.width) * static_cast<std::size_t>(camera.sensor.height);
  const std::size_t moments = each_raw_frame ? camera.mode.sequence.size() : 1;
  PixelLight out;
  out.width = camera.sensor.width, out.height = camera.sensor.height, out.moments = static_cast<int>(moments);
  for (std::size_t i = 0; i < moments * pixels * camera.illumination.size(); ++i) {
    out.power_w.push_back(1e-14f * static_cast<float>(i % 97)), out.path_length_m.push_back(0.01f * static_cast<float>(i % 601));
  }
  for (std::size_t i = 0; i < moments * pixels; ++i) out.ambient_e_per_s.push_back(1e4f * static_cast<float>(i % 89));
  return out;
}

inline std::vector<float> some_light(std::size_t count) {
  std::vector<float> out;
  for (std::size_t i = 0; i < count; ++i) out.push_back(1e4f * static_cast<float>(i % 89));
  return out;
}

/// Both backends, entered at each stage, again and again in turn: none may take another's arrays.
inline void expect_same_own_arrays(const Scene& scene, const Camera& camera) {
  Simulator cpu(scene, camera, on(Backend::cpu)), cuda(scene, camera, on(Backend::cuda));
  const Frame frame = cpu.frame(0);
  for (std::uint64_t index = 1; index < 3; ++index) {
    EXPECT_EQ(first_difference(cpu.frame(index), cuda.frame(index)), "") << scene.name;
    for (const bool each_raw_frame : {false, true}) {
      const Geometry seen = full_geometry(scene, camera, frame, each_raw_frame);
      EXPECT_EQ(first_difference(cpu.frame(index, seen), cuda.frame(index, seen)), "") << scene.name << ", geometry " << each_raw_frame;
      const PixelLight light = full_light(camera, each_raw_frame);
      EXPECT_EQ(first_difference(cpu.frame(index, light), cuda.frame(index, light)), "") << scene.name << ", light " << each_raw_frame;
    }
    if (camera.illumination.size() == 1) {  // otherwise with waveforms of their own
      const Transient light{camera.sensor.width,
                            camera.sensor.height,
                            7,
                            0.5,
                            0.3,
                            some_light(frame.truth.z_m.size() * 7),
                            index == 1 ? std::vector<float>() : some_light(frame.truth.z_m.size())};
      EXPECT_EQ(first_difference(cpu.frame(index, light), cuda.frame(index, light)), "") << scene.name << ", light by path length";
    }
    Geometry least = geometry_of(scene, camera, frame);
    least.specular.clear(), least.exponent.clear(), least.object_id.clear(), least.shadow.clear();
    EXPECT_EQ(first_difference(cpu.frame(index, least), cuda.frame(index, least)), "") << scene.name << ", least geometry";
    // as many bytes of another meaning
    Geometry other = least;
    least.shadow.assign(least.z_m.size() * camera.illumination.size(), 1), other.sun_shadow.assign(least.shadow.size(), 1);
    if (camera.illumination.size() > 1) continue;
    EXPECT_EQ(first_difference(cpu.frame(index, least), cuda.frame(index, least)), "") << scene.name << ", in the light's shadow";
    EXPECT_EQ(first_difference(cpu.frame(index, other), cuda.frame(index, other)), "") << scene.name << ", in the sun's shadow";
  }
}

}  // namespace tofray::test
