// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any text as a message of a page: a message that is in its bounds, or what is wrong with it.
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/text.h"
#include "view/control.h"
#include "view/meter.h"
#include "view/wire.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tofray::view;
  const Control read = parse_control({reinterpret_cast<const char*>(data), size});
  if (const auto* refused = std::get_if<Refused>(&read)) {
    if (refused->text.empty() || tofray::base::printable_lines(refused->text) != refused->text) std::abort();
  } else if (const auto* want = std::get_if<Want>(&read)) {
    for (const std::uint16_t one : want->arrays)
      if (one >= wire_arrays().size()) std::abort();
    if (want->rate && want->rate->kind == Rate::Kind::number && !(want->rate->hz >= 0.01 && want->rate->hz <= 1000)) std::abort();
  } else if (const auto* edit = std::get_if<Edit>(&read)) {
    const auto is_key = [](const std::string& key) { return key.size() <= 1000 && key.find('=') == std::string::npos; };
    if (!is_key(edit->key)) std::abort();
    for (const auto& [key, text] : edit->overrides)
      if (key.empty() || !is_key(key)) std::abort();
    const bool of_b = edit->kind == Edit::Kind::open || edit->kind == Edit::Kind::close;
    if (of_b && edit->side != Side::b) std::abort();
    if (!edit->scene.empty() && edit->kind != Edit::Kind::open) std::abort();
  } else if (const auto* pixel = std::get_if<PixelQuestion>(&read)) {
    if (pixel->u < 0 || pixel->v < 0) std::abort();
  } else if (const auto* why = std::get_if<WhyQuestion>(&read)) {
    if (why->u0 < 0 || why->v0 < 0 || why->u1 < why->u0 || why->v1 < why->v0) std::abort();
    if (why->u1 - why->u0 >= 64 || why->v1 - why->v0 >= 64) std::abort();
  }
  // However the bytes of a stream are cut, its frames are the same.
  FrameMeter whole, cut;
  const bool at_once = whole.take(data, size, {});
  bool by_byte = true;
  for (std::size_t i = 0; i < size && by_byte; ++i) by_byte = cut.take(data + i, 1, {});
  if (at_once != by_byte) std::abort();
  return 0;
}
