// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "shards/shown_samples.h"

#include <algorithm>
#include <cmath>

#include "files/npy.h"
#include "pictures/color_map.h"
#include "pictures/png_file.h"
#include "pictures/value_scale.h"
#include "shards/layout.h"
#include "shards/quantised.h"
#include "shards/shard_tar.h"

namespace tofray::shards {

namespace {

constexpr std::uint64_t most_spread = 24;
constexpr std::size_t most_worst = 6;

/// Lengths in the colours of depth pictures, from the 1st to the 99th percentile; what is invalid is dark.
std::string depth_picture(const files::NpyArray& z, const files::Json* about) {
  const auto height = static_cast<int>(z.shape[0]), width = static_cast<int>(z.shape[1]);
  std::vector<double> valid;
  for (std::size_t i = 0; i < z.count(); ++i)
    if (const double one = stored_number(z, i, about); std::isfinite(one)) valid.push_back(one);
  const pictures::PictureScale scale = pictures::length_scale(valid);
  std::vector<std::uint8_t> pixels;
  pixels.reserve(3 * z.count());
  for (std::size_t i = 0; i < z.count(); ++i) {
    const double one = stored_number(z, i, about);
    const pictures::Rgb color = std::isfinite(one) ? pictures::depth_color(scale.at(one)) : pictures::invalid_color;
    pixels.insert(pixels.end(), {color.red, color.green, color.blue});
  }
  return pictures::png_rgb8(width, height, pixels);
}

/// What a sample's JSON says of the array in a member.
const files::Json* array_of(const files::Json& about, const std::string& member) {
  const files::Json* const arrays = about.find("arrays");
  return arrays != nullptr ? arrays->find(member.substr(0, member.size() - std::string_view(".npy").size())) : nullptr;
}

}  // namespace

void ShownSamples::add(const Record& record, const Record::Sample& sample, std::uint64_t row) {
  const std::uint64_t wanted = std::min(most_spread, rows_);
  if (spread_.size() < wanted && row >= spread_.size() * rows_ / wanted) spread_.push_back({record.shard, sample});
  const Place place{record.shard, sample};
  const auto after =
      std::upper_bound(worst_.begin(), worst_.end(), place, [](const Place& a, const Place& b) { return a.share() < b.share(); });
  if (worst_.size() == most_worst && after == worst_.end()) return;
  worst_.insert(after, place);
  if (worst_.size() > most_worst) worst_.pop_back();
}

std::vector<ShownSample> ShownSamples::spread() const { return read(spread_); }
std::vector<ShownSample> ShownSamples::worst() const { return read(worst_); }

std::vector<ShownSample> ShownSamples::read(const std::vector<Place>& places) const {
  std::vector<ShownSample> out;
  for (const Place& place : places) {
    const std::filesystem::path path = folder_ / tar_name(place.shard);
    ShardTar tar(path);
    if (!tar.is_open()) throw Error(ErrorKind::io, path.native() + ": error: cannot open it");
    ShownSample& one = out.emplace_back();
    one.sample = place.sample.sample, one.view = place.sample.view, one.pixels = place.sample.pixels, one.valid = place.sample.valid;
    for (const char* wanted : {"json", "gt_z_m.npy", "z_m.npy"})
      for (const Record::Member& member : place.sample.members) {
        if (member.name != wanted) continue;
        const std::string bytes = tar.read(member), where = path.native() + ": " + member.name;
        if (member.name == "json")
          one.about = files::parse_json(bytes, where);
        else
          one.png = depth_picture(files::parse_npy(bytes, where), array_of(one.about, member.name));
      }
  }
  return out;
}

}  // namespace tofray::shards
