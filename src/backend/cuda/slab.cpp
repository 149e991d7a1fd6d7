// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/cuda/slab.h"

#include <cstring>

namespace tofray::backend::gpu {

namespace {

/// Calls visit(pointer, elements, stage that writes it) for each array of a view, in a fixed order.
template <class View, class Visit>
void each_array(View& v, std::size_t pixels, std::size_t phases, const Visit& visit) {
  using namespace pipeline;
  const std::size_t all = pixels * phases;
  visit(v.raw, all, stage_raw), visit(v.z, pixels, stage_depth), visit(v.range, pixels, stage_depth), visit(v.points, 3 * pixels, stage_depth);
  visit(v.amplitude, pixels, stage_depth), visit(v.ambient, pixels, stage_depth), visit(v.noise, pixels, stage_depth);
  visit(v.confidence, pixels, stage_depth), visit(v.flags, pixels, stage_depth);
  visit(v.tap_a, all, stage_raw), visit(v.tap_b, all, stage_raw), visit(v.gt_signal, all, stage_raw);
  visit(v.gt_range, pixels, stage_trace), visit(v.gt_z, pixels, stage_trace), visit(v.gt_reflectivity, pixels, stage_trace);
  visit(v.gt_position, 3 * pixels, stage_trace), visit(v.gt_normal, 3 * pixels, stage_trace), visit(v.gt_object, pixels, stage_trace);
  visit(v.gt_irradiance, pixels, stage_trace), visit(v.gt_radiance, pixels, stage_trace), visit(v.gt_power, pixels, stage_trace);
}

std::size_t rounded(std::size_t bytes) { return (bytes + 255) / 256 * 256; }

}  // namespace

Slab::Slab(const pipeline::Setup& setup, const flow::FrameView& wanted, bool filter)
    : pixels_(static_cast<std::size_t>(setup.lens.width) * static_cast<std::size_t>(setup.lens.height)),
      phases_(static_cast<std::size_t>(setup.sensor.raw_frames)) {
  int i = 0;
  each_array(wanted, pixels_, phases_, [&](const auto* array, std::size_t count, pipeline::Stages stage) {
    const bool has_place = array != nullptr && stage <= setup.last_stage;
    if (has_place) {
      offset_[i] = bytes_ + 1;
      bytes_ = rounded(bytes_ + count * sizeof *array);
    }
    ++i;
  });
  shown_bytes_ = bytes_;
  filtered_offset_ = bytes_;
  if (filter) bytes_ = rounded(bytes_ + pixels_ * sizeof(float));
}

flow::FrameView Slab::view(void* base) const {
  flow::FrameView out{};
  int i = 0;
  each_array(out, pixels_, phases_, [&]<class T>(T*& array, std::size_t, pipeline::Stages) {
    array = offset_[i] == 0 ? nullptr : reinterpret_cast<T*>(static_cast<unsigned char*>(base) + offset_[i] - 1);
    ++i;
  });
  return out;
}

float* Slab::filtered(void* base) const {
  return filtered_offset_ == bytes_ ? nullptr : reinterpret_cast<float*>(static_cast<unsigned char*>(base) + filtered_offset_);
}

void Slab::copy_out(const void* base, const flow::FrameView& to) const {
  int i = 0;
  each_array(to, pixels_, phases_, [&](auto* array, std::size_t count, pipeline::Stages) {
    if (array != nullptr && offset_[i] != 0) {
      std::memcpy(array, static_cast<const unsigned char*>(base) + offset_[i] - 1, count * sizeof *array);
    }
    ++i;
  });
}

}  // namespace tofray::backend::gpu
