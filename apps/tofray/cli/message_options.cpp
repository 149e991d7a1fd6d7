// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "cli/option_values.h"

#include "messages/topics.h"
#include "run/manifest.h"

namespace tofray::app {

std::vector<OptionSpec> message_specs() {
  return {
      {"--driver", 0, "NAME", "whose topics and frames: plain, pmd, pico_flexx, ifm, k4a, realsense (plain)",
       [](Options& o, const std::string& v) { o.messages.driver = static_cast<Driver>(word_of("--driver", v, run::driver_words())); },
       "plain pmd pico_flexx ifm k4a realsense"},
      {"--topics", 0, "LIST",
       "out of depth, amplitude, noise, confidence, points, raw, rectified, truth, clock; with \",\" between (what the driver has, and "
       "raw)",
       [](Options& o, const std::string& v) {
         for (const std::string& group : split(v, ',')) {
           (void)word_of("--topics", group, messages::topic_groups());
           o.messages.topics.push_back(group);
         }
       },
       "depth amplitude noise confidence points raw rectified truth clock", true},
      {"--camera-name", 0, "NAME", "first part of topics and frames (the driver's, or camera)",
       [](Options& o, const std::string& v) { o.messages.name = v; }},
      {"--stamp", 0, "WHEN", "start, middle or end of a frame's exposures (middle)",
       [](Options& o, const std::string& v) { o.messages.stamp = static_cast<StampAt>(word_of("--stamp", v, run::stamp_words())); },
       "start middle end"},
      {"--epoch", 0, "S", "seconds since 1970 at the simulation's time 0 (0)",
       [](Options& o, const std::string& v) {
         o.messages.epoch_s = number_of("--epoch", v, 0, 2e9, "seconds, 0 to 2e9, as in --epoch 1.7e9");
       }},
      {"--depth-encoding", 0, "NAME", "32FC1 (m, NaN: invalid) or 16UC1 (mm, 0: invalid) (the driver's)",
       [](Options& o, const std::string& v) {
         static const std::vector<std::string> all = {"32FC1", "16UC1"};
         o.messages.depth_encoding = all[word_of("--depth-encoding", v, all)];
       },
       "32FC1 16UC1"},
      {"--amplitude-step", 0, "E", "electrons of 1 in mono16 (the least power of two at which nothing clips)",
       [](Options& o, const std::string& v) {
         o.messages.amplitude_step_e = number_of("--amplitude-step", v, 1e-9, 1e9, "electrons, 1e-9 to 1e9, as in --amplitude-step 0.5");
       }},
      {"--unorganized", 0, nullptr, "clouds of the valid points alone, in one row",
       [](Options& o, const std::string&) { o.messages.unorganized = true; }},
      {"--mcap-compression", 0, "NAME", "zstd, or none: larger and faster (zstd)",
       [](Options& o, const std::string& v) {
         static const std::vector<std::string> all = {"none", "zstd"};
         o.mcap_compression = word_of("--mcap-compression", v, all) == 0 ? McapCompression::none : McapCompression::zstd;
       },
       "none zstd"},
  };
}

}  // namespace tofray::app
