// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Code for GPUs in a library of its own (TOFRAY_CUDA_APART): it is found where packages put it, and taken only if it is of the same sources.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <vector>

#include "backend/cuda/part.h"

namespace {

namespace fs = std::filesystem;
using tofray::backend::gpu::load_part;
using tofray::backend::gpu::Part;
using tofray::backend::gpu::part_file;
using tofray::backend::gpu::part_folders;

const fs::path parts = TOFRAY_PARTS;
const std::string ours = "1.2.3 (sources 0123abcd)";

/// A folder that goes with the test.
struct EmptyFolder {
  fs::path path;
  EmptyFolder() {
    std::string pattern = (fs::temp_directory_path() / "tofray-part-XXXXXX").string();
    path = ::mkdtemp(pattern.data());
  }
  ~EmptyFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  EmptyFolder(const EmptyFolder&) = delete;
  EmptyFolder& operator=(const EmptyFolder&) = delete;
};

}  // namespace

TEST(part, of_the_same_sources_is_taken_and_works) {
  const Part part = load_part({parts / "good"}, ours);
  ASSERT_NE(part.runtime, nullptr) << part.lack;
  EXPECT_EQ(part.lack, "");
  EXPECT_EQ(part.runtime->runtime_version(), "13.0");
  int devices = 0;
  EXPECT_EQ(part.runtime->count_devices(devices), 0);
  EXPECT_EQ(devices, 1);
}

TEST(part, of_other_sources_is_refused_and_both_are_named) {
  const Part part = load_part({parts / "other"}, ours);
  EXPECT_EQ(part.runtime, nullptr);
  EXPECT_TRUE(part.is_installed);
  EXPECT_EQ(part.lack, "the code for GPUs, " + (parts / "other/libtofray_cuda.so").string() +
                           ", is of tofray 1.2.3 (sources 4567cdef), this is tofray 1.2.3 (sources 0123abcd); install both of one version");
}

TEST(part, that_is_none_of_tofrays_is_refused) {
  const Part part = load_part({parts / "foreign"}, ours);
  EXPECT_EQ(part.runtime, nullptr);
  EXPECT_NE(part.lack.find("foreign/libtofray_cuda.so, is none of tofray's"), std::string::npos) << part.lack;
}

TEST(part, that_is_no_library_is_refused_with_the_loaders_reason) {
  const EmptyFolder folder;
  std::ofstream(folder.path / part_file) << "no library";
  const Part part = load_part({folder.path}, ours);
  EXPECT_EQ(part.runtime, nullptr);
  EXPECT_TRUE(part.is_installed);
  EXPECT_NE(part.lack.find("cannot be loaded: "), std::string::npos) << part.lack;
}

TEST(part, that_is_not_there_is_named_with_its_package) {
  const EmptyFolder folder;
  const Part part = load_part({folder.path, folder.path / "lib"}, ours);
  EXPECT_EQ(part.runtime, nullptr);
  EXPECT_FALSE(part.is_installed);
  EXPECT_EQ(part.lack,
            "the part of tofray that has code for GPUs is not installed: the package tofray-cuda, whose libtofray_cuda.so belongs beside "
            "libtofray.so");
}

TEST(part, of_the_first_folder_that_has_one_counts) {
  const EmptyFolder folder;
  EXPECT_NE(load_part({folder.path, parts / "good", parts / "other"}, ours).runtime, nullptr);
  EXPECT_EQ(load_part({folder.path, parts / "other", parts / "good"}, ours).runtime, nullptr);
}

TEST(part, is_looked_for_beside_the_program_whatever_the_current_folder_is) {
  const std::vector<fs::path> folders = part_folders();
  ASSERT_FALSE(folders.empty());
  EXPECT_EQ(folders[0], fs::canonical("/proc/self/exe").parent_path());
  EXPECT_TRUE(std::all_of(folders.begin(), folders.end(), [](const fs::path& folder) { return folder.is_absolute(); }));
}
