// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

#include "base/ranges.h"
#include "tofray/camera.h"
#include "tofray/error.h"
#include "tofray/scene.h"

/// Single checks of numbers that a program set; a message names the member by its path.
namespace tofray::simulator {

namespace range = base::range;

[[noreturn]] void refuse(const std::string& what, const std::string& more, ErrorKind kind = ErrorKind::bad_input);

void within(double value, const base::Range& range, const std::string& path);
void within(const std::vector<double>& values, const base::Range& range, const std::string& path);
void within(const Vec3& values, const base::Range& range, const std::string& path);
/// Components within range::component, and not all of them about zero.
void direction(const Vec3& value, const std::string& path);
/// As many x as y, at least `least`; x ascends.
void samples(const std::vector<double>& x, const base::Range& x_range, const std::vector<double>& y, const base::Range& y_range,
             std::size_t least, const std::string& path);
void at_most(std::size_t count, std::int64_t most, const std::string& path);

}  // namespace tofray::simulator
