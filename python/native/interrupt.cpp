// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "interrupt.h"

#include <pthread.h>

#include <atomic>

namespace tofray::python {

namespace {

std::atomic<FrameProgress*> running{nullptr};
struct sigaction before {};
static_assert(std::atomic<FrameProgress*>::is_always_lock_free, "a signal handler may not wait");

void on_interrupt(int signal, siginfo_t* info, void* context) {
  if (FrameProgress* const progress = running.load()) progress->stop.store(true);
  if ((before.sa_flags & SA_SIGINFO) != 0)
    before.sa_sigaction(signal, info, context);
  else if (before.sa_handler != SIG_DFL && before.sa_handler != SIG_IGN)
    before.sa_handler(signal);
}

pthread_t main_thread{};

}  // namespace

bool is_main_thread() {
  // Python's main thread is the one that threading knows as such; after a fork, the one that forked.
  if (pthread_equal(main_thread, pthread_self()) != 0) return true;
  namespace py = pybind11;
  const py::module_ threading = py::module_::import("threading");
  const bool is = threading.attr("main_thread")().is(threading.attr("current_thread")());
  if (is) main_thread = pthread_self();
  return is;
}

StopOnInterrupt::StopOnInterrupt(FrameProgress& progress) {
  if (!is_main_thread()) return;
  outer_ = running.exchange(&progress);
  if (outer_ != nullptr) {  // a frame within a frame's callback: our handler stands already
    installed_ = true;
    return;
  }
  struct sigaction current {};
  sigaction(SIGINT, nullptr, &current);
  if ((current.sa_flags & SA_SIGINFO) == 0 && (current.sa_handler == SIG_DFL || current.sa_handler == SIG_IGN)) {
    running.store(nullptr);
    return;
  }
  before = current;
  struct sigaction ours = current;
  ours.sa_flags |= SA_SIGINFO;
  ours.sa_sigaction = &on_interrupt;
  sigaction(SIGINT, &ours, nullptr);
  installed_ = true;
}

StopOnInterrupt::~StopOnInterrupt() {
  if (!installed_) return;
  running.store(outer_);
  if (outer_ != nullptr) return;
  // A handler that somebody set in between (Python of a callback) stays.
  struct sigaction current {};
  sigaction(SIGINT, nullptr, &current);
  if ((current.sa_flags & SA_SIGINFO) != 0 && current.sa_sigaction == &on_interrupt) sigaction(SIGINT, &before, nullptr);
}

}  // namespace tofray::python
