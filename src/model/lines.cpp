// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "model/lines.h"

#include <algorithm>

#include "base/text.h"

namespace tofray::model {

namespace {

using Kind = ValueForm::Kind;

std::string as_code(const std::string& text) { return "`" + text + "`"; }

std::string range(const ValueForm& form) {
  return base::quantity_text(form.low, form.example) + " to " + base::quantity_text(form.high, form.example);
}

/// What may stand there, in words.
std::string value_text(const ValueForm& form) {
  switch (form.kind) {
    case Kind::number:
    case Kind::integer: return as_code(form.example) + ", " + range(form);
    case Kind::boolean: return "`true` or `false`";
    case Kind::text: return form.what + " such as " + as_code(form.example);
    case Kind::choice: {
      std::vector<std::string> names;
      for (const auto& name : form.names) names.push_back(as_code(name));
      return base::listed(names);
    }
    case Kind::list: {
      const bool fixed = form.min_items == form.max_items;
      return "list of " + std::to_string(form.min_items) + (fixed ? "" : " to " + std::to_string(form.max_items)) + ": " +
             value_text(form.forms[0]);
    }
    case Kind::either: {
      std::vector<std::string> all;
      for (const ValueForm& one : form.forms) all.push_back(value_text(one));
      return base::listed(all, "or a");
    }
    case Kind::map:
    case Kind::dictionary:
    case Kind::tagged:
    case Kind::variant: return "map";
    case Kind::anything: break;
  }
  return "";
}

class Lines {
 public:
  std::vector<Line> all;

  /// @param kind   that the keys belong to, for their lines; may be empty
  void keys(const ValueForm& form, const std::string& path, const std::string& kind) {
    const std::string note = kind.empty() ? "" : kind + ": ";
    for (const Key& key : form.keys) {
      const std::string here = path.empty() ? key.name : path + "." + key.name;
      const bool value = has_values(key.form) && (key.form.kind != Kind::list || has_values(key.form.forms[0]));
      if (value) all.push_back({here, value_text(key.form), key.fallback, key.required, note + key.doc, key.member, kind});
      below(key.form, here, key);
    }
  }

 private:
  static bool has_values(const ValueForm& form) {
    const auto structs = [](const ValueForm& one) {
      return one.kind == Kind::map || one.kind == Kind::tagged || (one.kind == Kind::list && one.forms[0].kind == Kind::map);
    };
    if (form.kind == Kind::either) return !std::all_of(form.forms.begin(), form.forms.end(), structs);
    return is_scalar(form) || form.kind == Kind::list;
  }

  void below(const ValueForm& form, const std::string& path, const Key& key) {
    switch (form.kind) {
      case Kind::map: return keys(form, path, "");
      case Kind::list:
        if (!has_values(form.forms[0])) below(form.forms[0], path + ".0", key);
        return;
      case Kind::dictionary:
        if (form.forms[0].kind == Kind::either)
          all.push_back({path + ".NAME", value_text(form.forms[0]), {}, false, key.doc, key.member, {}});
        return below(form.forms[0], path + ".NAME", key);
      case Kind::tagged:
        all.push_back({path + "." + form.tag,
                       value_text(choice(form.names)),
                       key.fallback.empty() ? form.default_tag : key.fallback,
                       false,
                       key.doc,
                       {},
                       {}});
        for (std::size_t i = 0; i < form.forms.size(); ++i) keys(form.forms[i], path, form.names[i]);
        return;
      case Kind::variant:
        for (std::size_t i = 0; i < form.forms.size(); ++i) keys(form.forms[i], path + "." + form.names[i], "");
        return;
      case Kind::either:
        for (const ValueForm& one : form.forms) below(one, path, key);
        return;
      default: return;
    }
  }
};

}  // namespace

std::vector<Line> lines_of(const FileForm& file) {
  Lines lines;
  lines.keys(file.root, "", "");
  return std::move(lines.all);
}

}  // namespace tofray::model
