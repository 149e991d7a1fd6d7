// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "base/constants.h"
#include "base/limits.h"
#include "base/text.h"
#include "base/units.h"
#include "load/camera_modes.h"

namespace tofray::load {

using yaml::Value;

namespace {

using base::pi;

// Largest deviation from equally spaced reference phases [rad]; what is left of 0, 1/3, 2/3 of a turn in decimals of a degree.
constexpr double spacing_tolerance = 1e-4;

// Whether the reference phases are 2π/N apart, in any order and from any start.
bool equally_spaced(std::vector<double> phases) {
  const double turn = 2 * pi, step = turn / static_cast<double>(phases.size());
  for (double& phase : phases) phase -= turn * std::floor(phase / turn);
  std::sort(phases.begin(), phases.end());
  for (std::size_t i = 0; i < phases.size(); ++i) {
    const double next = i + 1 < phases.size() ? phases[i + 1] : phases[0] + turn;
    if (!(std::abs(next - phases[i] - step) <= spacing_tolerance)) return false;
  }
  return true;
}

std::string milliseconds(double seconds) { return base::number_text(std::round(seconds * 1e9) / 1e6) + " ms"; }

// A list of reference phases, or of delays, makes one raw frame of each.
void add_raw_frames(const Value& entry, const RawFrame& raw, std::vector<RawFrame>& sequence, base::Faults& faults) {
  const Value &phase = entry["reference_phase"], &delay = entry["reference_delay"];
  if (raw.lit && !entry["modulation_frequency"])
    faults.add(entry.place(), "a lit raw frame lacks modulation_frequency", "expected modulation_frequency, or lit: false");
  if (raw.lit && !phase && !delay)
    faults.add(entry.place(), "a lit raw frame lacks reference_phase", "expected reference_phase, or reference_delay, or lit: false");
  // (`meta` has both, one of which is 0.)
  const bool either = phase.either == 0 && delay.either == 0 && (raw.reference_phase_rad == 0 || raw.reference_delay_s == 0);
  if (phase && delay && !either)
    faults.add(delay.place(), "a raw frame has reference_phase and reference_delay", "expected one of them, or 0 for the other");
  for (const char* key : {"modulation_frequency", "reference_phase", "reference_delay"}) {
    if (!raw.lit && entry[key])
      faults.add(entry[key].place(), std::string("an unlit raw frame has no ") + key, "take it out, or lit: false");
  }
  const bool late = static_cast<bool>(delay);
  const Value& given = late ? delay : phase;
  if (given.either == 0) sequence.push_back(raw);
  for (const auto& one : given.items) {
    sequence.push_back(raw);
    (late ? sequence.back().reference_delay_s : sequence.back().reference_phase_rad) = one.number;
  }
}

void check_phases(const Value& sequence, const Mode& mode, base::Faults& faults) {
  std::map<double, std::vector<const RawFrame*>> lit;
  for (const auto& raw : mode.sequence)
    if (raw.lit) lit[raw.modulation_frequency_hz].push_back(&raw);
  for (const auto& [hz, frames] : lit) {
    const std::string at = " at " + base::quantity_text(hz, "1 MHz");
    std::vector<double> phases;
    for (const auto* raw : frames) phases.push_back(raw->reference_phase_rad + 2 * pi * hz * raw->reference_delay_s);
    if (phases.size() < 3)
      faults.add(sequence.place(), "too few reference phases" + at,
                 "got " + std::to_string(phases.size()) + ", expected three or more, equally spaced over 360 deg");
    else if (!equally_spaced(phases))
      faults.add(sequence.place(), "the reference phases" + at + " are not equally spaced",
                 "expected " + std::to_string(phases.size()) + " of them, 360/" + std::to_string(phases.size()) + " deg apart, each once");
    for (const auto* raw : frames)
      if (raw->integration_time_s != frames[0]->integration_time_s) {
        faults.add(sequence.place(), "the raw frames" + at + " differ in integration_time",
                   "expected one integration_time for each modulation frequency");
        break;
      }
  }
}

Mode read_mode(const Value& value, const std::string& name, base::Faults& faults) {
  Mode out;
  out.name = name;
  if (!value.good) return out;
  Filler("", faults).fill(value, out);
  const std::vector<RawFrame> entries = std::move(out.sequence);
  out.sequence.clear();
  for (std::size_t i = 0; i < entries.size(); ++i) add_raw_frames(value["sequence"].items[i], entries[i], out.sequence, faults);
  if (static_cast<long long>(out.sequence.size()) > base::limit::raw_frames.value)
    faults.add(value["sequence"].place(), "the sequence has too many raw frames",
               "got " + std::to_string(out.sequence.size()) + ", at most " + std::to_string(base::limit::raw_frames.value),
               ErrorKind::limit);
  else
    check_phases(value["sequence"], out, faults);
  return out;
}

}  // namespace

Modes::Modes(const Value& root, base::Faults& faults) : root_(root), faults_(faults), wanted_(find_wanted()) {
  const Value& all = root["modes"];
  for (std::size_t i = 0; i < all.names.size(); ++i) {
    const std::size_t before = faults.size();
    Mode mode = read_mode(all.items[i], all.names[i], faults);
    modes_.push_back({std::move(mode), faults.size() == before && all.items[i].good});
  }
}

std::size_t Modes::find_wanted() const {
  const Value &all = root_["modes"], &wanted = root_["mode"];
  if (!wanted || all.names.empty()) return 0;
  const auto found = std::find(all.names.begin(), all.names.end(), wanted.text);
  if (found != all.names.end()) return static_cast<std::size_t>(found - all.names.begin());
  faults_.add(wanted.place(), "no mode " + base::in_quotes(wanted.text) + base::did_you_mean(wanted.text, all.names),
              "modes of this camera: " + base::listed(all.names, "and") + "; --mode or camera.mode chooses one");
  return 0;
}

void Modes::choose(std::size_t which, Camera& camera, Filler& filler) const {
  const Value& all = root_["modes"];
  if (modes_.empty()) return;
  camera.mode_names = all.names;
  // That of the profile first: another mode may have been chosen before.
  const auto fill = [&](const char* key, auto& record) {
    record = {};
    filler.fill(root_[key], record);
    filler.fill(all.items[which][key], record);
  };
  fill("decoding", camera.decoding), fill("readout", camera.readout), fill("auto_exposure", camera.auto_exposure);
  camera.mode = modes_[which].mode;
  filler.remember(all.items[which], camera.mode);
  if (modes_[which].good) check_time(all.items[which], camera);
  // After the check's place was found: the override counts, not what the mode says.
  if (faults_.empty()) check_edges(camera);
}

void Modes::check_time(const Value& chosen, Camera& camera) const {
  const Value& sequence = chosen["sequence"];
  const Value& override_time = root_["integration_time"];
  auto& raw_frames = camera.mode.sequence;
  if (override_time && override_time.good)
    for (auto& raw : raw_frames)
      if (raw.lit) raw.integration_time_s = override_time.number;
  const Value& override_rate = root_["frame_rate"];
  if (override_rate && override_rate.good) camera.mode.frame_rate_hz = override_rate.number;
  const base::Place& place = override_rate ? override_rate.place() : override_time ? override_time.place() : sequence.place();
  double total = 0;
  for (const auto& raw : raw_frames) total += raw.integration_time_s + camera.readout_time_s;
  const double frame = 1 / camera.mode.frame_rate_hz;
  if (!(total <= frame * (1 + 1e-9)))
    faults_.add(place, "the sequence does not fit into a frame",
                "got " + std::to_string(raw_frames.size()) + " raw frames of " + milliseconds(total) + " together, readout included; at " +
                    base::quantity_text(camera.mode.frame_rate_hz, "1 Hz") + " a frame has " + milliseconds(frame) +
                    "\nlower integration_time or frame_rate (--fps)");
  for (const auto& raw : raw_frames)
    if (raw.integration_time_s < camera.min_integration_time_s) {
      faults_.add(place, "integration_time is below the camera's shortest",
                  "got " + base::quantity_text(raw.integration_time_s, "1 us") + ", expected at least " +
                      base::quantity_text(camera.min_integration_time_s, "1 us") + " (timing.min_integration_time)");
      break;
    }
}

// A linear edge may not be longer than the pulse or the pause that it leads to.
void Modes::check_edges(const Camera& camera) const {
  double highest = 0;
  for (const auto& raw : camera.mode.sequence) highest = std::max(highest, raw.modulation_frequency_hz);
  for (std::size_t i = 0; i < camera.illumination.size(); ++i) {
    const Waveform& waveform = camera.illumination[i].waveform;
    if (waveform.kind != Waveform::Kind::rectangular) continue;
    const double room = std::min(waveform.duty, 1 - waveform.duty) / highest;
    if (waveform.rise_time_s > room)
      faults_.add(root_["illumination"].items[i]["waveform"].place_of("rise_time"), "the pulse's edges are longer than the pulse",
                  "got rise_time " + base::quantity_text(waveform.rise_time_s, "1 ns") + ", at most " + base::quantity_text(room, "1 ns") +
                      " at " + base::quantity_text(highest, "1 MHz") + " and this duty");
  }
}

}  // namespace tofray::load
