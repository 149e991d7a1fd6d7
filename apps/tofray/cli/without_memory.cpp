// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/without_memory.h"

#include <sys/resource.h>
#include <ucontext.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

#include "cli/console.h"
#include "files/atomic_file.h"
#include "tofray/error.h"

// A sanitizer has handlers and a stack of its own. (clang says by another word what g++ says by these.)
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define TOFRAY_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define TOFRAY_SANITIZED
#endif
#endif

namespace tofray::app {

namespace {

constexpr int exit_code = static_cast<int>(ErrorKind::limit);

/// Says it and ends; neither allocates nor runs what runs at an exit. Of several threads the first one does.
[[noreturn]] void end_without_memory() {
  static constinit std::atomic<bool> told{false};
  if (told.exchange(true))
    for (;;) ::pause();
  files::end_writing();
  constexpr std::string_view text(out_of_memory);
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(exit_code);
}

/// What no handler caught, or could not be thrown: lack of memory is told as elsewhere, all else is a fault of ours and leaves a core.
[[noreturn]] void end_on_terminate() {
  try {
    if (std::current_exception() != nullptr) throw;
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (const std::system_error& error) {
    if (error.code() == std::errc::resource_unavailable_try_again || error.code() == std::errc::not_enough_memory) end_without_memory();
  } catch (...) {}
  std::abort();
}

std::uintptr_t stack_top = 0, stack_bytes = 0;  ///< of the first thread, which alone has a stack that grows

#if defined(__x86_64__)
std::uintptr_t stack_pointer(const ucontext_t& at) { return static_cast<std::uintptr_t>(at.uc_mcontext.gregs[REG_RSP]); }
#elif defined(__aarch64__)
std::uintptr_t stack_pointer(const ucontext_t& at) { return static_cast<std::uintptr_t>(at.uc_mcontext.sp); }
#else
std::uintptr_t stack_pointer(const ucontext_t&) { return 0; }
#endif

/// A fault at the end of a stack that may still grow is a lack of memory (`ulimit -v`); any other one stays what it is.
extern "C" void end_on_fault(int signal, siginfo_t* info, void* context) {
  const auto address = reinterpret_cast<std::uintptr_t>(info->si_addr);
  const std::uintptr_t pointer = stack_pointer(*static_cast<const ucontext_t*>(context));
  constexpr std::uintptr_t frame = 1 << 20;  // of a function, at most
  const bool of_stack = pointer < stack_top && stack_top - pointer < stack_bytes && address + frame > pointer && address < stack_top;
  if (of_stack && stack_top - address < stack_bytes) end_without_memory();
  ::signal(signal, SIG_DFL);  // comes again when this returns
}

void be_ready() {
  end_cleanly_on_signals();
  std::set_terminate(end_on_terminate);
#if !defined(TOFRAY_SANITIZED)
  rlimit limit{};
  ::getrlimit(RLIMIT_STACK, &limit);
  constexpr rlim_t margin = 65536, most = rlim_t{1} << 30;
  if (limit.rlim_cur <= 2 * margin) return;
  stack_top = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  stack_bytes = static_cast<std::uintptr_t>(limit.rlim_cur < most ? limit.rlim_cur - margin : most);
  alignas(16) static char handler_stack[65536];
  stack_t stack{};
  stack.ss_sp = handler_stack, stack.ss_size = sizeof handler_stack;
  struct sigaction action {};
  action.sa_sigaction = end_on_fault;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigemptyset(&action.sa_mask);
  if (::sigaltstack(&stack, nullptr) == 0) ::sigaction(SIGSEGV, &action, nullptr);
#endif
}

// Before the initialisation of libraries and of all else: that a signal or a lack of memory comes early is no reason for other manners.
// What the loader does before cannot be reached. A sanitizer has to be first itself.
#if defined(TOFRAY_SANITIZED)
[[gnu::constructor(101)]] void be_ready_early() { be_ready(); }
#else
[[gnu::section(".preinit_array"), gnu::used]] void (*const be_ready_early)() = be_ready;
#endif

}  // namespace

}  // namespace tofray::app
