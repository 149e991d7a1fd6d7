// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "energy/rapl.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>

using namespace tofray;
using namespace tofray::energy;

namespace {

/// A tree like /sys/class/powercap.
class RaplTree : public testing::Test {
 protected:
  void zone(const std::string& folder, const std::string& name, const std::string& energy, const std::string& largest = "65532610987") {
    std::filesystem::create_directories(root_ / folder);
    std::ofstream(root_ / folder / "name") << name << "\n";
    std::ofstream(root_ / folder / "max_energy_range_uj") << largest << "\n";
    set(folder, energy);
  }
  void set(const std::string& folder, const std::string& energy) { std::ofstream(root_ / folder / "energy_uj") << energy << "\n"; }

  void SetUp() override {
    std::string pattern = (std::filesystem::temp_directory_path() / "tofray-rapl-XXXXXX").native();
    root_ = ::mkdtemp(pattern.data());
  }
  void TearDown() override { std::filesystem::remove_all(root_); }
  std::filesystem::path root_;
};

}  // namespace

TEST(rapl, counter_starts_again_at_0_beyond_its_largest_value) {
  EXPECT_EQ(counted(100, 350, 1000), 250u);
  EXPECT_EQ(counted(900, 50, 1000), 150u);
  EXPECT_EQ(counted(UINT64_MAX - 5, 5, UINT64_MAX), 10u);
}

TEST_F(RaplTree, one_package_counts_joules_from_start) {
  zone("intel-rapl:0", "package-0", "5000000");
  Rapl meter(root_.native());
  ASSERT_TRUE(meter.readable()) << meter.reason();
  EXPECT_EQ(meter.what(), "package-0");
  set("intel-rapl:0", "7000000");
  meter.start();
  set("intel-rapl:0", "9500000");
  EXPECT_DOUBLE_EQ(meter.joules(), 2.5);
  set("intel-rapl:0", "10500000");
  EXPECT_DOUBLE_EQ(meter.joules(), 3.5);  // since start, not since the last reading
  meter.start();
  EXPECT_DOUBLE_EQ(meter.joules(), 0);
}

TEST_F(RaplTree, packages_are_summed_and_each_wraps_around_by_its_own_range) {
  zone("intel-rapl:0", "package-0", "999000000", "1000000000");
  zone("intel-rapl:1", "package-1", "1900000", "2000000");
  Rapl meter(root_.native());
  EXPECT_EQ(meter.what(), "package-0, package-1");
  meter.start();
  set("intel-rapl:0", "500000");  // 1 J to the end, then 0.5 J
  set("intel-rapl:1", "400000");  // 0.1 J to the end, then 0.4 J
  EXPECT_NEAR(meter.joules(), 2.0, 1e-12);
  set("intel-rapl:1", "300000");  // around once more: 1.6 J to the end, then 0.3 J
  EXPECT_NEAR(meter.joules(), 3.9, 1e-12);
}

TEST_F(RaplTree, packages_are_named_in_their_order) {
  for (const bool upward : {true, false}) {  // a file system may list them by when they came
    SetUp();
    for (int i = 0; i < 5; ++i) {
      const std::string number = std::to_string(upward ? i : 4 - i);
      zone("intel-rapl:" + number, "package-" + number, "0");
    }
    EXPECT_EQ(Rapl(root_.native()).what(), "package-0, package-1, package-2, package-3, package-4");
    TearDown();
  }
}

TEST_F(RaplTree, parts_of_a_package_and_the_whole_board_are_not_added) {
  zone("intel-rapl:0", "package-0", "0");
  zone("intel-rapl:0:0", "core", "0");
  zone("intel-rapl:1", "psys", "0");
  zone("intel-rapl-mmio:0", "package-0", "0");
  zone("intel-rapl:", "package-1", "0");
  std::filesystem::create_directories(root_ / "intel-rapl");
  std::filesystem::create_directories(root_ / "dtpm");
  Rapl meter(root_.native());
  meter.start();
  for (const char* folder : {"intel-rapl:0", "intel-rapl:0:0", "intel-rapl:1", "intel-rapl-mmio:0", "intel-rapl:"}) set(folder, "1000000");
  EXPECT_DOUBLE_EQ(meter.joules(), 1);
}

TEST_F(RaplTree, says_why_nothing_can_be_read) {
  const std::string nowhere = (root_ / "nowhere").native();
  for (const std::string& root : {nowhere, root_.native()}) {
    Rapl none(root);
    EXPECT_NE(none.reason().find(root + " has no intel-rapl package"), std::string::npos) << none.reason();
    none.start();
    EXPECT_TRUE(std::isnan(none.joules()));
  }
  zone("intel-rapl:0", "package-0", "12x");
  EXPECT_NE(Rapl(root_.native()).reason().find("energy_uj does not hold a whole number"), std::string::npos);
  set("intel-rapl:0", "65532610988");
  EXPECT_NE(Rapl(root_.native()).reason().find("beyond max_energy_range_uj"), std::string::npos);
  set("intel-rapl:0", "12");
  std::filesystem::remove(root_ / "intel-rapl:0" / "max_energy_range_uj");
  EXPECT_NE(Rapl(root_.native()).reason().find("max_energy_range_uj: No such file"), std::string::npos);
  EXPECT_EQ(Rapl(root_.native()).reason().find("only root"), std::string::npos);
}

TEST_F(RaplTree, a_counter_that_only_root_may_read_is_named) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  zone("intel-rapl:0", "package-0", "1");
  std::filesystem::permissions(root_ / "intel-rapl:0" / "energy_uj", std::filesystem::perms::none);
  const Rapl meter(root_.native());
  EXPECT_NE(meter.reason().find("intel-rapl:0/energy_uj: Permission denied (on most systems only root"), std::string::npos)
      << meter.reason();
}

TEST_F(RaplTree, a_counter_that_goes_away_half_way_makes_the_result_unknown) {
  zone("intel-rapl:0", "package-0", "1");
  Rapl meter(root_.native());
  meter.start();
  set("intel-rapl:0", "2000001");
  EXPECT_DOUBLE_EQ(meter.joules(), 2);
  std::filesystem::remove(root_ / "intel-rapl:0" / "energy_uj");
  EXPECT_TRUE(std::isnan(meter.joules()));
  EXPECT_NE(meter.reason().find("No such file"), std::string::npos);
  set("intel-rapl:0", "3000001");
  EXPECT_TRUE(std::isnan(meter.joules()));  // the joules between are lost, so there is no sum any more
}
