// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/session.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "base/text.h"
#include "base/version.h"
#include "pictures/pictures.h"
#include "pixel_report.h"
#include "remarks.h"
#include "requests.h"
#include "results/file_arrays.h"
#include "results/frame_file.h"
#include "results/meta.h"
#include "run/file_pixel.h"
#include "tofray/error.h"
#include "view/scales.h"
#include "view/state.h"
#include "view/wire.h"

namespace tofray::view {

namespace {

using Clock = std::chrono::steady_clock;
using files::Json;

/// A frame with all its arrays, and what `inspect` makes of it.
struct Whole {
  std::uint32_t generation = 0;
  std::uint64_t index = 0;
  Frame frame;
  std::optional<results::Arrays> arrays;
};

/// A simulator and the arrays that it computes.
struct Simulating {
  std::uint32_t generation = 0;
  std::vector<std::uint16_t> arrays;  ///< empty: all
  std::optional<Simulator> simulator;
};

std::vector<std::uint16_t> joined(const std::vector<std::vector<std::uint16_t>>& wants) {
  std::vector<std::uint16_t> all;
  for (const auto& one : wants) all.insert(all.end(), one.begin(), one.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool has_transient(const std::vector<std::uint16_t>& arrays) {
  return std::any_of(arrays.begin(), arrays.end(),
                     [](std::uint16_t one) { return std::string_view(wire_arrays()[one].name).starts_with("transient_"); });
}

/// Calls `work`; what it throws becomes a text.
template <class Work>
std::optional<std::string> fault_of(const Work& work) {
  try {
    work();
    return {};
  } catch (const Error& error) {
    return error.what();
  } catch (const std::bad_alloc&) {
    return "error: out of memory";
  } catch (const std::exception& error) {
    return std::string("error: unexpected: ") + error.what();
  }
}

}  // namespace

/// What waits for the thread.
struct Session::Mail {
  struct Change {
    std::uint64_t client;
    Edit edit;
  };
  std::vector<Change> edits;                    ///< of each key the last one
  std::vector<std::uint64_t> joined;            ///< who wants a greeting
  std::map<std::uint64_t, Question> questions;  ///< by page
  std::vector<std::pair<std::uint64_t, std::string>> fits;
  std::optional<bool> playing;
  std::optional<std::uint64_t> frame;
  bool again = false, stop = false;
  [[nodiscard]] bool empty() const {
    return edits.empty() && joined.empty() && questions.empty() && fits.empty() && !playing && !frame && !again && !stop;
  }
};

class Session::Impl {
 public:
  Impl(const app::Options& options, bool test_hooks, std::string build)
      : state_(first_state(options)), test_hooks_(test_hooks), build_(std::move(build)) {
    // What cannot be simulated at all is told before there is an address.
    simulator_of(whole_, {});
  }

  void run(Outbox& outbox);
  /// @param put  puts something into the mailbox; @return whether the frame under way is no longer wanted
  template <class Put>
  void post(const Put& put) {
    const std::lock_guard lock(mutex_);
    if (put(mail_, demand_)) interrupt();
    changed_.notify_all();
  }
  bool ended(std::chrono::milliseconds within) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, within, [this] { return ended_; });
  }
  void stop() {
    const std::lock_guard lock(mutex_);
    mail_.stop = true, progress_.stop = true;
    changed_.notify_all();
  }
  [[nodiscard]] std::string warnings() const { return app::texts(state_.in.remarks); }

  std::thread thread;

 private:
  /// Gives up the frame under way, but not two in a row: who drags a slider sees some of it on the way.
  void interrupt() {
    if (computing_ && !interrupted_before_) progress_.stop = true;
  }
  Mail wait();
  void work(Mail mail);
  void change(const std::vector<Mail::Change>& changes);
  bool due(const Demand& demand, Clock::time_point now) const;
  void show();
  Simulator& simulator_of(Simulating& of, const std::vector<std::uint16_t>& arrays);
  bool computed(Simulating& of, const std::vector<std::uint16_t>& arrays, std::uint64_t index, Frame& into);
  const Whole* whole(std::uint64_t index);
  const results::Arrays& arrays_of_whole();
  bool ready_to_greet();
  void greet(const std::vector<std::uint64_t>& clients);
  std::string hello() const;
  void answer(const Question& question);
  void fit(std::uint64_t client, const std::string& array);
  void tell_fault_to_all(const std::string& text) { out_->tell_all(fault_text({}, text)); }
  void restart_clock() { next_ = Clock::now() + period(demand_now_); }
  [[nodiscard]] Clock::duration period(const Demand& demand) const {
    return demand.rate_hz < 1e9 && demand.rate_hz > 0
               ? std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1 / demand.rate_hz))
               : Clock::duration::zero();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  // guarded by it:
  Mail mail_;
  Demand demand_;
  bool computing_ = false, interrupted_before_ = false, ended_ = false;

  FrameProgress progress_;
  // of the thread alone:
  State state_;
  bool test_hooks_;
  std::string build_;
  Outbox* out_ = nullptr;
  Demand demand_now_;
  Simulating live_, whole_;
  std::optional<Whole> last_;
  Frame frame_;
  std::vector<std::pair<std::string, Json>> scales_;  ///< by array, locked since the first frame or the last fit
  std::vector<Pane> panes_;
  bool shown_ = false;   ///< the frame of the state has been published
  bool at_once_ = true;  ///< the next one answers a change
  Clock::time_point next_ = Clock::now();
  std::uint32_t sequence_ = 0;
  SessionCounts counts_;
};

Session::Mail Session::Impl::wait() {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (!mail_.empty() || due(demand_, Clock::now())) break;
    const bool clocked = demand_.ready && shown_ && state_.playing;
    if (clocked)
      changed_.wait_until(lock, next_);
    else
      changed_.wait(lock);
  }
  demand_now_ = demand_;
  return std::exchange(mail_, Mail());
}

/// Whether a frame is to be computed now: somebody looks, and it is a new one.
bool Session::Impl::due(const Demand& demand, Clock::time_point now) const {
  return demand.ready && !demand.wants.empty() && (!shown_ || (state_.playing && now >= next_));
}

void Session::Impl::run(Outbox& outbox) {
  out_ = &outbox;
  outbox.own_rate(state_.in.camera.mode.frame_rate_hz);
  for (;;) {
    Mail mail = wait();
    if (mail.stop) break;
    if (const auto fault = fault_of([&] { work(std::move(mail)); })) {
      shown_ = true, state_.playing = false;  // until something changes
      tell_fault_to_all(*fault);
      outbox.tell_all(state_text(state_));
    }
  }
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

void Session::Impl::work(Mail mail) {
  if (!mail.edits.empty()) change(mail.edits);
  if (mail.frame && *mail.frame != state_.frame) state_.frame = *mail.frame, shown_ = false, at_once_ = true;
  if (mail.playing) state_.playing = *mail.playing, restart_clock();
  if (mail.again) shown_ = false, at_once_ = true;
  if (mail.frame || mail.playing) out_->tell_all(state_text(state_));
  if (!mail.joined.empty()) greet(mail.joined);
  for (const auto& [client, array] : mail.fits) fit(client, array);
  for (const auto& [client, question] : mail.questions) answer(question);
  if (due(demand_now_, Clock::now())) show();
}

void Session::Impl::greet(const std::vector<std::uint64_t>& clients) {
  if (!ready_to_greet()) {  // the frame was given up for something newer
    post([&](Mail& later, Demand&) { return later.joined.insert(later.joined.end(), clients.begin(), clients.end()), false; });
    return;
  }
  for (const std::uint64_t one : clients) out_->greet(one, hello());
}

void Session::Impl::change(const std::vector<Mail::Change>& changes) {
  bool any = false;
  for (const Mail::Change& one : changes) {
    const auto fault = fault_of([&] {
      State next = changed(state_, one.edit);
      // What is good by itself may not go together: asked before the old state goes.
      Simulating fresh;
      const std::vector<std::uint16_t> arrays = joined(demand_now_.wants);
      std::swap(next, state_);
      try {
        simulator_of(fresh, arrays);
      } catch (...) {
        std::swap(next, state_);
        throw;
      }
      (arrays.empty() ? whole_ : live_) = std::move(fresh);
      any = true;
    });
    if (fault) out_->tell(one.client, fault_text(one.edit.id, *fault));
  }
  if (!any) return;
  shown_ = false, at_once_ = true;
  out_->own_rate(state_.in.camera.mode.frame_rate_hz);
  out_->tell_all(state_text(state_));
}

/// The simulator of the state, with these arrays; with all of them where none is named.
Simulator& Session::Impl::simulator_of(Simulating& of, const std::vector<std::uint16_t>& arrays) {
  if (of.simulator && of.generation == state_.generation && of.arrays == arrays) return *of.simulator;
  SimulatorOptions wanted = app::simulator_options(state_.options);
  wanted.arrays = sources_of(arrays);
  wanted.progress = &progress_;
  const bool without_transient = !arrays.empty() && !has_transient(arrays) && state_.in.scene.transport.transient.bins > 0;
  of.simulator.reset();
  if (without_transient) {
    Scene scene = state_.in.scene;
    scene.transport.transient = {};
    of.simulator.emplace(scene, state_.in.camera, wanted);
  } else {
    of.simulator.emplace(state_.in.scene, state_.in.camera, wanted);
  }
  of.generation = state_.generation, of.arrays = arrays;
  return *of.simulator;
}

/// @return whether the frame came to its end
bool Session::Impl::computed(Simulating& of, const std::vector<std::uint16_t>& arrays, std::uint64_t index, Frame& into) {
  Simulator& simulator = simulator_of(of, arrays);
  {
    const std::lock_guard lock(mutex_);
    if (mail_.stop) return false;
    computing_ = true, progress_.stop = false;
  }
  const Clock::time_point start = Clock::now();
  const auto fault = fault_of([&] { simulator.frame(index, into); });
  counts_.compute_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  const std::lock_guard lock(mutex_);
  computing_ = false, interrupted_before_ = progress_.stop;
  if (fault) throw Error(ErrorKind::bug, *fault);
  if (!progress_.stop) ++counts_.computed;
  return !progress_.stop;
}

/// The frame that is due, computed and handed over.
void Session::Impl::show() {
  const bool tick = shown_;
  const std::uint64_t index = state_.frame + (tick ? 1 : 0);
  if (!computed(live_, joined(demand_now_.wants), index, frame_)) return;
  state_.frame = index, shown_ = true;
  const Clock::time_point now = Clock::now();
  next_ = tick ? std::max(next_ + period(demand_now_), now) : now + period(demand_now_);
  auto published = std::make_shared<Published>();
  published->generation = state_.generation, published->sequence = ++sequence_, published->frame = index;
  published->at_once = !tick && at_once_;
  const double hz = state_.in.camera.mode.frame_rate_hz;
  const WireHead head{
      0, 0, state_.generation, sequence_, hz > 0 ? static_cast<double>(index) / hz : 0, static_cast<float>(counts_.compute_ms)};
  for (const auto& want : demand_now_.wants)
    published->messages.emplace_back(want, std::make_shared<const std::string>(encoded(head, frame_, want)));
  at_once_ = false;
  out_->publish(std::move(published), counts_);
}

/// A frame of the state with all its arrays; null where it was given up.
const Whole* Session::Impl::whole(std::uint64_t index) {
  if (last_ && last_->generation == state_.generation && last_->index == index) return &*last_;
  Whole fresh;
  if (last_) fresh.frame = std::move(last_->frame);
  last_.reset();
  if (!computed(whole_, {}, index, fresh.frame)) return nullptr;
  fresh.generation = state_.generation, fresh.index = index;
  return &last_.emplace(std::move(fresh));
}

const results::Arrays& Session::Impl::arrays_of_whole() {
  Whole& of = *last_;
  if (!of.arrays) {
    const run::Loaded& in = state_.in;
    const std::string meta = results::frame_meta(in.scene, in.camera, app::simulator_options(state_.options), of.index);
    const std::string& name = state_.options.words[0];
    of.arrays.emplace(
        files::parse_npz(results::frame_npz_bytes(of.frame, in.camera, camera_pose(in.scene, of.frame.truth.time_s), meta), name), name);
  }
  return *of.arrays;
}

/// The ranges of colours are those of the first frame that anybody saw. @return whether it came to its end
bool Session::Impl::ready_to_greet() {
  if (!panes_.empty()) return true;
  const Whole* first = whole(state_.frame);
  if (first == nullptr) return false;
  panes_ = panes_of(first->frame);
  for (const Pane& one : panes_) scales_.emplace_back(one.array, *scale_json(first->frame, one.array));
  return true;
}

std::string Session::Impl::hello() const {
  Json arrays = Json::array(), panes = Json::array();
  for (const WireArray& one : wire_arrays()) {
    Json json = Json::object();
    json.set("name", one.name).set("unit", one.unit).set("what", one.what).set("dtype", one.type);
    arrays.push(std::move(json.set("shape", shape_name(one.shape))));
  }
  for (std::size_t i = 0; i < panes_.size(); ++i)
    panes.push(Json::object().set("array", panes_[i].array).set("title", panes_[i].title).set("scale", scales_[i].second));
  Json json = Json::object();
  json.set("type", "hello").set("protocol", 1).set("version", base::version()).set("build", build_);
  put_camera(json, state_);
  json.set("arrays", std::move(arrays)).set("panes", std::move(panes)).set("palettes", palettes_json());
  json.set("invalid", invalid_json()).set("invalid_color", invalid_color_json()).set("command", command_of(state_));
  json.set("generation", state_.generation).set("playing", state_.playing).set("frame", state_.frame);
  json.set("seed", state_.options.seed.value_or(0));
  Json overrides = Json::array();
  for (const auto& [key, value] : state_.options.set) overrides.push(Json::array().push(key).push(value));
  json.set("overrides", std::move(overrides));
  if (test_hooks_) json.set("test_hooks", true);
  return files::json_text(json);
}

void Session::Impl::answer(const Question& question) {
  const PixelQuestion& asked = question.pixel;
  const std::uint64_t index = question.generation == state_.generation ? question.frame : state_.frame;
  const auto fault = fault_of([&] {
    const Whole* of = whole(index);
    if (of == nullptr)  // it comes again, unless a newer one does
      return post([&](Mail& later, Demand&) { return later.questions.emplace(question.client, question), false; });
    const results::Arrays& arrays = arrays_of_whole();
    const PixelChain chain = run::pixel_chain(arrays, asked.u, asked.v);
    run::FrameOrigin origin;
    origin.in = state_.in, origin.simulated = app::simulator_options(state_.options);
    const std::size_t pixel = static_cast<std::size_t>(asked.v) * arrays.width() + static_cast<std::size_t>(asked.u);
    Json values = Json::array();
    for (std::uint16_t i = 0; i < wire_arrays().size(); ++i) {
      const std::vector<double> numbers = pixel_values(of->frame, i, pixel);
      if (numbers.empty()) continue;
      const WireArray& array = wire_arrays()[i];
      Json value = array.shape == ArrayShape::image ? Json(numbers[0]) : Json::list(numbers);
      values.push(Json::object().set("name", array.name).set("unit", array.unit).set("value", std::move(value)));
    }
    const pictures::FlagRow* const reason = pictures::invalid_reason(of->frame.depth.flags[pixel]);
    Json json = Json::object();
    json.set("type", "pixel").set("id", asked.id).set("u", asked.u).set("v", asked.v);
    json.set("generation", state_.generation).set("frame", index);
    json.set("report", app::pixel_json(arrays, chain, run::pixel_bounces(arrays, origin, asked.u, asked.v)));
    json.set("values", std::move(values)).set("why", reason == nullptr ? "" : reason->words);
    out_->tell(question.client, files::json_text(json));
  });
  if (fault) out_->tell(question.client, fault_text(asked.id, *fault));
}

void Session::Impl::fit(std::uint64_t client, const std::string& array) {
  const auto fault = fault_of([&] {
    const auto found = std::find_if(scales_.begin(), scales_.end(), [&](const auto& one) { return one.first == array; });
    const Whole* of = found == scales_.end() ? nullptr : whole(state_.frame);
    if (found == scales_.end() || found->second.is_null())
      throw Error(ErrorKind::bad_input, "error: no pane has a range of colours for " + base::in_quotes(array));
    if (of == nullptr) return;
    found->second = *scale_json(of->frame, array);
    out_->tell_all(files::json_text(Json::object().set("type", "scale").set("array", array).set("scale", found->second)));
  });
  if (fault) out_->tell(client, fault_text({}, *fault));
}

Session::Session(app::Options options, bool test_hooks, std::string build)
    : impl_(std::make_unique<Impl>(options, test_hooks, std::move(build))) {}

Session::~Session() {
  stop();
  if (impl_->thread.joinable()) impl_->thread.join();
}

void Session::start(Outbox& outbox) {
  impl_->thread = std::thread([this, &outbox] { impl_->run(outbox); });
}

void Session::stop() { impl_->stop(); }

bool Session::ended(std::chrono::milliseconds within) { return impl_->ended(within); }

std::string Session::warnings() const { return impl_->warnings(); }

void Session::demand(Demand demand, bool again) {
  impl_->post([&](Mail& mail, Demand& now) {
    now = std::move(demand), mail.again = mail.again || again;
    return false;
  });
}

void Session::join(std::uint64_t client) {
  impl_->post([&](Mail& mail, Demand&) { return mail.joined.push_back(client), false; });
}

void Session::edit(std::uint64_t client, Edit edit) {
  impl_->post([&](Mail& mail, Demand&) {
    std::erase_if(mail.edits, [&](const Mail::Change& one) { return one.edit.key == edit.key; });
    mail.edits.push_back({client, std::move(edit)});
    return true;
  });
}

void Session::play(bool playing) {
  impl_->post([&](Mail& mail, Demand&) { return mail.playing = playing, false; });
}

void Session::seek(std::uint64_t frame) {
  impl_->post([&](Mail& mail, Demand&) { return mail.frame = frame, true; });
}

void Session::ask(const Question& question) {
  impl_->post([&](Mail& mail, Demand&) { return mail.questions[question.client] = question, false; });
}

void Session::fit(std::uint64_t client, std::string array) {
  impl_->post([&](Mail& mail, Demand&) {
    std::erase_if(mail.fits, [&](const auto& one) { return one.second == array; });
    mail.fits.emplace_back(client, std::move(array));
    return false;
  });
}

}  // namespace tofray::view
