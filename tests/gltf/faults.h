// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "everything.h"

#include <algorithm>

namespace tofray::gltf_test {

/// What is changed where (nothing: it is taken out), and the error's first line behind "m: error: ".
struct Fault {
  const char* at;
  const char* value;
  const char* message;
};

inline std::string with(const std::string& at, const std::string& value) {
  Document json = everything_file().with_buffer("");
  const Document::json_pointer pointer(at);
  if (value.empty())
    json[pointer.parent_pointer()].erase(pointer.back());
  else
    json[pointer] = Document::parse(value);
  File file = everything_file();
  file.json = json;
  return file.glb();
}

/// "accessors[0].count" of "/accessors/0/count".
inline std::string place_of(const std::string& pointer) {
  std::string out;
  for (std::size_t from = 1; from < pointer.size();) {
    const std::size_t end = std::min(pointer.find('/', from), pointer.size());
    const std::string part = pointer.substr(from, end - from);
    const bool index = part.find_first_not_of("0123456789") == std::string::npos;
    out += index ? "[" + part + "]" : (out.empty() ? "" : ".") + part;
    from = end + 1;
  }
  return out;
}

inline void expect_each(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) {
    SCOPED_TRACE(std::string(fault.at) + " = " + fault.value);
    const std::string message = message_of(with(fault.at, fault.value));
    EXPECT_EQ(message.rfind("m: error: " + std::string(fault.message), 0), 0U) << message << "\nexpected: " << fault.message;
  }
}

/// Each of these values at each of these places, refused as not being `kind`.
inline void expect_kind(const std::vector<const char*>& places, const std::vector<const char*>& values, const std::string& kind) {
  for (const char* at : places)
    for (const char* value : values) {
      const std::string expected = "m: error: " + place_of(at) + " is not " + kind, message = message_of(with(at, value));
      EXPECT_EQ(message.rfind(expected, 0), 0U) << at << " = " << value << "\n" << message << "\nexpected: " << expected;
    }
}

}  // namespace tofray::gltf_test
