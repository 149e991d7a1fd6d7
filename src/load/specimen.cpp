// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "load/specimen.h"

#include <algorithm>

#include "base/text.h"
#include "files/npy.h"
#include "files/text_file.h"
#include "model/tables.h"

namespace tofray::load {

using base::in_quotes;
using yaml::Node;

namespace {

const std::vector<std::string>& kinds() { return model::table_of<DecoderCalibration>().rows.front().form.names; }

bool is_kind(const std::string& word) { return std::find(kinds().begin(), kinds().end(), word) != kinds().end(); }

/// The text of the file that is named, and the path that was opened.
std::string text_of(const Node& name, const NamedBy& by, std::string& path) {
  const std::string what = in_quotes(name.text) + " is no calibration" + base::did_you_mean(name.text, kinds());
  const std::string wanted = "expected exact, none, or a specimen's file, as `python3 -m tofray calibrate` writes it";
  if (by.folder.empty())
    base::fail(name.place, what, wanted + "; this profile cannot name files: use --set camera.decoding.calibration=FILE");
  try {
    path = name.text;
    return by.anywhere ? files::read_text(name.text) : files::read_reference(name.text, by.folder, by.root, name.place, path);
  } catch (const Error& fault) {
    const std::string text = fault.what(), mark = "error: ";
    const std::size_t at = text.find(mark);
    base::fail(name.place, what, wanted + "\n" + (at == std::string::npos ? text : text.substr(at + mark.size())), fault.kind());
  }
}

/// A specimen's calibration says what it is of itself.
Node specimen_in(const std::string& text, const std::string& path) {
  Node out = yaml::parse_tree(text, path);
  const Node* kind = out.find("kind");
  const bool is_one = out.kind == Node::Kind::map && out.find("frequencies") != nullptr && (kind == nullptr || kind->text == "specimen");
  if (!is_one)
    base::fail(out.place, "this is no calibration of a specimen",
               "expected a map with `frequencies`, as `python3 -m tofray calibrate phase` writes it; of another program's lens: `tofray "
               "calibration`");
  if (kind != nullptr) return out;
  out.keys.insert(out.keys.begin(), {"kind", out.place});
  Node word;
  word.kind = Node::Kind::scalar, word.text = "specimen", word.place = out.place;
  out.items.insert(out.items.begin(), std::move(word));
  return out;
}

}  // namespace

std::map<std::string, std::string> splice_calibrations(Node& profile, const std::map<std::string, NamedBy>& who) {
  std::map<std::string, std::string> folders;
  const auto splice = [&](Node& has) {
    Node* decoding = has.find("decoding");
    Node* name = decoding == nullptr ? nullptr : decoding->find("calibration");
    if (name == nullptr || name->kind != Node::Kind::scalar || is_kind(name->text)) return;
    const auto by = name->place.source == nullptr ? who.end() : who.find(*name->place.source);
    std::string path;
    const std::string text = text_of(*name, by == who.end() ? NamedBy() : by->second, path);
    *name = specimen_in(text, path);
    folders[path] = files::folder_of(path);
  };
  splice(profile);
  if (Node* modes = profile.find("modes"))
    for (Node& mode : modes->items) splice(mode);
  return folders;
}

std::vector<double> read_pixel_phases(const std::string& name, const std::string& folder, const base::Place& place) {
  std::string path;
  const std::string bytes = files::read_reference(name, folder, {}, place, path);
  const files::NpyArray array = files::parse_npy(bytes, path);
  if (array.type.kind != 'f' || array.shape.size() != 2)
    base::fail(place, "these are no phases of pixels",
               "got " + array.type.name() + " of shape " + files::shape_text(array.shape) + " in " + in_quotes(name) +
                   ", expected float32 or float64 of shape (height, width)");
  std::vector<double> out(array.count());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = array.number(i);
  return out;
}

}  // namespace tofray::load
