// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <sstream>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include <yaml-cpp/anchor.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

#include "base/limits.h"
#include "base/text.h"
#include "yaml/json_text.h"
#include "yaml/tree.h"

namespace tofray::yaml {

namespace {

using base::fail;
using base::Place;

// What yaml-cpp lets pass: builds the tree from its events, and refuses.
class Builder : public YAML::EventHandler {
 public:
  /// @param joined  where surrogate pairs end that were joined
  Builder(std::string_view text, const Place& start, const std::vector<std::size_t>& joined)
      : text_(text), start_(start), joined_(joined) {}

  Node take(bool& any) {
    any = documents_ > 0;
    return std::move(root_);
  }
  // Columns count characters, as editors do.
  Place place(const YAML::Mark& mark) const {
    if (start_.line == 0 || mark.is_null()) return start_;
    return {start_.source, mark.line + 1, column(mark)};
  }

  void OnDocumentStart(const YAML::Mark& mark) override {
    if (documents_++ > 0)
      fail(place(mark), "a second document starts here", "expected one document in a file; take out the line \"---\" or split the file");
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override { add(mark, anchor, Node()); }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, const std::string& value) override {
    refuse_tag(mark, tag);
    Node node;
    node.kind = Node::Kind::scalar;
    node.quoted = tag == "!";
    if (node.quoted) refuse_open_quote(mark);
    node.text = value;
    add(mark, anchor, std::move(node));
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    refuse_tag(mark, tag);
    open(mark, anchor, Node::Kind::list);
  }
  void OnSequenceEnd() override { close(); }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, YAML::EmitterStyle::value) override {
    refuse_tag(mark, tag);
    open(mark, anchor, Node::Kind::map);
  }
  void OnMapEnd() override { close(); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end())
      fail(place(mark), "this alias stands inside its own anchor", "expected a value that does not contain itself");
    count(mark, found->second);
    attach(mark, Node(found->second));
  }

 private:
  struct Open {
    Node node;
    YAML::anchor_t anchor;
    YAML::Mark mark;
    bool key_pending = false;
    std::unordered_set<std::string> seen;
  };

  static bool starts_character(char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }

  // yaml-cpp counts bytes. From the last place asked for in the line, so that a file of one long line costs no square.
  int column(const YAML::Mark& mark) const { return column_in_text(mark) + longer_before(mark); }

  /// What surrogate pairs of this line were longer before they were joined.
  int longer_before(const YAML::Mark& mark) const {
    if (joined_.empty() || mark.pos < mark.column) return 0;
    const auto end = std::upper_bound(joined_.begin(), joined_.end(), static_cast<std::size_t>(mark.pos));
    return 2 * static_cast<int>(end - std::upper_bound(joined_.begin(), end, static_cast<std::size_t>(mark.pos - mark.column)));
  }

  int column_in_text(const YAML::Mark& mark) const {
    const auto position = static_cast<std::size_t>(mark.pos);
    if (ascii_only_ || mark.pos < mark.column || position > text_.size()) return mark.column + 1;
    if (mark.line != last_.line) last_ = {mark.line, position - static_cast<std::size_t>(mark.column), 1};
    for (; last_.position < position; ++last_.position) last_.column += starts_character(text_[last_.position]) ? 1 : 0;
    for (; last_.position > position; --last_.position) last_.column -= starts_character(text_[last_.position - 1]) ? 1 : 0;
    return last_.column;
  }

  // At the end of the text yaml-cpp takes an open quote for a closed one.
  void refuse_open_quote(const YAML::Mark& mark) const {
    if (mark.pos < 0 || static_cast<std::size_t>(mark.pos) >= text_.size()) return;
    std::size_t at = text_.find_first_of("\"'", static_cast<std::size_t>(mark.pos));
    if (at == std::string_view::npos) return;
    const char quote = text_[at];
    for (++at; at < text_.size(); ++at) {
      if (quote == '"' && text_[at] == '\\')
        ++at;
      else if (text_[at] == quote && quote == '\'' && at + 1 < text_.size() && text_[at + 1] == quote)
        ++at;
      else if (text_[at] == quote)
        return;
    }
    fail(place(mark), "the quote is not closed", "expected another " + std::string(1, quote) + " at the end of the text");
  }

  void refuse_tag(const YAML::Mark& mark, const std::string& tag) const {
    const bool written =
        mark.pos >= 0 && static_cast<std::size_t>(mark.pos) < text_.size() && text_[static_cast<std::size_t>(mark.pos)] == '!';
    if ((tag.empty() || tag == "?" || tag == "!") && !written) return;
    fail(place(mark), "tags such as \"!!str\" are not used here", "got the tag " + base::in_quotes(tag) + "; take it out");
  }

  // What an anchor keeps and what an alias repeats takes memory, too.
  void count(const YAML::Mark& mark, const Node& node) {
    std::size_t bytes = node.text.size();
    for (const auto& key : node.keys) bytes += key.text.size();
    count(mark, 1, bytes);
    for (const auto& item : node.items) count(mark, item);
  }

  void count(const YAML::Mark& mark, std::int64_t nodes, std::size_t bytes) {
    nodes_ += nodes;
    bytes_ += static_cast<std::int64_t>(bytes);
    if (nodes_ > base::limit::nodes.value)
      fail(place(mark), "too many values", "a file may hold " + std::to_string(base::limit::nodes.value) + ", aliases written out",
           ErrorKind::limit);
    if (bytes_ > base::limit::file_bytes.value)
      fail(place(mark), "too much text", "a file may hold " + std::to_string(base::limit::file_bytes.value) + " bytes, aliases written out",
           ErrorKind::limit);
  }

  void too_deep(const YAML::Mark& mark, int depth) const {
    if (depth > base::limit::nesting_depth.value)
      fail(place(mark), "nested too deeply",
           "lists and maps may stand " + std::to_string(base::limit::nesting_depth.value) + " deep inside each other", ErrorKind::limit);
  }

  void open(const YAML::Mark& mark, YAML::anchor_t anchor, Node::Kind kind) {
    too_deep(mark, static_cast<int>(stack_.size()) + 1);
    count(mark, 1, 0);
    Node node;
    node.kind = kind;
    node.place = place(mark);
    stack_.push_back({std::move(node), anchor, mark, false, {}});
  }

  void close() {
    Open done = std::move(stack_.back());
    stack_.pop_back();
    if (done.anchor != 0) {
      count(done.mark, done.node);
      anchors_[done.anchor] = done.node;
    }
    attach(done.mark, std::move(done.node));
  }

  void add(const YAML::Mark& mark, YAML::anchor_t anchor, Node node) {
    count(mark, 1, node.text.size() * (anchor != 0 ? 2 : 1));
    node.place = place(mark);
    if (anchor != 0) anchors_[anchor] = node;
    attach(mark, std::move(node));
  }

  void attach(const YAML::Mark& mark, Node node) {
    if (stack_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = stack_.back();
    too_deep(mark, static_cast<int>(stack_.size()) + node.height);
    if (parent.node.kind == Node::Kind::map && !parent.key_pending) {
      if (node.kind != Node::Kind::scalar)
        fail(place(mark), "a key must be a plain word",
             "got a list, a map or nothing as the key, expected e.g. \"name: value\"; or a closing bracket is missing below");
      if (node.text == "<<" && !node.quoted)
        fail(place(mark), "merge keys (\"<<\") are not used here", "write the keys out, or give the whole value by an alias: key: *name");
      if (!parent.seen.insert(node.text).second) duplicate(mark, parent.node, node.text);
      parent.node.keys.push_back({std::move(node.text), place(mark)});
      parent.key_pending = true;
      return;
    }
    parent.key_pending = false;
    parent.node.height = std::max(parent.node.height, node.height + 1);
    parent.node.items.push_back(std::move(node));
  }

  void duplicate(const YAML::Mark& mark, const Node& map, const std::string& key) const {
    Place first;
    for (const auto& known : map.keys)
      if (known.text == key) first = known.place;
    fail(place(mark), "the key " + base::in_quotes(key) + " stands twice in this map",
         first.line > 0 ? "first in line " + std::to_string(first.line) + "; take one of them out" : "take one of them out");
  }

 public:
  bool ascii_only_ = true;

 private:
  std::string_view text_;
  Place start_;
  const std::vector<std::size_t>& joined_;
  struct Last {
    int line = -1;
    std::size_t position = 0;
    int column = 1;
  };
  mutable Last last_;
  int documents_ = 0;
  std::int64_t nodes_ = 0, bytes_ = 0;
  Node root_;
  std::vector<Open> stack_;
  std::unordered_map<YAML::anchor_t, Node> anchors_;
};

/// @return whether all of it is ASCII
bool check_bytes(std::string_view text, const Place& start) {
  const bool json = looks_like_json(text);
  bool in_quotes = false, escaped = false;  // of JSON, whose strings may hold the byte 127
  Place here = start;
  const bool counted = start.line > 0;
  bool ascii = true;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const std::size_t length = base::utf8_length(text, i);
    if (length == 0) fail(here, "this is not UTF-8 text", "got the byte " + std::to_string(byte) + "; save the file as UTF-8");
    if (byte == 0) fail(here, "a NUL byte stands here", "expected text; a file in UTF-16 has to be saved as UTF-8");
    if ((byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') || (byte == 0x7F && !in_quotes))
      fail(here, "a control character stands here", "got the byte " + std::to_string(byte) + "; take it out");
    if (json && byte == '"' && !escaped) in_quotes = !in_quotes;
    escaped = in_quotes && byte == '\\' && !escaped;
    ascii = ascii && length == 1;
    if (counted) {
      here.column += 1;
      if (byte == '\n') here = {here.source, here.line + 1, 1};
    }
    i += length;
  }
  return ascii;
}

std::string line_of(std::string_view text, int line) {
  std::size_t from = 0;
  for (int i = 0; i < line; ++i) {
    from = text.find('\n', from);
    if (from == std::string_view::npos) return {};
    ++from;
  }
  return std::string(text.substr(from, text.find('\n', from) - from));
}

std::string syntax_hint(std::string_view text, const YAML::Mark& mark) {
  const std::string line = mark.is_null() ? std::string() : line_of(text, mark.line);
  const std::size_t first = line.find_first_not_of(" \t");
  std::string hint = line.empty() ? std::string() : "got " + base::in_quotes(line.substr(first == std::string::npos ? 0 : first)) + "\n";
  if (line.substr(0, first).find('\t') != std::string::npos) return hint + "indent with spaces: YAML takes no tabs there";
  return hint + "look for a missing or extra bracket, quote, comma or \":\", or other indentation than in the lines around it";
}

Node parse(std::string_view text, const Place& start) {
  if (static_cast<std::int64_t>(text.size()) > base::limit::file_bytes.value)
    fail(start, "the text is too long",
         "got " + std::to_string(text.size()) + " bytes, at most " + std::to_string(base::limit::file_bytes.value), ErrorKind::limit);
  const bool ascii = check_bytes(text, start);
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);  // byte order mark
  JoinedSurrogates joined;
  if (looks_like_json(text)) {
    joined = join_surrogates(text);
    text = joined.text;
  }
  Builder builder(text, start, joined.behind);
  builder.ascii_only_ = ascii;
  try {
    std::istringstream stream{std::string(text)};
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder)) {}
  } catch (const YAML::Exception& e) {
    fail(builder.place(e.mark), "not valid YAML: " + e.msg, syntax_hint(text, e.mark));
  }
  bool any = false;
  Node root = builder.take(any);
  if (!any) root.place = start;
  return root;
}

}  // namespace

Node parse_tree(std::string_view text, const std::string& source) {
  return parse(text, {std::make_shared<const std::string>(source), 1, 1});
}

Node parse_value(std::string_view text, const Place& place) {
  Node node = parse(text, {place.source, 0, 0});
  set_place(node, place);
  return node;
}

}  // namespace tofray::yaml
