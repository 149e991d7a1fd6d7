// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "files/npy.h"
#include "files/zip_writer.h"
#include "tofray/error.h"

/// Several arrays in one file (.npz): a zip of .npy entries, stored or deflated, the same bytes each run.
namespace tofray::files {

/// An array to write; the data stay the caller's.
struct NpyView {
  std::string name;  ///< without ".npy"
  NpyType type;
  NpyShape shape;
  std::string_view bytes;
};

/// View of a vector's data under a shape. @throws Error (bug) where they do not fit
template <class Vector, class T = typename Vector::value_type>
NpyView npy_view(const std::string& name, const NpyShape& shape, const Vector& data, NpyType type = npy_type_of<T>()) {
  std::size_t count = 1;
  for (const std::size_t extent : shape) count *= extent;
  if (count != data.size()) throw Error(ErrorKind::bug, "error: array " + name + " does not have the shape " + shape_text(shape));
  return {name, type, shape, {reinterpret_cast<const char*>(data.data()), data.size() * sizeof(T)}};
}

/// The bytes of a .npz file. Entries stand in the order given; their time is 1980-01-01 in every time zone.
std::string npz_bytes(const std::vector<NpyView>& arrays, Packing packing = Packing::stored);
/// The bytes of a .npz file, into memory that is used again.
void npz_bytes(const std::vector<NpyView>& arrays, Packing packing, std::string& file);

struct NamedArray {
  std::string name;
  NpyArray array;
};

/// Reads the arrays of a .npz file that is in memory, in the file's order. Stored and deflated entries are read.
/// @param wanted  names to read; empty: all
/// @throws Error (bad_input) where anything is malformed; (limit) beyond data_limits.h
std::vector<NamedArray> parse_npz(std::string_view file, const std::string& where, const std::vector<std::string>& wanted = {});

/// Reads a .npz file. @throws Error as parse_npz, and (io) where it cannot be read.
std::vector<NamedArray> read_npz(const std::string& path, const std::vector<std::string>& wanted = {});

}  // namespace tofray::files
