// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Files that are written piece by piece and get their name once: complete or absent, whatever call fails, and whoever is first.
#include "files/streamed_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>

#include "files/sha256.h"
#include "files/tar.h"
#include "support/samples.h"

namespace {

using namespace tofray;
using namespace tofray::files;
using out_test::error_of;
using out_test::read_file;
using out_test::TemporaryFolder;
using out_test::write_file;

/// Which call fails, and with what; `done`: it does what it should and says that it failed, as over a network whose answer was lost.
struct Lie {
  std::string call;
  int code = 0;
  bool done = false;
};
Lie lie;

template <class Call>
auto maybe(const char* name, const Call& call) {
  if (lie.call != name) return call();
  if (lie.done) call();
  errno = lie.code;
  return decltype(call())(-1);
}

const FileCalls calls{
    [](int folder, const char* name, int flags, mode_t mode) {
      const bool folder_only = (flags & O_DIRECTORY) != 0;
      return maybe(folder_only ? "open folder" : "open", [&] { return ::openat(folder, name, flags, mode); });
    },
    [](int file, const void* bytes, size_t count) { return maybe("write", [&] { return ::write(file, bytes, count); }); },
    [](int file) { return maybe("sync", [&] { return ::fsync(file); }); },
    [](int file) {
      const int result = ::close(file);
      if (lie.call != "close") return result;
      errno = lie.code;
      return -1;
    },
    [](int from, const char* a, int to, const char* b) { return maybe("rename", [&] { return ::renameat(from, a, to, b); }); },
    [](int from, const char* a, int to, const char* b) { return maybe("link", [&] { return ::linkat(from, a, to, b, 0); }); }};

class streamed : public ::testing::Test {
 protected:
  streamed() {
    lie = {};
    std::filesystem::create_directory(folder_.path() / "work");
  }
  /// Writes a file of that content. @return whether it got its name
  bool write(const std::string& content) {
    StreamedFile file(folder_.path() / "a.tar", folder_.path() / "work", calls);
    for (const char c : content) file.append({&c, 1});
    EXPECT_EQ(file.finish(), sha256_hex(content));
    EXPECT_EQ(file.size(), content.size());
    return file.publish();
  }
  [[nodiscard]] std::string content() const { return read_file(folder_.path() / "a.tar"); }
  [[nodiscard]] std::ptrdiff_t temporaries() const {
    return std::distance(std::filesystem::directory_iterator(folder_.path() / "work"), std::filesystem::directory_iterator());
  }
  TemporaryFolder folder_;
};

TEST_F(streamed, file_has_its_name_when_it_is_complete_and_not_before) {
  StreamedFile file(folder_.path() / "a.tar", folder_.path() / "work", calls);
  const std::string large(std::size_t{3} << 20, 'x');
  file.append(large), file.append("end");
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "a.tar"));
  EXPECT_EQ(file.finish(), sha256_hex(large + "end"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "a.tar"));
  EXPECT_TRUE(file.publish());
  EXPECT_EQ(content(), large + "end");
}

TEST_F(streamed, file_of_who_came_first_stays) {
  EXPECT_TRUE(write("first"));
  EXPECT_FALSE(write("second"));
  EXPECT_EQ(content(), "first");
  EXPECT_EQ(temporaries(), 0);
}

TEST_F(streamed, file_may_take_the_place_of_another) {
  write_file(folder_.path() / "a.tar", "torn");
  StreamedFile file(folder_.path() / "a.tar", folder_.path() / "work", calls);
  file.append("whole"), file.finish(), file.replace();
  EXPECT_EQ(content(), "whole");
}

TEST_F(streamed, file_that_was_linked_though_the_call_says_it_failed_is_there) {
  for (const int code : {EIO, EEXIST, ESTALE, ENOENT, ETIMEDOUT}) {
    std::filesystem::remove(folder_.path() / "a.tar");
    lie = {"link", code, true};
    EXPECT_TRUE(write("done")) << code;
    EXPECT_EQ(content(), "done");
    EXPECT_EQ(temporaries(), 0);
  }
}

TEST_F(streamed, file_is_renamed_where_there_are_no_links) {
  for (const int code : {EPERM, ENOSYS, EOPNOTSUPP, EMLINK}) {
    std::filesystem::remove(folder_.path() / "a.tar");
    lie = {"link", code, false};
    EXPECT_TRUE(write("first")) << code;
    EXPECT_FALSE(write("second")) << code;
    EXPECT_EQ(content(), "first");
    EXPECT_EQ(temporaries(), 0);
  }
}

TEST_F(streamed, file_is_absent_where_a_step_fails_and_the_error_says_why) {
  for (const auto& [call, code, what] : std::vector<std::tuple<std::string, int, std::string>>{
           {"open folder", EACCES, "cannot open the folder of its temporary file"},
           {"open", EDQUOT, "cannot make this temporary file"},
           {"write", ENOSPC, "cannot write it"},
           {"sync", EIO, "cannot sync it to the disk"},
           {"close", ENOSPC, "cannot close it"},
           {"link", EIO, "cannot give the complete file its name"},
           {"link", ENOSPC, "cannot give the complete file its name"},
       }) {
    lie = {call, code, false};
    const Error error = error_of([&] { write("lost"); });
    lie = {};
    EXPECT_EQ(error.kind(), ErrorKind::io) << call;
    EXPECT_TRUE(std::string(error.what()).find(what) != std::string::npos) << error.what();
    if (code == ENOSPC) {
      EXPECT_TRUE(std::string(error.what()).find("needed ") != std::string::npos) << error.what();
    }
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "a.tar")) << call;
    EXPECT_EQ(temporaries(), 0) << call;
    EXPECT_TRUE(write("now")) << "after the fault is gone";
    std::filesystem::remove(folder_.path() / "a.tar");
  }
}

TEST(tar, has_headers_as_posix_says) {
  const std::string header = tar_header("000000123.raw.npy", 1000);
  ASSERT_EQ(header.size(), 512U);
  EXPECT_EQ(header.substr(0, 18), std::string("000000123.raw.npy\0", 18));
  EXPECT_EQ(header.substr(124, 12), std::string("00000001750\0", 12));
  EXPECT_EQ(header.substr(257, 8), std::string("ustar\00000", 8));
  unsigned sum = 0;
  for (std::size_t i = 0; i < 512; ++i) sum += i >= 148 && i < 156 ? ' ' : static_cast<unsigned char>(header[i]);
  EXPECT_EQ(std::stoul(header.substr(148, 6), nullptr, 8), sum);
  EXPECT_EQ(tar_padding(0), 0U);
  EXPECT_EQ(tar_padding(1), 511U);
  EXPECT_EQ(tar_padding(512), 0U);
  EXPECT_EQ(error_of([] { tar_header(std::string(101, 'a'), 1); }).kind(), ErrorKind::limit);
  EXPECT_EQ(error_of([] { tar_header("a", std::uint64_t{1} << 33); }).kind(), ErrorKind::limit);
}

}  // namespace
