// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/constants.h"
#include "base/limits.h"
#include "base/text.h"
#include "base/units.h"
#include "cli/commands.h"
#include "cli/option_values.h"
#include "messages/topics.h"
#include "results/array_table.h"
#include "run/manifest.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

void take_set(Options& o, const std::string& value) {
  const std::size_t equals = value.find('=');
  if (equals == 0 || equals == std::string::npos)
    refuse("--set", value, "KEY=VALUE, as in --set camera.lens.f_number=1.2 or --set objects.0.plane.reflectivity=\"40 %\"");
  o.set.emplace_back(value.substr(0, equals), value.substr(equals + 1));
}

void take_factor(Options& o, const std::string& value) {
  double number = 0;
  const char* const end = value.data() + value.size();
  const auto read = std::from_chars(value.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || !(number > 0 && number <= 1e30))
    refuse("--factor", value, "electrons per second for 1 of the file's unit, a number above 0, as in --factor 2.5e6");
  o.per_factor = number;
}

/// Of `tofray process --transient`.
std::vector<OptionSpec> transient_specs() {
  return {
      {"--transient", 0, "FILE", "begin with light by path length: a .npz of tofray, or a .npy or .npz of another renderer",
       [](Options& o, const std::string& v) { o.transient = v; }, "<files>"},
      {"--first", 0, "LENGTH",
       "with --transient: path length at which the first bin begins, from light to camera (what the file says, or 0)",
       [](Options& o, const std::string& v) { o.first_m = length_of("--first", v, 0, 1e6); }},
      {"--width", 0, "LENGTH", "with --transient: width of a bin in path length (what the file says)",
       [](Options& o, const std::string& v) { o.width_m = length_of("--width", v, 1e-6, 1e6); }},
      {"--factor", 0, "X", "with --transient: electrons per second for 1 of the file's unit (1)", take_factor},
  };
}

void take_noise(Options& o, const std::string& value) {
  if (value == "off")
    o.noise = Noise::off;
  else if (value == "exact")
    o.noise = Noise::exact;
  else
    refuse("--noise", value, "off (expected values) or exact (shot and read noise)");
}

void take_backend(Options& o, const std::string& value) {
  if (value == "auto")
    o.backend = Backend::automatic;
  else if (value == "cpu")
    o.backend = Backend::cpu;
  else if (value == "cuda")
    o.backend = Backend::cuda;
  else
    refuse("--backend", value, "auto, cpu or cuda");
}

void take_at(Options& o, const std::string& value) { add_distances("--at", o, value); }

void take_reflectivity(Options& o, const std::string& value) {
  for (const std::string& part : split(value, ',')) {
    const base::Quantity share = base::parse_quantity(part, base::Dimension::fraction);
    const bool number = share.status == base::Quantity::Status::good || share.status == base::Quantity::Status::bare;
    if (!number || !(share.value >= 0 && share.value <= 1))
      refuse("--reflectivity", part, "shares of 0 to 100 %, as in --reflectivity 10%,80%");
    o.reflectivities.push_back(share.value);
  }
}

/// Light of the sun's spectrum from everywhere, by illuminance or by its share of the standard sun.
void take_ambient(Options& o, const std::string& value) {
  for (const std::string& part : split(value, ',')) {
    AmbientCase one;
    const base::Quantity lux = base::parse_quantity(part, base::Dimension::illuminance),
                         share = base::parse_quantity(part, base::Dimension::fraction);
    if (lux.status == base::Quantity::Status::good && lux.value >= 0 && lux.value <= 1e6) {
      one.ambient.quantity = Ambient::Quantity::illuminance_lx, one.ambient.amount = lux.value;
      if (lux.value > 0) one.name = "at " + base::quantity_text(lux.value, lux.value < 1000 ? "1 lx" : "1 klx");
    } else if (share.status == base::Quantity::Status::good && part.find('%') != std::string::npos && share.value >= 0 &&
               share.value <= 10) {
      one.ambient.amount = share.value;
      if (share.value > 0) one.name = fmt::format("at {:g} % sun", 100 * share.value);
    } else if (part != "none") {
      refuse("--ambient", part,
             "an illuminance of 0 to 1000 klx, a share of the sun's light of 0 to 1000 %, or none, as in --ambient none,50klx,100%");
    }
    if (one.ambient.amount > 0) one.ambient.spectrum = Ambient::Spectrum::sun_am15;
    o.ambients.push_back(one);
  }
}

void take_emit(Options& o, const std::string& value) {
  std::vector<std::string> kinds;
  for (const std::string& kind : split(value, ',')) {
    if (kind != "npz" && kind != "png" && kind != "ply" && kind != "mcap")
      refuse("--emit", value, "npz, png, ply, mcap or several of them, as in --emit npz,png");
    if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
  }
  o.emit = kinds;
}

void take_theme(Options& o, const std::string& value) {
  if (value != "dark" && value != "light") refuse("--theme", value, "dark or light (dark text on white, for papers)");
  o.theme = value == "light" ? pictures::Theme::light : pictures::Theme::dark;
}

void take_scale(Options& o, const std::string& value) {
  o.scale = static_cast<int>(whole("--scale", value, 1, 8, "a whole number of 1 to 8"));
}

constexpr auto most_threads = static_cast<std::uint64_t>(base::limit::threads.value);
constexpr int most_block = 1024;  // CUDA's threads per block; they go together in warps of 32
constexpr const char* block_sizes_expected =
    "multiples of 32 up to 1024: 128, or 64,128,256, or first:last:step as in --block-size 32:1024:32";

int warps(const std::string& part, const std::string& value) {
  const std::uint64_t size = whole("--block-size", part, 32, most_block, block_sizes_expected);
  if (size % 32 != 0) refuse("--block-size", value, block_sizes_expected);
  return static_cast<int>(size);
}

/// "32:1024:32" or "128".
void add_block_sizes(std::vector<int>& sizes, const std::string& part, const std::string& value) {
  const std::vector<std::string> parts = split(part, ':');
  const int first = warps(parts[0], value), last = parts.size() > 1 ? warps(parts[1], value) : first;
  const int step = parts.size() > 2 ? warps(parts[2], value) : most_block;
  if (parts.size() == 2 || parts.size() > 3 || first > last) refuse("--block-size", value, block_sizes_expected);
  for (int size = first; size <= last; size += step) {
    if (std::find(sizes.begin(), sizes.end(), size) == sizes.end()) sizes.push_back(size);
  }
}

void take_block_size(Options& o, const std::string& value) {
  o.block_sizes.clear();
  for (const std::string& part : split(value, ',')) add_block_sizes(o.block_sizes, part, value);
  std::sort(o.block_sizes.begin(), o.block_sizes.end());
}

void take_stage(Options& o, const std::string& value) {
  const std::vector<std::string> known = {"trace", "power", "raw", "all"};
  o.stages.clear();
  for (const std::string& stage : split(value, ',')) {
    if (std::find(known.begin(), known.end(), stage) == known.end())
      refuse("--stage", value, "trace, power, raw, all (the whole frame) or several of them, as in --stage power,all");
    if (std::find(o.stages.begin(), o.stages.end(), stage) == o.stages.end()) o.stages.push_back(stage);
  }
}

void take_pixel(Options& o, const std::string& value) {
  const char* const end = value.data() + value.size();
  int u = 0, v = 0;
  const auto first = std::from_chars(value.data(), end, u);
  const bool comma = first.ec == std::errc() && first.ptr != end && *first.ptr == ',';
  const auto second = comma ? std::from_chars(first.ptr + 1, end, v) : first;
  if (!comma || second.ec != std::errc() || second.ptr != end || u < 0 || v < 0)
    refuse("--pixel", value, "column,row counted from 0, as in --pixel 112,86");
  o.pixel = {u, v};
}

constexpr std::uint64_t most_frames = 1'000'000'000;

/// What computes.
std::vector<OptionSpec> machine_specs() {
  return {
      {"--threads", 0, "N", "threads to use; the results are the same (0: one per core)",
       [](Options& o, const std::string& v) {
         o.threads = static_cast<int>(whole("--threads", v, 0, most_threads, "a whole number of 0 to 1024"));
       }},
      {"--backend", 0, "NAME", "what to compute on; the results are the same (auto: a GPU if there is one)", take_backend, "auto cpu cuda"},
      {"--device", 0, "N", "which GPU, from 0 on (`tofray doctor` names them)",
       [](Options& o, const std::string& v) { o.device = static_cast<int>(whole("--device", v, 0, 1023, "a whole number of 0 to 1023")); }},
  };
}

void take_picture(Options& o, const std::string& value) {
  if (!pictures::format_of(value))
    refuse("-o", value, "a picture's name that ends in .png, .svg or .pdf, as in -o slide.svg (SVG and PDF for slides and papers)");
  o.output = value;
}

/// Of `tofray preview`.
std::vector<OptionSpec> preview_specs() {
  return {
      {"--output", 'o', "FILE", "picture to write: .png, .svg or .pdf; without it the terminal shows z", take_picture, "<files>", false,
       "preview"},
      {"--raw", 0, nullptr, "the raw frames, in place of z, amplitude and error", [](Options& o, const std::string&) { o.raw = true; }},
      {"--theme", 0, "NAME", "look of the picture: dark, or light for papers (dark)", take_theme, "dark light", false, "preview"},
      {"--scale", 0, "N", "N times as many pixels along each side; of SVG and PDF N times the size (1)", take_scale, "", false, "preview"},
  };
}

/// Of `tofray bench`.
std::vector<OptionSpec> bench_specs() {
  return {
      {"--warmup", 0, "N", "frames that run before the clock does (3)",
       [](Options& o, const std::string& v) { o.warmup = whole("--warmup", v, 0, most_frames, "a whole number of 0 to 1000000000"); }},
      {"--batch", 0, "N",
       "frames per second of batches of N frames that follow each other, of other seeds, of other poses (--frames: batches, 20)",
       [](Options& o, const std::string& v) { o.batch = whole("--batch", v, 1, 1'000'000, "a whole number of 1 to 1000000"); }},
      {"--block-size", 0, "LIST", "time the GPU with these threads per block: 128, or 64,128,256, or 32:1024:32 (first:last:step)",
       take_block_size, "32:1024:32 128", true},
      {"--stage", 0, "LIST", "time from the ray to the end of these stages, against sequential code: trace, power, raw, all", take_stage,
       "all trace power raw", true},
      {"--compare", 0, nullptr, "run variants in turn and print ratios", [](Options& o, const std::string&) { o.compare = true; }},
  };
}

/// Names of hosts as a browser sends them.
void take_allowed_host(Options& o, const std::string& value) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view(".-_:[]").find(c) != std::string_view::npos;
  };
  if (value.empty() || value.size() > 255 || !std::all_of(value.begin(), value.end(), good))
    refuse("--allow-host", value, "a host's name, with or without a port, as in --allow-host lab7 or --allow-host lab7:8080");
  o.view.allowed_hosts.push_back(value);
}

void take_rate(Options& o, const std::string& value) {
  double number = 0;
  const char* const end = value.data() + value.size();
  const auto read = std::from_chars(value.data(), end, number);
  if (value != "own" && value != "max" && (read.ec != std::errc() || read.ptr != end || !(number >= 0.01 && number <= 1000)))
    refuse("--rate", value, "own (as many frames a second as the camera), max, or a number of 0.01 to 1000");
  o.view.rate = value;
}

/// Of `tofray view`.
std::vector<OptionSpec> view_specs() {
  return {
      {"--port", 0, "N", "port to listen on; 0: any that is free (7170, or one of the next 20)",
       [](Options& o, const std::string& v) {
         o.view.port = static_cast<int>(whole("--port", v, 0, 65535, "a whole number of 0 to 65535"));
       }},
      {"--host", 0, "ADDRESS", "listen there in place of this machine's own 127.0.0.1 and ::1: other machines may reach it then",
       [](Options& o, const std::string& v) { o.view.host = v; }},
      {"--allow-host", 0, "NAME", "a further name of this server; may be repeated", take_allowed_host},
      {"--open", 0, nullptr, "open it in the browser", [](Options& o, const std::string&) { o.view.open = true; }},
      {"--embed", 0, nullptr, "pages of this machine may hold the viewer in a frame",
       [](Options& o, const std::string&) { o.view.embed = true; }},
      {"--export", 0, "FILE", "write the page with --frames frames in it, one .html file that needs no server and no network, and end",
       [](Options& o, const std::string& v) {
         if (!v.ends_with(".html") && !v.ends_with(".htm")) refuse("--export", v, "the name of a page, as in --export out.html");
         o.view.export_file = v;
       },
       "<files>"},
      {"--arrays", 0, "LIST", "arrays that the page of --export gets, as in z_m,flags (of all panes, and raw)",
       [](Options& o, const std::string& v) {
         (void)results::ArrayChoice(v);
         o.arrays = v;
       },
       "<arrays>", true, "view"},
      {"--output", 'o', "DIR", "folder for what pages record and export (the working folder)",
       [](Options& o, const std::string& v) { o.output = v; }, "<files>", false, "view"},
      {"--end-with-input", 0, nullptr, "end when standard input ends: with the program that started it",
       [](Options& o, const std::string&) { o.view.end_with_input = true; }},
      {"--beside", 0, "SCENE", "opens a scene as side B: a recording beside its simulation (--set is of side A)",
       [](Options& o, const std::string& v) { o.view.beside = v; }, "<scenes> <files>"},
      {"--rate", 0, "RATE", "frames a second: own (the camera's), max, or a number (own)", take_rate, "own max"},
      {"--test-hooks", 0, nullptr, "the page tells tests what it draws", [](Options& o, const std::string&) { o.view.test_hooks = true; },
       "", false, "", true},
  };
}

void take_angle(Options& o, const std::string& value) {
  const base::Quantity angle = base::parse_quantity(value, base::Dimension::angle);
  constexpr double steepest = 89.0 / 180 * base::pi;
  if (angle.status != base::Quantity::Status::good || !(std::fabs(angle.value) <= steepest))
    refuse("--angle", value, "an angle of -89 to 89 deg, as in --angle 20deg");
  o.angle_rad = angle.value;
}

void take_temperature(Options& o, const std::string& value) {
  std::string text = value;
  if (text.ends_with("C") && !text.ends_with("degC") && !text.ends_with("\u00b0C")) text.insert(text.size() - 1, "deg");  // 60C
  const base::Quantity celsius = base::parse_quantity(text, base::Dimension::celsius);
  if (celsius.status != base::Quantity::Status::good || !(celsius.value >= -100 && celsius.value <= 200))
    refuse("--temperature", value, "a temperature of -100 to 200 degC, as in --temperature 60C");
  o.temperature_celsius = celsius.value;
}

/// Of `tofray budget`.
std::vector<OptionSpec> budget_specs() {
  return {
      {"--distance", 0, "LENGTHS", "distances of the wall: 2m, 0.5m,1m or 0.3m:5m:50 (50 of them) (0.5m,1m,2m,4m)",
       [](Options& o, const std::string& v) { add_distances("--distance", o, v); }},
      {"--reflectivity", 0, "SHARES", "reflectivities of the wall: 10%,80% (20%,80%)", take_reflectivity, "", false, "budget"},
      {"--ambient", 0, "LIGHTS", "light of the sun's spectrum on the wall: none,50klx,100% (of the standard sun) (none)", take_ambient, "",
       false, "budget"},
      {"--angle", 0, "ANGLE", "angle by which the wall is turned about the camera's y (0deg: it faces the camera)", take_angle},
      {"--temperature", 0, "T", "temperature of the camera, in place of the profile's: 60C", take_temperature},
      {"--pixel", 0, "U,V", "the pixel at column U, row V of the image (that on the optical axis)", take_pixel, "", false, "budget"},
      {"--auto-exposure", 0, nullptr, "integration times as the profile's auto_exposure leaves them of each wall",
       [](Options& o, const std::string&) { o.auto_exposure = true; }},
      {"--need", 0, "TEXT", "with --solve: the range noise that is needed, \"sigma 10mm at 3m, 10%, 50klx\"",
       [](Options& o, const std::string& v) { o.need = v; }},
      {"--solve", 0, "KEY", "with --need: key of the profile whose number is to be found, such as illumination.0.power",
       [](Options& o, const std::string& v) { o.solve = v; }, "<numbers>"},
      {"--csv", 0, nullptr, "a line of CSV for each row on stdout", [](Options& o, const std::string&) { o.csv = true; }},
      {"--output", 'o', "FILE", "file to write: .csv or .json; without it a table on stdout", take_budget_file, "<files>", false, "budget"},
  };
}

std::vector<OptionSpec> specs() {
  return {
      {"--output", 'o', "DIR", "folder to write to", [](Options& o, const std::string& v) { o.output = v; }, "<files>"},
      {"--clean", 0, nullptr, "remove files of earlier runs that this one does not write, by the manifest.json in the folder",
       [](Options& o, const std::string&) { o.clean = true; }},
      {"--set", 0, "KEY=VALUE", "change a key of the scene, or of its camera as camera.…; may be repeated", take_set, "<keys>"},
      {"--mode", 0, "NAME", "the camera's mode (`tofray list cameras` names them)", [](Options& o, const std::string& v) { o.mode = v; },
       "<modes>"},
      {"--at", 0, "LENGTHS", "distances of the table: 2m, 0.5m,1m or 0.3m..4m (eight of them; 0.3m..4m:50 is 50)", take_at},
      {"--reflectivity", 0, "SHARES", "reflectivities of the table: 10%,80%", take_reflectivity},
      {"--ambient", 0, "LIGHTS", "light of the sun's spectrum in the table: none,50klx,100% (of the standard sun)", take_ambient},
      {"--sources", 0, nullptr, "of a profile: list each number without a source, not only their count",
       [](Options& o, const std::string&) { o.sources = true; }},
      {"--camera", 0, "PROFILE", "camera profile: a built-in name or a file", [](Options& o, const std::string& v) { o.camera = v; },
       "<profiles> <files>"},
      {"--seed", 0, "N", "seed of the noise (0)",
       [](Options& o, const std::string& v) { o.seed = whole("--seed", v, 0, UINT64_MAX, "a whole number of 0 to 18446744073709551615"); }},
      {"--noise", 0, "KIND", "off: expected values; exact: shot and read noise (exact)", take_noise, "off exact"},
      {"--exposure-samples", 0, "N", "instants within each exposure, for motion blur (1)",
       [](Options& o, const std::string& v) {
         o.exposure_samples = static_cast<int>(whole("--exposure-samples", v, 1, 1000, "a whole number of 1 to 1000"));
       }},
      {"--subpixel", 0, "N", "N x N samples within each pixel: pixels at edges are mixed (1)",
       [](Options& o, const std::string& v) { o.subpixel = static_cast<int>(whole("--subpixel", v, 1, 16, "a whole number of 1 to 16")); }},
      {"--bounces", 0, "N", "maximum number of bounces: light by up to N more surfaces, multipath (as --set transport.bounces=N)",
       [](Options& o, const std::string& v) {
         o.set.emplace_back("transport.bounces", std::to_string(whole("--bounces", v, 0, 64, "a whole number of 0 to 64")));
       }},
      {"--samples", 0, "N",
       "light paths per pixel (Monte Carlo samples), with --bounces (as --set transport.samples=N); auto: 16 to 1024, as each pixel needs",
       [](Options& o, const std::string& v) {
         const bool goes_on = v == "auto";
         const std::string first =
             goes_on ? "16" : std::to_string(whole("--samples", v, 1, 65536, "a whole number of 1 to 65536, or auto"));
         o.set.emplace_back("transport.samples", first);
         if (goes_on) o.set.emplace_back("transport.max_samples", "1024");
       },
       "auto"},
      {"--fps", 0, "F", "frames per second, in place of the mode's: as --set camera.frame_rate='F Hz'",
       [](Options& o, const std::string& v) { take_frame_rate("--fps", o, v); }},
      {"--frames", 0, "N", "how many frames",
       [](Options& o, const std::string& v) { o.frames = whole("--frames", v, 1, most_frames, "a whole number of 1 to 1000000000"); }},
      {"--first-frame", 0, "I", "number of the first frame: a part of a longer run (0)",
       [](Options& o, const std::string& v) {
         o.first_frame = whole("--first-frame", v, 0, most_frames, "a whole number of 0 to 1000000000");
       }},
      {"--emit", 0, "KINDS",
       "what to write, out of npz,png,ply (all for one frame, npz for many), and mcap: all frames in run.mcap, for ROS 2", take_emit,
       "npz png ply mcap", true},
      {"--theme", 0, "NAME", "look of preview.png and raw.png: dark, or light for papers (dark)", take_theme, "dark light"},
      {"--scale", 0, "N", "preview.png and raw.png with N times as many pixels along each side, for slides (1)", take_scale},
      {"--arrays", 0, "LIST", "arrays that npz files get, as in raw,z_m,gt_* (all; `tofray list arrays` names them)",
       [](Options& o, const std::string& v) {
         (void)results::ArrayChoice(v);
         o.arrays = v;
       },
       "<arrays>", true},
      {"--compress", 0, nullptr, "deflate npz files: smaller and slower", [](Options& o, const std::string&) { o.compress = true; }},
      {"--from", 0, "MANIFEST", "make again what a manifest.json describes, byte for byte",
       [](Options& o, const std::string& v) { o.from = v; }, "<files>"},
      {"--root", 0, "DIR", "folder whose files a scene may also read; without it only its own folder, since a scene may be a stranger's",
       [](Options& o, const std::string& v) { o.root = v; }, "<files>"},
      {"--pixel", 0, "U,V", "show one pixel's whole chain, from light to depth", take_pixel},
      {"--plan", 0, nullptr, "of a scene: the passes that its frame takes, in their order; nothing is computed",
       [](Options& o, const std::string&) { o.plan = true; }},
      {"--json", 0, nullptr, "one JSON object on stdout", [](Options& o, const std::string&) { o.json = true; }},
      {"--quiet", 'q', nullptr, "no progress and no summary; warnings and errors stay",
       [](Options& o, const std::string&) { o.quiet = true; }},
  };
}

}  // namespace

const std::vector<OptionSpec>& all_options() {
  static const std::vector<OptionSpec> all = [] {
    std::vector<OptionSpec> joined = specs();
    for (const std::vector<OptionSpec>& more :
         {machine_specs(), message_specs(), bench_specs(), transient_specs(), preview_specs(), view_specs(), budget_specs(),
          measuring_specs(), dataset_specs(), sweep_specs(), stream_specs()})
      joined.insert(joined.end(), more.begin(), more.end());
    return joined;
  }();
  return all;
}

const OptionSpec& option(std::string_view name, std::string_view command) {
  for (const std::string_view of : {command, std::string_view()})
    for (const OptionSpec& one : all_options())
      if (name == one.name && of == one.of) return one;
  throw Error(ErrorKind::bug, fmt::format("error: no option is called {}", name));
}

namespace {

struct Group {
  const char* name;
  std::vector<std::string_view> options;
};

const std::vector<Group>& groups() {
  static const std::vector<Group> all = {
      {"Scene and camera", {"--set",           "--mode", "--camera",   "--fps",          "--transient", "--first",      "--width",
                            "--factor",        "--at",   "--distance", "--reflectivity", "--ambient",   "--angle",      "--temperature",
                            "--auto-exposure", "--need", "--solve",    "--vary",         "--sources",   "--add-camera", "--root"}},
      {"Depth",
       {"--region", "--as", "--truth", "--unit", "--intrinsics", "--quantity", "--shift", "--limit", "--metric", "--by-object", "--best"}},
      {"Simulation", {"--seed", "--noise", "--exposure-samples", "--subpixel", "--bounces", "--samples"}},
      {"Measuring", {"--warmup", "--compare", "--batch", "--stage", "--block-size"}},
      {"Frames", {"--frames", "--duration", "--first-frame", "--repeat", "--from", "--pixel", "--plan"}},
      {"Output",
       {"--output", "--export", "--clean", "--emit", "--arrays", "--compress", "--raw", "--theme", "--scale", "--csv", "--json",
        "--quiet"}},
      {"Stream", {"--to", "--domain", "--interface", "--qos", "--history", "--latency", "--drift", "--wait-readers", "--pose-from"}},
      {"Shards",
       {"--pilot", "--shard-samples", "--part", "--shards", "--recompute", "--partial", "--tasks", "--sbatch", "--engine", "--print"}},
      {"Messages of ROS 2 (render: with --emit mcap)",
       {"--driver", "--topics", "--camera-name", "--stamp", "--epoch", "--depth-encoding", "--amplitude-step", "--unorganized",
        "--mcap-compression"}},
      {"Server", {"--port", "--host", "--allow-host", "--allow-origin"}},
      {"Viewer", {"--open", "--beside", "--embed", "--end-with-input", "--rate", "--test-hooks"}},
      {"Machine", {"--threads", "--backend", "--device"}}};
  return all;
}

std::size_t group_number(const OptionSpec& one) {
  for (std::size_t i = 0; i < groups().size(); ++i)
    for (const std::string_view name : groups()[i].options)
      if (name == one.name) return i;
  throw Error(ErrorKind::bug, fmt::format("error: the option {} is in no group of help", one.name));
}

}  // namespace

const char* group_of(const OptionSpec& one) { return groups()[group_number(one)].name; }

std::vector<const OptionSpec*> options_of(const Command& command) {
  std::vector<const OptionSpec*> own;
  for (const char* name : command.options) own.push_back(&option(name, command.name));
  std::stable_sort(own.begin(), own.end(), [](const auto* a, const auto* b) { return group_number(*a) < group_number(*b); });
  return own;
}

}  // namespace tofray::app
