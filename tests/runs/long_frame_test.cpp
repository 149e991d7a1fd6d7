// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Within a frame that takes minutes: how far it is, and its end by a signal.
#include <gtest/gtest.h>

#include <cerrno>
#include <chrono>
#include <cstring>

#include "support/sanitizers.h"
#include "support/tool.h"

namespace tofray::test {
namespace {

using Seconds = std::chrono::duration<double>;

/// More than a minute of a processor's time.
Arguments endless(const Arguments& more) {
  Arguments all = {"render", "corner", "-o", "out", "--backend", "cpu", "--bounces", "4", "--samples", "8192"};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Whether a file gets to have a text in time.
bool comes(const fs::path& file, const std::string& text) {
  for (int i = 0; i < 3000; ++i) {
    if (has(content(file), text)) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return false;
}

void wait_until_it_computes(const Folder& folder) {
  for (int i = 0; i < 3000 && !fs::exists(folder / "out"); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
}

/// All that lies in the folder of results.
std::size_t results_in(const Folder& folder) {
  const fs::directory_iterator all(folder / "out");
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

/// The other side of a terminal whose screen is a file; where the machine has no such terminals it is not open().
class Terminal {
 public:
  explicit Terminal(const fs::path& screen) : master_(::posix_openpt(O_RDWR | O_NOCTTY)) {
    const bool made = master_ >= 0 && ::grantpt(master_) == 0 && ::unlockpt(master_) == 0;
    const char* const name = made ? ::ptsname(master_) : nullptr;
    if (name == nullptr || ::access(name, R_OK | W_OK) != 0) {
      reason_ = std::strerror(errno);
      return;
    }
    name_ = name;
    reader_ = std::thread([this, screen] {
      std::ofstream out(screen, std::ios::binary);
      char bytes[4096];
      for (ssize_t n = 0; (n = ::read(master_, bytes, sizeof bytes)) > 0;) out.write(bytes, n).flush();
    });
  }
  ~Terminal() {
    if (reader_.joinable()) reader_.join();  // ends with the program, the only one that has the terminal open
    if (master_ >= 0) ::close(master_);
  }
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  [[nodiscard]] bool open() const { return !name_.empty(); }
  [[nodiscard]] const std::string& reason() const { return reason_; }  ///< why it is not
  /// stderr of a child.
  [[nodiscard]] Prepare as_stderr(const fs::path& folder) const {
    return [name = name_, folder] {
      ::dup2(::open(name.c_str(), O_RDWR | O_NOCTTY), 2);
      if (::chdir(folder.c_str()) != 0) ::_exit(126);
    };
  }

 private:
  int master_;
  std::string name_, reason_;
  std::thread reader_;
};

}  // namespace

TEST(long_frame, is_given_up_soon_and_leaves_nothing) {
  for (const bool many : {false, true})
    for (const auto& [signal, code] : {std::pair{SIGINT, 130}, {SIGTERM, 143}}) {
      const Folder folder;
      Running child(
          start(endless(many ? Arguments{"--frames", "3"} : Arguments{}), folder / "stdout", folder / "stderr", in_folder(folder.path())));
      wait_until_it_computes(folder);
      const auto before = std::chrono::steady_clock::now();
      child.send(signal);
      EXPECT_EQ(child.finish(), code);
      // A tile of one bundle of ways is let to its end where many frames are under way: a quarter of a second.
      EXPECT_LT(Seconds(std::chrono::steady_clock::now() - before).count(), with_sanitizers ? 60 : 8);
      EXPECT_EQ(results_in(folder), 0U);
      EXPECT_EQ(content(folder / "stdout"), "");
      EXPECT_EQ(has(content(folder / "stderr"), "interrupted before the first frame was complete\n"), many) << content(folder / "stderr");
    }
}

TEST(long_frame, says_how_far_it_is_in_plain_lines_unless_it_is_to_be_quiet) {
  const Folder folder, silent;
  Running child(start(endless({"--threads", "1"}), folder / "stdout", folder / "stderr", in_folder(folder.path())));
  Running quiet(start(endless({"--threads", "1", "--quiet"}), silent / "stdout", silent / "stderr", in_folder(silent.path())));
  EXPECT_TRUE(comes(folder / "stderr", " left\n"));
  const std::string said = content(folder / "stderr");
  EXPECT_TRUE(has(said, " %  ")) << said;
  EXPECT_FALSE(has(said, "\r")) << said;
  EXPECT_EQ(content(silent / "stderr"), "");
  for (Running* one : {&child, &quiet}) {
    one->send(SIGTERM);
    EXPECT_EQ(one->finish(), 143);
  }
}

TEST(long_frame, has_a_bar_that_moves_on_a_terminal) {
  const Folder folder;
  const Terminal terminal(folder / "screen");
  if (!terminal.open()) GTEST_SKIP() << "this machine has no pseudo-terminals (/dev/pts): " << terminal.reason();
  Running child(start(endless({}), folder / "stdout", folder / "stderr", terminal.as_stderr(folder.path())));
  EXPECT_TRUE(comes(folder / "screen", " left"));
  EXPECT_TRUE(comes(folder / "screen", "] 1 %  ")) << content(folder / "screen");
  EXPECT_TRUE(has(content(folder / "screen"), "\r\x1b[K[")) << content(folder / "screen");
  child.send(SIGINT);
  EXPECT_EQ(child.finish(), 130);
}

}  // namespace tofray::test
