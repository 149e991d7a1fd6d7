// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "model/form.h"

namespace tofray::model {

Form number(base::Dimension dimension, base::Range range, const std::string& example) {
  Form form;
  form.kind = Form::Kind::number;
  form.dimension = dimension;
  form.bare = dimension == base::Dimension::none || dimension == base::Dimension::fraction;
  form.low = range.low;
  form.high = range.high;
  form.example = example;
  return form;
}

Form integer(base::Range range, const std::string& example) {
  Form form = number(base::Dimension::none, range, example);
  form.kind = Form::Kind::integer;
  return form;
}

Form boolean() {
  Form form;
  form.kind = Form::Kind::boolean;
  form.example = "true";
  return form;
}

Form text(const std::string& what, const std::string& example) {
  Form form;
  form.kind = Form::Kind::text;
  form.what = what;
  form.example = example;
  return form;
}

Form choice(std::vector<std::string> names) {
  Form form;
  form.kind = Form::Kind::choice;
  form.example = names.front();
  form.names = std::move(names);
  return form;
}

Form list(Form item, int min_items, int max_items) {
  Form form;
  form.kind = Form::Kind::list;
  form.forms.push_back(std::move(item));
  form.min_items = min_items;
  form.max_items = max_items;
  return form;
}

Form map(std::vector<Key> keys) {
  Form form;
  form.kind = Form::Kind::map;
  form.keys = std::move(keys);
  return form;
}

Form dictionary(Form item, int min_items, int max_items) {
  Form form = list(std::move(item), min_items, max_items);
  form.kind = Form::Kind::dictionary;
  return form;
}

Form either(std::vector<Form> forms) {
  Form form;
  form.kind = Form::Kind::either;
  form.forms = std::move(forms);
  return form;
}

Key required(const std::string& name, Form form, const std::string& doc) { return {name, std::move(form), doc, true, {}, {}}; }

Key absent(const std::string& name, Form form, const std::string& doc) { return {name, std::move(form), doc, false, {}, {}}; }

Key since(Stage stage, Key key) {
  key.stage = stage;
  return key;
}

bool is_scalar(const Form& form) {
  using enum Form::Kind;
  return form.kind == number || form.kind == integer || form.kind == boolean || form.kind == text || form.kind == choice;
}

const std::vector<std::string>& provenance_keys() {
  static const std::vector<std::string> keys = {"source", "assumed", "note"};
  return keys;
}

}  // namespace tofray::model
