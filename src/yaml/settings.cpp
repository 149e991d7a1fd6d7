// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "yaml/settings.h"

#include <algorithm>
#include <charconv>

#include "base/limits.h"
#include "base/text.h"

namespace tofray::yaml {

using base::Place;

void refuse_too_many(std::size_t changes, const Place& place) {
  if (changes > static_cast<std::size_t>(base::limit::overrides.value))
    base::fail(place, "too many keys are changed",
               "got " + std::to_string(changes) + ", at most " + std::to_string(base::limit::overrides.value) + " (`tofray --limits`)",
               ErrorKind::limit);
}

namespace {

// Says which kind of thing a map is: another kind has other keys, so the old ones must go.
const char* const kind_keys[] = {"kind", "brdf"};

bool stays_whole(const Node& map) {
  if (map.items.empty() || map.find("value") != nullptr) return true;
  for (const auto& key : map.keys)
    if (key.text.find('.') != std::string::npos) return true;
  return std::any_of(std::begin(kind_keys), std::end(kind_keys), [&](const char* key) { return map.find(key) != nullptr; });
}

bool same_kind(const Node& a, const Node& b) {
  for (const char* key : kind_keys) {
    const Node* in_a = a.find(key);
    const Node* in_b = b.find(key);
    if (in_b != nullptr && (in_a == nullptr || in_a->text != in_b->text)) return false;
  }
  return true;
}

// Whether `key: value` makes another kind of thing of a map.
bool says_other_kind(const Node& map, const std::string& key, const Node& value) {
  if (std::find(std::begin(kind_keys), std::end(kind_keys), key) == std::end(kind_keys)) return false;
  const Node* now = map.find(key);
  return now == nullptr || now->text != value.text;
}

Node& child(Node& map, const std::string& key, const Place& place) {
  if (Node* found = map.find(key)) return *found;
  map.keys.push_back({key, place});
  map.items.emplace_back();
  map.items.back().place = place;
  return map.items.back();
}

void merge(Node& into, Node value, const Place& place) {
  const bool maps =
      into.kind == Node::Kind::map && value.kind == Node::Kind::map && value.find("value") == nullptr && same_kind(into, value);
  if (!maps) {
    into = std::move(value);
    return;
  }
  refuse_too_many(value.keys.size(), place);
  for (std::size_t i = 0; i < value.keys.size(); ++i) merge(child(into, value.keys[i].text, place), std::move(value.items[i]), place);
}

Node& element(Node& list, const std::string& part, const std::string& before, const Place& place) {
  std::size_t index = 0;
  const auto read = std::from_chars(part.data(), part.data() + part.size(), index);
  if (read.ec == std::errc() && read.ptr == part.data() + part.size() && index < list.items.size()) return list.items[index];
  const std::size_t size = list.items.size();
  const bool number = !part.empty() && part.find_first_not_of("0123456789") == std::string::npos;
  const std::string what = "no such element: " + base::in_quotes(part) + " in " + base::in_quotes(before);
  if (size == 0) base::fail(place, what, "the list is empty");
  base::fail(place, number ? what + ", which has " + std::to_string(size) : what,
             (number ? "they are counted from 0: expected " : "it is a list; expected an index, as in ") + before + ".0" +
                 (size > 1 ? " … " + before + "." + std::to_string(size - 1) : ""));
}

}  // namespace

void set_key(Node& root, const std::string& path, Node value, const Place& place, Maps maps) {
  const auto parts = std::count(path.begin(), path.end(), '.') + 1;
  if (parts > base::limit::nesting_depth.value)
    base::fail(place, "the key has too many parts",
               "got " + std::to_string(parts) + ", at most " + std::to_string(base::limit::nesting_depth.value) + " (`tofray --limits`)",
               ErrorKind::limit);
  set_place(value, place);
  Node* here = &root;
  std::string before;
  for (std::size_t from = 0; from <= path.size();) {
    const std::size_t dot = std::min(path.find('.', from), path.size());
    const std::string part = path.substr(from, dot - from);
    if (part.empty())
      base::fail(place, "the key " + base::in_quotes(path) + " has an empty part",
                 "expected words with one \".\" between them, e.g. lens.f_number");
    const bool last = dot == path.size();
    if (here->kind == Node::Kind::list) {
      here = &element(*here, part, before, place);
    } else {
      if (here->kind != Node::Kind::map || (here->find("value") != nullptr && part != "value" && here->find(part) == nullptr)) {
        *here = Node();
        here->kind = Node::Kind::map;
        here->place = place;
      }
      if (last && says_other_kind(*here, part, value)) {
        here->keys.clear();
        here->items.clear();
      }
      here = &child(*here, part, place);
    }
    before += (before.empty() ? "" : ".") + part;
    from = dot + 1;
    if (last) break;
  }
  if (maps == Maps::replace)
    *here = std::move(value);
  else
    merge(*here, std::move(value), place);
}

namespace {

void flatten(const Node& map, const std::string& before, const std::vector<std::string>& without, std::vector<Override>& out) {
  for (std::size_t i = 0; i < map.keys.size(); ++i) {
    const std::string& key = map.keys[i].text;
    if (before.empty() && std::find(without.begin(), without.end(), key) != without.end()) continue;
    const Node& value = map.items[i];
    const std::string path = before + key;
    if (value.kind == Node::Kind::map && !stays_whole(value))
      flatten(value, path + ".", without, out);
    else
      out.push_back({path, flow_text(value), base::to_string(map.keys[i].place)});
  }
}

}  // namespace

std::vector<Override> flattened(const Node& map, const std::vector<std::string>& without) {
  std::vector<Override> out;
  flatten(map, "", without, out);
  return out;
}

}  // namespace tofray::yaml
