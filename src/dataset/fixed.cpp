// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/text.h"
#include "dataset/forms.h"
#include "files/sha256.h"
#include "files/text_file.h"

namespace tofray::dataset {

namespace {

namespace fs = std::filesystem;
using yaml::Node;

std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells(1);
  for (const char c : line) {
    if (c == ',')
      cells.emplace_back();
    else if (c != '\r')
      cells.back() += c;
  }
  for (std::string& cell : cells) {
    const std::size_t first = cell.find_first_not_of(" \t");
    cell = first == std::string::npos ? "" : cell.substr(first, cell.find_last_not_of(" \t") - first + 1);
  }
  return cells;
}

/// Of all files that were read, by name.
using Inputs = std::map<std::string, FileRecord>;

void remember(Inputs& inputs, const std::string& name, const std::string& bytes) {
  inputs.insert_or_assign(name, FileRecord{name, bytes.size(), files::sha256_hex(bytes)});
}

std::vector<std::vector<std::string>> table_of(const Node& name, const std::string& folder, Inputs& inputs) {
  std::string found;
  const std::string text = files::read_reference(name.text, folder, "", name.place, found);
  remember(inputs, name.text, text);
  std::vector<std::vector<std::string>> rows;
  for (std::size_t begin = 0, line = 1; begin < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const auto cells = cells_of(std::string_view(text).substr(begin, end - begin));
    begin = end + 1;
    if (cells.size() == 1 && (cells[0].empty() || cells[0][0] == '#')) continue;
    if (!rows.empty() && cells.size() != rows[0].size())
      base::fail(
          {std::make_shared<const std::string>(found), static_cast<int>(line), 1},
          "the row has another number of columns than the first line",
          "got " + std::to_string(cells.size()) + ", expected " + std::to_string(rows[0].size()) + ": " + base::listed(rows[0], "and"));
    rows.push_back(cells);
  }
  if (rows.size() < 2)
    base::fail(name.place, "the table " + base::in_quotes(name.text) + " has no rows",
               "expected a line with the names of its columns, and a line for each row");
  for (const std::string& column : rows[0])
    if (!is_name(column))
      base::fail({std::make_shared<const std::string>(found), 1, 1}, "a column's name is no name: " + base::in_quotes(column),
                 "expected letters, digits and _, beginning with a letter, as expressions take them");
  return rows;
}

/// Paths below the folder that match the pattern, component by component.
void match(const fs::path& folder, const std::string& prefix, std::string_view pattern, std::vector<std::string>& found) {
  const std::size_t slash = pattern.find('/');
  const std::string part(pattern.substr(0, slash));
  std::error_code fault;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, fault)) {
    const std::string name = entry.path().filename().string();
    if (::fnmatch(part.c_str(), name.c_str(), FNM_PERIOD) != 0) continue;
    if (slash == std::string_view::npos) {
      if (entry.is_regular_file(fault)) found.push_back(prefix + name);
    } else if (entry.is_directory(fault)) {
      match(entry.path(), prefix + name + "/", pattern.substr(slash + 1), found);
    }
  }
}

std::vector<std::string> files_of(const Node& pattern, const std::string& folder, Inputs& inputs) {
  if (pattern.text.starts_with('/') || ("/" + pattern.text + "/").find("/../") != std::string::npos)
    base::fail(pattern.place, "files lie beside the set's file or below: " + base::in_quotes(pattern.text),
               "expected a pattern such as \"assets/*.glb\"");
  std::vector<std::string> names;
  match(folder, "", pattern.text, names);
  if (names.empty())
    base::fail(pattern.place, "no file matches " + base::in_quotes(pattern.text), "it is looked for in " + base::in_quotes(folder, 200),
               ErrorKind::io);
  std::vector<std::pair<std::string, std::string>> by_content;
  for (const std::string& name : names) {
    std::string found;
    remember(inputs, name, files::read_reference(name, folder, "", pattern.place, found, base::limit::mesh_bytes));
    by_content.emplace_back(inputs[name].sha256, name);
  }
  std::sort(by_content.begin(), by_content.end());
  names.clear();
  for (auto& [hash, name] : by_content) names.push_back(std::move(name));
  return names;
}

class Finder {
 public:
  Finder(const SetFile& set, Fixed& into) : set_(set), fixed_(into) {}

  void walk(const Node& node, bool in_choice) {
    if (node.kind != Node::Kind::map && node.kind != Node::Kind::list) return;
    const bool form = node.kind == Node::Kind::map && !node.keys.empty();
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const Node& item = node.items[i];
      const std::string_view key = form ? std::string_view(node.keys[i].text) : std::string_view();
      if (key == "grid") grid(item, node.keys[i].place, in_choice);
      if (key == "table" && item.kind == Node::Kind::scalar) fixed_.tables.emplace(&item, table_of(item, set_.folder, inputs_));
      if (key == "files" && item.kind == Node::Kind::scalar)
        fixed_.files.emplace(&item, files_of(item, set_.folder, inputs_)), patterns_.push_back(&item);
      walk(item, in_choice || key == "choice" || key == "grid");
    }
  }
  void finish() {
    multiply();
    if (set_.split.by == SplitShares::By::asset) pool();
    for (auto& [name, record] : inputs_) fixed_.inputs.push_back(std::move(record));
  }

 private:
  /// Which of each pattern's files are for which split, pattern after pattern: the same bytes are in one split wherever they stand.
  void pool() {
    if (patterns_.empty())
      base::fail(set_.split.place, "split is by asset, and the set draws no files",
                 "expected a value by {files: \"assets/*.glb\"}, or by: scene");
    std::map<std::string, Split> known;
    for (const Node* pattern : patterns_) {
      std::vector<std::string> contents;
      for (const std::string& name : fixed_.files[pattern]) contents.push_back(inputs_.at(name).sha256);
      assign_assets(set_, contents, known);
      Pools& pools = fixed_.pools[pattern];
      for (std::size_t i = 0; i < contents.size(); ++i) pools[static_cast<std::size_t>(known.at(contents[i]))].push_back(i);
      for (const Split split : {Split::train, Split::validation, Split::test})
        if (share_of(set_.split, split) > 0 && pools[static_cast<std::size_t>(split)].empty())
          base::fail(pattern->place, std::string("none of the files is for ") + split_name(split),
                     std::to_string(contents.size()) + " files match, " +
                         std::to_string(std::set(contents.begin(), contents.end()).size()) +
                         " of them different; expected one for each split, at least");
    }
  }
  void multiply() {
    for (auto one = order_.rbegin(); one != order_.rend(); ++one) {
      Fixed::Grid& grid = fixed_.grids[*one];
      grid.below = fixed_.combinations;
      constexpr std::uint64_t most = std::uint64_t{1} << 53;
      if (grid.size > most / fixed_.combinations)
        base::fail((*one)->place, "the grids have more than 2^53 combinations", "expected fewer values, or another form for some of them",
                   ErrorKind::limit);
      fixed_.combinations *= grid.size;
    }
  }
  void grid(const Node& item, const base::Place& place, bool in_choice) {
    if (in_choice)
      base::fail(place, "a grid stands in a choice or in another grid",
                 "expected it outside: each sample has one value of each grid, so that all combinations occur");
    Fixed::Grid grid;
    if (item.kind == Node::Kind::list) grid.size = item.items.size();
    if (item.kind == Node::Kind::map)
      if (const Node* n = item.find("n"); n != nullptr && n->kind == Node::Kind::scalar) {
        std::string why;
        const auto count = parse_amount(n->text, why);
        constexpr double most = 1e9;
        if (count && count->unit.empty() && count->number >= 1 && count->number <= most &&
            count->number == static_cast<double>(static_cast<std::uint64_t>(count->number)))
          grid.size = static_cast<std::uint64_t>(count->number);
      }
    if (grid.size == 0)
      base::fail(item.place, "a grid has no values",
                 "expected a list, as in {grid: [1 m, 2 m, 3 m]}, or {grid: {from: 1 m, to: 3 m, n: 5}}");
    fixed_.grids.emplace(&item, grid);
    order_.push_back(&item);
  }

  const SetFile& set_;
  Fixed& fixed_;
  std::vector<const Node*> order_, patterns_;
  Inputs inputs_;
};

}  // namespace

Fixed fixed_of(const SetFile& set) {
  Fixed fixed;
  Finder finder(set, fixed);
  for (const Node* part : {&set.let, &set.scene, &set.set}) finder.walk(*part, false);
  finder.finish();
  return fixed;
}

}  // namespace tofray::dataset
