// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/stream_carrier.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "base/text.h"
#include "cli/console.h"
#include "dds/load.h"
#include "tofray/error.h"
#if defined(TOFRAY_HAS_VIEW)
#include "foxglove/server.h"
#endif

namespace tofray::app {

namespace {

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

[[noreturn]] void refuse_for(const char* option, const char* carrier) {
  throw Error(ErrorKind::bad_input, fmt::format("error: {0} is of --to {1} alone\n  expected --to {1}, or no {0}", option, carrier));
}

/// How many messages of a topic are kept for who comes later: of /tf_static at least one for each camera.
int history_of(const Options& options) {
  constexpr int usual = 5, usual_of_sensors = 2;
  const auto cameras = static_cast<int>(options.stream.cameras.size());
  return std::max(options.stream.history.value_or(options.stream.sensor_qos ? usual_of_sensors : usual), cameras);
}

int domain_of(const Options& options) {
  const std::string asked = environment("ROS_DOMAIN_ID");
  if (options.stream.domain || asked.empty()) return options.stream.domain.value_or(0);
  int domain = -1;
  const auto read = std::from_chars(asked.data(), asked.data() + asked.size(), domain);
  if (read.ec != std::errc() || read.ptr != asked.data() + asked.size() || domain < 0 || domain > 232)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: ROS_DOMAIN_ID is {}\n  expected a whole number of 0 to 232, or --domain N", base::in_quotes(asked)));
  return domain;
}

dds::Settings dds_settings(const Options& options) {
  if (options.view.port) refuse_for("--port", "foxglove");
  if (!options.view.host.empty()) refuse_for("--host", "foxglove");
  if (!options.view.allowed_hosts.empty()) refuse_for("--allow-host", "foxglove");
  if (!options.stream.allowed_origins.empty()) refuse_for("--allow-origin", "foxglove");
  dds::Settings out;
  out.domain = domain_of(options);
  if (!options.stream.interface.empty())
    out.interface = options.stream.interface;
  else
    out.config = environment("CYCLONEDDS_URI");
  out.history = history_of(options);
  return out;
}

Carrier by_dds(const Options& options) {
  const dds::Settings settings = dds_settings(options);
  const std::string where = !settings.config.empty()     ? "on the network of CYCLONEDDS_URI"
                            : settings.interface == "lo" ? "on this machine alone"
                                                         : "on " + settings.interface + ", where other machines see it";
  return {dds::open_publisher(settings),
          "dds",
          fmt::format("DDS domain {}, {}", settings.domain, where),
          {{"domain", settings.domain}, {"interface", settings.config.empty() ? settings.interface : "CYCLONEDDS_URI"}}};
}

#if defined(TOFRAY_HAS_VIEW)

Carrier by_foxglove(const Options& options) {
  if (options.stream.domain) refuse_for("--domain", "dds");
  if (!options.stream.interface.empty()) refuse_for("--interface", "dds");
  foxglove::Settings settings{options.view.port, options.view.host, options.view.allowed_hosts, options.stream.allowed_origins,
                              history_of(options)};
  foxglove::Server server = foxglove::open_server(settings);
  if (server.on_all) say("warning: other machines reach the stream, and what it sends is not encrypted\n");
  return {std::move(server.publisher),
          "foxglove",
          fmt::format("open {} in Foxglove or Lichtblick, {}", server.url,
                      server.on_all ? "also from other machines" : "on this machine alone"),
          {{"url", server.url}}};
}

#else

Carrier by_foxglove(const Options&) {
  throw Error(ErrorKind::device,
              "error: this tofray was built without Foxglove's WebSocket: Boost 1.74 or newer was not there\n"
              "  install libboost-dev and build again, or use --to dds");
}

#endif

}  // namespace

Carrier open_carrier(const Options& options) {
  return options.stream.to == Options::Stream::To::foxglove ? by_foxglove(options) : by_dds(options);
}

}  // namespace tofray::app
