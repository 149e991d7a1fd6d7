// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace tofray::test {

constexpr double pi = 3.14159265358979323846;
constexpr double two_pi = 2 * pi;

}  // namespace tofray::test
