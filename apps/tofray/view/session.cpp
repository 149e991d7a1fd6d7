// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "view/session.h"

#include <algorithm>

#include "cli/requests.h"
#include "view/session_impl.h"

namespace tofray::view {

namespace {

/// Frames a second; of files that do not say it, as many as can well be looked at.
double own_rate(const State& state) {
  constexpr double of_files_hz = 5;
  const double hz = state.in.camera.mode.frame_rate_hz;
  return state.recorded && !(hz > 0) ? of_files_hz : hz;
}

}  // namespace

Session::Mail Session::Impl::wait() {
  std::unique_lock lock(mutex_);
  for (;;) {
    if (!mail_.empty() || !splits_.empty() || !series_.empty() || due(demand_, Clock::now())) break;
    const bool clocked = demand_.ready && all_shown() && playing();
    if (clocked)
      changed_.wait_until(lock, next_);
    else
      changed_.wait(lock);
  }
  demand_now_ = demand_;
  return std::exchange(mail_, Mail());
}

/// Whether a frame is to be computed now: a page looks, and it is a new one.
bool Session::Impl::due(const Demand& demand, Clock::time_point now) const {
  return demand.ready && !demand.wants.empty() && (!all_shown() || (playing() && now >= next_));
}

void Session::Impl::run(Outbox& outbox) {
  out_ = &outbox;
  outbox.own_rate(own_rate(a_.state));
  if (b_) outbox.other(true);
  for (;;) {
    Mail mail = wait();
    if (mail.stop) break;
    if (const auto fault = fault_of([&] { work(std::move(mail)); })) {
      for (SideOfSession* one : sides()) one->shown = true, one->state.playing = false;  // until something changes
      tell_fault_to_all(*fault);
      tell_state();
    }
  }
  recorder_->abandon();
  std::unique_ptr<Recorder> last;
  {
    const std::lock_guard lock(mutex_);
    last = std::move(recorder_);
  }
  last.reset();  // waits for its thread
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
  for (const std::uint64_t client : mail.left) forget(client);
  if (!mail.joined.empty()) greet(mail.joined);
  for (const auto& [client, array] : mail.fits) fit(client, array);
  for (const auto& [client, question] : mail.questions) answer(question);
  for (const Mail::Asked& one : mail.queries) answer(one);
  for (const auto& [of, inquired] : mail.inquiries) answer(inquired);
  for (const Mail::Ordered& one : mail.orders) take(one);
  for (const auto& [client, question] : mail.whys) begin_split(question);
  if (due(demand_now_, Clock::now())) show();
  go_on_with_split();
  go_on_with_series();
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
  if (next.recorded)
    (void)next.recorded->frame(next.frame, next.in.camera, app::simulator_options(next.options));
  else
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
  out_->own_rate(own_rate(a_.state));
  tell_state();
  for (const Done& one : done)
    out_->tell(one.client,
               files::json_text(
                   Json::object().set("type", "done").set("id", one.id).set("side", name_of(one.side)).set("generation", one.generation)));
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

void Session::order(std::uint64_t client, const Order& order) {
  impl_->post([&](Mail& mail, Demand&) { return mail.orders.push_back({client, order}), false; });
}

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

void Session::leave(std::uint64_t client) {
  impl_->post([&](Mail& mail, Demand&) { return mail.left.push_back(client), false; });
}

void Session::inquire(Inquired inquired) {
  impl_->post([&](Mail& mail, Demand&) {
    mail.inquiries.insert_or_assign(std::pair{inquired.client, inquired.what.index()}, std::move(inquired));
    return false;
  });
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

void Session::why(const Why& question) {
  impl_->post([&](Mail& mail, Demand&) { return mail.whys[question.client] = question, false; });
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
