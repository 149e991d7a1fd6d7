// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "dataset/draw.h"
#include "dataset/expression.h"
#include "dataset/judge.h"
#include "dataset/placing.h"
#include "dataset/set_file.h"
#include "dataset/split.h"
#include "tofray/dataset.h"
#include "tofray/file_record.h"
#include "yaml/tree.h"

/// Forms: maps such as {uniform: [1 m, 3 m]} that stand for a value by chance, and their values for one sample.
namespace tofray::dataset {

/// What a form is drawn anew for. A view has one frame: `per: frame` says the same.
enum class Per : std::uint8_t { set, device, scene, view };

/// What is the same for all samples of a set: combinations of its grids, rows of its tables, files of its patterns.
struct Fixed {
  struct Grid {
    std::uint64_t size = 0;
    std::uint64_t below = 1;  ///< combinations of those that stand behind it
  };
  std::map<const yaml::Node*, Grid> grids;
  std::map<const yaml::Node*, std::vector<std::vector<std::string>>> tables;  ///< the names of the columns first
  std::map<const yaml::Node*, std::vector<std::string>> files;                ///< by SHA-256 of their bytes
  std::map<const yaml::Node*, Pools> pools;                                   ///< of these, where the set is split by asset
  std::vector<FileRecord> inputs;                                             ///< all tables and files, by name, each once
  std::uint64_t combinations = 1;
};

/// The keys of `scatter` in a set's list of objects, and of `look` in its camera's pose.
const std::vector<std::string>& scatter_keys();
const std::vector<std::string>& look_keys();

/// Looks at all forms of a set. It points into the set, which has to stay. @throws Error with line and column: tables and files that cannot be read, a grid in a choice
Fixed fixed_of(const SetFile& set);

/// A sample's values.
class Sample {
 public:
  /// @param attempt  at a sample that the set's `accept` takes
  Sample(const SetFile& set, const Fixed& fixed, std::uint64_t sample, std::uint64_t view, std::uint32_t attempt = 0);

  /// The scene without forms; each value stands where its form stands in the set's file.
  yaml::Node scene();
  /// Keys and values as --set takes them.
  std::vector<std::pair<std::string, std::string>> settings();
  /// All that was drawn for it, in the order of the file.
  [[nodiscard]] const std::vector<Drawn>& drawn() const { return drawn_; }
  /// Adds what was drawn anew for this view, by its place in its law; after scene() and settings().
  void judge(Judgement& into) const;
  /// Objects that are to be put, after scene().
  [[nodiscard]] const std::vector<Scatter>& scatters() const { return scatters_; }
  /// The `look` of the camera's pose, as it is written; null where there is none.
  [[nodiscard]] const yaml::Node* look() const { return look_; }
  /// Its values, of one of several tries at it.
  Look draw_look(int attempt);
  /// How far all else has to be from the camera that looks [m], and how often a place is drawn.
  double look_clear();
  int look_tries();
  /// A number of [0, 1) by chance for a path, one for each sample.
  [[nodiscard]] double chance(const std::string& path) const { return unit_number(bits(Per::scene, path)); }
  /// A seed derived for it: 53 bits.
  [[nodiscard]] std::uint64_t seed(Per per, std::string_view path) const;

 private:
  struct Index {
    std::uint64_t at, count;  ///< which one of how many
  };
  struct Form;
  [[nodiscard]] Address address(Per per) const;
  [[nodiscard]] Index index(Per per) const;
  [[nodiscard]] std::uint64_t bits(Per per, const std::string& path) const;
  void claim(const std::string& path, const base::Place& place);

  /// @return false where the key is left out
  bool resolve(const yaml::Node& node, const std::string& path, yaml::Node& into);
  bool resolve_form(const Form& form, const std::string& path, yaml::Node& into);
  void resolve_items(const yaml::Node& node, const std::string& path, yaml::Node& into);
  Amount amount(const yaml::Node& node, const std::string& form);
  std::vector<Amount> amounts(const yaml::Node& list, std::size_t count, const std::string& form);
  std::vector<double> weights(const Form& form, std::size_t count) const;
  yaml::Node drawn_number(const Form& form, const yaml::Node& ends, const std::string& path);
  /// One of the files of a pattern, of those of the sample's split.
  std::size_t draw_file(const Form& form, std::size_t count, const std::string& path);
  bool one_of(const Form& form, std::size_t chosen, const std::string& path, yaml::Node& into);
  bool draw_choice(const Form& form, const std::string& path, yaml::Node& into);
  bool draw_grid(const Form& form, const std::string& path, yaml::Node& into);
  void draw_cap(const Form& form, const std::string& path, yaml::Node& into);
  void draw_rotation(const yaml::Node& node, const std::string& path, yaml::Node& into);
  void draw_row(const yaml::Node& node, const yaml::Node& table, const std::string& name);
  /// Draws what stands under a name of `let`, unless it was drawn before.
  void know(const std::string& name, const base::Place& place);
  /// @param written  a name of `let`, or with "." a column of its row
  Named named(std::string_view written, const base::Place& place);
  // look.cpp
  void see_look(const yaml::Node& pose);
  double look_value(const char* key, int attempt, double low, double high, base::Dimension dimension);
  // scatter.cpp
  void scatter(const yaml::Node& map, const std::string& list_path, yaml::Node& into);
  void where(const yaml::Node& map, Scatter& out);
  void add_scattered(const yaml::Node& of, const std::string& path, const std::string& name, yaml::Node& into);
  /// A number in SI units. @param expected  for messages
  double quantity(const yaml::Node& node, const std::string& path, base::Dimension dimension, const char* expected);
  void note(const Form& form, const std::string& path, std::string text, double value);
  void locate(Per per, const std::string& path, const std::string& form, const std::optional<Portion>& where);
  [[nodiscard]] bool is_drawn_here(Per per) const;

  const SetFile& set_;
  const Fixed& fixed_;
  std::uint64_t sample_, view_;
  std::uint32_t attempt_;
  std::set<std::string> claimed_;
  std::map<std::string, Named, std::less<>> known_;
  std::map<std::string, std::map<std::string, std::string>, std::less<>> rows_;  ///< of tables, by name
  std::vector<std::string> asked_;                                               ///< names under way
  std::vector<Drawn> drawn_;
  /// Where in its law something was drawn.
  struct Placed {
    std::string path, form;
    Portion where;
    double spread = 0;
  };
  std::vector<Placed> placed_;
  std::vector<Scatter> scatters_;
  const yaml::Node* look_ = nullptr;
};

}  // namespace tofray::dataset
