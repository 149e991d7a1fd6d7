// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/output_folder.h"

#include <gtest/gtest.h>

#include "files/sha256.h"
#include "support/samples.h"

using namespace tofray;
using namespace tofray::files;
using out_test::error_of;
using out_test::TemporaryFolder;

TEST(output_folder, makes_parents_replaces_its_own_files_and_leaves_others) {
  TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "a" / "b";
  {
    OutputFolder out(path);
    out.write("depth.png", "old");
  }
  out_test::write_file(path / "notes.txt", "mine");
  OutputFolder out(path.string() + "/");
  out.write("frame.npz", "abc");
  out.write("depth.png", "x");
  out.write("depth.png", "newer");
  EXPECT_EQ(out_test::read_file(path / "depth.png"), "newer");
  EXPECT_EQ(out_test::read_file(path / "notes.txt"), "mine");
  ASSERT_EQ(out.files().size(), 2U);
  EXPECT_EQ(out.files()[0].sha256, sha256_hex("abc"));
  EXPECT_EQ(out.files()[1].bytes, 5U);
  EXPECT_EQ(error_of([&] { const OutputFolder bad(path / "notes.txt"); }).kind(), ErrorKind::io);
  EXPECT_EQ(error_of([&] { const OutputFolder bad(path / "notes.txt" / "c"); }).kind(), ErrorKind::io);
  EXPECT_EQ(error_of([&] { const OutputFolder bad("/proc/tofray/out"); }).kind(), ErrorKind::io);
}
