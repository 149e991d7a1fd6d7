// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "files/live_temporary.h"

#include <fmt/core.h>
#include <sched.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <thread>

#include "files/atomic_file.h"
#include "tofray/error.h"

namespace tofray::files {

/// filling: there is no file yet. opening: there may be one, or will be. live: there is.
enum class SlotState : int { free, filling, opening, live, being_removed, removed };

/// Folder and name of a temporary; no memory is allocated, so that a signal handler may read it.
struct TemporarySlot {
  std::atomic<SlotState> state{SlotState::free};
  std::atomic<pid_t> thread{0};  ///< that opens it
  int folder = -1;
  char name[56] = {};
};

namespace {

constexpr int slot_count = 64;
constinit TemporarySlot slots[slot_count];
constinit std::atomic<unsigned> next_number{0};
constinit std::atomic<bool> ended{false};  ///< no temporary may begin
static_assert(std::atomic<SlotState>::is_always_lock_free);

}  // namespace

LiveTemporary::LiveTemporary(int folder) {
  for (TemporarySlot& slot : slots) {
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

LiveTemporary::~LiveTemporary() {
  SlotState expected = SlotState::live;
  if (slot_->state.compare_exchange_strong(expected, SlotState::free)) return;
  // a signal handler in another thread has it: the folder must stay open until it is through
  while (slot_->state != SlotState::removed) std::this_thread::yield();
  slot_->state = SlotState::free;
}

const char* LiveTemporary::name() const { return slot_->name; }
void LiveTemporary::opened() const { slot_->state = SlotState::live; }

void end_writing() noexcept {
  ended = true;
  remove_live_temporaries();
}

void remove_live_temporaries() noexcept {
  const int saved_errno = errno;
  for (TemporarySlot& slot : slots) {
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
