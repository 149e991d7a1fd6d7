// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/session.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "base/text.h"
#include "base/version.h"
#include "cli/remarks.h"
#include "cli/requests.h"
#include "commands/pixel_report.h"
#include "pictures/pictures.h"
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
    std::vector<std::uint64_t> earlier;  ///< numbers of the page's messages that this one came in place of
  };
  struct Asked {
    std::uint64_t client;
    Query query;
  };
  std::vector<Change> edits;
  std::vector<std::uint64_t> joined;            ///< who wants a greeting
  std::map<std::uint64_t, Question> questions;  ///< by page
  std::vector<std::pair<std::uint64_t, std::string>> fits;
  std::vector<Asked> queries;  ///< of each page and kind the last one
  std::optional<bool> playing;
  std::optional<std::uint64_t> frame;
  bool again = false, stop = false;
  [[nodiscard]] bool empty() const {
    return edits.empty() && joined.empty() && questions.empty() && fits.empty() && queries.empty() && !playing && !frame && !again && !stop;
  }
  /// Whether the frame under way is no longer the one that is wanted.
  [[nodiscard]] bool outdates() const { return !edits.empty() || frame.has_value(); }

  /// Whether a page's later change says all that its earlier one did.
  static bool replaces(const Edit& later, const Edit& earlier) {
    using Kind = Edit::Kind;
    const bool one_key = later.kind == Kind::set && earlier.kind == Kind::set && later.key == earlier.key;
    const bool one_kind = later.kind == earlier.kind && (later.kind == Kind::seed || (later.kind == Kind::state && later.seed));
    return later.side == earlier.side && (one_key || one_kind);
  }
  /// In the place of an earlier one where nothing else lies between that it could depend on; otherwise at the end.
  void add(std::uint64_t client, Edit&& edit) {
    constexpr std::size_t most_earlier = 10'000;
    for (auto one = edits.rbegin(); one != edits.rend(); ++one) {
      if (one->client != client) break;
      if (replaces(edit, one->edit)) {
        if (one->earlier.size() < most_earlier) one->earlier.push_back(one->edit.id);
        one->edit = std::move(edit);
        return;
      }
      if (one->edit.kind != Edit::Kind::set || edit.kind != Edit::Kind::set) break;
    }
    edits.push_back({client, std::move(edit), {}});
  }
};

/// A state, what computes it, and how far that has come.
struct SideOfSession {
  Side side;
  State state;
  Simulating live, whole, draft;
  std::optional<Whole> last;
  Frame frame, draft_frame;
  std::uint32_t sequence = 0;
  bool shown = false;    ///< the frame of the state has been published
  bool drafted = false;  ///< … or a draft of it
  /// How long a frame takes; a draft comes before a long one.
  double frame_ms = std::numeric_limits<double>::infinity();
};

class Session::Impl {
 public:
  Impl(const app::Options& options, bool test_hooks, std::string build) : test_hooks_(test_hooks), build_(std::move(build)) {
    a_.side = Side::a, a_.state = first_state(options);
    // What cannot be simulated at all is told before there is an address.
    simulator_of(a_.whole, a_.state, {});
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
  [[nodiscard]] std::string warnings() const { return app::texts(a_.state.in.remarks); }

  std::thread thread;

 private:
  /// A frame is given up for a newer one, but not two in a row, drafts counted: who drags a slider sees some of it on the way.
  [[nodiscard]] bool may_give_up() const { return !interrupted_before_; }
  void interrupt() {
    if (computing_ && may_give_up()) progress_.stop = true;
  }
  Mail wait();
  void work(Mail mail);
  void change(const std::vector<Mail::Change>& changes);
  void make(const Edit& edit);
  void close_other();
  [[nodiscard]] bool all_shown() const { return a_.shown && (!b_ || b_->shown); }
  [[nodiscard]] bool playing() const { return a_.state.playing; }
  void show_again() {
    for (SideOfSession* one : sides()) one->shown = one->drafted = false;
    at_once_ = true;
  }
  [[nodiscard]] std::vector<SideOfSession*> sides() {
    std::vector<SideOfSession*> all{&a_};
    if (b_) all.push_back(&*b_);
    return all;
  }
  /// @throws Error where there is no side B
  SideOfSession& side(Side which);
  void set_frame(std::uint64_t index) {
    for (SideOfSession* one : sides()) one->state.frame = index;
  }
  void tell_state() { out_->tell_all(state_text(a_.state, b_ ? &b_->state : nullptr)); }
  bool due(const Demand& demand, Clock::time_point now) const;
  void show();
  bool show(SideOfSession& of);
  void publish(SideOfSession& of, const Frame& frame, bool draft);
  Simulator& simulator_of(Simulating& of, const State& state, const std::vector<std::uint16_t>& arrays, bool draft = false);
  bool computed(Simulating& of, const State& state, const std::vector<std::uint16_t>& arrays, Frame& into, double& took_ms,
                std::uint64_t index, bool draft = false);
  const Whole* whole(SideOfSession& of, std::uint64_t index);
  const results::Arrays& arrays_of_whole(SideOfSession& of);
  bool ready_to_greet();
  void greet(const std::vector<std::uint64_t>& clients);
  std::string hello() const;
  void answer(const Question& question);
  void answer(const Mail::Asked& asked);
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
  SideOfSession a_;
  std::optional<SideOfSession> b_;
  std::uint32_t generations_of_b_ = 0;
  bool test_hooks_;
  std::string build_;
  Outbox* out_ = nullptr;
  Demand demand_now_;
  std::vector<std::pair<std::string, Json>> scales_;  ///< by array, locked since the first frame or the last fit
  std::vector<Pane> panes_;
  bool at_once_ = true;  ///< the next frame answers a change
  Clock::time_point next_ = Clock::now();
  SessionCounts counts_;
};

Session::Mail Session::Impl::wait() {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (!mail_.empty() || due(demand_, Clock::now())) break;
    const bool clocked = demand_.ready && all_shown() && playing();
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
  return demand.ready && !demand.wants.empty() && (!all_shown() || (playing() && now >= next_));
}

void Session::Impl::run(Outbox& outbox) {
  out_ = &outbox;
  outbox.own_rate(a_.state.in.camera.mode.frame_rate_hz);
  for (;;) {
    Mail mail = wait();
    if (mail.stop) break;
    if (const auto fault = fault_of([&] { work(std::move(mail)); })) {
      for (SideOfSession* one : sides()) one->shown = true, one->state.playing = false;  // until something changes
      tell_fault_to_all(*fault);
      tell_state();
    }
  }
  const std::lock_guard lock(mutex_);
  ended_ = true;
  changed_.notify_all();
}

void Session::Impl::work(Mail mail) {
  if (!mail.edits.empty()) change(mail.edits);
  if (mail.frame && *mail.frame != a_.state.frame) set_frame(*mail.frame), show_again();
  if (mail.playing) {
    for (SideOfSession* one : sides()) one->state.playing = *mail.playing;
    restart_clock();
  }
  if (mail.again) show_again();
  if (mail.frame || mail.playing) tell_state();
  if (!mail.joined.empty()) greet(mail.joined);
  for (const auto& [client, array] : mail.fits) fit(client, array);
  for (const auto& [client, question] : mail.questions) answer(question);
  for (const Mail::Asked& one : mail.queries) answer(one);
  if (due(demand_now_, Clock::now())) show();
}

void Session::Impl::greet(const std::vector<std::uint64_t>& clients) {
  if (!ready_to_greet()) {  // the frame was given up for something newer
    post([&](Mail& later, Demand&) { return later.joined.insert(later.joined.end(), clients.begin(), clients.end()), false; });
    return;
  }
  for (const std::uint64_t one : clients) out_->greet(one, hello());
}

SideOfSession& Session::Impl::side(Side which) {
  if (which == Side::a) return a_;
  if (!b_) throw Error(ErrorKind::bad_input, "error: there is no side B\n  expected a message `other` first, which opens it");
  return *b_;
}

/// The key that a fault in a list of --set names; empty where it names none.
std::string key_in(const std::string& fault) {
  constexpr std::string_view before = "--set ";
  if (!fault.starts_with(before)) return {};
  return fault.substr(before.size(), std::min(fault.find(": error"), fault.size()) - before.size());
}

/// @throws Error where the state is wrong; then all is as it was
void Session::Impl::make(const Edit& edit) {
  if (edit.kind == Edit::Kind::close) return close_other();
  const bool opens = edit.kind == Edit::Kind::open;
  const std::uint32_t generation = opens || edit.side == Side::b ? generations_of_b_ + 1 : a_.state.generation + 1;
  State next = opens ? opened(a_.state, edit, generation) : changed(side(edit.side).state, edit);
  next.generation = generation;
  // What is good by itself may not go together: asked before the old state goes.
  Simulating fresh;
  const std::vector<std::uint16_t> arrays = joined(demand_now_.wants);
  simulator_of(fresh, next, arrays);
  if (opens) {
    b_.emplace().side = Side::b;
    out_->other(true);
  }
  SideOfSession& of = side(edit.side);
  of.state = std::move(next);
  (arrays.empty() ? of.whole : of.live) = std::move(fresh);
  of.shown = of.drafted = false, at_once_ = true;
  if (of.side == Side::b) generations_of_b_ = generation;
}

void Session::Impl::close_other() {
  if (!b_) return;
  b_.reset();
  out_->other(false);
}

void Session::Impl::change(const std::vector<Mail::Change>& changes) {
  struct Done {
    std::uint64_t client, id;
    Side side;
    std::uint32_t generation;
  };
  std::vector<Done> done;
  for (const Mail::Change& one : changes) {
    std::vector<std::uint64_t> ids = one.earlier;
    ids.push_back(one.edit.id);
    const auto fault = fault_of([&] { make(one.edit); });
    const std::string key = !fault ? std::string() : one.edit.key.empty() ? key_in(*fault) : one.edit.key;
    const std::uint32_t generation = one.edit.side == Side::a ? a_.state.generation : generations_of_b_;
    for (const std::uint64_t id : ids) {
      if (fault)
        out_->tell(one.client, fault_text(id, *fault, key));
      else
        done.push_back({one.client, id, one.edit.side, generation});
    }
  }
  if (done.empty()) return;
  out_->own_rate(a_.state.in.camera.mode.frame_rate_hz);
  tell_state();
  for (const Done& one : done)
    out_->tell(one.client,
               files::json_text(
                   Json::object().set("type", "done").set("id", one.id).set("side", name_of(one.side)).set("generation", one.generation)));
}

/// What is quickly seen of a state that takes long.
bool can_be_drafted(const State& state) {
  const app::Options& o = state.options;
  return state.in.scene.transport.bounces > 0 || o.subpixel.value_or(1) > 1 || o.exposure_samples.value_or(1) > 1;
}

/// The simulator of the state, with these arrays; with all of them where none is named.
/// @param draft  without light that bounces, with one sample of each pixel and exposure
Simulator& Session::Impl::simulator_of(Simulating& of, const State& state, const std::vector<std::uint16_t>& arrays, bool draft) {
  if (of.simulator && of.generation == state.generation && of.arrays == arrays) return *of.simulator;
  SimulatorOptions wanted = app::simulator_options(state.options);
  wanted.arrays = sources_of(arrays);
  wanted.progress = &progress_;
  const bool without_transient = !arrays.empty() && !has_transient(arrays) && state.in.scene.transport.transient.bins > 0;
  of.simulator.reset();
  if (draft || without_transient) {
    Scene scene = state.in.scene;
    if (draft)
      scene.transport = {}, wanted.subpixel = wanted.exposure_samples = 1;
    else
      scene.transport.transient = {};
    of.simulator.emplace(scene, state.in.camera, wanted);
  } else {
    of.simulator.emplace(state.in.scene, state.in.camera, wanted);
  }
  of.generation = state.generation, of.arrays = arrays;
  return *of.simulator;
}

/// @return whether the frame came to its end
bool Session::Impl::computed(Simulating& of, const State& state, const std::vector<std::uint16_t>& arrays, Frame& into, double& took_ms,
                             std::uint64_t index, bool draft) {
  Simulator& simulator = simulator_of(of, state, arrays, draft);
  {
    const std::lock_guard lock(mutex_);
    if (mail_.stop) return false;
    // What came since the thread looked into its mailbox.
    if (may_give_up() && mail_.outdates()) return interrupted_before_ = true, false;
    computing_ = true, progress_.stop = false;
  }
  const Clock::time_point start = Clock::now();
  const auto fault = fault_of([&] { simulator.frame(index, into); });
  counts_.compute_ms = took_ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  const std::lock_guard lock(mutex_);
  computing_ = false, interrupted_before_ = progress_.stop;
  if (fault) throw Error(ErrorKind::bug, *fault);
  if (!progress_.stop) ++counts_.computed;
  return !progress_.stop;
}

/// The frames that are due, computed and handed over: of both sides the same.
void Session::Impl::show() {
  const bool tick = all_shown();
  if (tick) {
    set_frame(a_.state.frame + 1);
    for (SideOfSession* one : sides()) one->shown = false;
  }
  for (SideOfSession* one : sides())
    if (!one->shown && !show(*one)) return;
  const Clock::time_point now = Clock::now();
  next_ = !at_once_ ? std::max(next_ + period(demand_now_), now) : now + period(demand_now_);
  at_once_ = false;
}

bool Session::Impl::show(SideOfSession& of) {
  constexpr double long_ms = 50;
  const std::vector<std::uint16_t> arrays = joined(demand_now_.wants);
  if (at_once_ && of.frame_ms > long_ms && can_be_drafted(of.state) && !of.drafted) {
    double took = 0;
    if (!computed(of.draft, of.state, arrays, of.draft_frame, took, of.state.frame, true)) return false;
    publish(of, of.draft_frame, true);
    of.drafted = true;
  }
  double took = 0;
  const bool whole = computed(of.live, of.state, arrays, of.frame, took, of.state.frame);
  of.frame_ms = whole ? took : std::max(of.frame_ms, took);
  if (!whole) return false;
  publish(of, of.frame, false);
  of.shown = true;
  return true;
}

void Session::Impl::publish(SideOfSession& of, const Frame& frame, bool draft) {
  auto published = std::make_shared<Published>();
  published->side = of.side, published->at_once = at_once_;
  published->generation = of.state.generation, published->sequence = ++of.sequence, published->frame = of.state.frame;
  const double hz = of.state.in.camera.mode.frame_rate_hz;
  const WireHead head{static_cast<std::uint8_t>(of.side),
                      static_cast<std::uint8_t>(draft ? 1 : 0),
                      of.state.generation,
                      of.sequence,
                      hz > 0 ? static_cast<double>(of.state.frame) / hz : 0,
                      static_cast<float>(counts_.compute_ms)};
  for (const auto& want : demand_now_.wants)
    published->messages.emplace_back(want, std::make_shared<const std::string>(encoded(head, frame, want)));
  {
    // Whether there is room for more is told anew once this one was offered.
    const std::lock_guard lock(mutex_);
    demand_.ready = false;
  }
  out_->publish(std::move(published), counts_);
}

/// A frame of the state with all its arrays; null where it was given up.
const Whole* Session::Impl::whole(SideOfSession& of, std::uint64_t index) {
  if (of.last && of.last->generation == of.state.generation && of.last->index == index) return &*of.last;
  Whole fresh;
  if (of.last) fresh.frame = std::move(of.last->frame);
  of.last.reset();
  double took = 0;
  if (!computed(of.whole, of.state, {}, fresh.frame, took, index)) return nullptr;
  fresh.generation = of.state.generation, fresh.index = index;
  return &of.last.emplace(std::move(fresh));
}

const results::Arrays& Session::Impl::arrays_of_whole(SideOfSession& side) {
  Whole& of = *side.last;
  if (!of.arrays) {
    const run::Loaded& in = side.state.in;
    const std::string meta = results::frame_meta(in.scene, in.camera, app::simulator_options(side.state.options), of.index);
    const std::string& name = side.state.options.words[0];
    of.arrays.emplace(
        files::parse_npz(results::frame_npz_bytes(of.frame, in.camera, camera_pose(in.scene, of.frame.truth.time_s), meta), name), name);
  }
  return *of.arrays;
}

/// The ranges of colours are those of the first frame that anybody saw. @return whether it came to its end
bool Session::Impl::ready_to_greet() {
  if (!panes_.empty()) return true;
  const auto lock_scales = [this](const Frame& first) {
    panes_ = panes_of(first);
    for (const Pane& one : panes_) scales_.emplace_back(one.array, *scale_json(first, one.array));
  };
  if (can_be_drafted(a_.state)) {  // who comes does not wait for a long frame
    Simulating draft;
    Frame frame;
    double took = 0;
    if (!computed(draft, a_.state, {}, frame, took, a_.state.frame, true)) return false;
    lock_scales(frame);
    return true;
  }
  const Whole* first = whole(a_, a_.state.frame);
  if (first == nullptr) return false;
  lock_scales(first->frame);
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
  json.set("type", "hello").set("protocol", 2).set("version", base::version()).set("build", build_);
  json.set("arrays", std::move(arrays)).set("panes", std::move(panes)).set("palettes", palettes_json());
  json.set("invalid", invalid_json()).set("invalid_color", invalid_color_json());
  put_state(json, a_.state, b_ ? &b_->state : nullptr);
  if (test_hooks_) json.set("test_hooks", true);
  return files::json_text(json);
}

void Session::Impl::answer(const Question& question) {
  const PixelQuestion& asked = question.pixel;
  const auto fault = fault_of([&] {
    SideOfSession& on = side(asked.side);
    const State& state = on.state;
    const std::uint64_t index = question.generation == state.generation ? question.frame : state.frame;
    const Whole* of = whole(on, index);
    if (of == nullptr)  // it comes again, unless a newer one does
      return post([&](Mail& later, Demand&) { return later.questions.emplace(question.client, question), false; });
    const results::Arrays& arrays = arrays_of_whole(on);
    const PixelChain chain = run::pixel_chain(arrays, asked.u, asked.v);
    run::FrameOrigin origin;
    origin.in = state.in, origin.simulated = app::simulator_options(state.options);
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
    json.set("side", name_of(asked.side)).set("generation", state.generation).set("frame", index);
    json.set("report", app::pixel_json(arrays, chain, run::pixel_bounces(arrays, origin, asked.u, asked.v)));
    json.set("values", std::move(values)).set("why", reason == nullptr ? "" : reason->words);
    out_->tell(question.client, files::json_text(json));
  });
  if (fault) out_->tell(question.client, fault_text(asked.id, *fault));
}

void Session::Impl::answer(const Mail::Asked& asked) {
  const auto fault = fault_of([&] {
    const State& state = side(asked.query.side).state;
    if (asked.query.kind == Query::Kind::controls) return out_->tell(asked.client, controls_text(state, asked.query));
    constexpr std::size_t most_bytes = 900'000;  // a page that takes 1 MB too slowly is let go
    const Saved file = saved(state);
    Json json = Json::object();
    json.set("type", "saved").set("id", asked.query.id).set("side", name_of(asked.query.side));
    const std::string text = files::json_text(json.set("name", file.name).set("text", file.text).set("command", file.command));
    if (text.size() > most_bytes)
      throw Error(ErrorKind::limit,
                  "error: the scene's file is too long to be sent\n  the command makes the same frames: " + command_of(state));
    out_->tell(asked.client, text);
  });
  if (fault) out_->tell(asked.client, fault_text(asked.query.id, *fault));
}

void Session::Impl::fit(std::uint64_t client, const std::string& array) {
  const auto fault = fault_of([&] {
    const auto found = std::find_if(scales_.begin(), scales_.end(), [&](const auto& one) { return one.first == array; });
    const Whole* of = found == scales_.end() ? nullptr : whole(a_, a_.state.frame);
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
    mail.add(client, std::move(edit));
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

void Session::query(std::uint64_t client, const Query& query) {
  impl_->post([&](Mail& mail, Demand&) {
    std::erase_if(mail.queries, [&](const Mail::Asked& one) {
      return one.client == client && one.query.kind == query.kind && one.query.side == query.side;
    });
    mail.queries.push_back({client, query});
    return false;
  });
}

}  // namespace tofray::view
