// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/range.h"
#include "base/units.h"
#include "tofray/frame_arrays.h"

/// What may stand in a file: the tables as a tree of forms. Reading, messages, suggestions, JSON Schema and reference page go by it.
namespace tofray::model {

struct Key;

/// What one value may be.
struct ValueForm {
  enum class Kind {
    number,  ///< with the unit of `dimension`
    integer,
    boolean,
    text,
    choice,      ///< one of `names`
    list,        ///< of forms[0], min_items … max_items of them
    map,         ///< with `keys`
    dictionary,  ///< free names, each with a value of forms[0]
    tagged,      ///< a map whose key `tag` says which of `forms` (maps) it is; `names` are the tags
    variant,     ///< a map with exactly one key out of `names`; forms[i] says what stands there
    either,      ///< a value of one of `forms`, told apart by being a scalar, a list or a map
    anything,    ///< interpreted later
  };
  Kind kind = Kind::anything;
  base::Dimension dimension = base::Dimension::none;
  bool bare = false;         ///< a number without a unit is good (in SI units)
  double low = 0, high = 0;  ///< SI, both included
  std::string example;       ///< number: as one writes it
  std::vector<std::string> names;
  std::vector<ValueForm> forms;
  std::vector<Key> keys;
  std::vector<std::string> exactly_one;  ///< map: exactly one of these keys has to be there
  std::vector<std::string> at_most_one;  ///< map: not two of these
  bool open = false;                     ///< map: keys that the table does not have are kept, not refused
  std::string tag, default_tag;
  std::string what;  ///< text: what it is, e.g. "the name of a material"; tagged: the file whose name may stand in its place
  int min_items = 0, max_items = 0;
  std::vector<std::pair<std::string, std::string>> meant;  ///< map: unknown keys that people try, and the dotted path that they mean
};

/// A key of a map.
struct Key {
  std::string name;
  ValueForm form;
  std::string doc;  ///< one line
  bool required = false;
  std::string fallback;             ///< what holds where the key is absent, as one writes it; empty: the key's line says it
  std::string member;               ///< what it is in code, e.g. "Pixel::read_noise_e"; empty: no member of its own
  std::optional<Stage> stage = {};  ///< Row::stage
};

// The forms are written in this shorthand.
ValueForm number(base::Dimension dimension, base::Range range, const std::string& example);
ValueForm integer(base::Range range, const std::string& example);
ValueForm boolean();
ValueForm text(const std::string& what, const std::string& example);
ValueForm choice(std::vector<std::string> names);
ValueForm list(ValueForm item, int min_items, int max_items);
ValueForm map(std::vector<Key> keys);
ValueForm dictionary(ValueForm item, int min_items, int max_items);
ValueForm either(std::vector<ValueForm> forms);

Key required(const std::string& name, ValueForm form, const std::string& doc);
Key absent(const std::string& name, ValueForm form, const std::string& doc);

/// The first stage of a frame that looks at it. @return the key
Key since(Stage stage, Key key);

/// Whether it is written as one word or number.
bool is_scalar(const ValueForm& form);

/// A whole file kind.
struct FileForm {
  std::string kind;  ///< "scene", "camera"
  std::string title;
  ValueForm root;
  /// Numbers may be written {value: …, source: …} or {value: …, assumed: …}, and every map may say source, assumed and note.
  bool provenance = false;
};

const FileForm& scene_form();
const FileForm& camera_form();

/// Keys that every map has where FileForm::provenance is set.
const std::vector<std::string>& provenance_keys();

}  // namespace tofray::model
