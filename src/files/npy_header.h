// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <string_view>

#include "files/npy.h"

namespace tofray::files {

/// What the header of a .npy file says, checked.
struct NpyHeader {
  NpyType type;
  NpyShape shape;
  bool fortran_order = false;
  bool big_endian = false;
  std::size_t length = 0;      ///< bytes of the header: the data start here
  std::size_t data_bytes = 0;  ///< bytes of the data, at most max_array_bytes
};

/// Reads a header; the data need not be there.
/// @throws Error (bad_input) where it is cut short, malformed or of a type that is not read (objects, records, complex numbers);
/// (limit) beyond the limits of data_limits.h
NpyHeader parse_npy_header(std::string_view file, const std::string& where);

/// What a file holds cannot be taken. @throws Error (bad_input) "where: error: what"
[[noreturn]] void refuse(const std::string& where, const std::string& what);

/// Text for a message: control characters and bytes beyond ASCII as \xNN, at most 80 characters.
std::string printable(std::string_view text);

}  // namespace tofray::files
