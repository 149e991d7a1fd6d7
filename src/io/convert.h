// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "io/builtin.h"
#include "io/reader.h"
#include "tofray/scene.h"

/// Steps that scene and camera share between a read value and the public structs.
namespace tofray::io {

/// Three numbers; zero where the value is absent or faulty.
Vec3 vector(const Value& value);

std::vector<double> numbers(const Value& list);

/// A map of two lists as long as each other, the first ascending.
void table(const Value& map, const char* x_key, const char* y_key, base::Faults& faults, std::vector<double>& x, std::vector<double>& y);

/// Reads what the user named and no built-in has; the error suggests one whose name is near.
std::string read_named(const std::string& kind, const std::string& name, const std::vector<Builtin>& builtins);

}  // namespace tofray::io
