// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pictures/pictures.h"
#include "tofray/camera_report.h"
#include "tofray/mcap.h"
#include "tofray/quality.h"
#include "tofray/simulator.h"

namespace tofray::app {

/// What the user wrote after `tofray COMMAND`, checked. A command sees only options that it has (see commands.h).
struct Options {
  std::vector<std::string> typed;                        ///< the whole command line, for manifest.json
  std::vector<std::string> words;                        ///< what stands there without an option's name: files, names
  std::vector<std::pair<std::string, std::string>> set;  ///< --set, in order
  std::optional<std::uint64_t> seed;
  std::optional<Noise> noise;
  std::optional<std::vector<std::string>> emit;  ///< out of npz, png, ply, mcap
  MessageOptions messages;                       ///< --driver, --topics and others of MCAP files
  std::optional<McapCompression> mcap_compression;
  std::string arrays;     ///< of frame.npz, as typed; empty: all
  bool compress = false;  ///< frame.npz deflated
  std::optional<std::uint64_t> frames;
  std::optional<std::pair<int, int>> pixel;  ///< u, v
  std::optional<std::uint64_t> batch;        ///< --batch: frames at once
  std::vector<int> block_sizes;              ///< --block-size: CUDA threads per block
  std::vector<std::string> stages;           ///< --stage, out of trace, power, raw, all
  std::optional<int> exposure_samples, subpixel;
  std::uint64_t first_frame = 0;
  std::uint64_t warmup = 3;
  int threads = 0;  ///< 0: one per core
  std::optional<Backend> backend;
  int device = -1;  ///< which GPU; -1: the first one
  pictures::Theme theme = pictures::Theme::dark;
  int scale = 1;  ///< of preview.png and raw.png
  std::string mode, camera, root, from, output;
  std::vector<double> at_m;                                 ///< --at, --distance
  std::vector<double> reflectivities;                       ///< --reflectivity
  std::vector<AmbientCase> ambients;                        ///< --ambient
  double angle_rad = 0;                                     ///< --angle
  std::optional<double> temperature_celsius;                ///< --temperature
  std::string need, solve;                                  ///< --need, --solve, as typed
  ImageRegion region;                                       ///< --region
  std::string like;                                         ///< --as: whose conditions
  double truth_m = 0;                                       ///< --truth; 0: not given
  double unit_m = 0;                                        ///< --unit; 0: not given
  std::optional<std::array<double, 4>> intrinsics;          ///< --intrinsics: fx, fy, cx, cy in pixels
  std::string quantity = "z";                               ///< --quantity: z or range
  bool fit_shift = false;                                   ///< --shift fit
  std::vector<std::pair<std::string, std::string>> limits;  ///< --limit, in order
  std::vector<std::string> vary;                            ///< --vary, in order, as typed
  std::vector<std::string> metrics;                         ///< --metric
  std::uint64_t repeat = 1;                                 ///< --repeat
  std::string best;                                         ///< --best, as typed
  bool by_object = false;                                   ///< --by-object
  std::string transient;                                    ///< --transient: a file
  std::optional<double> first_m, width_m, per_factor;       ///< --first, --width, --factor: what that file does not say
  struct View {
    std::optional<int> port;
    std::string host, rate = "own", export_file, beside;
    std::vector<std::string> allowed_hosts;
    bool open = false, embed = false, end_with_input = false, test_hooks = false;
  } view;  ///< of `tofray view`
  struct Stream {
    enum class To { dds, foxglove } to = To::dds;
    std::vector<std::string> allowed_origins;
    std::optional<int> domain;
    std::string interface;  ///< empty: loopback
    bool sensor_qos = false;
    std::optional<int> history;
    double latency_s = 0, drift = 0;  ///< drift: by how much the camera's clock is fast, as a share
    bool epoch_now = false;
    std::optional<double> duration_s;
    int readers = 0;
    std::string poses;  ///< --pose-from: "-" or a file; empty: the camera is where the scene has it
    /// --add-camera: names, and what is set of each, in order.
    std::vector<std::pair<std::string, std::vector<std::pair<std::string, std::string>>>> cameras;
  } stream;  ///< of `tofray stream`
  struct Shards {
    std::uint64_t part = 0, parts = 1;
    std::vector<std::uint64_t> list;
    std::uint64_t pilot = 8, samples = 0;
    double recompute = 0;
    bool partial = false, print_only = false;
    std::uint64_t tasks = 0;          ///< 0: chosen
    std::vector<std::string> sbatch;  ///< options of sbatch
    std::string engine = "slurm";     ///< or kubernetes, aws-batch
  } shards;                           ///< of `tofray dataset`
  bool json = false, quiet = false, compare = false, clean = false, sources = false, raw = false, csv = false, auto_exposure = false,
       plan = false;
};

}  // namespace tofray::app
