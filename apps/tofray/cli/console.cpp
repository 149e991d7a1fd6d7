// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/console.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <string>
#include <system_error>

#include "base/text.h"
#include "files/atomic_file.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

/// All bytes, over interruptions and short writes. @return how many could not be written, with errno set
std::size_t write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return bytes.size();
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return 0;
}

std::atomic<bool> ending{false};
static_assert(std::atomic<bool>::is_always_lock_free);

std::atomic<bool> noting{false};  ///< a StopRequest lives
std::atomic<int> noted{0};
std::atomic<std::int64_t> noted_at_ns{0};
std::atomic<std::atomic<bool>*> to_stop{nullptr};  ///< of that StopRequest
static_assert(std::atomic<std::atomic<bool>*>::is_always_lock_free);
static_assert(std::atomic<int>::is_always_lock_free && std::atomic<std::int64_t>::is_always_lock_free);

std::int64_t now_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{1'000'000'000} * now.tv_sec + now.tv_nsec;
}

/// Whether this signal is the noted one once more: timeout(1), npm and others send it to the program and to its group. Nobody presses Ctrl-C
/// twice in half a second and means two things.
bool is_the_noted_one(int signal) {
  constexpr std::int64_t together_ns = 500'000'000;
  return noted == signal && now_ns() - noted_at_ns < together_ns;
}

// Only async-signal-safe calls.
extern "C" void end_on_signal(int signal) {
  int none = 0;
  if (noted == none) noted_at_ns = now_ns();  // first: another thread may get the next one now
  if (noting && signal != SIGPIPE && noted.compare_exchange_strong(none, signal)) {
    const int error = errno;  // of a call that the signal came into
    *to_stop.load() = true;
    if (::isatty(STDERR_FILENO) != 0) write_all(STDERR_FILENO, "\r\x1b[Kstopping; once more ends at once\n");
    errno = error;
    return;
  }
  if (noting && is_the_noted_one(signal)) return;
  // Another thread is at it already.
  if (ending.exchange(true)) {
    for (;;) ::pause();
  }
  files::end_writing();
  if (signal != SIGPIPE && ::isatty(STDERR_FILENO) != 0) write_all(STDERR_FILENO, "\ninterrupted\n");
  ::_exit(128 + signal);
}

bool is_set(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr && *value != '\0';
}

}  // namespace

void secure_standard_files() {
  // Lowest number first: open() takes the lowest that is free. stdout opened for reading refuses every write, as a closed one does.
  const int flags[] = {O_RDONLY, O_RDONLY, O_WRONLY};
  for (int file = 0; file < 3; ++file) {
    if (::fcntl(file, F_GETFD) < 0 && errno == EBADF && ::open("/dev/null", flags[file]) < 0) ::_exit(static_cast<int>(ErrorKind::io));
  }
}

void print(std::string_view text) { print_picture(base::printable_lines(text)); }

void print_picture(std::string_view text) {
  const std::size_t left = write_all(STDOUT_FILENO, text);
  if (left == 0) return;
  const int error = errno;
  std::string more;
  struct statvfs room {};
  struct stat file {};
  const bool full = (error == ENOSPC || error == EDQUOT) && ::fstat(STDOUT_FILENO, &file) == 0 && S_ISREG(file.st_mode);
  if (full && ::fstatvfs(STDOUT_FILENO, &room) == 0)
    more = "\n  needed " + std::to_string(left) + " bytes, free " +
           std::to_string(static_cast<unsigned long long>(room.f_bavail) * room.f_frsize) + " bytes";
  throw Error(ErrorKind::io, "error: cannot write to standard output: " + std::generic_category().message(error) + more);
}

void say(std::string_view text) { redraw(base::printable_lines(text)); }

void redraw(std::string_view line) { write_all(STDERR_FILENO, line); }

bool stdout_is_terminal() { return ::isatty(STDOUT_FILENO) != 0; }
bool stderr_is_terminal() { return ::isatty(STDERR_FILENO) != 0; }

bool stdout_has_colors() {
  const char* terminal = std::getenv("TERM");
  return stdout_is_terminal() && !is_set("NO_COLOR") && !(terminal != nullptr && std::string_view(terminal) == "dumb");
}

int terminal_columns() {
  winsize size{};
  for (const int file : {STDOUT_FILENO, STDERR_FILENO}) {
    if (::ioctl(file, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  }
  const char* columns = std::getenv("COLUMNS");
  const long wanted = columns != nullptr ? std::strtol(columns, nullptr, 10) : 0;
  return wanted > 0 && wanted < 10'000 ? static_cast<int>(wanted) : 80;
}

void yield_to_signal() {
  while (ending) ::pause();
}

void end_cleanly_on_signals() {
  struct sigaction action {};
  action.sa_handler = end_on_signal;
  action.sa_flags = SA_RESTART;
  sigfillset(&action.sa_mask);
  // A file that grows beyond the limit of the user is an error like a full disk, not an end without a word.
  ::signal(SIGXFSZ, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
    struct sigaction before {};
    // nohup and shells in the background ignore some: so do we.
    if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN) ::sigaction(signal, &action, nullptr);
  }
}

StopRequest::StopRequest(std::atomic<bool>* stop) {
  to_stop = stop;
  noted = 0;
  noting = true;
}

StopRequest::~StopRequest() { noting = false; }

int StopRequest::signal() const { return noted; }

}  // namespace tofray::app
