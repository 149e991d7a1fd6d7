// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cli/options.h"
#include "run/inputs.h"
#include "stream/pace.h"
#include "stream/publisher.h"
#include "tofray/messages.h"
#include "tofray/simulator.h"

namespace tofray::app {

/// Topics that are offered, by name: cameras of one scene share some of them.
class Outlets {
 public:
  Outlets(stream::Publisher& publisher, bool sensor_qos) : publisher_(publisher), sensor_qos_(sensor_qos) {}
  /// @return whether it was not there yet
  bool offer(const Topic& topic);
  void send(const Topic& topic, const Message& message);
  [[nodiscard]] const std::map<std::string, std::string>& types() const { return types_; }

  std::uint64_t messages = 0, bytes = 0;  ///< that were sent
  std::uint64_t refused = 0;              ///< that were not, because readers were behind

 private:
  stream::Publisher& publisher_;
  bool sensor_qos_;
  std::map<std::string, int> numbers_;
  std::map<std::string, std::string> types_;
};

/// What of the camera's time becomes when.
struct Pacing {
  std::uint64_t first_frame = 0;
  double latency_s = 0;
  double drift = 0;  ///< by how much the camera's clock is fast, as a share
};

/// A camera of a scene: its frames as messages.
class StreamedCamera : public stream::Eye {
 public:
  /// @throws Error as Simulator and Messages
  StreamedCamera(run::Loaded in, const MessageOptions& messages, const SimulatorOptions& options, const Pacing& pacing);

  void offer(Outlets& outlets);
  /// Simulates the first frame, which may take longer than others.
  void prepare();
  /// When the camera could send a frame, by its own clock [s].
  [[nodiscard]] double ready_at_s(std::uint64_t frame) const;
  /// Where the camera is in the frames that follow, in the place of where the scene has it.
  void place(std::vector<CameraKeyframe> keyframes);
  /// @param epoch_s  of all stamps, where they are not what was asked for
  void begin(std::optional<double> epoch_s);

  [[nodiscard]] double due_s(std::uint64_t frame) const override;
  void make(std::uint64_t frame) override;
  void send() override;

  [[nodiscard]] const run::Loaded& inputs() const { return in_; }
  [[nodiscard]] const MessageOptions& options() const { return messages_.options(); }
  [[nodiscard]] RanOn ran_on() const { return simulator_.ran_on(); }
  [[nodiscard]] double rate_hz() const { return in_.camera.mode.frame_rate_hz; }

 private:
  void simulate(std::uint64_t frame);

  run::Loaded in_;
  Messages messages_;
  Simulator simulator_;
  Pacing pacing_;
  Outlets* outlets_ = nullptr;
  bool owns_clock_ = true;  ///< of several cameras the first one sends /clock
  Frame frame_;
  std::optional<std::uint64_t> simulated_;  ///< which one that is
  FrameRequest request_;                    ///< where the camera is placed
  double ready_s_ = 0;                      ///< from a frame's start until a camera could send it
  bool said_static_ = false;
  std::vector<Message> made_;
};

}  // namespace tofray::app
