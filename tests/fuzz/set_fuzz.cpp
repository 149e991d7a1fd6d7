// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any text as the file of a data set, and three of its samples: an Error, or scenes that are read back as they were written.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "dataset/forms.h"
#include "fuzz/shown.h"
#include "load/trees.h"
#include "tofray/tofray.h"

namespace {

using namespace tofray;

/// Without what stands in files beside it: those of the machine are none of a fuzzer's business.
bool asks_for_files(const std::string& text) { return text.find("files") != std::string::npos || text.find("table") != std::string::npos; }

void draw(const dataset::SetFile& set, const dataset::Fixed& fixed, std::uint64_t sample) {
  dataset::Sample drawing(set, fixed, sample, sample % set.views);
  const std::string text = load::block_yaml(drawing.scene());
  for (const auto& [key, value] : drawing.settings())
    if (value.find('\n') != std::string::npos) std::abort();
  dataset::Sample again(set, fixed, sample, sample % set.views);
  if (load::block_yaml(again.scene()) != text) std::abort();
  if (load::block_yaml(yaml::parse_tree(text, "drawn")) != text) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  if (asks_for_files(text)) return 0;
  try {
    const dataset::SetFile set = dataset::parse_set(text, "<fuzz>");
    const dataset::Fixed fixed = dataset::fixed_of(set);
    for (const std::uint64_t sample : {std::uint64_t{0}, set.samples / 2, set.samples - 1}) draw(set, fixed, sample);
  } catch (const Error& e) {
    if (e.kind() == ErrorKind::bug || std::string(e.what()).find(": error: ") == std::string::npos) std::abort();
    if (!fuzz::may_be_shown(e)) std::abort();
  }
  return 0;
}
