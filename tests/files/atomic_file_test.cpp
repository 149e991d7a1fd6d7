// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <thread>

#include "files/atomic_file.h"
#include "files/sha256.h"
#include "support/samples.h"

using namespace tofray;
using namespace tofray::files;
using out_test::error_of;
using out_test::read_file;
using out_test::TemporaryFolder;

namespace {

// which call fails, at its how-manieth use, and with what; the system's own behaviour otherwise
struct Fault {
  std::string call;
  int at = 1;
  int code = EIO;
  int seen = 0;
};
Fault fault;

bool strikes(const char* call) {
  if (fault.call != call || ++fault.seen != fault.at) return false;
  errno = fault.code;
  return true;
}

/// Real calls, the chosen one failing; each write takes at most 1000 bytes, so that short writes are the rule.
const FileCalls faulty_calls{
    [](int folder, const char* name, int flags, mode_t mode) { return strikes("open") ? -1 : ::openat(folder, name, flags, mode); },
    [](int file, const void* bytes, size_t count) -> ssize_t {
      return strikes("write") ? -1 : ::write(file, bytes, std::min<size_t>(count, 1000));
    },
    [](int file) { return strikes("sync") ? -1 : ::fsync(file); },
    [](int file) {
      const bool struck = strikes("close");
      const int code = errno, result = ::close(file);
      if (struck) errno = code;
      return struck ? -1 : result;
    },
    [](int from, const char* a, int to, const char* b) { return strikes("rename") ? -1 : ::renameat(from, a, to, b); },
    [](int from, const char* a, int to, const char* b) { return ::linkat(from, a, to, b, 0); }};

/// Somebody who may not write everywhere, even where the tests run as root.
class AsNobody {
 public:
  AsNobody() : root_(geteuid() == 0) {
    if (root_ && seteuid(65534) != 0) throw std::runtime_error("seteuid");
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;
  ~AsNobody() {
    if (root_ && seteuid(0) != 0) std::abort();
  }

 private:
  bool root_;
};

}  // namespace

TEST(atomic_file, replaces_a_file_and_leaves_nothing_else) {
  TemporaryFolder folder;
  write_file_atomically(folder.file("a"), "first");
  write_file_atomically(folder.file("a"), std::string("sec\0nd", 6));
  write_file_atomically(folder.file("empty"), "");
  EXPECT_EQ(read_file(folder.file("a")), std::string("sec\0nd", 6));
  EXPECT_EQ(read_file(folder.file("empty")), "");
  EXPECT_EQ(folder.entries(), 2U);
}

TEST(atomic_file, whatever_call_fails_old_data_are_intact_and_the_temporary_is_gone) {
  const std::string news(2500, 'n');
  struct Case {
    const char* call;
    int at;
    int code;
  };
  // the 2nd open is the temporary's; the 1st sync is the file's, the 1st close too
  for (const Case& c : {Case{"open", 1, EACCES},
                        {"open", 2, ENOSPC},
                        {"write", 1, ENOSPC},
                        {"write", 3, EDQUOT},
                        {"write", 2, EIO},
                        {"sync", 1, EIO},
                        {"sync", 1, ENOSPC},
                        {"close", 1, EIO},
                        {"rename", 1, EIO},
                        {"rename", 1, ENOSPC}}) {
    SCOPED_TRACE(std::string(c.call) + " " + std::to_string(c.at) + " " + std::to_string(c.code));
    TemporaryFolder folder;
    write_file_atomically(folder.file("old"), "old data");
    fault = {c.call, c.at, c.code};
    const Error error = error_of([&] { write_file_atomically(folder.file("old"), news, faulty_calls); });
    EXPECT_EQ(error.kind(), ErrorKind::io);
    const std::string text = error.what();
    EXPECT_EQ(text.rfind(folder.file("old") + ": error: cannot ", 0), 0U) << text;
    if (c.code == ENOSPC || c.code == EDQUOT) {
      EXPECT_NE(text.find("needed 2500 bytes"), std::string::npos) << text;
      EXPECT_NE(text.find("free "), std::string::npos) << text;
    }
    EXPECT_EQ(read_file(folder.file("old")), "old data");
    EXPECT_EQ(folder.entries(), 1U);
  }
  fault = {};
}

TEST(atomic_file, a_folder_that_cannot_be_synced_is_an_error_but_the_file_is_whole) {
  TemporaryFolder folder;
  fault = {"sync", 2, EIO};
  EXPECT_EQ(error_of([&] { write_file_atomically(folder.file("a"), "data", faulty_calls); }).kind(), ErrorKind::io);
  EXPECT_EQ(read_file(folder.file("a")), "data");
  fault = {"sync", 2, EINVAL};  // a file system that cannot sync folders
  write_file_atomically(folder.file("b"), "data", faulty_calls);
  fault = {};
  EXPECT_EQ(folder.entries(), 2U);
}

TEST(atomic_file, interrupted_calls_and_short_writes_are_continued) {
  std::string data;
  for (int i = 0; i < 5000; ++i) data += std::to_string(i);
  for (const char* call : {"open", "write", "sync"}) {
    TemporaryFolder folder;
    fault = {call, call[0] == 'w' ? 7 : 1, EINTR};
    write_file_atomically(folder.file("a"), data, faulty_calls);
    EXPECT_EQ(fault.seen >= fault.at, true);
    EXPECT_EQ(read_file(folder.file("a")), data);
  }
  fault = {};
}

TEST(atomic_file, a_temporary_left_by_a_killed_process_is_passed_over) {
  TemporaryFolder folder;
  fault = {"open", 2, EEXIST};
  write_file_atomically(folder.file("a"), "data", faulty_calls);
  fault = {};
  EXPECT_EQ(read_file(folder.file("a")), "data");
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(atomic_file, full_device_read_only_folder_long_name_and_missing_folder_say_so) {
  TemporaryFolder folder;
  const auto message = [](const std::string& path) {
    const Error error = error_of([&] { write_file_atomically(path, "data"); });
    EXPECT_EQ(error.kind(), ErrorKind::io);
    return std::string(error.what());
  };
  EXPECT_NE(message("/dev/full").find("/dev/full: error: this is a device"), std::string::npos);
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  EXPECT_NE(message(folder.file(std::string(300, 'x'))).find("File name too long\n  the name has 300 bytes; most file systems take 255"),
            std::string::npos);
  EXPECT_NE(message(folder.file("no/such/a")).find("cannot open its folder: No such file or directory"), std::string::npos);
  EXPECT_NE(message(folder.path().string()).find("Is a directory"), std::string::npos);
  EXPECT_NE(message(folder.path().string() + "/").find("this is a folder"), std::string::npos);
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0555));
  {
    const AsNobody nobody;
    EXPECT_NE(message(folder.file("a")).find("Permission denied\n  expected a folder that you may write to"), std::string::npos);
  }
  std::filesystem::permissions(folder.path(), std::filesystem::perms(0755));
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(atomic_file, a_small_file_system_that_is_full_keeps_the_old_file) {
  TemporaryFolder folder;
  if (geteuid() != 0 || std::system(("mount -t tmpfs -o size=1m tmpfs '" + folder.path().string() + "' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "cannot mount a small file system here";
  write_file_atomically(folder.file("a"), "old data");
  const Error error = error_of([&] { write_file_atomically(folder.file("a"), std::string(3 << 20, 'x')); });
  EXPECT_NE(std::string(error.what()).find("needed 3145728 bytes, free "), std::string::npos) << error.what();
  EXPECT_EQ(read_file(folder.file("a")), "old data");
  EXPECT_EQ(folder.entries(), 1U);
  ASSERT_EQ(std::system(("umount '" + folder.path().string() + "'").c_str()), 0);
}

TEST(atomic_file, any_path_that_the_system_takes_is_good) {
  TemporaryFolder folder;
  const std::string odd = folder.file("\xFF\xFE caf\xE9 \n'\"\\");
  write_file_atomically(odd, "data");
  EXPECT_EQ(read_file(odd), "data");
  // 4 kB: one byte below the longest path there is
  std::string path = folder.path().string();
  while (path.size() < 3890) {
    path += std::string("/").append(200, 'd');
    std::filesystem::create_directory(path);
  }
  path += std::string("/").append(4095 - 1 - path.size(), 'f');
  ASSERT_EQ(path.size(), 4095U);
  write_file_atomically(path, "data");
  EXPECT_EQ(read_file(path), "data");
}

TEST(atomic_file, umask_sets_the_permissions_and_may_not_stop_us) {
  TemporaryFolder folder;
  const mode_t before = umask(0027);
  write_file_atomically(folder.file("a"), "data");
  umask(0777);
  write_file_atomically(folder.file("b"), "data");
  umask(before);
  struct stat a {
  }, b{};
  ASSERT_EQ(stat(folder.file("a").c_str(), &a), 0);
  ASSERT_EQ(stat(folder.file("b").c_str(), &b), 0);
  EXPECT_EQ(a.st_mode & 07777, 0640U);
  EXPECT_EQ(b.st_mode & 07777, 0U);
  EXPECT_EQ(b.st_size, 4);
}

TEST(atomic_file, a_signal_in_the_midst_of_writing_leaves_no_temporary) {
  TemporaryFolder folder;
  const std::string path = folder.file("a");
  write_file_atomically(path, "old data");
  // a child gets the signal at its 3rd write, where the temporary is there and half full
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    std::signal(SIGINT, [](int) {
      remove_live_temporaries();
      _exit(130);
    });
    FileCalls calls = system_file_calls();
    calls.write = [](int file, const void* bytes, size_t count) -> ssize_t {
      static int uses = 0;
      if (++uses == 3) raise(SIGINT);
      return ::write(file, bytes, std::min<size_t>(count, 100));
    };
    write_file_atomically(path, std::string(1000, 'n'), calls);
    _exit(1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_EQ(read_file(path), "old data");
  EXPECT_EQ(folder.entries(), 1U);
}

TEST(atomic_file, files_written_while_temporaries_are_removed_are_whole_or_absent) {
  TemporaryFolder folder;
  std::atomic<bool> stop{false};
  std::thread remover([&] {
    while (!stop) remove_live_temporaries();
  });
  std::vector<std::thread> writers;
  for (int w = 0; w < 4; ++w)
    writers.emplace_back([&, w] {
      for (int i = 0; i < 100; ++i) {
        try {
          write_file_atomically(folder.file(std::to_string(w)), std::string(5000, static_cast<char>('a' + w)));
        } catch (const Error& error) {
          EXPECT_EQ(error.kind(), ErrorKind::io);
        }
      }
    });
  for (std::thread& writer : writers) writer.join();
  stop = true;
  remover.join();
  EXPECT_LE(folder.entries(), 4U);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(read_file(entry.path()).size(), 5000U) << entry.path();
  // and the table is free again
  for (int i = 0; i < 200; ++i) write_file_atomically(folder.file("after"), "data");
}

// A pipe without a reader would hang whoever opens it, and what goes into a device is lost.
TEST(atomic_file, pipes_devices_and_links_to_them_are_refused_and_stay) {
  TemporaryFolder folder;
  ASSERT_EQ(mkfifo(folder.file("pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink(folder.file("pipe"), folder.file("link"));
  std::filesystem::create_symlink("/dev/null", folder.file("null"));
  for (const char* name : {"pipe", "link", "null"}) {
    const Error error = error_of([&] { write_file_atomically(folder.file(name), "data"); });
    EXPECT_EQ(error.kind(), ErrorKind::io);
    EXPECT_NE(std::string(error.what()).find(std::string(name) == "null" ? "a device" : "a pipe"), std::string::npos) << error.what();
  }
  EXPECT_EQ(folder.entries(), 3U);
  EXPECT_TRUE(std::filesystem::is_fifo(folder.file("pipe")) && std::filesystem::is_symlink(folder.file("null")));
}

/// Starts a write in a child and kills the child with its temporary half full; calls `between` before that, while it lives.
template <class Between>
void with_killed_write(const std::string& path, const Between& between) {
  int here[2];
  ASSERT_EQ(pipe(here), 0);
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    static int ready = here[1];
    FileCalls calls = system_file_calls();
    calls.write = [](int file, const void* bytes, size_t) -> ssize_t {
      (void)!::write(file, bytes, 1);
      (void)!::write(ready, "x", 1);
      for (;;) pause();
    };
    write_file_atomically(path, "data", calls);
    _exit(1);
  }
  char byte = 0;
  EXPECT_EQ(read(here[0], &byte, 1), 1);
  between();
  kill(child, SIGKILL);
  int status = 0;
  EXPECT_EQ(waitpid(child, &status, 0), child);
  close(here[0]);
  close(here[1]);
}

TEST(atomic_file, a_killed_write_s_temporary_goes_with_the_next_clean_up_and_a_live_one_stays) {
  TemporaryFolder folder;
  with_killed_write(folder.file("a"), [&] {
    EXPECT_EQ(folder.entries(), 1U);
    remove_stale_temporaries(folder.path());
    EXPECT_EQ(folder.entries(), 1U) << "its maker lives";
  });
  EXPECT_EQ(folder.entries(), 1U);
  remove_stale_temporaries(folder.path());
  EXPECT_EQ(folder.entries(), 0U);
}

TEST(atomic_file, a_clean_up_takes_plain_files_of_our_names_and_nothing_else) {
  TemporaryFolder folder;
  for (const char* name :
       {".tofray-1-2.tmp", ".tofray-1-.tmp", ".tofray--2.tmp", ".tofray-1-2.tmp.txt", "tofray-1-2.tmp", ".tofray-1-2x.tmp", "a.tmp"})
    out_test::write_file(folder.file(name), "x");
  std::filesystem::create_directory(folder.file(".tofray-3-4.tmp"));
  std::filesystem::create_symlink(folder.file("a.tmp"), folder.file(".tofray-5-6.tmp"));
  ASSERT_EQ(mkfifo(folder.file(".tofray-7-8.tmp").c_str(), 0600), 0);
  remove_stale_temporaries(folder.path());
  EXPECT_FALSE(std::filesystem::exists(folder.file(".tofray-1-2.tmp")));
  EXPECT_EQ(folder.entries(), 9U);
  remove_stale_temporaries(folder.file("a.tmp"));
  remove_stale_temporaries(folder.file("missing"));
}

TEST(sha256, agrees_with_the_standard_s_examples) {
  // FIPS 180-4: "abc", and the empty message
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  const std::string_view parts[] = {"a", "", "bc"};
  EXPECT_EQ(sha256_hex(parts), sha256_hex("abc"));
}
