// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

/// The rows by the members that they are of: for those who show the public structs to people, for instance in another language.
namespace tofray::model {

/// What numbers may stand in a member.
struct MemberNumbers {
  std::string name;  ///< of a curve: what files call its positions or its values; else empty
  std::string unit;  ///< SI; empty: none
  double low, high;  ///< both included
};

/// What one row says. A member that files say in several ways, or otherwise for each kind of its struct, has several.
struct MemberRow {
  std::string record, member;          ///< "Pixel", "read_noise_e"
  std::string key;                     ///< in files, dotted; empty: files have no such key
  std::string doc;                     ///< may be empty
  std::string group;                   ///< the line of the map that the key is in; empty: it is in the struct's own
  std::string tag;                     ///< where the row is of some kinds alone: the member that says which
  std::vector<int> kinds;              ///< of such a row: values of `tag` for which it is there
  bool may_be_absent;                  ///< in files, where `doc` then says what holds
  std::vector<MemberNumbers> numbers;  ///< none of words and structs; two of a curve in one member; else one
};

struct MemberRows {
  std::vector<MemberRow> rows;
  std::vector<std::string> without_row;  ///< members that users do not set: "Scene::source"
};

/// Of scene and camera, and of all structs that they are made of.
MemberRows member_rows();

}  // namespace tofray::model
