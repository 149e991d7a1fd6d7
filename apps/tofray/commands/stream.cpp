// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <thread>

#include "cli/commands.h"
#include "cli/console.h"
#include "cli/remarks.h"
#include "cli/requests.h"
#include "commands/results.h"
#include "commands/stream_camera.h"
#include "commands/stream_carrier.h"
#include "messages/topics.h"
#include "run/input_kind.h"
#include "run/pose_lines.h"
#include "tofray/error.h"

namespace tofray::app {

namespace {

using Steady = std::chrono::steady_clock;
constexpr std::chrono::milliseconds moment(20);  // after which Ctrl-C is looked for

class MachineClock : public stream::Clock {
 public:
  double now_s() override { return std::chrono::duration<double>(Steady::now() - start_).count(); }
  void wait_until(double time_s) override {
    const auto at = start_ + std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(time_s));
    std::this_thread::sleep_until(std::min(at, Steady::now() + moment));
  }

 private:
  Steady::time_point start_ = Steady::now();
};

double processor_time_s() {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec); };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

/// Topics unless asked: what drivers send, and the time.
MessageOptions messages_of(const Options& options, const std::string& name) {
  MessageOptions out = options.messages;
  if (!name.empty()) out.name = name;
  if (!out.topics.empty()) return out;
  out.topics = messages::usual_groups(out.driver);
  std::erase(out.topics, "raw");
  out.topics.emplace_back("clock");
  return out;
}

void refuse_shared_frames(const Options& options) {
  const messages::Profile& profile = messages::profile_of(options.messages.driver);
  if (std::string_view(profile.frames.front()).find("{}") == std::string_view::npos)
    throw Error(ErrorKind::bad_input, fmt::format("error: the driver {} has one frame {} for all cameras, whatever they are called\n"
                                                  "  expected another --driver with several cameras, as plain",
                                                  profile.word, profile.frames.front()));
}

using Cameras = std::vector<std::unique_ptr<StreamedCamera>>;

/// The scene once for each camera; what is odd about it is told once.
Cameras load_cameras(const std::string& scene, const Options& options, FrameProgress& now, Remarks& remarks) {
  auto wanted = options.stream.cameras;
  if (wanted.size() > 1) refuse_shared_frames(options);
  if (wanted.empty()) wanted.emplace_back();
  Cameras out;
  SimulatorOptions simulated = simulator_options(options);
  simulated.progress = &now;
  for (const auto& [name, settings] : wanted) {
    InputRequest request = input_request(scene, options);
    request.set.insert(request.set.end(), settings.begin(), settings.end());
    run::Loaded in = run::load(request);
    if (out.empty()) remarks.tell(in.remarks);
    const Pacing pacing{options.first_frame, options.stream.latency_s, options.stream.drift};
    out.push_back(std::make_unique<StreamedCamera>(std::move(in), messages_of(options, name), simulated, pacing));
  }
  return out;
}

/// 0: without end.
std::uint64_t frames_of(const Options& options, const Cameras& cameras) {
  if (!options.stream.duration_s) return options.frames.value_or(0);
  if (options.frames) throw Error(ErrorKind::bad_input, "error: --frames and --duration both say how long\n  expected one of them");
  const double frames = std::floor(*options.stream.duration_s * cameras.front()->rate_hz() + 1e-6);
  return std::max<std::uint64_t>(static_cast<std::uint64_t>(frames), 1);
}

/// How a stream went.
struct Course {
  std::vector<stream::Account> accounts;
  double seconds = 0, processor_s = 0;
  bool delivered = true;
  int readers = 0;                    ///< subscriptions at the end
  std::optional<double> poses_end_s;  ///< when the last pose from outside is
};

/// @return whether they came
bool wait_for_readers(stream::Publisher& publisher, int readers, const std::atomic<bool>& stop) {
  while (!stop && publisher.readers() < readers) std::this_thread::sleep_for(moment);
  return !stop;
}

double host_time_s() { return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count(); }

/// Poses are of one camera, and their time is its clock.
void refuse_with_poses(const Options& options) {
  if (options.stream.poses.empty()) return;
  const auto refuse_both = [](const char* other, const char* why) {
    throw Error(ErrorKind::bad_input, fmt::format("error: --pose-from and {} together\n  {}", other, why));
  };
  if (options.stream.cameras.size() > 1) refuse_both("several cameras", "the poses are of one camera");
  if (options.stream.latency_s > 0)
    refuse_both("--latency", "frames are sent once poses reach their end, whatever this machine's clock says");
  if (options.stream.drift != 0) refuse_both("--drift", "frames are sent once poses reach their end, whatever this machine's clock says");
}

/// Frames of a camera that is moved from outside: each is made and sent once the poses reach its end, as fast as they come, and none is dropped.
/// The first one is that which starts with the first pose or after it.
stream::Account follow(StreamedCamera& camera, run::PoseLines& poses, const Options& options, std::uint64_t frames,
                       const std::atomic<bool>& stop) {
  stream::Account out;
  if (!poses.reach(-1e300, stop)) return out;
  const double rate_hz = camera.rate_hz(), first = std::ceil(*poses.first_s() * rate_hz - 1e-6);
  std::uint64_t frame = std::max(options.first_frame, first > 0 ? static_cast<std::uint64_t>(first) : 0);
  for (; (frames == 0 || out.sent < frames) && poses.reach(camera.ready_at_s(frame), stop); ++frame) {
    camera.place(poses.between(static_cast<double>(frame) / rate_hz, camera.ready_at_s(frame)));
    camera.make(frame - options.first_frame);
    camera.send();
    ++out.sent;
  }
  return out;
}

Course stream_all(const Cameras& cameras, stream::Publisher& publisher, const Options& options, const std::atomic<bool>& stop) {
  Course out;
  std::vector<stream::Eye*> eyes;
  for (const auto& camera : cameras) camera->prepare(), eyes.push_back(camera.get());
  if (!wait_for_readers(publisher, options.stream.readers, stop)) {
    out.accounts.resize(cameras.size());
    return out;
  }
  MachineClock clock;
  const double epoch_s = host_time_s(), before_s = processor_time_s();
  for (const auto& camera : cameras) camera->begin(options.stream.epoch_now ? std::optional(epoch_s) : std::nullopt);
  if (options.stream.poses.empty()) {
    out.accounts = stream::run(eyes, frames_of(options, cameras), clock, stop);
  } else {
    run::PoseLines poses(options.stream.poses);
    out.accounts = {follow(*cameras.front(), poses, options, frames_of(options, cameras), stop)};
    out.poses_end_s = poses.last_s();
  }
  out.seconds = clock.now_s(), out.processor_s = processor_time_s() - before_s;
  out.readers = publisher.readers();
  constexpr double at_most_s = 5, interrupted_s = 0.3;
  out.delivered = publisher.delivered(stop ? interrupted_s : at_most_s);
  return out;
}

double in_ms(double seconds) { return std::round(1e5 * seconds) / 100; }

files::Json camera_json(const StreamedCamera& camera, const stream::Account& account) {
  return files::Json::object()
      .set("name", camera.options().name)
      .set("camera", camera.inputs().camera.name)
      .set("mode", camera.inputs().camera.mode.name)
      .set("rate_hz", camera.rate_hz())
      .set("sent", account.sent)
      .set("dropped", account.dropped)
      .set("late_p50_ms", in_ms(account.lateness.quantile(0.5)))
      .set("late_p99_ms", in_ms(account.lateness.quantile(0.99)))
      .set("late_max_ms", in_ms(account.lateness.largest_s()));
}

files::Json course_json(const Course& course, const Cameras& cameras, const Outlets& outlets, const Carrier& carrier) {
  files::Json all = files::Json::array(), topics = files::Json::object();
  for (std::size_t i = 0; i < cameras.size(); ++i) all.push(camera_json(*cameras[i], course.accounts[i]));
  for (const auto& [name, type] : outlets.types()) topics.set(name, type);
  files::Json out = files::Json::object();
  for (const auto& [key, value] : carrier.place) out.set(key, value);
  if (course.poses_end_s) out.set("poses_end_s", *course.poses_end_s);
  return out.set("scene", cameras.front()->inputs().scene.name)
      .set("to", carrier.name)
      .set("cameras", std::move(all))
      .set("topics", std::move(topics))
      .set("messages", outlets.messages)
      .set("bytes", outlets.bytes)
      .set("not_sent", outlets.refused)
      .set("readers", course.readers)
      .set("delivered", course.delivered)
      .set("seconds", course.seconds)
      .set("processor_s", course.processor_s);
}

std::string course_text(const Course& course, const Cameras& cameras, const Outlets& outlets) {
  std::string out;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const stream::Account& account = course.accounts[i];
    if (course.poses_end_s) {
      out += fmt::format("{}: {} frame{} in {:.1f} s, by poses up to {:g} s\n", cameras[i]->options().name, account.sent,
                         account.sent == 1 ? "" : "s", course.seconds, *course.poses_end_s);
      continue;
    }
    out +=
        fmt::format("{}: {} frame{} in {:.1f} s, {} dropped; late by {:.1f} ms at most, by {:.1f} ms in 99 % of the frames\n",
                    cameras[i]->options().name.empty() ? "camera" : cameras[i]->options().name, account.sent, account.sent == 1 ? "" : "s",
                    course.seconds, account.dropped, in_ms(account.lateness.largest_s()), in_ms(account.lateness.quantile(0.99)));
  }
  const double processors = course.seconds > 0 ? course.processor_s / course.seconds : 0;
  return out + fmt::format("{} messages, {:.1f} MB; {} subscription{} at the end; {:.2f} processors were busy\n", outlets.messages,
                           1e-6 * static_cast<double>(outlets.bytes), course.readers, course.readers == 1 ? "" : "s", processors);
}

/// What did not go as it should.
void tell_losses(const Course& course, const Cameras& cameras, const Outlets& outlets, const Options& options, Remarks& remarks) {
  std::uint64_t sent = 0, dropped = 0;
  for (const stream::Account& one : course.accounts) sent += one.sent, dropped += one.dropped;
  if (dropped > 0)
    remarks.tell(
        fmt::format("warning: {} of {} frames were dropped: they were not ready when the next ones were due\n  a lower --rate, "
                    "fewer --topics or fewer pixels (camera.readout.binning) help\n",
                    dropped, sent + dropped));
  if (!options.stream.poses.empty() && sent == 0)
    remarks.tell(
        fmt::format("warning: no frame was sent: {}\n  expected lines of t x y z qx qy qz qw for {:g} s and more, which a frame takes\n",
                    course.poses_end_s ? fmt::format("the poses end at {:g} s", *course.poses_end_s) : "there are no poses",
                    1 / cameras.front()->rate_hz()));
  if (outlets.refused > 0)
    remarks.tell(fmt::format("warning: {} messages were not sent to all readers: some were too far behind\n", outlets.refused));
  if (!course.delivered) remarks.tell("warning: not all readers had all of the last messages when the stream ended\n");
}

std::string beginning_text(const Outlets& outlets, const Carrier& carrier, const Options& options) {
  std::string out = fmt::format("{}; {} topics:", carrier.where, outlets.types().size());
  for (const auto& [name, type] : outlets.types()) out += " " + name;
  out += options.stream.readers > 0 ? fmt::format("\n  begins once there are {} subscriptions\n", options.stream.readers) : "\n";
  return out + (options.frames || options.stream.duration_s ? "" : "  Ctrl-C ends it\n");
}

}  // namespace

int run_stream(const Options& options) {
  Remarks remarks;
  refuse_with_poses(options);
  const Carrier carrier = open_carrier(options);
  const NameChoice chosen = choose_scene(options.words[0]);
  remarks.tell(run::note_of(chosen));
  FrameProgress now;
  const Cameras cameras = load_cameras(chosen.name, options, now, remarks);
  say_fallback(options, cameras.front()->ran_on(), remarks);
  const bool bounded = frames_of(options, cameras) > 0;
  Outlets outlets(*carrier.publisher, options.stream.sensor_qos);
  for (const auto& camera : cameras) camera->offer(outlets);
  const Talk talk(options.quiet);
  const StopRequest stop(&now.stop);
  talk(beginning_text(outlets, carrier, options));
  const Course course = stream_all(cameras, *carrier.publisher, options, now.stop);
  tell_losses(course, cameras, outlets, options, remarks);
  const bool interrupted = stop.signal() != 0 && bounded;
  if (options.json)
    print(files::json_text(remarks.put(course_json(course, cameras, outlets, carrier).set("interrupted", interrupted)), 2) + "\n");
  else
    talk(course_text(course, cameras, outlets));
  return interrupted ? 128 + stop.signal() : 0;
}

}  // namespace tofray::app
