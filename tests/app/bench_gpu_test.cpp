// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// What `tofray bench` does with a GPU, on a stand-in for CUDA's runtime that computes on the processor.
#include <gtest/gtest.h>

#include <cmath>

#include "bench/bench.h"
#include "bench/experiment.h"
#include "cli/commands.h"
#include "files/json.h"
#include "rows.h"
#include "support/stand_in_cuda.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

using namespace tofray::app;

/// What `tofray bench card …` would read, on a small sensor.
Options on_stand_in(const fs::path& folder) {
  Options options;
  options.words = {"card"};
  options.set = {{"camera.sensor.width", "28"}, {"camera.sensor.height", "22"}};
  options.backend = Backend::cuda;
  options.frames = 2;
  options.json = true;
  options.output = (folder / "out").native();
  return options;
}

/// What a command prints, run within this program.
files::Json printed(int (*command)(const Options&), const Options& options) {
  testing::internal::CaptureStdout();
  EXPECT_EQ(command(options), 0);
  return files::parse_json(testing::internal::GetCapturedStdout(), "stdout");
}

TEST(experiment, on_a_stand_in_for_a_gpu_every_block_size_gives_the_processors_bytes) {
  const WithStandIn here;
  const Folder folder;
  Options options = on_stand_in(folder.path());
  options.block_sizes = {32, 96, 1024};
  options.stages = {"power", "all"};
  const files::Json json = printed(run_experiment, options);
  EXPECT_EQ(*json.find("gpu")->string(), "Stand-in 0");
  const files::Json::Array& rows = *json.find("results")->items();
  ASSERT_EQ(rows.size(), 2u * 5);
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(*rows[i].find("sha256")->string(), *rows[0].find("sha256")->string());
  EXPECT_EQ(*rows[2].find("code")->string(), "cuda");
  EXPECT_EQ(number(rows[3], "block_size"), 96);
  EXPECT_GT(number(rows[4], "occupancy"), 0);
  // The stand-in is no GPU that NVML knows.
  int with_gpu = 0;
  for (const files::Json& row : rows) {
    if (!row.find("energy")->is_null() && row.find("energy")->find("gpu_not_readable") != nullptr) ++with_gpu;
  }
  EXPECT_EQ(with_gpu, 2);  // the best block size of each stage; the yardsticks are the processor's
}

TEST(bench_batch, measures_batches_that_stay_and_batches_that_go_to_the_host) {
  const WithStandIn here;
  const Folder folder;
  Options options = on_stand_in(folder.path());
  options.batch = 5;
  const files::Json json = printed(run_bench, options);
  const files::Json::Array& rows = *json.find("results")->items();
  ASSERT_EQ(rows.size(), 3u);
  for (const files::Json& row : rows) {
    EXPECT_EQ(number(row, "batch"), 5);
    for (const char* rate : {"frames_per_s_device", "frames_per_s_resident", "frames_per_s_host"}) EXPECT_GT(number(row, rate), 0) << rate;
  }
  EXPECT_EQ(*rows[0].find("differing")->string(), "index");
  EXPECT_EQ(*rows[2].find("differing")->string(), "poses");
}

}  // namespace
}  // namespace tofray::test
