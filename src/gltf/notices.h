// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace tofray::gltf {

/// What is told about a file that is good but for what is left out: each sentence once, with how often it came.
class Notices {
 public:
  void add(const std::string& sentence) {
    for (auto& [text, times] : found_)
      if (text == sentence) {
        ++times;
        return;
      }
    if (found_.size() < most)
      found_.emplace_back(sentence, 1);
    else
      ++others_;
  }

  [[nodiscard]] std::vector<std::string> sentences() const {
    std::vector<std::string> out;
    for (const auto& [text, times] : found_) out.push_back(times == 1 ? text : text + " (" + std::to_string(times) + " times)");
    if (others_ > 0) out.push_back("and " + std::to_string(others_) + " more");
    return out;
  }

 private:
  static constexpr std::size_t most = 50;
  std::vector<std::pair<std::string, std::size_t>> found_;
  std::size_t others_ = 0;
};

}  // namespace tofray::gltf
