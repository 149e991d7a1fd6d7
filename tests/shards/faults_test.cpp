// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Sets whose makers are killed, stopped, doubled and without room: nothing is lost, nothing is there twice, the same bytes after it.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mount.h>

#include <chrono>
#include <set>
#include <thread>

#include "files/json.h"
#include "shards/layout.h"
#include "small_set.h"
#include "support/samples.h"
#include "support/sanitizers.h"

namespace {

using namespace tofray;
using namespace tofray::test;
using namespace std::chrono_literals;

// More of them by TOFRAY_LONG=1, as .ci/long has it.
const bool at_length = std::getenv("TOFRAY_LONG") != nullptr;
const int kills = at_length ? 200 : with_sanitizers ? 5 : 25;

Running run_of(const SmallSet& set, Arguments more = {}) {
  Arguments all{"dataset", "run", set.out().native(), "--threads", "2"};
  all.insert(all.end(), more.begin(), more.end());
  return Running(start(all, set.folder / "stdout", set.folder / "stderr"));
}

/// How long an undisturbed run takes.
std::chrono::microseconds time_of_a_run() {
  const SmallSet set;
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_EQ(run_of(set).finish(), 0);
  return std::chrono::duration_cast<std::chrono::microseconds>(std::chrono::steady_clock::now() - begin);
}

/// Whatever happened: a run makes what is missing, and then all is as if nothing had been.
void expect_whole_after_a_run(const SmallSet& set, const std::string& what) {
  for (const auto& [name, bytes] : published(set.out())) {
    // A tar without its record may be there; a record never without its tar.
    if (name.starts_with("shards/") && name.ends_with(".json")) {
      EXPECT_EQ(bytes, undisturbed().at(name)) << what;
      EXPECT_EQ(content(set.out() / (name.substr(0, name.size() - 5) + ".tar")), undisturbed().at(name.substr(0, name.size() - 5) + ".tar"))
          << what;
    }
  }
  const Result result = run({"dataset", "run", set.out().native(), "--threads", "2"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(run({"dataset", "merge", set.out().native()}).code, 0);
  EXPECT_EQ(published(set.out()), undisturbed()) << what;
  EXPECT_EQ(under_way(set.out()), 0U) << what << ": what a dead process left is removed";
}

TEST(killed, at_any_time_and_run_again_leaves_what_an_undisturbed_run_leaves) {
  const auto whole = time_of_a_run();
  out_test::Random random(7);
  const SmallSet set;
  // A run that was quicker than the one whose time was taken ends before it is killed: then once more.
  const int wanted = kills / 2 + 1;
  int killed = 0;
  for (int i = 0; (i < kills || killed < wanted) && i < 20 * kills; ++i) {
    // One after the other until all is there, then from the beginning.
    if (dataset_status(set.out()).complete == 8) {
      expect_whole_after_a_run(set, "kill " + std::to_string(i));
      fs::remove_all(set.out() / "shards");
      for (const char* file : {"SHA256SUMS", "statistics.json", "wids.json", "card.md", "croissant.json", "preview.html"})
        fs::remove(set.out() / file);
      fs::remove_all(set.out() / "index");
    }
    Running process = run_of(set);
    std::this_thread::sleep_for(std::chrono::microseconds(random.below(static_cast<std::size_t>(whole.count()))));
    process.send(SIGKILL);
    killed += process.finish() == 1000 + SIGKILL ? 1 : 0;
  }
  EXPECT_GE(killed, wanted);
  expect_whole_after_a_run(set, "at last");
}

TEST(killed, before_any_call_that_changes_a_file_and_run_again_leaves_what_an_undisturbed_run_leaves) {
  if (with_sanitizers) GTEST_SKIP() << "sanitizers have to be loaded first";
  const SmallSet set;
  const auto with_kill = [&](long at) {
    return [at, count = (set.folder / "count").native()] {
      ::setenv("LD_PRELOAD", TOFRAY_KILL_AT_CALL, 1), ::setenv("KILL_COUNT", count.c_str(), 1);
      if (at > 0) ::setenv("KILL_AT", std::to_string(at).c_str(), 1);
    };
  };
  const Arguments arguments{"dataset", "run", set.out().native(), "--shards", "1,4", "--threads", "2", "--quiet"};
  ASSERT_EQ(run(arguments, with_kill(0)).code, 0);
  const long calls = std::stol(content(set.folder / "count"));
  EXPECT_GT(calls, 30);
  for (long at = 1; at <= calls; at += at_length ? 1 : 3) {
    fs::remove_all(set.out() / "shards");
    EXPECT_EQ(run(arguments, with_kill(at)).code, 1000 + SIGKILL) << at << " of " << calls;
    EXPECT_EQ(run(arguments).code, 0) << at;
    for (const std::uint64_t shard : {1, 4}) {
      EXPECT_EQ(content(set.out() / shards::tar_name(shard)), undisturbed().at(shards::tar_name(shard))) << at;
      EXPECT_EQ(content(set.out() / shards::record_name(shard)), undisturbed().at(shards::record_name(shard))) << at;
    }
    EXPECT_EQ(under_way(set.out()), 0U) << at;
  }
}

/// A run whose files lie on a network of which one call fails ends well, or with a word on it, and another run makes the rest.
TEST(network, that_fails_at_any_call_loses_nothing_and_leaves_no_record_without_its_bytes) {
  if (with_sanitizers) GTEST_SKIP() << "sanitizers have to be loaded first";
  const SmallSet set;
  const Arguments arguments{"dataset", "run", set.out().native(), "--shards", "1,4", "--threads", "2", "--quiet"};
  const auto with = [&](const char* fault, long at) {
    return [fault, at, under = set.out().native(), count = (set.folder / "count").native()] {
      ::setenv("LD_PRELOAD", TOFRAY_NETWORK_FAULTS, 1), ::setenv("FAULT", fault, 1), ::setenv("FAULT_UNDER", under.c_str(), 1);
      ::setenv("FAULT_COUNT", count.c_str(), 1);
      if (at != 0) ::setenv("FAULT_AT", std::to_string(at).c_str(), 1);
    };
  };
  struct Case {
    const char* fault;
    bool ends_well;      ///< whatever call it is
    const char* reason;  ///< in the words of a run that does not
  };
  for (const Case& one : {Case{"link_done", true, ""}, Case{"lockless", true, ""}, Case{"unseen", true, ""},
                          Case{"link_lost", false, "Input/output error"}, Case{"stale", false, "Stale file handle"},
                          Case{"close_full", false, "No space left on device"}, Case{"sync_quota", false, "Disk quota exceeded"}}) {
    // −1 is no call at all: how many there are. 0: all of them.
    long calls = 1;
    for (long at = -1; at <= calls; at += at > 0 && !at_length ? std::max(1L, calls / 8) : 1) {
      SCOPED_TRACE(std::string(one.fault) + " at call " + std::to_string(at) + " of " + std::to_string(calls));
      if (one.fault != std::string("unseen")) fs::remove_all(set.out() / "shards");  // else: another machine has made them
      const Result result = run(arguments, with(one.fault, at));
      if (at < 0) {
        calls = std::stol(content(set.folder / "count"));
        EXPECT_GE(calls, 1);
        EXPECT_EQ(result.code, 0) << result.err;
      } else if (one.ends_well) {
        EXPECT_EQ(result.code, 0) << result.err;
      } else if (result.code != 0) {
        EXPECT_EQ(result.code, 3) << result.err;
        EXPECT_TRUE(has(result.err, one.reason) && has(result.err, set.out().native())) << result.err;
      } else {
        EXPECT_NE(at, 0) << "no call of all was of any use";
      }
      for (const std::uint64_t shard : {1, 4}) {
        const fs::path record = set.out() / shards::record_name(shard);
        if (!fs::exists(record)) continue;
        EXPECT_EQ(content(record), undisturbed().at(shards::record_name(shard)));
        EXPECT_EQ(content(set.out() / shards::tar_name(shard)), undisturbed().at(shards::tar_name(shard)));
      }
      EXPECT_EQ(run(arguments).code, 0);
      for (const std::uint64_t shard : {1, 4}) {
        EXPECT_EQ(content(set.out() / shards::tar_name(shard)), undisturbed().at(shards::tar_name(shard)));
        EXPECT_EQ(content(set.out() / shards::record_name(shard)), undisturbed().at(shards::record_name(shard)));
      }
    }
  }
}

/// Peak of a run's memory, in kB.
long peak_of_a_run(const char* samples) {
  SetText text;
  text.samples = samples;
  const SmallSet set(text, 50);
  const pid_t child =
      start({"dataset", "run", set.out().native(), "--threads", "2", "--quiet"}, set.folder / "stdout", set.folder / "stderr");
  int status = 0;
  rusage used{};
  while (::wait4(child, &status, 0, &used) < 0 && errno == EINTR) {}
  EXPECT_EQ(status, 0) << content(set.folder / "stderr");
  return used.ru_maxrss;
}

TEST(memory, of_a_run_does_not_grow_with_the_samples_that_it_made) {
  if (with_sanitizers) GTEST_SKIP() << "sanitizers keep what is freed";
  const long few = peak_of_a_run("100"), many = peak_of_a_run(at_length ? "20000" : "2000");
  EXPECT_LT(many, few + 4000) << "kB; " << few << " of 100 samples";
}

TEST(memory, that_lacks_is_said_and_another_run_makes_the_rest) {
  if (with_sanitizers) GTEST_SKIP() << "sanitizers need the address space";
  const SmallSet set;
  const Arguments arguments{"dataset", "run", set.out().native(), "--threads", "1", "--quiet"};
  int failed = 0, good = 0;
  // Less than the program itself takes, and the kernel ends it before it begins.
  for (auto most = static_cast<rlim_t>(fs::file_size(TOFRAY_TOOL)) + 25'000'000; most < 400'000'000 && good < 2; most += 4'000'000) {
    fs::remove_all(set.out() / "shards");
    const Result result = run(arguments, [most] {
      const rlimit limit{most, most};
      ::setrlimit(RLIMIT_AS, &limit);
    });
    good += result.code == 0 ? 1 : 0;
    if (result.code == 0 || (result.code == 127 && has(result.err, "shared librar"))) continue;  // the loader's word: it never began
    EXPECT_EQ(result.code, 4) << most << ": " << result.err;
    EXPECT_TRUE(has(result.err, "out of memory") || has(result.err, "error: the system refuses ")) << most << ": " << result.err;
    EXPECT_EQ(under_way(set.out()), 0U) << most;
    ++failed;
  }
  EXPECT_EQ(good, 2);
  EXPECT_GT(failed, 0);
  expect_whole_after_a_run(set, "with all the memory that there is");
}

TEST(killed, politely_ends_within_the_sample_and_leaves_no_part_of_a_file) {
  const auto whole = time_of_a_run();
  out_test::Random random(8);
  for (const int signal : {SIGTERM, SIGINT}) {
    const SmallSet set;
    int stopped = 0;
    for (int i = 0; i < (at_length ? 50 : 5) || (stopped == 0 && i < 100); ++i) {
      Running process = run_of(set);
      std::this_thread::sleep_for(
          std::chrono::microseconds(whole.count() / 4 + static_cast<long>(random.below(static_cast<std::size_t>(whole.count() / 4)))));
      process.send(signal);
      const int code = process.finish();
      EXPECT_TRUE(code == 0 || code == 128 + signal || code == 1000 + signal) << code << content(set.folder / "stderr");
      if (code == 128 + signal) {
        ++stopped;
        EXPECT_EQ(under_way(set.out()), 0U);
      }
      if (dataset_status(set.out()).complete == 8) fs::remove_all(set.out() / "shards");
    }
    EXPECT_GT(stopped, 0);
    expect_whole_after_a_run(set, "signal " + std::to_string(signal));
  }
}

TEST(two_processes, that_make_the_same_shards_at_once_both_end_well) {
  for (int i = 0; i < (at_length ? 100 : 10); ++i) {
    const SmallSet set;
    std::vector<std::unique_ptr<Running>> both;
    for (int k = 0; k < 2; ++k)
      both.push_back(std::make_unique<Running>(start({"dataset", "run", set.out().native(), "--threads", "1"},
                                                     set.folder / ("out" + std::to_string(k)), set.folder / ("err" + std::to_string(k)))));
    for (int k = 0; k < 2; ++k)
      EXPECT_EQ(both[static_cast<std::size_t>(k)]->finish(), 0) << content(set.folder / ("err" + std::to_string(k)));
    merge_shards(set.out());
    ASSERT_EQ(published(set.out()), undisturbed());
    EXPECT_EQ(under_way(set.out()), 0U);
  }
}

TEST(tar, without_a_record_gives_way) {
  const SmallSet set;
  set.run();
  const fs::path record = set.out() / shards::record_name(4), tar = set.out() / shards::tar_name(4);
  std::string bytes = content(tar);
  bytes[600] = static_cast<char>(bytes[600] ^ 1);
  fs::remove(record);
  write(tar, bytes);
  EXPECT_EQ(run({"dataset", "run", set.out().native()}).code, 0);
  EXPECT_EQ(content(tar), undisturbed().at(shards::tar_name(4)));
  EXPECT_EQ(content(record), undisturbed().at(shards::record_name(4)));
}

TEST(disk, that_is_full_is_told_with_bytes_and_the_rest_is_made_once_there_is_room) {
  const SmallSet set;
  const fs::path small = set.folder / "small";
  fs::create_directory(small);
  if (::mount("tmpfs", small.c_str(), "tmpfs", 0, "size=700k") != 0) GTEST_SKIP() << "only root may mount";
  const auto unmount = [&] { ::umount2(small.c_str(), MNT_DETACH); };
  const Result planned = run({"dataset", "plan", (set.folder / "set.yaml").native(), "-o", small.native(), "--shard-samples", "5"});
  EXPECT_EQ(planned.code, 0) << planned.err;
  const Result full = run({"dataset", "run", small.native()});
  EXPECT_EQ(full.code, 3) << full.err;
  EXPECT_TRUE(has(full.err, "No space left on device") && has(full.err, "needed ") && has(full.err, "free ")) << full.err;
  const std::uint64_t complete = dataset_status(small).complete;
  EXPECT_LT(complete, 8U);
  EXPECT_GT(complete, 0U);
  EXPECT_TRUE(verify_shards({small, {}, 0, 1}).faults.empty());
  EXPECT_EQ(::mount("tmpfs", small.c_str(), "tmpfs", MS_REMOUNT, "size=20m"), 0);
  EXPECT_EQ(run({"dataset", "run", small.native()}).code, 0);
  EXPECT_EQ(run({"dataset", "merge", small.native()}).code, 0);
  for (const auto& [name, bytes] : published(small)) {
    if (name.starts_with("shards/")) {
      EXPECT_EQ(bytes, undisturbed().at(name)) << name;
    }
  }
  unmount();
}

TEST(clock, and_times_of_files_decide_nothing) {
  const SmallSet set;
  run_shards({set.out(), {0, 1, {0, 1, 2}}, 1});
  for (const auto& entry : fs::recursive_directory_iterator(set.out()))
    fs::last_write_time(entry.path(),
                        fs::file_time_type::clock::now() + std::chrono::hours(24 * (entry.path().extension() == ".tar" ? -9000 : 9000)));
  EXPECT_EQ(set.run().made, 5U);
  merge_shards(set.out());
  EXPECT_EQ(published(set.out()), undisturbed());
}

TEST(command, tells_what_it_did_and_ends_with_1_where_something_is_missing) {
  const SmallSet set;
  const std::string out = set.out().native();
  const Result status = run({"dataset", "status", out});
  EXPECT_EQ(status.code, 1);
  EXPECT_EQ(status.out, "0 of 8 shards complete\n  missing  0-7\n");
  const Result some = run({"dataset", "run", out, "--shards", "0,2-3", "--json", "--quiet"});
  EXPECT_EQ(some.code, 0);
  EXPECT_TRUE(some.out.starts_with("{\"shard\":0,\"samples\":5,\"holes\":0,\"bytes\":")) << some.out;
  EXPECT_EQ(run({"dataset", "status", out}).out, "3 of 8 shards complete\n  missing  1, 4-7\n");
  EXPECT_EQ(run({"dataset", "merge", out}).code, 2);
  EXPECT_EQ(run({"dataset", "verify", out}).code, 1);
  const Result rest = run({"dataset", "run", out, "--part", "0/1"});
  EXPECT_EQ(rest.code, 0);
  EXPECT_TRUE(has(rest.err, "5 shards made, 3 there before\n")) << rest.err;
  const Result verified = run({"dataset", "verify", out, "--recompute", "100%"});
  EXPECT_EQ(verified.out, "8 shards read, 40 samples computed again (each is, by a chance of 100 %)\n");
  EXPECT_EQ(verified.code, 0);
  const Result merged = run({"dataset", "merge", out});
  EXPECT_TRUE(merged.out.starts_with("40 samples in 8 shards, ")) << merged.out;
  for (const auto& [arguments, expected] :
       std::vector<std::pair<Arguments, std::string>>{{{"dataset", "run", out, "--part", "4/4"}, "--part cannot be \"4\""},
                                                      {{"dataset", "run", out, "--part", "3"}, "--part cannot be \"3\""},
                                                      {{"dataset", "run", out, "--shards", "3-1"}, "--shards cannot be"},
                                                      {{"dataset", "run", out, "--recompute", "1%"}, "dataset run takes no --recompute"},
                                                      {{"dataset", "verify", out, "--recompute", "200%"}, "--recompute cannot be"},
                                                      {{"dataset", "status", out, "more"}, "dataset status takes a folder alone"},
                                                      {{"dataset", "plan", (set.folder / "set.yaml").native()}, "a plan needs a folder"},
                                                      {{"dataset", "plans", out}, "did you mean \"plan\""}}) {
    const Result refused = run(arguments);
    EXPECT_EQ(refused.code, 2);
    EXPECT_TRUE(has(refused.err, expected)) << refused.err;
  }
}

TEST(submit, prints_what_other_engines_take) {
  const SmallSet set;
  const auto printed = [&](const char* engine, const char* tasks) {
    return test::run({"dataset", "submit", set.out().native(), "--engine", engine, "--tasks", tasks, "--threads", "2", "--print"});
  };
  const Result kubernetes = printed("kubernetes", "4");
  EXPECT_EQ(kubernetes.code, 0) << kubernetes.err;
  const files::Json job = files::parse_json(kubernetes.out, "job");
  EXPECT_EQ(*job.find("metadata")->find("name")->string(), "tofray-small");
  std::uint64_t completions = 0;
  EXPECT_TRUE(job.find("spec")->find("completions")->unsigned_integer(completions));
  EXPECT_EQ(completions, 4U);
  EXPECT_TRUE(has(kubernetes.out, "--part \\\"$JOB_COMPLETION_INDEX/4\\\" --threads 2 --quiet")) << kubernetes.out;
  const Result aws = printed("aws-batch", "4");
  EXPECT_EQ(*files::parse_json(aws.out, "job").find("jobName")->string(), "tofray-small");
  EXPECT_TRUE(has(aws.out, "--part \\\"$AWS_BATCH_JOB_ARRAY_INDEX/4\\\"")) << aws.out;
  EXPECT_TRUE(has(printed("aws-batch", "1").err, "2 to 10000 jobs, not 1"));
  EXPECT_TRUE(has(printed("sge", "1").err, "slurm, kubernetes or aws-batch"));
  const Result unprinted = test::run({"dataset", "submit", set.out().native(), "--engine", "kubernetes"});
  EXPECT_EQ(unprinted.code, 2);
  EXPECT_TRUE(has(unprinted.err, "expected --print")) << unprinted.err;
}

}  // namespace
