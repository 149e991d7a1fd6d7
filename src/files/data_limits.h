// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>

/// Limits on what data files (.npy, .npz) may make the reader do.
namespace tofray::files {

inline constexpr std::size_t max_data_file_bytes = std::size_t{8} << 30;  ///< of a .npy or .npz file
inline constexpr std::size_t max_array_bytes = std::size_t{4} << 30;      ///< of one array, unpacked
inline constexpr std::size_t max_unpacked_bytes = std::size_t{12} << 30;  ///< of all arrays of a file together
inline constexpr std::size_t max_npz_entries = 4096;
inline constexpr std::size_t max_pack_ratio = 1100;  ///< unpacked over packed size; deflate cannot reach 1033
inline constexpr std::size_t max_npy_dimensions = 8;
inline constexpr std::size_t max_npy_header_bytes = 65536;
inline constexpr std::size_t max_manifest_bytes = std::size_t{64} << 20;
inline constexpr std::size_t max_image_side = 16384;  ///< pixels, of raw data to process
inline constexpr std::size_t max_phases = 256;        ///< raw frames of raw data to process

}  // namespace tofray::files
