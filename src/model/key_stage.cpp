// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "model/key_stage.h"

#include <algorithm>
#include <vector>

namespace tofray::model {

namespace {

bool is_element(const std::string& part) {
  return part == "*" || (!part.empty() && part.find_first_not_of("0123456789") == std::string::npos);
}

std::vector<std::string> parts_of(const std::string& key) {
  std::vector<std::string> out;
  for (std::size_t from = 0; from <= key.size();) {
    const std::size_t end = std::min(key.find('.', from), key.size());
    out.push_back(key.substr(from, end - from));
    from = end + 1;
  }
  return out;
}

class Walk {
 public:
  explicit Walk(std::vector<std::string> parts) : parts_(std::move(parts)) {}

  /// @param stage  of what the form is a part of
  void at(const ValueForm& form, std::size_t next, Stage stage) {
    using enum ValueForm::Kind;
    if (next == parts_.size()) return found(form, stage);
    const std::string& part = parts_[next];
    switch (form.kind) {
      case map:
        for (const Key& key : form.keys)
          if (key.name == part) at(key.form, next + 1, key.stage.value_or(stage));
        return;
      case list:
        if (is_element(part)) at(form.forms[0], next + 1, stage);
        return;
      case dictionary: return at(form.forms[0], next + 1, stage);
      case tagged:
        if (part == form.tag && next + 1 == parts_.size()) return found(form, stage);
        for (const ValueForm& one : form.forms) at(one, next, stage);
        return;
      case variant:
        for (std::size_t i = 0; i < form.names.size(); ++i)
          if (form.names[i] == part) at(form.forms[i], next + 1, stage);
        return;
      case either:
        for (const ValueForm& one : form.forms) at(one, next, stage);
        return;
      default: return;
    }
  }
  [[nodiscard]] const std::optional<KnownKey>& result() const { return result_; }

 private:
  void found(const ValueForm& form, Stage stage) {
    if (result_)
      result_->stage = std::min(result_->stage, stage);
    else
      result_ = KnownKey{&form, stage};
  }

  std::vector<std::string> parts_;
  std::optional<KnownKey> result_;
};

}  // namespace

std::optional<KnownKey> known_key(const FileForm& file, const std::string& key) {
  Walk walk(parts_of(key));
  walk.at(file.root, 0, Stage::trace);
  return walk.result();
}

}  // namespace tofray::model
