// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/pixel_answer.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/constants.h"
#include "commands/pixel_report.h"
#include "pictures/pictures.h"
#include "results/meta.h"
#include "run/file_pixel.h"
#include "tofray/error.h"
#include "view/wire.h"

namespace tofray::view {

namespace {

using files::Json;

/// The chain's stages, each a list of numbers with names.
class Flow {
 public:
  Flow& stage(const char* name) {
    close();
    name_ = name;
    return *this;
  }
  Flow& add(const char* name, double value, const char* unit) {
    values_.push(Json::object().set("name", name).set("value", value).set("unit", unit));
    return *this;
  }
  /// By raw frame.
  Flow& add(const char* name, const PixelChain& chain, double ChainRawFrame::*member, const char* unit) {
    std::vector<double> list;
    for (const ChainRawFrame& k : chain.raw_frames) list.push_back(k.*member);
    if (!list.empty()) values_.push(Json::object().set("name", name).set("value", Json::list(list)).set("unit", unit));
    return *this;
  }
  Flow& add(const char* name, double value, const char* unit, std::size_t phase) {
    values_.push(Json::object().set("name", name).set("value", value).set("unit", unit).set("phase", static_cast<std::uint64_t>(phase)));
    return *this;
  }
  Json list() {
    close();
    return std::move(stages_);
  }

 private:
  void close() {
    if (name_ != nullptr) stages_.push(Json::object().set("stage", name_).set("values", std::exchange(values_, Json::array())));
    name_ = nullptr;
  }
  const char* name_ = nullptr;
  Json values_ = Json::array(), stages_ = Json::array();
};

double in_phase(const ChainPhase& phase) { return phase.amplitude_e * std::cos(base::two_pi * phase.measured_turns); }
double quadrature(const ChainPhase& phase) { return phase.amplitude_e * std::sin(base::two_pi * phase.measured_turns); }

Json flow_json(const PixelChain& chain, const Camera& camera) {
  Flow flow;
  flow.stage("light").add("object", static_cast<double>(chain.object), "1").add("reflectivity", chain.reflectivity, "1");
  flow.add("true_range", chain.true_range_m, "m").add("incidence", chain.incidence_rad, "rad");
  flow.add("irradiance", chain.irradiance_w_m2, "W/m2")
      .add("radiance", chain.radiance_w_m2_sr, "W/(m2 sr)")
      .add("power", chain.power_w, "W");
  flow.stage("electrons").add("signal", chain, &ChainRawFrame::signal_e, "e");
  flow.add("direct", chain, &ChainRawFrame::direct_e, "e").add("indirect", chain, &ChainRawFrame::indirect_e, "e");
  flow.stage("taps").add("tap_a", chain, &ChainRawFrame::tap_a_e, "e").add("tap_b", chain, &ChainRawFrame::tap_b_e, "e");
  flow.stage("adc").add("code", chain, &ChainRawFrame::code_dn, "DN").add("difference", chain, &ChainRawFrame::difference_e, "e");
  flow.stage("correlation");
  for (std::size_t k = 0; k < chain.phases.size(); ++k) {
    const ChainPhase& phase = chain.phases[k];
    flow.add("i", in_phase(phase), "e", k).add("q", quadrature(phase), "e", k).add("amplitude", phase.amplitude_e, "e", k);
  }
  flow.stage("phase");
  for (std::size_t k = 0; k < chain.phases.size(); ++k)
    flow.add("measured", chain.phases[k].measured_turns, "turns", k).add("calibrated", chain.phases[k].calibrated_turns, "turns", k);
  flow.stage("unwrapping");
  for (std::size_t k = 0; k < chain.phases.size(); ++k) {
    const ChainPhase& phase = chain.phases[k];
    flow.add("half_wave", phase.half_wave_m, "m", k).add("cycles", phase.cycles, "1", k).add("half_path", phase.half_path_m, "m", k);
  }
  flow.stage("range").add("range", chain.range_m, "m").add("noise", chain.noise_m, "m");
  const Decoding& decoding = camera.decoding;
  if (decoding.temporal_frames > 1 || decoding.filter.kind != ImageFilter::Kind::none) {
    flow.stage("filter");
    if (decoding.temporal_frames > 1) flow.add("temporal_frames", decoding.temporal_frames, "1");
    using Kind = ImageFilter::Kind;
    const Kind kind = decoding.filter.kind;
    if (kind == Kind::gaussian || kind == Kind::bilateral) flow.add("sigma", decoding.filter.sigma_px, "px");
    if (kind == Kind::median || kind == Kind::adaptive) flow.add("radius", decoding.filter.radius_px, "px");
  }
  flow.stage("z").add("z", chain.point_m[2], "m").add("x", chain.point_m[0], "m").add("y", chain.point_m[1], "m");
  return flow.list();
}

/// The raw frames of one of the chain's phases.
std::vector<std::size_t> samples_of(const PixelChain& chain, std::size_t phase) {
  std::vector<std::size_t> out;
  for (std::size_t k = 0; k < chain.raw_frames.size(); ++k)
    if (chain.raw_frames[k].lit && chain.raw_frames[k].modulation_frequency_hz == chain.phases[phase].modulation_frequency_hz)
      out.push_back(k);
  return out;
}

Json phasors_json(const PixelChain& chain, const PixelChain& expected) {
  Json list = Json::array();
  for (std::size_t i = 0; i < chain.phases.size(); ++i) {
    const ChainPhase& phase = chain.phases[i];
    Json json = Json::object();
    json.set("frequency_hz", phase.modulation_frequency_hz).set("unit", "e").set("i", in_phase(phase)).set("q", quadrature(phase));
    // Reference phases are equally spaced, of all cameras that there can be: the noise of Z is round.
    json.set("sigma_i", phase.noise_e).set("sigma_q", phase.noise_e).set("covariance", 0);
    json.set("amplitude", phase.amplitude_e).set("phase_rad", base::two_pi * phase.measured_turns);
    const bool known = i < expected.phases.size();
    json.set("truth_i", known ? in_phase(expected.phases[i]) : std::nan(""));
    list.push(std::move(json.set("truth_q", known ? quadrature(expected.phases[i]) : std::nan(""))));
  }
  return list;
}

/// @param through  what the curves go through: the pixel as it is expected, or as it was measured
Json curves_json(const PixelChain& chain, const PixelChain& through, const Camera& camera) {
  const std::vector<std::vector<double>> curves = correlation_curves(through, camera);
  Json list = Json::array();
  for (std::size_t i = 0; i < curves.size() && i < chain.phases.size(); ++i) {
    Json samples = Json::array();
    for (const std::size_t k : samples_of(chain, i))
      samples.push(Json::list(std::array{chain.raw_frames[k].reference_phase_rad, chain.raw_frames[k].difference_e}));
    Json json = Json::object();
    json.set("frequency_hz", chain.phases[i].modulation_frequency_hz).set("unit", "e").set("points", Json::list(curves[i]));
    list.push(std::move(json.set("samples", std::move(samples))));
  }
  return list;
}

Json values_json(const Frame& frame, std::size_t pixel) {
  Json values = Json::array();
  for (std::uint16_t i = 0; i < wire_arrays().size(); ++i) {
    const std::vector<double> numbers = pixel_values(frame, i, pixel);
    if (numbers.empty()) continue;
    const WireArray& array = wire_arrays()[i];
    Json value = array.shape == ArrayShape::image ? Json(numbers[0]) : Json::list(numbers);
    values.push(Json::object().set("name", array.name).set("unit", array.unit).set("value", std::move(value)));
  }
  return values;
}

}  // namespace

void put_pixel(Json& json, const Frame& frame, const Camera* camera, const std::string& name, int u, int v) {
  const int width = std::max({frame.raw.width, frame.depth.width, frame.truth.width});
  const int height = std::max({frame.raw.height, frame.depth.height, frame.truth.height});
  if (u < 0 || v < 0 || u >= width || v >= height)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: pixel {},{} is outside the image\n  expected columns of 0 to {} and rows of 0 to {}", u, v, width - 1,
                            height - 1));
  const std::size_t pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(width) + static_cast<std::size_t>(u);
  const pictures::FlagRow* const reason = frame.depth.flags.empty() ? nullptr : pictures::invalid_reason(frame.depth.flags[pixel]);
  json.set("values", values_json(frame, pixel)).set("why", reason == nullptr ? "" : reason->words);
  if (camera == nullptr) return void(json.set("report", Json::object()));
  const PixelChain chain = pixel_chain(frame, *camera, u, v, Noise::exact);
  json.set("report", app::pixel_json(name, {}, chain, {})).set("flow", flow_json(chain, *camera));
  json.set("phasors", phasors_json(chain, {})).set("curve", curves_json(chain, chain, *camera));
}

void put_pixel(Json& json, const PixelInState& in, int u, int v) {
  const Frame& frame = in.frame;
  const PixelArrays arrays = pixel_arrays(frame);
  const PixelChain chain = pixel_chain(frame, in.camera, u, v, in.simulated.noise);
  const PixelChain expected = pixel_chain(in.expected, in.camera, u, v, Noise::off);
  const PixelBounces bounces =
      has_bounces(arrays, u, v) ? pixel_bounces(arrays, frame.index, in.scene, in.camera, in.simulated, u, v) : PixelBounces();
  const Json meta = files::parse_json(results::frame_meta(in.scene, in.camera, in.simulated, frame.index), "meta");
  const std::size_t pixel = static_cast<std::size_t>(v) * static_cast<std::size_t>(arrays.width) + static_cast<std::size_t>(u);
  const pictures::FlagRow* const reason = pictures::invalid_reason(frame.depth.flags[pixel]);
  json.set("report", app::pixel_json(in.name, meta, chain, bounces));
  json.set("values", values_json(frame, pixel)).set("why", reason == nullptr ? "" : reason->words);
  json.set("flow", flow_json(chain, in.camera)).set("phasors", phasors_json(chain, expected));
  json.set("curve", curves_json(chain, in.scene.transport.bounces > 0 ? chain : expected, in.camera));
}

}  // namespace tofray::view
