// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "commands/stream_camera.h"

#include "messages/type_hash.h"

namespace tofray::app {

namespace {

constexpr const char* clock_topic = "/clock";

SimulatorOptions for_messages(SimulatorOptions options, const Messages& messages) {
  options.arrays = messages.arrays();
  return options;
}

Scene without_histograms(Scene scene) {
  scene.transport.transient = {};
  return scene;
}

}  // namespace

bool Outlets::offer(const Topic& topic) {
  if (numbers_.contains(topic.name)) return false;
  const bool lasting = !sensor_qos_ || !topic.type.starts_with("sensor_msgs/");
  numbers_[topic.name] = publisher_.offer({topic.name, topic.type, messages::type_hash(topic.type), lasting});
  types_[topic.name] = topic.type;
  return true;
}

void Outlets::send(const Topic& topic, const Message& message) {
  if (!publisher_.send(numbers_.at(topic.name), message.data, message.publish_ns)) {
    ++refused;
    return;
  }
  ++messages, bytes += message.data.size();
}

StreamedCamera::StreamedCamera(run::Loaded in, const MessageOptions& messages, const SimulatorOptions& options, const Pacing& pacing)
    : in_(std::move(in)),
      messages_(in_.scene, in_.camera, messages),
      simulator_(without_histograms(in_.scene), in_.camera, for_messages(options, messages_)),
      pacing_(pacing) {}

void StreamedCamera::offer(Outlets& outlets) {
  outlets_ = &outlets;
  for (const Topic& topic : messages_.topics()) {
    const bool is_new = outlets.offer(topic);
    if (topic.name == clock_topic) owns_clock_ = is_new;
  }
}

void StreamedCamera::simulate(std::uint64_t frame) {
  if (simulated_ == frame) return;
  request_.index = frame;
  if (request_.camera.empty())
    simulator_.frame(frame, frame_);
  else
    simulator_.frame(request_, frame_);
  simulated_ = frame;
}

void StreamedCamera::place(std::vector<CameraKeyframe> keyframes) {
  request_.camera = std::move(keyframes);
  simulated_.reset();
}

void StreamedCamera::prepare() {
  simulate(pacing_.first_frame);
  const Message first = messages_.of(frame_).front();
  const double start_s = static_cast<double>(pacing_.first_frame) / rate_hz();
  ready_s_ = 1e-9 * static_cast<double>(first.publish_ns) - messages_.options().epoch_s - start_s;
}

void StreamedCamera::begin(std::optional<double> epoch_s) {
  if (!epoch_s) return;
  MessageOptions options = messages_.options();
  options.epoch_s = *epoch_s - static_cast<double>(pacing_.first_frame) / rate_hz();
  messages_ = Messages(in_.scene, in_.camera, options);
}

double StreamedCamera::ready_at_s(std::uint64_t frame) const { return static_cast<double>(frame) / rate_hz() + ready_s_; }

double StreamedCamera::due_s(std::uint64_t frame) const { return ready_at_s(frame) / (1 + pacing_.drift) + pacing_.latency_s; }

void StreamedCamera::make(std::uint64_t frame) {
  simulate(pacing_.first_frame + frame);
  messages_.of(frame_, request_.camera.empty() ? in_.scene : placed_scene(in_.scene, in_.camera, request_), made_);
}

void StreamedCamera::send() {
  const std::vector<Topic>& topics = messages_.topics();
  if (!said_static_)
    for (const Message& one : messages_.before(frame_)) outlets_->send(topics[one.topic], one);
  said_static_ = true;
  for (const Message& one : made_)
    if (owns_clock_ || topics[one.topic].name != clock_topic) outlets_->send(topics[one.topic], one);
}

}  // namespace tofray::app
