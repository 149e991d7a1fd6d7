// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "tofray/messages.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/text.h"
#include "camera/readout/image_camera.h"
#include "files/json.h"
#include "messages/parts.h"
#include "tofray/error.h"
#include "tofray/flags.h"
#include "tofray/simulator.h"

namespace tofray {

namespace {

using messages::Content;
using messages::Header;
using messages::Plan;
using messages::Size;

[[noreturn]] void refuse_option(const std::string& what, const std::string& expected) {
  throw Error(ErrorKind::bad_input, fmt::format("error: {}\n  expected {}", what, expected));
}

/// The least power of two at which an amplitude of the largest codes that there are fits into 16 bits: A is at most √2 times the largest |A−B|.
double natural_step_e(const camera::ImageCamera& camera) {
  const double codes = std::max(camera.adc.mid_code, std::ldexp(1, camera.adc.bits) - 1 - camera.adc.mid_code);
  const double most_e = std::sqrt(2) * codes * camera.adc.step_e_per_dn / camera.mode.gain;
  double step = 1;
  while (step * 65535 < most_e) step *= 2;
  while (0.5 * step * 65535 >= most_e && step > 1e-9) step *= 0.5;
  return step;
}

bool is_name(const std::string& name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) { return letter(c) || c == '_' || (c >= '0' && c <= '9'); });
}

/// Checked, and nothing left open.
MessageOptions completed(MessageOptions options, const camera::ImageCamera& camera) {
  const messages::Profile& profile = messages::profile_of(options.driver);
  if (options.name.empty())
    options.name = profile.name;
  else if (!is_name(options.name) || options.name.size() > 100)
    refuse_option(fmt::format("a camera cannot have the name {} in topics", base::in_quotes(options.name)),
                  "letters, digits and _, a letter first, as in left_camera");
  if (options.topics.empty()) options.topics = messages::usual_groups(options.driver);
  for (const std::string& group : options.topics)
    if (const auto& all = messages::topic_groups(); std::find(all.begin(), all.end(), group) == all.end())
      refuse_option(fmt::format("there are no topics {}{}", base::in_quotes(group), base::did_you_mean(group, all)), base::listed(all));
  if (options.depth_encoding.empty()) options.depth_encoding = profile.depth_encoding;
  if (options.depth_encoding != "32FC1" && options.depth_encoding != "16UC1")
    refuse_option(fmt::format("depth cannot be encoded as {}", base::in_quotes(options.depth_encoding)),
                  "32FC1 (metres, NaN where invalid) or 16UC1 (millimetres, 0 where invalid)");
  if (options.amplitude_step_e == 0) options.amplitude_step_e = natural_step_e(camera);
  if (!(options.amplitude_step_e >= 1e-9 && options.amplitude_step_e <= 1e9))
    refuse_option(fmt::format("the amplitude's step cannot be {} electrons", base::number_text(options.amplitude_step_e)), "1e-9 to 1e9");
  if (!(options.epoch_s >= 0 && options.epoch_s <= 2e9))
    refuse_option(fmt::format("the epoch cannot be {} s", base::number_text(options.epoch_s)),
                  "seconds since 1970 of the simulation's time 0: 0 to 2e9");
  return options;
}

/// When a frame is looked at [s], in simulated time.
struct Times {
  double start = 0, stamp = 0, end = 0;
};

Times times_of(const Frame& frame, StampAt at) {
  const Raw& raw = frame.raw;
  if (raw.start_time_s.empty() || raw.start_time_s.size() != raw.integration_time_s.size())
    refuse_option("a frame without start_time_s and integration_time_s has no stamp", "both, one number for each raw frame");
  Times out;
  out.start = raw.start_time_s.front();
  out.end = raw.start_time_s.back() + raw.integration_time_s.back();
  out.stamp = at == StampAt::start ? out.start : at == StampAt::end ? out.end : 0.5 * (out.start + out.end);
  return out;
}

}  // namespace

struct Messages::Impl {
  Scene scene;
  camera::ImageCamera camera;
  MessageOptions options;
  std::vector<Plan> plans;
  std::vector<Topic> topics;
  std::vector<std::string> frames;  ///< of coordinates: … link, optical
  std::vector<std::int32_t> nearest;
  Lens pinhole;
  std::vector<std::string> raw_topics;

  Impl(const Scene& of, const Camera& by, const MessageOptions& wanted) : scene(of), camera(by), options(completed(wanted, camera)) {
    const auto phases = static_cast<int>(camera.mode.sequence.size());
    for (const char* frame : messages::profile_of(options.driver).frames) frames.push_back(fmt::format(fmt::runtime(frame), options.name));
    plans = messages::plan_of(options, phases);
    bool rectified = false;
    for (const Plan& plan : plans) {
      topics.push_back(plan.topic);
      rectified = rectified || plan.content == Content::rect_depth || plan.content == Content::rect_amplitude8;
      if (plan.content == Content::raw) raw_topics.push_back(plan.topic.name);
    }
    pinhole = messages::pinhole_of(camera.lens);
    if (rectified) nearest = messages::nearest_pixels(camera.lens, size());
  }

  [[nodiscard]] Size size() const { return {camera.sensor.width, camera.sensor.height}; }
  [[nodiscard]] std::int64_t stamp_of(double time_s) const {
    const double ns = std::floor(1e9 * (time_s + options.epoch_s) + 0.5);
    if (!(ns >= 0 && ns < 2147483648e9))
      refuse_option(fmt::format("the time {} s fits into no stamp", base::number_text(time_s + options.epoch_s)),
                    "0 to 2147483647 s; the epoch is added to times before the simulation's 0");
    return static_cast<std::int64_t>(ns);
  }
  /// @throws Error where the array has another size than the image
  template <class Array>
  const Array& checked(const Array& array, const char* name, std::size_t each = 1) const {
    if (array.size() != each * size().pixels())
      refuse_option(fmt::format("the frame's {} has {} values", name, array.size()),
                    fmt::format("{}: {} x {} pixels{}", each * size().pixels(), size().width, size().height,
                                array.empty() ? "; the simulator was asked for other arrays" : ""));
    return array;
  }
  template <class T>
  [[nodiscard]] std::vector<T> rectified(const std::vector<T>& image, T nothing) const {
    std::vector<T> out;
    out.reserve(nearest.size());
    for (const std::int32_t from : nearest) out.push_back(from < 0 ? nothing : image[static_cast<std::size_t>(from)]);
    return out;
  }
  [[nodiscard]] std::vector<messages::NamedStand> static_stands() const {
    std::vector<messages::NamedStand> all;
    for (std::size_t i = 1; i < frames.size(); ++i)
      all.push_back({frames[i - 1], frames[i], i + 1 == frames.size() ? messages::optical_in_link() : messages::Stand{}});
    return all;
  }
  /// Whether a second of simulated time has passed since the frame before.
  [[nodiscard]] bool diagnosed(const Frame& frame, double start_s) const {
    const double rate = camera.mode.frame_rate_hz;
    return frame.index == 0 || !(rate > 1) || std::floor(start_s + 1e-9) != std::floor(start_s + 1e-9 - 1 / rate);
  }
  void put_raw(std::string& out, const Header& header, const Raw& raw, int phase) const;
  void put_raw_meta(std::string& out, const Frame& frame) const;
  void put_diagnostics(std::string& out, const Header& header, const Frame& frame) const;
  void put(const Plan& plan, const Frame& frame, const Scene& seen, const Times& times, const Header& header, std::string& out) const;
};

void Messages::Impl::put_raw(std::string& out, const Header& header, const Raw& raw, int phase) const {
  checked(raw.raw, "raw", raw_topics.size());
  messages::put_plain(out, header, size(), raw.raw.data() + static_cast<std::size_t>(phase) * size().pixels(), "mono16");
}

void Messages::Impl::put_raw_meta(std::string& out, const Frame& frame) const {
  const Raw& raw = frame.raw;
  files::Json lit = files::Json::array();
  for (const std::uint8_t one : raw.lit) lit.push(one != 0);
  const files::Json meta = files::Json::object()
                               .set("frame", frame.index)
                               .set("topics", files::Json::list(raw_topics))
                               .set("modulation_frequency_hz", files::Json::list(raw.modulation_frequency_hz))
                               .set("reference_phase_rad", files::Json::list(raw.reference_phase_rad))
                               .set("integration_time_s", files::Json::list(raw.integration_time_s))
                               .set("start_time_s", files::Json::list(raw.start_time_s))
                               .set("lit", std::move(lit));
  messages::Cdr(out).text(files::json_text(meta));
}

void Messages::Impl::put_diagnostics(std::string& out, const Header& header, const Frame& frame) const {
  constexpr double few = 0.1;
  const auto& flags = checked(frame.depth.flags, "flags");
  const auto all = static_cast<double>(flags.size());
  const auto share = [&](unsigned bits, bool set) {
    const auto count = std::count_if(flags.begin(), flags.end(), [&](unsigned one) { return ((one & bits) != 0) == set; });
    return static_cast<double>(count) / all;
  };
  const double valid = share(flags_invalid, false);
  std::vector<std::pair<std::string, std::string>> values = {{"frame", std::to_string(frame.index)},
                                                             {"frame_rate_hz", base::number_text(camera.mode.frame_rate_hz)},
                                                             {"temperature_celsius", base::number_text(camera.temperature.celsius)},
                                                             {"valid_share", fmt::format("{:.4f}", valid)}};
#define TOFRAY_SHARE(name, bit, ...) values.emplace_back(#name "_share", fmt::format("{:.4f}", share(bit, true)));
  TOFRAY_FLAGS(TOFRAY_SHARE)
#undef TOFRAY_SHARE
  messages::Cdr cdr(out);
  messages::put_header(cdr, header).count(1);
  const std::uint8_t level = valid < few ? 1 : 0;  // OK, WARN
  cdr.put(level).text((options.name.empty() ? "camera" : options.name) + ": depth");
  cdr.text(level == 0 ? fmt::format("{:.1f} % of the pixels have a depth", 100 * valid)
                      : fmt::format("only {:.1f} % of the pixels have a depth", 100 * valid));
  cdr.text(fmt::format("tofray {} {}", camera.name, camera.mode.name)).count(values.size());
  for (const auto& [key, value] : values) cdr.text(key).text(value);
}

void Messages::Impl::put(const Plan& plan, const Frame& frame, const Scene& seen, const Times& times, const Header& header,
                         std::string& out) const {
  const Depth& depth = frame.depth;
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const bool millimetres = options.depth_encoding == "16UC1", rational = options.driver == Driver::k4a;
  const double step = options.amplitude_step_e;
  switch (plan.content) {
    case Content::depth: return messages::put_depth(out, header, size(), checked(depth.z_m, "z_m"), millimetres);
    case Content::radial: return messages::put_depth(out, header, size(), checked(depth.range_m, "range_m"), millimetres);
    case Content::amplitude16:
    case Content::amplitude8:
      return messages::put_amplitude(out, header, size(), checked(depth.amplitude_e, "amplitude_e"), step,
                                     plan.content == Content::amplitude8);
    case Content::noise: return messages::put_plain(out, header, size(), checked(depth.noise_m, "noise_m").data(), "32FC1");
    case Content::confidence: return messages::put_plain(out, header, size(), checked(depth.confidence, "confidence").data(), "mono8");
    case Content::info: return messages::put_camera_info(out, header, size(), camera.lens, rational);
    case Content::rect_info: return messages::put_camera_info(out, header, size(), pinhole, rational);
    case Content::rect_depth: return messages::put_depth(out, header, size(), rectified(checked(depth.z_m, "z_m"), nan), millimetres);
    case Content::rect_amplitude8:
      return messages::put_amplitude(out, header, size(), rectified(checked(depth.amplitude_e, "amplitude_e"), nan), step, true);
    case Content::points: {
      const messages::Profile& profile = messages::profile_of(options.driver);
      checked(depth.points_m, "points_m", 3), checked(depth.amplitude_e, "amplitude_e"), checked(depth.noise_m, "noise_m");
      checked(depth.flags, "flags"), checked(depth.confidence, "confidence");
      return messages::put_cloud(out, header, depth, {profile.fields, profile.point_step, step, options.unorganized});
    }
    case Content::raw: return put_raw(out, header, frame.raw, plan.phase);
    case Content::raw_meta: return put_raw_meta(out, frame);
    case Content::truth_z: return messages::put_plain(out, header, size(), checked(frame.truth.z_m, "gt_z_m").data(), "32FC1");
    case Content::truth_object:
      return messages::put_plain(out, header, size(), checked(frame.truth.object_id, "gt_object_id").data(), "32SC1");
    case Content::tf:
      return messages::put_transforms(out, header.stamp_ns,
                                      {{"map", frames[0], messages::link_on_map(camera_pose(seen, times.stamp), seen.world_up)}});
    case Content::diagnostics: return put_diagnostics(out, header, frame);
    case Content::clock: {
      messages::Cdr cdr(out);
      messages::put_time(cdr, stamp_of(times.end + camera.readout_time_s));
      return;
    }
    case Content::tf_static: return;
  }
}

Messages::Messages(const Scene& scene, const Camera& camera, const MessageOptions& options) {
  (void)image_size(camera);  // complains of a camera that cannot be
  impl_ = std::make_unique<const Impl>(scene, camera, options);
}
Messages::~Messages() = default;
Messages::Messages(Messages&&) noexcept = default;
Messages& Messages::operator=(Messages&&) noexcept = default;

const std::vector<Topic>& Messages::topics() const { return impl_->topics; }
const MessageOptions& Messages::options() const { return impl_->options; }

std::vector<std::string> Messages::arrays() const {
  std::vector<std::string> out;
  const auto add = [&](std::initializer_list<const char*> names) {
    for (const char* name : names)
      if (std::find(out.begin(), out.end(), name) == out.end()) out.emplace_back(name);
  };
  for (const Plan& plan : impl_->plans) switch (plan.content) {
      case Content::depth:
      case Content::rect_depth: add({"z_m"}); break;
      case Content::radial: add({"range_m"}); break;
      case Content::amplitude16:
      case Content::amplitude8:
      case Content::rect_amplitude8: add({"amplitude_e"}); break;
      case Content::noise: add({"noise_m"}); break;
      case Content::confidence: add({"confidence"}); break;
      case Content::points: add({"points_m", "z_m", "amplitude_e", "noise_m", "flags", "confidence"}); break;
      case Content::raw: add({"raw"}); break;
      case Content::truth_z: add({"gt_z_m"}); break;
      case Content::truth_object: add({"gt_object_id"}); break;
      case Content::diagnostics: add({"flags"}); break;
      default: break;
    }
  return out;
}

std::vector<Message> Messages::before(const Frame& first) const {
  const std::int64_t start = impl_->stamp_of(times_of(first, StampAt::start).start);
  std::vector<Message> out;
  for (std::size_t i = 0; i < impl_->plans.size(); ++i) {
    if (impl_->plans[i].content != Content::tf_static) continue;
    Message& one = out.emplace_back(Message{i, start, start, {}});
    messages::put_transforms(one.data, start, impl_->static_stands());
  }
  return out;
}

std::vector<Message> Messages::of(const Frame& frame) const { return of(frame, impl_->scene); }

std::vector<Message> Messages::of(const Frame& frame, const Scene& seen) const {
  std::vector<Message> out;
  of(frame, seen, out);
  return out;
}

void Messages::of(const Frame& frame, const Scene& seen, std::vector<Message>& into) const {
  const auto of_other_size = [&](int width, int height) {
    return width != 0 && (width != impl_->size().width || height != impl_->size().height);
  };
  if (of_other_size(frame.raw.width, frame.raw.height) || of_other_size(frame.depth.width, frame.depth.height))
    refuse_option(fmt::format("the frame has {} x {} pixels", frame.depth.width, frame.depth.height),
                  fmt::format("{} x {}, as the camera delivers", impl_->size().width, impl_->size().height));
  const Times times = times_of(frame, impl_->options.stamp);
  const std::int64_t stamp = impl_->stamp_of(times.stamp), publish = impl_->stamp_of(times.end + impl_->camera.readout_time_s);
  const Header header{stamp, impl_->frames.back()};
  std::size_t count = 0;
  for (std::size_t i = 0; i < impl_->plans.size(); ++i) {
    const Plan& plan = impl_->plans[i];
    if (plan.content == Content::tf_static || (plan.content == Content::diagnostics && !impl_->diagnosed(frame, times.start))) continue;
    if (count == into.size()) into.emplace_back();
    Message& one = into[count++];
    one.topic = i, one.stamp_ns = stamp, one.publish_ns = publish;
    impl_->put(plan, frame, seen, times, header, one.data);
  }
  into.resize(count);
}

}  // namespace tofray
