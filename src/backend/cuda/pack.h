// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <cstring>
#include <vector>

#include "backend/cuda/arguments.h"

/// Copies all that a setup points to into one piece of memory, with pointers as the device will see them.
namespace tofray::backend::gpu {

/// Lays arrays one after the other, each aligned to 256 bytes. Without memory it only counts.
class Packer {
 public:
  Packer() = default;
  /// @param host    where the bytes go
  /// @param device  where they will be when the kernels read them
  Packer(void* host, const void* device) : host_(static_cast<unsigned char*>(host)), device_(static_cast<const unsigned char*>(device)) {}

  /// @return where the array will be on the device; null for a null pointer
  template <class T>
  const T* put(const T* array, std::size_t count) {
    if (array == nullptr || count == 0) return nullptr;
    const std::size_t at = (used_ + 255) / 256 * 256;
    used_ = at + count * sizeof(T);
    if (host_ == nullptr) return array;
    std::memcpy(host_ + at, array, count * sizeof(T));
    return reinterpret_cast<const T*>(device_ + at);
  }
  [[nodiscard]] std::size_t used() const { return used_; }

 private:
  unsigned char* host_ = nullptr;
  const unsigned char* device_ = nullptr;
  std::size_t used_ = 0;
};

/// The lens, of the middle of each pixel and of the samples within.
/// @return those of the samples, as the device sees them
std::vector<camera::LensView> pack_lenses(Packer& packer, const pipeline::Setup& from, pipeline::Setup& to);
/// Lights, scatter, sequence and tables. `to` is a copy of `from` and gets other pointers.
/// @return what the decoder knows of each modulation frequency, as the device sees it
std::vector<camera::DecodeModulation> pack_camera(Packer& packer, const pipeline::Setup& from, pipeline::Setup& to);
/// The sequence alone: its gates turn where the sensor drifts.
void pack_raw_frames(Packer& packer, const pipeline::Setup& from, camera::SensorView& to);
/// How long the decoder thinks each modulation frequency was exposed: that changes where exposures follow the light.
void pack_exposures(Packer& packer, std::vector<camera::DecodeModulation> there, const camera::DecoderView& from, camera::DecoderView& to);
/// Where the scene's things are at the times of a frame, and how they move.
void pack_motion(Packer& packer, const scene::SceneView& from, scene::SceneView& to);
/// Its shapes and materials, and what is derived of those that stand still. `to` is a copy of `from` and gets other pointers.
void pack_scene(Packer& packer, const scene::SceneView& from, scene::SceneView& to);

}  // namespace tofray::backend::gpu
