// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cairo.h>

namespace tofray::pictures {

/// Height of a capital letter over what fonts call their size.
inline constexpr double capital_height = 0.72;

/// Our letters, for what is written next. @param size  height of a capital letter
void set_font(cairo_t* context, double size);

/// @throws Error (limit): cairo fails where memory does
void refuse_failure(cairo_t* context);

}  // namespace tofray::pictures
