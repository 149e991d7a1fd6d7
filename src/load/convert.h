// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "load/builtin.h"
#include "tofray/scene.h"
#include "yaml/reader.h"

/// Steps that scene and camera share between a read value and the public structs.
namespace tofray::load {

/// Three numbers; zero where the value is absent or faulty.
Vec3 vector(const yaml::Value& value);

std::vector<double> numbers(const yaml::Value& list);

/// Rows of numbers out of a text, "," or blanks between them; none where there is a fault.
/// @param path   the file that the text is of, for messages
std::vector<std::vector<double>> rows_of_numbers(std::string_view text, const std::string& path, base::Faults& faults);

/// Reads what the user named and no built-in has; the error suggests one whose name is near.
std::string read_named(const std::string& kind, const std::string& name, const std::vector<Builtin>& builtins);

}  // namespace tofray::load
