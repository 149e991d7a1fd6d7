// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/text_file.h"

#include <gtest/gtest.h>

#include "support/samples.h"

using namespace tofray;
using out_test::error_of;

TEST(text_file, that_cannot_be_read_is_named_and_why) {
  const out_test::TemporaryFolder folder;
  const auto said = [](const std::string& path) {
    const Error error = error_of([&] { (void)files::read_text(path); });
    EXPECT_EQ(error.kind(), ErrorKind::io) << error.what();
    return std::string(error.what());
  };
  EXPECT_NE(said(folder.file("none.yaml")).find("none.yaml: error: cannot open the file: No such file or directory"), std::string::npos);
  EXPECT_NE(said(folder.path().string()).find("Is a directory"), std::string::npos);
  // Whatever stands behind a NUL, the system would not see it.
  out_test::write_file(folder.file("scene.yaml"), "objects: []\n");
  EXPECT_NE(said(folder.file("scene.yaml") + std::string("\0.txt", 5)).find("a file's name holds no NUL"), std::string::npos);
  EXPECT_EQ(files::read_text(folder.file("scene.yaml")), "objects: []\n");
}
