// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// Animations: what a channel's sampler gives a node.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "base/limits.h"
#include "base/text.h"
#include "gltf/reading.h"

namespace tofray::gltf {
namespace {

constexpr unsigned real_or_normalized = written::real | written::normalized_unsigned | written::normalized_signed;
constexpr Wanted wanted_times{"SCALAR", nullptr, written::real, "SCALAR of floats: seconds"};
constexpr Wanted wanted_vectors{"VEC3", nullptr, written::real, "VEC3 of floats"};
constexpr Wanted wanted_rotations{"VEC4", nullptr, real_or_normalized, "VEC4 of floats or normalized numbers"};
constexpr Wanted wanted_shares{"SCALAR", nullptr, real_or_normalized, "SCALAR of floats or normalized numbers"};

Channel::Interpolation interpolation_of(const Item& sampler) {
  const std::string_view name = sampler.text("interpolation").value_or("LINEAR");
  if (name == "LINEAR") return Channel::Interpolation::linear;
  if (name == "STEP") return Channel::Interpolation::step;
  if (name == "CUBICSPLINE") return Channel::Interpolation::cubic_spline;
  sampler.fail_at("interpolation", "is none", "got " + base::in_quotes(name) + ", expected LINEAR, STEP or CUBICSPLINE");
}

/// Reads the animations of a file.
class AnimationReader {
 public:
  explicit AnimationReader(Reading& reading) : reading_(reading), rising_(reading.accessors.size()), rotations_(reading.accessors.size()) {}

  Animation read(const Item& item) {
    Animation out;
    out.name = item.name();
    const std::vector<Item> samplers = item.objects("samplers");
    std::set<std::pair<int, Channel::Path>> targets;
    for (const Item& one : item.objects("channels")) {
      Channel channel;
      if (!read_target(one.required_object("target"), channel)) continue;
      if (!targets.emplace(channel.node, channel.path).second)
        one.fail("has the target of another channel", fmt::format("both move nodes[{}] in the same way", channel.node));
      const int sampler = one.required_index("sampler", samplers.size(), "samplers of its animation");
      read_sampler(samplers[static_cast<std::size_t>(sampler)], channel);
      const bool first = out.channels.empty();
      out.start_s = first ? channel.times_s->front() : std::min<double>(out.start_s, channel.times_s->front());
      out.end_s = first ? channel.times_s->back() : std::max<double>(out.end_s, channel.times_s->back());
      out.channels.push_back(std::move(channel));
    }
    return out;
  }

 private:
  /// @return false where it is nothing that is read
  bool read_target(const Item& target, Channel& channel) {
    const std::string_view path = target.required_text("path");
    if (path == "pointer") return left_out("channels that animate by KHR_animation_pointer are left out");
    channel.node = target.index("node", reading_.model.nodes.size(), "nodes");
    if (path == "translation")
      channel.path = Channel::Path::translation;
    else if (path == "rotation")
      channel.path = Channel::Path::rotation;
    else if (path == "scale")
      channel.path = Channel::Path::scale;
    else if (path == "weights")
      channel.path = Channel::Path::weights;
    else
      target.fail_at("path", "is none of a node", "got " + base::in_quotes(path) + ", expected translation, rotation, scale or weights");
    if (channel.node == none) return left_out("channels that move no node are left out");
    check_node(target, channel);
    return true;
  }

  bool left_out(const std::string& sentence) {
    reading_.notices.add(sentence);
    return false;
  }

  [[nodiscard]] std::size_t targets_of(const Node& node) const {
    return node.mesh == none ? 0 : reading_.model.meshes[static_cast<std::size_t>(node.mesh)].weights.size();
  }

  void check_node(const Item& target, const Channel& channel) const {
    const Node& node = reading_.model.nodes[static_cast<std::size_t>(channel.node)];
    if (channel.path == Channel::Path::weights && targets_of(node) == 0)
      target.fail_at("node", "has no morph targets", fmt::format("nodes[{}] has no weights to animate", channel.node));
    if (channel.path != Channel::Path::weights && node.matrix)
      target.fail_at("node", "has a matrix", fmt::format("nodes[{}] is animated: expected translation, rotation and scale", channel.node));
  }

  void read_sampler(const Item& item, Channel& channel) {
    channel.interpolation = interpolation_of(item);
    const bool cubic = channel.interpolation == Channel::Interpolation::cubic_spline;
    const int input = item.required_index("input", reading_.accessors.size(), "accessors");
    const int output = item.required_index("output", reading_.accessors.size(), "accessors");
    const std::uint64_t keys = reading_.accessors[input].count;
    count(item, keys);
    if (keys < (cubic ? 2 : 1))
      item.fail_at("input", "has too few keyframes", fmt::format("got {}, expected {} or more", keys, cubic ? 2 : 1));
    const std::size_t targets = targets_of(reading_.model.nodes[static_cast<std::size_t>(channel.node)]);
    const std::uint64_t each = (cubic ? 3 : 1) * (channel.path == Channel::Path::weights ? targets : 1),
                        got = reading_.accessors[output].count;
    if (got != each * keys)  // below 2^48
      item.fail_at("output", "has not the values that its keyframes need",
                   fmt::format("got {} elements, expected {} for each of {} keyframes", got, each, keys));
    channel.times_s = times(item, input);
    read_values(item, output, channel, targets);
  }

  void count(const Item& item, std::uint64_t keys) {
    const auto most = static_cast<std::uint64_t>(base::limit::gltf_keyframes.value);
    if (keys > most - keyframes_)
      item.fail_at("input", "has too many keyframes",
                   fmt::format("got {}; all channels may have {} (`tofray --limits`), of which {} are left", keys, most, most - keyframes_),
                   ErrorKind::limit);
    keyframes_ += keys;
  }

  /// Many samplers may share an accessor: what is known of one is looked at once.
  Floats times(const Item& item, int input) {
    Floats all = reading_.accessors.finite_floats(input, wanted_times, item);
    if (rising_[static_cast<std::size_t>(input)]) return all;
    const auto fault = std::adjacent_find(all->begin(), all->end(), [](float a, float b) { return !(a < b); });
    if (fault != all->end())
      reading_.accessors[input].item.fail("has keyframes whose times do not rise",
                                          fmt::format("got {} behind {} as number {}", fault[1], fault[0], fault - all->begin() + 1));
    rising_[static_cast<std::size_t>(input)] = true;
    return all;
  }

  void read_values(const Item& item, int output, Channel& channel, std::size_t targets) {
    Accessors& accessors = reading_.accessors;
    switch (channel.path) {
      case Channel::Path::translation:
      case Channel::Path::scale: channel.values = accessors.finite_floats(output, wanted_vectors, item); return;
      case Channel::Path::weights:
        channel.width = targets;
        channel.values = accessors.finite_floats(output, wanted_shares, item);
        return;
      case Channel::Path::rotation:
        channel.width = 4;
        channel.values = accessors.finite_floats(output, wanted_rotations, item);
        check_rotations(item, output, channel);
    }
  }

  /// No quaternion at a keyframe may be zero. (Tangents may.)
  void check_rotations(const Item& item, int output, const Channel& channel) {
    const bool cubic = channel.interpolation == Channel::Interpolation::cubic_spline;
    std::uint8_t& known = rotations_[static_cast<std::size_t>(output)];
    const auto bit = static_cast<std::uint8_t>(cubic ? 2 : 1);
    if ((known & bit) != 0) return;
    known = static_cast<std::uint8_t>(known | bit);
    const std::vector<float>& all = *channel.values;
    const std::size_t step = cubic ? 12 : 4;
    for (std::size_t i = cubic ? 4 : 0; i < all.size(); i += step) {
      const double size = length({all[i], all[i + 1], all[i + 2], all[i + 3]});
      if (!(size > 1e-6 && size < 1e6))
        item.fail_at("output", "has no rotation at a keyframe",
                     fmt::format("got a quaternion of length {} at number {}", base::number_text(size), i / step));
    }
  }

  Reading& reading_;
  std::vector<bool> rising_;
  std::vector<std::uint8_t> rotations_;
  std::uint64_t keyframes_ = 0;
};

}  // namespace

void read_animations(Reading& reading) {
  AnimationReader reader(reading);
  for (const Item& item : reading.root.objects("animations")) reading.model.animations.push_back(reader.read(item));
}

}  // namespace tofray::gltf
