// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "analysis/noise_over_time.h"
#include "cli/remarks.h"
#include "files/json.h"
#include "tofray/causes.h"
#include "tofray/error.h"
#include "view/drag.h"
#include "view/fault.h"
#include "view/greeting.h"
#include "view/recorder.h"
#include "view/scene_3d.h"
#include "view/session.h"
#include "view/state.h"

/// What a session is made of: its mailbox, its sides, and the thread that computes them (session.cpp: mailbox and changes; session_frames.cpp:
/// frames and drafts; session_answers.cpp: what pages ask; session_inquiries.cpp: what they ask of the scene and of many frames).
namespace tofray::view {

using Clock = std::chrono::steady_clock;
using files::Json;

/// How a state is computed.
enum class Manner : std::uint8_t {
  whole,
  draft,     ///< without light that bounces, with one sample of each pixel and exposure
  expected,  ///< without noise, of direct light alone
};

/// A frame with all its arrays, or with those of its raw frames.
struct Whole {
  std::uint32_t generation = 0;
  std::uint64_t index = 0;
  Frame frame;
};

/// A simulator and the arrays that it computes.
struct Simulating {
  std::uint32_t generation = 0;
  std::vector<std::uint16_t> arrays;  ///< empty: all
  std::optional<Simulator> simulator;
};

/// The arrays that any of these sets has.
std::vector<std::uint16_t> joined(const std::vector<std::vector<std::uint16_t>>& wants);
/// What is quickly seen of a state that takes long.
bool can_be_drafted(const State& state);

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
  std::vector<std::uint64_t> joined;                                    ///< clients that want a greeting
  std::vector<std::uint64_t> left;                                      ///< clients that are gone
  std::map<std::uint64_t, Question> questions;                          ///< by page
  std::map<std::uint64_t, Why> whys;                                    ///< by page
  std::map<std::pair<std::uint64_t, std::size_t>, Inquired> inquiries;  ///< by page and kind
  std::vector<std::pair<std::uint64_t, std::string>> fits;
  std::vector<Asked> queries;  ///< of each page and kind the last one
  struct Ordered {
    std::uint64_t client;
    Order order;
  };
  std::vector<Ordered> orders;
  std::optional<bool> playing;
  std::optional<std::uint64_t> frame;
  bool again = false, stop = false;
  [[nodiscard]] bool empty() const {
    return edits.empty() && joined.empty() && left.empty() && questions.empty() && whys.empty() && inquiries.empty() && fits.empty() &&
           queries.empty() && orders.empty() && !playing && !frame && !again && !stop;
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

/// What pages draw of a state in 3D.
struct Drawing {
  std::uint32_t generation = 0;
  double time_s = 0;
  std::uint64_t number = 0;  ///< another one where it looks otherwise
  Geometry geometry;
};

/// A state, what computes it, and how far that has come.
struct SideOfSession {
  Side side;
  State state;
  Simulating live, whole, draft, expected, seen;
  std::optional<Whole> last, last_expected, last_seen;
  std::optional<Drawing> drawing;
  Frame frame, draft_frame;
  std::uint32_t sequence = 0;
  bool shown = false;    ///< the frame of the state has been published
  bool drafted = false;  ///< a draft of the state's frame has been published
  /// How long a frame takes; a draft comes before a long one.
  double frame_ms = std::numeric_limits<double>::infinity();
};

/// The causes of an error, found one frame at a time.
struct Split {
  Why question;
  std::uint32_t generation = 0;
  std::uint64_t frame = 0;
  ErrorCauses causes;
};

/// The state in which an object was taken, as long as the page pulls at it.
struct Held {
  Side side = Side::a;
  std::uint32_t generation = 0;
  Scene scene;
  Camera camera;
  Overrides set;
  double time_s = 0;
  Truth truth;  ///< gt_object_id and gt_z_m
  int object = -1, u = -1, v = -1;
};

/// Noise over frames of a state that stands still, found a few frames at a time.
struct Series {
  std::uint64_t client = 0;
  Temporal asked;
  std::uint32_t generation = 0;
  std::uint64_t first = 0;
  Simulator simulator;
  Frame frame;
  analysis::NoiseOverTime noise;
  Clock::time_point told = Clock::now();
};

class Session::Impl {
 public:
  Impl(const app::Options& options, bool test_hooks, std::string build) : test_hooks_(test_hooks), build_(std::move(build)) {
    a_.side = Side::a, a_.state = first_state(options);
    recorder_ = std::make_unique<Recorder>(options.output);
    // What cannot be simulated at all is told before there is an address.
    if (!a_.state.recorded) simulator_of(a_.whole, a_.state, {});
    if (std::optional<State> beside = state_beside(options)) {
      b_.emplace().side = Side::b, b_->state = std::move(*beside);
      if (!b_->state.recorded) simulator_of(b_->whole, b_->state, {});
      generations_of_b_ = b_->state.generation;
    }
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
    if (recorder_) recorder_->abandon();
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
    for (SideOfSession* one : sides()) one->state.frame = frame_within(a_.state, index);
  }
  void tell_state() { out_->tell_all(state_text(a_.state, b_ ? &b_->state : nullptr)); }
  bool due(const Demand& demand, Clock::time_point now) const;
  void show();
  bool show(SideOfSession& of);
  void publish(SideOfSession& of, const Frame& frame, bool draft);
  Simulator& simulator_of(Simulating& of, const State& state, const std::vector<std::uint16_t>& arrays, Manner manner = Manner::whole);
  bool computed(Simulating& of, const State& state, const std::vector<std::uint16_t>& arrays, Frame& into, double& took_ms,
                std::uint64_t index, Manner manner = Manner::whole);
  const Whole* whole(SideOfSession& of, std::uint64_t index);
  const Whole* expected(SideOfSession& of, std::uint64_t index);
  const Whole* seen(SideOfSession& of, std::uint64_t index);
  const Whole* frame_of(SideOfSession& of, std::optional<Whole>& last, Simulating& simulating, std::uint64_t index,
                        const std::vector<std::uint16_t>& arrays, Manner manner);
  bool ready_to_greet();
  void greet(const std::vector<std::uint64_t>& clients);
  std::string hello() const;
  void answer(const Question& question);
  void answer(const Mail::Asked& asked);
  void take(const Mail::Ordered& ordered);
  void tell_picture(const Inquired& inquired, const Whole& of);
  void tell_restored(const Inquired& inquired, const Restore& asked);
  void answer(const Inquired& inquired);
  void answer_what(const Inquired& inquired);
  void ask_again(const Inquired& inquired);
  /// Which frame a question is about.
  [[nodiscard]] static std::uint64_t frame_asked(const Inquired& inquired, const State& state) {
    return inquired.generation == state.generation ? inquired.frame : state.frame;
  }
  const Drawing& drawing_of(SideOfSession& on, const SceneAt& at);
  void tell_scene(const Inquired& inquired, const SceneQuestion& asked, double time_s);
  /// The state that a drag began in; null where its frame was given up. @throws Error where it is no longer known
  const Held* held(const Inquired& inquired, std::optional<std::uint32_t> base, int object, int u, int v);
  void tell_moved(const Inquired& inquired, const char* type, std::uint64_t id, std::uint32_t base, const Moved& moved);
  void begin_series(const Inquired& inquired, const Temporal& asked, double time_s);
  void go_on_with_series();
  /// @return whether it is done
  bool step(Series& series);
  void tell_series(const Series& series, bool done);
  void forget(std::uint64_t client);
  void answer_recorded(const Question& question, const SideOfSession& on, const Frame& frame, std::uint64_t index);
  void begin_split(const Why& question);
  void go_on_with_split();
  void tell_split(const Split& split);
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
  std::unique_ptr<Recorder> recorder_;  ///< goes with the thread, under the lock
  // of the thread alone:
  SideOfSession a_;
  std::optional<SideOfSession> b_;
  std::uint32_t generations_of_b_ = 0;
  bool test_hooks_;
  std::string build_;
  Outbox* out_ = nullptr;
  Demand demand_now_;
  Scales scales_;        ///< locked since the first frame or the last fit
  bool at_once_ = true;  ///< the next frame answers a change
  Clock::time_point next_ = Clock::now();
  SessionCounts counts_;
  std::map<std::uint64_t, Split> splits_;                          ///< by page
  std::uint64_t last_split_ = 0;                                   ///< whose frame came last
  std::map<std::uint64_t, Series> series_;                         ///< by page
  std::map<std::uint64_t, Held> held_;                             ///< by page
  std::map<std::pair<std::uint64_t, Side>, std::uint64_t> drawn_;  ///< the drawing that a page has, by its number
  std::uint64_t drawings_ = 0;
};

}  // namespace tofray::view
