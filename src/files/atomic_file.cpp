// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/atomic_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/core.h>
#include <sched.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>

#include "files/descriptor.h"
#include "tofray/error.h"

namespace tofray::files {
namespace {

// --- temporaries that a signal handler can remove -----------------------------------------------------------------------------

/// filling: there is no file yet. opening: there may be one, or will be. live: there is.
enum class SlotState : int { free, filling, opening, live, being_removed, removed };

/// Folder and name of a temporary; no memory is allocated, so that a signal handler may read it.
struct Slot {
  std::atomic<SlotState> state{SlotState::free};
  std::atomic<pid_t> thread{0};  ///< that opens it
  int folder = -1;
  char name[56] = {};
};

constexpr int slot_count = 64;
constinit Slot slots[slot_count];
constinit std::atomic<unsigned> next_number{0};
constinit std::atomic<bool> ended{false};  ///< no temporary may begin
static_assert(std::atomic<SlotState>::is_always_lock_free);

/// A place in the table, for as long as the temporary may exist.
class LiveTemporary {
 public:
  explicit LiveTemporary(int folder) {
    for (Slot& slot : slots) {
      SlotState expected = SlotState::free;
      if (!slot.state.compare_exchange_strong(expected, SlotState::filling)) continue;
      slot_ = &slot;
      slot.folder = folder;
      const auto number = next_number.fetch_add(1);
      *fmt::format_to_n(slot.name, sizeof slot.name - 1, ".tofray-{}-{}.tmp", getpid(), number).out = '\0';
      slot.thread = ::gettid();
      slot.state = SlotState::opening;
      // Either we see here that all has ended, or who ends it sees us.
      if (!ended) return;
      slot.state = SlotState::free;
      throw Error(ErrorKind::io, "error: interrupted");
    }
    throw Error(ErrorKind::limit, fmt::format("error: more than {} files are being written at once", slot_count));
  }
  LiveTemporary(const LiveTemporary&) = delete;
  LiveTemporary& operator=(const LiveTemporary&) = delete;
  ~LiveTemporary() {
    SlotState expected = SlotState::live;
    if (slot_->state.compare_exchange_strong(expected, SlotState::free)) return;
    // a signal handler in another thread has it: the folder must stay open until it is through
    while (slot_->state != SlotState::removed) std::this_thread::yield();
    slot_->state = SlotState::free;
  }
  [[nodiscard]] const char* name() const { return slot_->name; }
  /// The file is there, or could not be made.
  void opened() const { slot_->state = SlotState::live; }

 private:
  Slot* slot_ = nullptr;
};

// --- failures -----------------------------------------------------------------------------------------------------------------

/// "12345 bytes", and that no file more can be made where that is so.
std::string room_text(const struct statvfs& room) {
  return fmt::format("{} bytes{}", static_cast<unsigned long long>(room.f_bavail) * room.f_frsize,
                     room.f_files > 0 && room.f_favail == 0 ? " and no place for one more file" : "");
}

/// Throws what the user reads: path, step, reason, and the room that is left where that is the reason.
[[noreturn]] void fail(const std::filesystem::path& path, const char* step, int code, std::size_t needed, int folder) {
  std::string text = fmt::format("{}: error: cannot {}: {}", path.native(), step, std::generic_category().message(code));
  if (code == ENOSPC || code == EDQUOT) {
    struct statvfs room {};
    if (folder >= 0 && fstatvfs(folder, &room) == 0)
      text += fmt::format("\n  needed {} bytes, free {} in {}", needed, room_text(room),
                          path.has_parent_path() ? path.parent_path().native() : ".");
    else
      text += fmt::format("\n  needed {} bytes", needed);
  } else if (code == ENAMETOOLONG) {
    text += fmt::format("\n  the name has {} bytes; most file systems take 255", path.filename().native().size());
  } else if (code == ENOENT) {
    text += "\n  expected a folder that exists";
  } else if (code == EACCES || code == EPERM || code == EROFS) {
    text += "\n  expected a folder that you may write to; choose another one with -o";
  }
  throw Error(ErrorKind::io, text);
}

int open_retrying(const FileCalls& calls, int folder, const char* name, int flags) {
  int file = -1;
  do {
    file = calls.open_at(folder, name, flags | O_CLOEXEC, 0666);
  } while (file < 0 && errno == EINTR);
  return file;
}

/// All bytes, over interruptions and short writes; false with errno set.
bool write_all(const FileCalls& calls, int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = calls.write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    if (written == 0) {
      errno = EIO;
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Some file systems cannot sync a folder, a pipe or a device; that is no failure.
bool sync(const FileCalls& calls, int file) {
  int result = -1;
  do {
    result = calls.sync(file);
  } while (result < 0 && errno == EINTR);
  return result == 0 || errno == EINVAL || errno == ENOTSUP;
}

/// A name that a pipe, a device or a socket has cannot be replaced by a file; opening it could hang, and what is written is lost.
void refuse_special(const std::filesystem::path& path, mode_t mode) {
  const char* what = S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
  throw Error(ErrorKind::io,
              fmt::format("{}: error: this is {}, or a link to one\n  expected a file, or nothing, in its place", path.native(), what));
}

/// Removes the temporary unless it has got its name.
class RemoveUnlessKept {
 public:
  RemoveUnlessKept(int folder, const char* name) : folder_(folder), name_(name) {}
  RemoveUnlessKept(const RemoveUnlessKept&) = delete;
  RemoveUnlessKept& operator=(const RemoveUnlessKept&) = delete;
  ~RemoveUnlessKept() {
    if (!kept_) unlinkat(folder_, name_, 0);
  }
  void keep() { kept_ = true; }

 private:
  int folder_;
  const char* name_;
  bool kept_ = false;
};

/// Says with a lock that the temporary's maker lives. @return false where remove_stale_temporaries() of another process was quicker
bool claim(int file) {
  // A file system without locks refuses them to those who clean up, too.
  if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) return false;
  struct stat status {};
  return ::fstat(file, &status) == 0 && status.st_nlink > 0;
}

/// Whether a name is that of a temporary of ours: ".tofray-PROCESS-NUMBER.tmp".
bool is_temporary_name(std::string_view name) {
  const auto digits = [&name] {
    const std::size_t count = std::min(name.find_first_not_of("0123456789"), name.size());
    name.remove_prefix(count);
    return count > 0;
  };
  const auto word = [&name](std::string_view expected) {
    const bool there = name.starts_with(expected);
    if (there) name.remove_prefix(expected.size());
    return there;
  };
  return word(".tofray-") && digits() && word("-") && digits() && name == ".tmp";
}

/// Removes one temporary if it is a file of this user's that nobody holds a lock on.
void remove_if_stale(int folder, const char* name) {
  const Descriptor file(::openat(folder, name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC), system_file_calls());
  struct stat opened {
  }, named{};
  if (file.number() < 0 || ::fstat(file.number(), &opened) != 0 || !S_ISREG(opened.st_mode) || opened.st_uid != ::geteuid()) return;
  if (::flock(file.number(), LOCK_EX | LOCK_NB) != 0) return;
  const bool same =
      ::fstatat(folder, name, &named, AT_SYMLINK_NOFOLLOW) == 0 && named.st_ino == opened.st_ino && named.st_dev == opened.st_dev;
  if (same) ::unlinkat(folder, name, 0);
}

/// Writes the temporary and renames it. @return true, or false where its name was taken or taken away: another one will do
bool write_and_rename(const std::filesystem::path& path, std::string_view bytes, int folder, const FileCalls& calls) {
  const LiveTemporary temporary(folder);
  Descriptor file(open_retrying(calls, folder, temporary.name(), O_WRONLY | O_CREAT | O_EXCL), calls);
  temporary.opened();
  if (file.number() < 0 && errno == EEXIST) return false;
  if (file.number() < 0) fail(path, "make a temporary file in its folder", errno, bytes.size(), folder);
  RemoveUnlessKept guard(folder, temporary.name());
  // The lock lasts until the second descriptor closes, after the rename.
  const Descriptor second(::fcntl(file.number(), F_DUPFD_CLOEXEC, 0), calls);
  if (second.number() < 0) fail(path, "lock its temporary file", errno, bytes.size(), folder);
  if (!claim(second.number())) return false;
  if (!write_all(calls, file.number(), bytes)) fail(path, "write it", errno, bytes.size(), folder);
  if (!sync(calls, file.number())) fail(path, "sync it to the disk", errno, bytes.size(), folder);
  if (!file.close()) fail(path, "close it", errno, bytes.size(), folder);
  if (calls.rename_at(folder, temporary.name(), folder, path.filename().c_str()) != 0)
    fail(path, "give the complete file its name", errno, bytes.size(), folder);
  guard.keep();
  return true;
}

}  // namespace

const FileCalls& system_file_calls() {
  static const FileCalls calls{[](int folder, const char* name, int flags, mode_t mode) { return ::openat(folder, name, flags, mode); },
                               ::write, ::fsync, ::close, ::renameat};
  return calls;
}

std::string free_room(std::filesystem::path path) {
  struct statvfs room {};
  while (::statvfs(path.empty() ? "." : path.c_str(), &room) != 0) {
    if (path.empty() || path == path.parent_path()) return "nobody knows how much";
    path = path.parent_path();
  }
  return room_text(room) + " in " + (path.empty() ? "." : path.native());
}

void write_file_atomically(const std::filesystem::path& path, std::string_view bytes, const FileCalls& calls) {
  if (!path.has_filename()) throw Error(ErrorKind::io, fmt::format("{}: error: this is a folder, not a file to write", path.native()));
  struct stat before {};
  if (::stat(path.c_str(), &before) == 0 && !S_ISREG(before.st_mode)) {
    if (S_ISDIR(before.st_mode)) fail(path, "write it", EISDIR, bytes.size(), -1);
    refuse_special(path, before.st_mode);
  }
  const std::filesystem::path parent = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const Descriptor folder(open_retrying(calls, AT_FDCWD, parent.c_str(), O_RDONLY | O_DIRECTORY), calls);
  if (folder.number() < 0) fail(path, "open its folder", errno, bytes.size(), -1);
  while (!write_and_rename(path, bytes, folder.number(), calls)) {}
  if (!sync(calls, folder.number())) fail(path, "sync its folder to the disk", errno, bytes.size(), folder.number());
}

void remove_stale_temporaries(const std::filesystem::path& folder) {
  const std::unique_ptr<DIR, int (*)(DIR*)> open(::opendir(folder.c_str()), ::closedir);
  if (!open) return;
  while (const dirent* entry = ::readdir(open.get()))
    if (is_temporary_name(entry->d_name)) remove_if_stale(::dirfd(open.get()), entry->d_name);
}

void end_writing() noexcept {
  ended = true;
  remove_live_temporaries();
}

void remove_live_temporaries() noexcept {
  const int saved_errno = errno;
  for (Slot& slot : slots) {
    // What another thread is opening will be there soon (unless a disk hangs). What this one was opening stays as it is meanwhile.
    const bool ours = slot.thread == ::gettid();
    for (int i = 0; !ours && i < 1'000'000 && slot.state == SlotState::opening; ++i) ::sched_yield();
    SlotState expected = ours && slot.state == SlotState::opening ? SlotState::opening : SlotState::live;
    if (!slot.state.compare_exchange_strong(expected, SlotState::being_removed)) continue;
    unlinkat(slot.folder, slot.name, 0);
    slot.state = SlotState::removed;
  }
  errno = saved_errno;
}

}  // namespace tofray::files
