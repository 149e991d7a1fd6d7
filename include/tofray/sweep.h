// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tofray/frame.h"
#include "tofray/options.h"
#include "tofray/quality.h"
#include "tofray/run.h"

/// A scene simulated with keys that vary, and how good its depth is with each: all combinations of all values. As load.h, of libtofray_files.
///
/// Each stage is computed as often as something differs that it looks at, and no more: where only what follows the light varies (the pixel, its
/// converter, exposures) rays are traced once, and where only Camera::decoding varies, raw frames are made once.
namespace tofray {

/// What varies: a key, and its values.
struct SweepAxis {
  /// A key of the scene or of its camera, "camera.illumination.0.power"; `*` in place of an index means all elements of a list, which then have
  /// the same value. `mode` is the camera's mode, `camera.profile` the camera.
  std::string key;
  std::vector<std::string> values;  ///< values as `--set` takes them: "0.2 W"
  std::vector<double> numbers;      ///< values in SI units, of a key whose value is a number; else empty
  std::string unit;                 ///< SI unit of these; empty: none
  Stage stage = Stage::trace;       ///< the first stage that looks at the key
};

/// Reads "KEY=VALUES": `a,b,c`; `A:B:n`, n numbers evenly from A to B; `A:B:logn`, with the same ratio between each and the next; `@all`, all that a
/// choice, a switch, `mode` or `profile` may be.
/// @param inputs  the scene of which it is a key; a key of a profile may leave "camera." away
/// @throws Error (bad_input) for a key that is not there, with the nearest ones, and for a value that it cannot have
SweepAxis sweep_axis(const std::string& text, const InputRequest& inputs);
/// An axis of a key and its values, one by one. @throws Error as the function of a text
SweepAxis sweep_axis(const std::string& key, const std::vector<std::string>& values, const InputRequest& inputs);

/// An axis of a key and its numbers in SI units, where the key's value is a number. @throws Error as the function of a text
SweepAxis sweep_axis_of_numbers(const std::string& key, const std::vector<double>& numbers, const InputRequest& inputs);

/// A number that a cell has of each region.
struct SweepMetric {
  std::string name;       ///< its unit is its end: "bias_m", "fill_percent"
  std::string what;       ///< one line
  bool at_least = false;  ///< more is better; false: nearer to 0 is
};
/// All of them. NaN where there is nothing that it could be of.
const std::vector<SweepMetric>& sweep_metrics();

/// What is simulated and measured.
struct SweepRequest {
  InputRequest inputs;
  std::vector<SweepAxis> axes;  ///< axes of sweep_axis(); at least one
  /// Seed, noise, threads, exposure_samples, subpixel. `arrays` are computed besides those that metrics need, for SweepWatch::frame; it is the
  /// processor that computes.
  SimulatorOptions simulator;
  std::uint64_t repeat = 1;          ///< frames of each cell, 1…1e6: those of `render --frames`
  ImageRegion region;                ///< region that is measured; empty: the whole image
  bool by_object = false;            ///< besides, each object's own pixels of it
  std::vector<std::string> metrics;  ///< names of sweep_metrics(), whose unit may be left away: "bias"; empty: all
};

/// How good depth is in each cell.
struct Sweep {
  std::vector<SweepAxis> axes;
  std::vector<std::string> regions;  ///< "all" or "92,66,40,40", then objects by name that some cell sees: "objects.2 (ball)"
  std::vector<std::string> metrics;  ///< names
  std::vector<double> values;        ///< [axis 0][axis 1]…[region][metric]
  std::uint64_t repeat = 1;          ///< frames of each cell
  bool interrupted = false;          ///< FrameProgress::stop was set: values mean nothing
  std::uint64_t traced = 0;          ///< number of frames that began with rays
  std::uint64_t from_light = 0;      ///< number of frames that began with light that was there
  std::uint64_t from_raw = 0;        ///< number of frames that began with raw frames that were there
  double seconds = 0;                ///< duration of the sweep [s]
  std::vector<InputFile> files;      ///< files that the first cell was made of
  RanOn ran_on;

  /// How many combinations there are.
  [[nodiscard]] std::uint64_t cells() const;
  /// Which value of an axis a cell has. The last axis is the one that varies from cell to cell.
  [[nodiscard]] std::size_t place(std::uint64_t cell, std::size_t axis) const;
  /// A number of a cell.
  [[nodiscard]] double value(std::uint64_t cell, std::size_t region, std::size_t metric) const;
};

/// Callbacks of a sweep. All of them may be left empty; no two are called at once.
struct SweepWatch {
  FrameProgress* progress = nullptr;                                 ///< its `stop` ends the sweep
  std::function<void(const Remark&)> remark = {};                    ///< told what is odd about the first cell's inputs
  std::function<void(std::uint64_t, std::uint64_t)> cell_done = {};  ///< told how many cells are done, of how many
  /// Shown each frame, with the cell's number, until it returns. Cells come in any order.
  std::function<void(std::uint64_t, const Frame&)> frame = {};
};

/// Simulates all cells. A cell's frames have the bytes of `tofray render` with its values as `--set` (and `--mode`), whatever they began with.
/// @throws Error as load_inputs() and Simulator, with the cell; (limit) for more than 100,000 cells; (bad_input) without an axis, for a key that two
/// of them have, an unknown metric, a region that is not in the image
Sweep sweep(const SweepRequest& request, const SweepWatch& watch = {});

/// Writes sweep.csv (a line for each cell and region), sweep.npz (values of each axis under its key; of each metric an array [axis 0][axis 1]…[region])
/// and manifest.json into a folder, each whole or not at all, the manifest last.
/// @param request  that it was made of
/// @param command  for people who read manifest.json: what was typed
/// @return what was written
/// @throws Error (io) where the folder cannot be written; (bad_input) for a sweep that was interrupted
std::vector<FileRecord> save_sweep(const Sweep& sweep, const SweepRequest& request, const std::string& folder,
                                   const std::vector<std::string>& command = {});

/// The cells that are good: those that hold all conditions, and of them each that no other is better than in every aim (the Pareto front).
/// @param wish  aims and conditions with "," between: "sigma, fill>95%", "rmse, illumination.0.power". An aim is a metric, or an axis of numbers,
///              which shall be small; a condition has < or > and a number with its unit. Metrics are those of the first region.
/// @return cells, ascending by the first aim; those where an aim or a condition is NaN are none of them
/// @throws Error (bad_input) for a name that the sweep does not have, a number of another unit, no aim
std::vector<std::uint64_t> best_cells(const Sweep& sweep, const std::string& wish);

}  // namespace tofray
