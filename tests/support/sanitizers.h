// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdlib>

/// clang says by another word what g++ says by these.
#if defined(__clang__)
#if __has_feature(address_sanitizer)
#define __SANITIZE_ADDRESS__ 1
#endif
#if __has_feature(thread_sanitizer)
#define __SANITIZE_THREAD__ 1
#endif
#endif

namespace tofray::test {

/// Built for a sanitizer that needs the address space for itself, much memory and time.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool with_sanitizers = true;
#else
constexpr bool with_sanitizers = false;
#endif

/// How often a test that repeats itself does so: a sanitizer sees in a tenth of it what it would see in all.
constexpr int often(int times) { return with_sanitizers ? times / 10 : times; }

/// How often a test repeats itself, unless an environment variable says another number (.ci/long).
inline int often_unless(const char* variable, int times) {
  const char* const said = std::getenv(variable);
  return said != nullptr ? std::atoi(said) : often(times);
}

}  // namespace tofray::test
