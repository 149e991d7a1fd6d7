// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <algorithm>
#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

/// What takes long to make, made once for all simulators of the process that need the same. Who compares keys compares contents: a key
/// holds all that the result depends on.
namespace tofray::base {

/// Bytes of unused results that are kept all the same, the last used ones: a program that makes one simulator after the other
/// finds what the one before had.
inline constexpr std::size_t kept_bytes = 64u << 20;

/// Keeps a result for a while, unless it is larger than all that may be kept. @param bytes  of it
void keep(const std::shared_ptr<const void>& result, std::size_t bytes);
/// Lets go of all unused results, of any kind: the next ones are made anew.
void forget_kept();

/// Results of one kind by their key. For any number of threads.
template <class Key, class T>
class Shared {
 public:
  /// The result for a key. Two threads that ask for the same new one at once may both make it; both get the same.
  /// @param make   () → T, which may throw: then there is none
  /// @param bytes  (const T&) → memory that it takes
  template <class Make, class Bytes>
  std::shared_ptr<const T> get(const Key& key, const Make& make, const Bytes& bytes) {
    std::shared_ptr<const T> result = find(key);
    if (result == nullptr) result = add(key, std::make_shared<const T>(make()));
    keep(result, bytes(*result));
    return result;
  }

 private:
  struct Entry {
    Key key;
    std::weak_ptr<const T> result;
  };

  std::shared_ptr<const T> find(const Key& key) {
    const std::lock_guard lock(mutex_);
    return find_locked(key);
  }
  std::shared_ptr<const T> find_locked(const Key& key) {
    for (const Entry& one : entries_)
      if (one.key == key)
        if (auto result = one.result.lock()) return result;
    return nullptr;
  }
  std::shared_ptr<const T> add(const Key& key, std::shared_ptr<const T> fresh) {
    const std::lock_guard lock(mutex_);
    if (auto other = find_locked(key)) return other;
    std::erase_if(entries_, [](const Entry& one) { return one.result.expired(); });
    entries_.push_back({key, fresh});
    return fresh;
  }

  std::mutex mutex_;
  std::vector<Entry> entries_;  ///< guarded by it
};

/// The one of its kind in the process. It is never destroyed: simulators may outlive what is static.
template <class Key, class T>
Shared<Key, T>& shared() {
  static auto* const all = new Shared<Key, T>;
  return *all;
}

}  // namespace tofray::base
