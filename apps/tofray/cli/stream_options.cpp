// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/units.h"
#include "cli/option_values.h"

/// Of `tofray stream`.
namespace tofray::app {

namespace {

double time_of(const char* option, const std::string& value, double high_s, const std::string& expected) {
  const base::Quantity time = base::parse_quantity(value, base::Dimension::time);
  if (time.status != base::Quantity::Status::good || !(time.value >= 0 && time.value <= high_s)) app::refuse(option, value, expected);
  return time.value;
}

void take_interface(Options& o, const std::string& value) {
  const auto good = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view(".:_-@").find(c) != std::string_view::npos;
  };
  if (value.empty() || value.size() > 64 || !std::all_of(value.begin(), value.end(), good))
    app::refuse("--interface", value, "a network interface's name or address, or auto, as in --interface eth0");
  o.stream.interface = value;
}

/// "https://app.example.org": a scheme, a host, a port where it is not the usual one.
void take_origin(Options& o, const std::string& value) {
  const std::size_t scheme = value.find("://");
  const bool good = scheme != std::string::npos && scheme > 0 && value.find_first_of(" \t,\"'<>") == std::string::npos &&
                    value.find('/', scheme + 3) == std::string::npos && value.size() <= 256;
  if (!good && value != "null")
    app::refuse("--allow-origin", value, "a page's origin, without a path, as in --allow-origin https://app.example.org");
  o.stream.allowed_origins.push_back(value);
}

void take_epoch(Options& o, const std::string& value) {
  o.stream.epoch_now = value == "now";
  o.messages.epoch_s = o.stream.epoch_now ? 0 : number_of("--epoch", value, 0, 2e9, "now, or seconds, 0 to 2e9, as in --epoch 1.7e9");
}

void take_camera(Options& o, const std::string& value) {
  const std::size_t colon = value.find(':'), equals = value.find('=');
  const std::string name = value.substr(0, colon);
  if (name.empty() || (colon != std::string::npos && (equals == std::string::npos || equals <= colon + 1)))
    app::refuse("--add-camera", value, "NAME or NAME:KEY=VALUE, as in --add-camera left:camera.pose.position=\"[-5cm,0,0]\"");
  auto& all = o.stream.cameras;
  auto camera = std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == name; });
  if (camera == all.end()) camera = all.insert(all.end(), {name, {}});
  if (colon != std::string::npos) camera->second.emplace_back(value.substr(colon + 1, equals - colon - 1), value.substr(equals + 1));
}

}  // namespace

std::vector<OptionSpec> stream_specs() {
  return {
      {"--to", 0, "WHERE", "dds: ROS 2 and other readers of DDS; foxglove: Foxglove, Lichtblick and other readers of their WebSocket (dds)",
       [](Options& o, const std::string& v) {
         o.stream.to = static_cast<Options::Stream::To>(word_of("--to", v, {"dds", "foxglove"}));
       },
       "dds foxglove"},
      {"--domain", 0, "N", "DDS domain (ROS_DOMAIN_ID, or 0)",
       [](Options& o, const std::string& v) {
         o.stream.domain = static_cast<int>(whole("--domain", v, 0, 232, "a whole number of 0 to 232"));
       }},
      {"--interface", 0, "NAME", "network interface, by name or address, or auto: other machines see it then (lo: this machine alone)",
       take_interface, "lo auto"},
      {"--port", 0, "N", "of --to foxglove: port to listen on; 0: any that is free (8765, or one of the next 20)",
       [](Options& o, const std::string& v) {
         o.view.port = static_cast<int>(whole("--port", v, 0, 65535, "a whole number of 0 to 65535"));
       },
       "", false, "stream"},
      {"--allow-origin", 0, "ORIGIN", "of --to foxglove: pages of that origin may read, beside those of this machine; as often as you like",
       take_origin},
      {"--qos", 0, "NAME", "compatible: reliable, transient local; sensor: best effort, volatile for images and clouds (compatible)",
       [](Options& o, const std::string& v) {
         o.stream.sensor_qos = word_of("--qos", v, {"compatible", "sensor"}) == 1;
       },
       "compatible sensor"},
      {"--history", 0, "N", "messages of each topic that are kept for who is late or comes late (5; sensor: 2)",
       [](Options& o, const std::string& v) {
         o.stream.history = static_cast<int>(whole("--history", v, 1, 100'000, "a whole number of 1 to 100000"));
       }},
      {"--rate", 0, "F", "frames a second, in the place of the mode's",
       [](Options& o, const std::string& v) { take_frame_rate("--rate", o, v); }, "", false, "stream"},
      {"--latency", 0, "TIME", "how long after its readout a frame is sent (0s)",
       [](Options& o, const std::string& v) {
         o.stream.latency_s = time_of("--latency", v, 60, "a time of 0 to 60 s, as in --latency 20ms");
       }},
      {"--drift", 0, "PPM", "by how many millionths the camera's clock is fast, against this machine's (0)",
       [](Options& o, const std::string& v) {
         o.stream.drift = 1e-6 * number_of("--drift", v, -1e4, 1e4, "millionths, -10000 to 10000, as in --drift 75");
       }},
      {"--duration", 0, "TIME", "how long, in the camera's time (until Ctrl-C)",
       [](Options& o, const std::string& v) { o.stream.duration_s = time_of("--duration", v, 1e8, "a time, as in --duration 60s"); }},
      {"--epoch", 0, "S", "seconds since 1970 at the simulation's time 0, or now: stamps are this machine's time at the start (0)",
       take_epoch, "now", false, "stream"},
      {"--wait-readers", 0, "N", "begin once there are N subscriptions to its topics",
       [](Options& o, const std::string& v) {
         o.stream.readers = static_cast<int>(whole("--wait-readers", v, 0, 100'000, "a whole number of 0 to 100000"));
       }},
      {"--pose-from", 0, "FILE",
       "poses of the camera that come while it streams, lines of t x y z qx qy qz qw from a pipe, or - : a frame is sent once they reach "
       "its end",
       [](Options& o, const std::string& v) {
         if (v.empty()) app::refuse("--pose-from", v, "a file or a pipe, or - for standard input");
         o.stream.poses = v;
       },
       "<files>"},
      {"--add-camera", 0, "NAME[:KEY=VALUE]", "a camera of that name, of which KEY is VALUE; as often as you like", take_camera},
  };
}

}  // namespace tofray::app
