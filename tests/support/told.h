// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <gtest/gtest.h>

#include <string>

#include "base/text.h"
#include "support/text.h"
#include "tofray/error.h"

namespace tofray::test {

/// What is wrong with a file's bytes: an error that may be shown and begins with the file's name.
inline void expect_told(const Error& error, const std::string& file) {
  const std::string text = error.what();
  EXPECT_TRUE(error.kind() == ErrorKind::bad_input || error.kind() == ErrorKind::limit) << text;
  EXPECT_EQ(text.rfind(file, 0), 0U) << text;
  EXPECT_TRUE(has(text, ": error: ")) << text;
  EXPECT_EQ(base::printable_lines(text), text);
}

}  // namespace tofray::test
