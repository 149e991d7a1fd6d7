// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Any text as a message of a page: a message that is in its bounds, or what is wrong with it.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "base/rotation.h"
#include "base/text.h"
#include "tofray/error.h"
#include "view/control.h"
#include "view/meter.h"
#include "view/picture_state.h"
#include "view/wire.h"

namespace {

using namespace tofray::view;

bool is_pixel(int u, int v) { return u >= 0 && v >= 0 && u <= 16384 && v <= 16384; }

/// The text of a stranger's picture: a state that is in its bounds and comes back as it is, or what is wrong with it.
void check_picture(std::string_view text) {
  PictureState state;
  try {
    state = parse_picture_text(text);
  } catch (const tofray::Error& error) {
    if (error.kind() != tofray::ErrorKind::bad_input || tofray::base::printable_lines(error.what()) != error.what()) std::abort();
    return;
  }
  if (state.scene.empty() || state.scene.size() > 1000 || state.frame > 1'000'000'000) std::abort();
  for (const auto& [key, value] : state.overrides)
    if (key.empty() || key.size() > 1000 || key.find('=') != std::string::npos) std::abort();
  std::string again;
  try {
    again = picture_text(state);
  } catch (const tofray::Error&) {
    return;  // what was written shorter may be too long
  }
  if (picture_text(parse_picture_text(again)) != again) std::abort();
}

/// What is asked of a frame is in its bounds, but for the image's.
void check(const Inquiry& inquiry) {
  if (const auto* drag = std::get_if<Drag>(&inquiry)) {
    if (drag->object < 0 || !is_pixel(drag->from_u, drag->from_v)) std::abort();
    if (!(std::abs(drag->to_u) <= 16384) || !(std::abs(drag->to_v) <= 16384)) std::abort();
  } else if (const auto* place = std::get_if<Place>(&inquiry)) {
    if (!place->position && !place->rotation) std::abort();
    if (place->object && *place->object < 0) std::abort();
    if (place->position)
      for (const double one : *place->position)
        if (!(std::abs(one) <= 1e6)) std::abort();
    if (place->rotation && !tofray::base::why_no_rotation(*place->rotation).what.empty()) std::abort();
  } else if (const auto* measure = std::get_if<Measure>(&inquiry)) {
    if (!is_pixel(measure->u[0], measure->v[0]) || !is_pixel(measure->u[1], measure->v[1])) std::abort();
  } else if (const auto* region = std::get_if<RegionQuestion>(&inquiry)) {
    if (!is_pixel(region->u0, region->v0) || !is_pixel(region->u1, region->v1)) std::abort();
    if (region->u1 < region->u0 || region->v1 < region->v0) std::abort();
  } else if (const auto* temporal = std::get_if<Temporal>(&inquiry)) {
    if (temporal->frames < 2 || temporal->frames > 10000) std::abort();
  } else if (const auto* restore = std::get_if<Restore>(&inquiry)) {
    if (restore->text.size() > most_picture_text) std::abort();
    check_picture(restore->text);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
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
  } else if (const auto* inquiry = std::get_if<Inquiry>(&read)) {
    check(*inquiry);
  } else if (const auto* order = std::get_if<Order>(&read)) {
    if (order->frames < 1 || order->frames > 10000 || order->first > 1'000'000'000) std::abort();
  }
  check_picture({reinterpret_cast<const char*>(data), size});
  // However the bytes of a stream are cut, its frames are the same.
  FrameMeter whole, cut;
  const bool at_once = whole.take(data, size, {});
  bool by_byte = true;
  for (std::size_t i = 0; i < size && by_byte; ++i) by_byte = cut.take(data + i, 1, {});
  if (at_once != by_byte) std::abort();
  return 0;
}
