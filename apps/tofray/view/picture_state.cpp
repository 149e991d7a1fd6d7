// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/picture_state.h"

#include "files/crc32.h"
#include "tofray/error.h"
#include "view/fields.h"

namespace tofray::view {

namespace {

using namespace fields;

constexpr std::size_t most_word = 1000, most_picture_values = 10'000;
constexpr std::uint64_t most_picture_frame = 1'000'000'000, most_picture_samples = 65'536;

std::string short_text(const Json& from, const char* name) {
  const std::string text = text_of(from, name);
  if (text.size() > most_word) throw Fault{base::in_quotes(name) + " is longer than 1000 bytes", ""};
  return text;
}

Overrides overrides_of(const Json& list) {
  if (!list.is_array()) throw Fault{"\"overrides\" is no list", ""};
  Overrides out;
  for (const Json& one : *list.items()) {
    if (!one.is_object()) throw Fault{"one of \"overrides\" is no JSON object", ""};
    std::string key = short_text(one, "key");
    if (key.empty() || key.find('=') != std::string::npos) throw Fault{base::in_quotes(key) + " is no key", ""};
    out.emplace_back(std::move(key), text_of(one, "text"));
  }
  return out;
}

PictureState state_of(const Json& from) {
  PictureState out;
  out.version = short_text(from, "tofray"), out.scene = short_text(from, "scene"), out.scene_sha256 = short_text(from, "scene_sha256");
  if (out.scene.empty()) throw Fault{"\"scene\" is empty", ""};
  out.overrides = overrides_of(member(from, "overrides"));
  out.seed = whole(from, "seed", UINT64_MAX), out.frame = whole(from, "frame", most_picture_frame);
  out.noise = short_text(from, "noise");
  out.exposure_samples = static_cast<int>(whole(from, "exposure_samples", most_picture_samples));
  out.subpixel = static_cast<int>(whole(from, "subpixel", most_picture_samples));
  return out;
}

void put_big_endian(std::string& out, std::uint64_t number) {
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>(number >> shift & 255U);
}

}  // namespace

std::string picture_text(const PictureState& state) {
  Json overrides = Json::array();
  for (const auto& [key, text] : state.overrides) overrides.push(Json::object().set("key", key).set("text", text));
  Json json = Json::object();
  json.set("tofray", state.version).set("scene", state.scene).set("scene_sha256", state.scene_sha256);
  json.set("overrides", std::move(overrides)).set("seed", state.seed).set("frame", state.frame).set("noise", state.noise);
  std::string text = files::json_text(json.set("exposure_samples", state.exposure_samples).set("subpixel", state.subpixel));
  if (text.size() > most_picture_text)
    throw Error(ErrorKind::limit,
                "error: the list of --set is longer than the 48 kB that a picture carries\n  save the scene as YAML, open that file, and "
                "take the picture there");
  return text;
}

PictureState parse_picture_text(std::string_view text) {
  constexpr const char* way_out =
      "\n  expected a picture that `tofray view` made; other programs leave out its text when they save it anew";
  if (text.size() > most_picture_text) throw Error(ErrorKind::bad_input, std::string("error: the picture's text is too long") + way_out);
  try {
    const Json json = files::parse_json(text, "the picture's text", most_picture_values);
    if (!json.is_object()) throw Fault{"it is no JSON object", ""};
    return state_of(json);
  } catch (const Fault& fault) {
    throw Error(ErrorKind::bad_input, "error: the picture's text says no state: " + fault.text + way_out);
  }
}

std::string png_with_text(std::string_view png, std::string_view keyword, std::string_view text) {
  constexpr std::size_t end_bytes = 12;  // the chunk IEND
  if (png.size() < end_bytes) throw Error(ErrorKind::bug, "error: a picture without an end");
  std::string chunk("iTXt");
  chunk.append(keyword);
  chunk.append(5, '\0');  // end of the keyword, not compressed (two bytes), no language, no other keyword
  chunk.append(text);
  std::string out(png.substr(0, png.size() - end_bytes));
  put_big_endian(out, chunk.size() - 4);
  out += chunk;
  put_big_endian(out, files::crc32(chunk));
  return out.append(png.substr(png.size() - end_bytes));
}

}  // namespace tofray::view
