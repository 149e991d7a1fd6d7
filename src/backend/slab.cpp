// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "backend/slab.h"

#include <algorithm>

namespace tofray::backend {

namespace {

std::size_t rounded(std::size_t bytes) { return (bytes + 255) / 256 * 256; }

}  // namespace

Slab::Slab(const pipeline::Setup& setup, const flow::FrameView& wanted, std::int64_t scratch)
    : size_{std::int64_t{setup.lens.width} * setup.lens.height, setup.sensor.raw_frames, setup.transient.bins, setup.decoder.modulations} {
  int i = 0;
  flow::each_array(wanted, [&](const auto* array, ArrayShape shape, Stage) {
    if (array != nullptr) {
      offset_[i] = bytes_ + 1;
      bytes_ = rounded(bytes_ + count(shape) * sizeof *array);
    }
    ++i;
  });
  shown_bytes_ = bytes_;
  scratch_offset_ = bytes_;
  bytes_ = rounded(bytes_ + static_cast<std::size_t>(scratch) * sizeof(float));
}

std::size_t Slab::count(ArrayShape shape) const { return static_cast<std::size_t>(flow::values_of(shape, size_)); }

flow::FrameView Slab::view(void* base) const {
  flow::FrameView out{};
  int i = 0;
  flow::each_array(out, [&]<class T>(T*& array, ArrayShape, Stage) {
    array = offset_[i] == 0 ? nullptr : reinterpret_cast<T*>(static_cast<unsigned char*>(base) + offset_[i] - 1);
    ++i;
  });
  return out;
}

float* Slab::scratch(void* base) const {
  return scratch_offset_ == bytes_ ? nullptr : reinterpret_cast<float*>(static_cast<unsigned char*>(base) + scratch_offset_);
}

std::vector<Slab::Piece> Slab::pieces(const void* base, const flow::FrameView& to) const {
  constexpr std::size_t most_bytes = 1 << 17;
  std::vector<Piece> out;
  int i = 0;
  flow::each_array(to, [&](auto* array, ArrayShape shape, Stage) {
    const std::size_t bytes = array != nullptr && offset_[i] != 0 ? count(shape) * sizeof *array : 0;
    for (std::size_t at = 0; at < bytes; at += most_bytes) {
      out.push_back({reinterpret_cast<unsigned char*>(array) + at, static_cast<const unsigned char*>(base) + offset_[i] - 1 + at,
                     std::min(most_bytes, bytes - at)});
    }
    ++i;
  });
  return out;
}

}  // namespace tofray::backend
