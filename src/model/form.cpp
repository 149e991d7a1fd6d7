// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "model/form.h"

namespace tofray::model {

ValueForm number(base::Dimension dimension, base::Range range, const std::string& example) {
  ValueForm form;
  form.kind = ValueForm::Kind::number;
  form.dimension = dimension;
  form.bare = dimension == base::Dimension::none || dimension == base::Dimension::fraction;
  form.low = range.low;
  form.high = range.high;
  form.example = example;
  return form;
}

ValueForm integer(base::Range range, const std::string& example) {
  ValueForm form = number(base::Dimension::none, range, example);
  form.kind = ValueForm::Kind::integer;
  return form;
}

ValueForm boolean() {
  ValueForm form;
  form.kind = ValueForm::Kind::boolean;
  form.example = "true";
  return form;
}

ValueForm text(const std::string& what, const std::string& example) {
  ValueForm form;
  form.kind = ValueForm::Kind::text;
  form.what = what;
  form.example = example;
  return form;
}

ValueForm choice(std::vector<std::string> names) {
  ValueForm form;
  form.kind = ValueForm::Kind::choice;
  form.example = names.front();
  form.names = std::move(names);
  return form;
}

ValueForm list(ValueForm item, int min_items, int max_items) {
  ValueForm form;
  form.kind = ValueForm::Kind::list;
  form.forms.push_back(std::move(item));
  form.min_items = min_items;
  form.max_items = max_items;
  return form;
}

ValueForm map(std::vector<Key> keys) {
  ValueForm form;
  form.kind = ValueForm::Kind::map;
  form.keys = std::move(keys);
  return form;
}

ValueForm dictionary(ValueForm item, int min_items, int max_items) {
  ValueForm form = list(std::move(item), min_items, max_items);
  form.kind = ValueForm::Kind::dictionary;
  return form;
}

ValueForm either(std::vector<ValueForm> forms) {
  ValueForm form;
  form.kind = ValueForm::Kind::either;
  form.forms = std::move(forms);
  return form;
}

Key required(const std::string& name, ValueForm form, const std::string& doc) { return {name, std::move(form), doc, true, {}, {}}; }

Key absent(const std::string& name, ValueForm form, const std::string& doc) { return {name, std::move(form), doc, false, {}, {}}; }

Key since(Stage stage, Key key) {
  key.stage = stage;
  return key;
}

bool is_scalar(const ValueForm& form) {
  using enum ValueForm::Kind;
  return form.kind == number || form.kind == integer || form.kind == boolean || form.kind == text || form.kind == choice;
}

const std::vector<std::string>& provenance_keys() {
  static const std::vector<std::string> keys = {"source", "assumed", "note"};
  return keys;
}

}  // namespace tofray::model
