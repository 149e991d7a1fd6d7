// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "base/constants.h"
#include "base/limits.h"
#include "base/text.h"
#include "base/units.h"
#include "io/camera_modes.h"

namespace tofray::io {

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

class ModeReader {
 public:
  ModeReader(const Value& root, Camera& camera, Filler& filler, base::Faults& faults)
      : root_(root), camera_(camera), filler_(filler), faults_(faults) {}
  void read();

 private:
  std::size_t chosen();
  Mode mode(const Value& value, const std::string& name);
  void raw_frame(const Value& entry, const RawFrame& raw, std::vector<RawFrame>& sequence);
  void check_phases(const Value& sequence, const Mode& mode);
  void check_time(const Value& chosen);
  void check_edges();

  const Value& root_;
  Camera& camera_;
  Filler& filler_;
  base::Faults& faults_;
};

Mode ModeReader::mode(const Value& value, const std::string& name) {
  Mode out;
  out.name = name;
  if (!value.good) return out;
  Filler("", faults_).fill(value, out);
  const std::vector<RawFrame> entries = std::move(out.sequence);
  out.sequence.clear();
  for (std::size_t i = 0; i < entries.size(); ++i) raw_frame(value["sequence"].items[i], entries[i], out.sequence);
  if (static_cast<long long>(out.sequence.size()) > base::limit::raw_frames.value)
    faults_.add(value["sequence"].place(), "the sequence has too many raw frames",
                "got " + std::to_string(out.sequence.size()) + ", at most " + std::to_string(base::limit::raw_frames.value),
                ErrorKind::limit);
  else
    check_phases(value["sequence"], out);
  return out;
}

// A list of reference phases makes one raw frame of each.
void ModeReader::raw_frame(const Value& entry, const RawFrame& raw, std::vector<RawFrame>& sequence) {
  for (const char* key : {"modulation_frequency", "reference_phase"}) {
    if (raw.lit && !entry[key])
      faults_.add(entry.place(), std::string("a lit raw frame lacks ") + key, "expected " + std::string(key) + ", or lit: false");
    if (!raw.lit && entry[key])
      faults_.add(entry[key].place(), std::string("an unlit raw frame has no ") + key, "take it out, or lit: false");
  }
  const Value& phase = entry["reference_phase"];
  if (phase.either == 0) sequence.push_back(raw);
  for (const auto& one : phase.items) {
    sequence.push_back(raw);
    sequence.back().reference_phase_rad = one.number;
  }
}

void ModeReader::check_phases(const Value& sequence, const Mode& mode) {
  std::map<double, std::vector<const RawFrame*>> lit;
  for (const auto& raw : mode.sequence)
    if (raw.lit) lit[raw.modulation_frequency_hz].push_back(&raw);
  for (const auto& [hz, frames] : lit) {
    const std::string at = " at " + base::quantity_text(hz, "1 MHz");
    std::vector<double> phases;
    for (const auto* raw : frames) phases.push_back(raw->reference_phase_rad);
    if (phases.size() < 3)
      faults_.add(sequence.place(), "too few reference phases" + at,
                  "got " + std::to_string(phases.size()) + ", expected three or more, equally spaced over 360 deg");
    else if (!equally_spaced(phases))
      faults_.add(sequence.place(), "the reference phases" + at + " are not equally spaced",
                  "expected " + std::to_string(phases.size()) + " of them, 360/" + std::to_string(phases.size()) + " deg apart, each once");
    for (const auto* raw : frames)
      if (raw->integration_time_s != frames[0]->integration_time_s) {
        faults_.add(sequence.place(), "the raw frames" + at + " differ in integration_time",
                    "expected one integration_time for each modulation frequency");
        break;
      }
  }
}

std::size_t ModeReader::chosen() {
  const Value &all = root_["modes"], &wanted = root_["mode"];
  if (!wanted) return 0;
  const auto found = std::find(all.names.begin(), all.names.end(), wanted.text);
  if (found != all.names.end()) return static_cast<std::size_t>(found - all.names.begin());
  faults_.add(wanted.place(), "no mode " + base::in_quotes(wanted.text) + base::did_you_mean(wanted.text, all.names),
              "modes of this camera: " + base::listed(all.names, "and"));
  return 0;
}

void ModeReader::read() {
  const Value& all = root_["modes"];
  if (!all || all.names.empty()) return;
  camera_.mode_names = all.names;
  const std::size_t which = chosen();
  for (std::size_t i = 0; i < all.items.size(); ++i) {
    const std::size_t before = faults_.size();
    Mode one = mode(all.items[i], all.names[i]);
    if (i != which) continue;
    camera_.mode = std::move(one);
    filler_.remember(all.items[i], camera_.mode);
    if (faults_.size() == before && all.items[i].good) check_time(all.items[i]);
  }
  // After the check's place was found: the override counts, not what the mode says.
  if (faults_.empty()) check_edges();
}

void ModeReader::check_time(const Value& chosen) {
  const Value& sequence = chosen["sequence"];
  const Value& override_time = root_["integration_time"];
  auto& raw_frames = camera_.mode.sequence;
  if (override_time && override_time.good)
    for (auto& raw : raw_frames)
      if (raw.lit) raw.integration_time_s = override_time.number;
  const base::Place& place = override_time ? override_time.place() : sequence.place();
  double total = 0;
  for (const auto& raw : raw_frames) total += raw.integration_time_s + camera_.readout_time_s;
  const double frame = 1 / camera_.mode.frame_rate_hz;
  if (!(total <= frame * (1 + 1e-9)))
    faults_.add(place, "the sequence does not fit into a frame",
                "got " + std::to_string(raw_frames.size()) + " raw frames of " + milliseconds(total) + " together, readout included; at " +
                    base::quantity_text(camera_.mode.frame_rate_hz, "1 Hz") + " a frame has " + milliseconds(frame) +
                    "\nlower integration_time, or modes." + camera_.mode.name + ".frame_rate");
  for (const auto& raw : raw_frames)
    if (raw.integration_time_s < camera_.min_integration_time_s) {
      faults_.add(place, "integration_time is below the camera's shortest",
                  "got " + base::quantity_text(raw.integration_time_s, "1 us") + ", expected at least " +
                      base::quantity_text(camera_.min_integration_time_s, "1 us") + " (timing.min_integration_time)");
      break;
    }
}

// A linear edge may not be longer than the pulse or the pause that it leads to.
void ModeReader::check_edges() {
  double highest = 0;
  for (const auto& raw : camera_.mode.sequence) highest = std::max(highest, raw.modulation_frequency_hz);
  for (std::size_t i = 0; i < camera_.illumination.size(); ++i) {
    const Waveform& waveform = camera_.illumination[i].waveform;
    if (waveform.kind != Waveform::Kind::rectangular) continue;
    const double room = std::min(waveform.duty, 1 - waveform.duty) / highest;
    if (waveform.rise_time_s > room)
      faults_.add(root_["illumination"].items[i]["waveform"].place_of("rise_time"), "the pulse's edges are longer than the pulse",
                  "got rise_time " + base::quantity_text(waveform.rise_time_s, "1 ns") + ", at most " + base::quantity_text(room, "1 ns") +
                      " at " + base::quantity_text(highest, "1 MHz") + " and this duty");
  }
}

}  // namespace

void read_modes(const Value& root, Camera& camera, Filler& filler, base::Faults& faults) {
  ModeReader(root, camera, filler, faults).read();
}

}  // namespace tofray::io
