// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "base/text.h"
#include "cli/requests.h"
#include "view/pixel_answer.h"
#include "view/session_impl.h"

namespace tofray::view {

/// The ranges of colours are those of the first frame that anybody saw. @return whether it came to its end
bool Session::Impl::ready_to_greet() {
  if (!scales_.panes.empty()) return true;
  if (can_be_drafted(a_.state)) {  // who comes does not wait for a long frame
    Simulating draft;
    Frame frame;
    double took = 0;
    if (!computed(draft, a_.state, {}, frame, took, a_.state.frame, Manner::draft)) return false;
    scales_ = scales_of(frame);
    return true;
  }
  const Whole* first = whole(a_, a_.state.frame);
  if (first == nullptr) return false;
  scales_ = scales_of(first->frame);
  return true;
}

std::string Session::Impl::hello() const {
  Json json = greeting(a_.state, b_ ? &b_->state : nullptr, scales_, build_);
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
    // What was given up comes again, unless a newer one does.
    const auto again = [&] { post([&](Mail& later, Demand&) { return later.questions.emplace(question.client, question), false; }); };
    if (of == nullptr) return again();
    if (state.recorded) return answer_recorded(question, on, of->frame, index);
    const Whole* direct = expected(on, index);
    if (direct == nullptr) return again();
    const SimulatorOptions simulated = app::simulator_options(state.options);
    PixelInState pixel{state.options.words[0], state.in.scene, state.in.camera, simulated, of->frame, direct->frame};
    Json json = Json::object();
    json.set("type", "pixel").set("id", asked.id).set("u", asked.u).set("v", asked.v);
    json.set("side", name_of(asked.side)).set("generation", state.generation).set("frame", index);
    put_pixel(json, pixel, asked.u, asked.v);
    out_->tell(question.client, files::json_text(json));
  });
  if (fault) out_->tell(question.client, fault_text(asked.id, *fault));
}

void Session::Impl::answer_recorded(const Question& question, const SideOfSession& on, const Frame& frame, std::uint64_t index) {
  const PixelQuestion& asked = question.pixel;
  const Recorded& files = *on.state.recorded;
  Json json = Json::object();
  json.set("type", "pixel").set("id", asked.id).set("u", asked.u).set("v", asked.v);
  json.set("side", name_of(asked.side)).set("generation", on.state.generation).set("frame", index);
  put_pixel(json, frame, files.live() ? &on.state.in.camera : nullptr, files.file(index), asked.u, asked.v);
  out_->tell(question.client, files::json_text(json));
}

/// In place of what the page asked before.
void Session::Impl::begin_split(const Why& question) {
  splits_.erase(question.client);
  const WhyQuestion& asked = question.asked;
  const auto fault = fault_of([&] {
    const State& state = side(asked.side).state;
    refuse(state, "why");
    const std::uint64_t index = question.generation == state.generation ? question.frame : state.frame;
    SimulatorOptions simulated = app::simulator_options(state.options);
    simulated.progress = &progress_;
    const PixelRegion region{asked.u0, asked.v0, asked.u1, asked.v1};
    splits_.emplace(question.client, Split{question, state.generation, index, {state.in.scene, state.in.camera, simulated, index, region}});
  });
  if (fault) out_->tell(question.client, fault_text(asked.id, *fault));
}

/// One frame of the page that has waited longest; what comes in meanwhile, and frames that are due, go first.
void Session::Impl::go_on_with_split() {
  if (splits_.empty()) return;
  auto one = splits_.upper_bound(last_split_);
  if (one == splits_.end()) one = splits_.begin();
  last_split_ = one->first;
  Split& split = one->second;
  const WhyQuestion& asked = split.question.asked;
  bool more = true;
  const auto fault = fault_of([&] {
    if (side(asked.side).state.generation != split.generation)
      throw Error(ErrorKind::bad_input, "error: the state has changed while the causes were sought\n  the question is to be asked again");
    {
      const std::lock_guard lock(mutex_);
      if (!mail_.empty()) return;
      computing_ = true, progress_.stop = false;
    }
    const auto failed = fault_of([&] { more = split.causes.step(); });
    const std::lock_guard lock(mutex_);
    computing_ = false;
    if (failed) throw Error(ErrorKind::bad_input, *failed);
  });
  if (fault) out_->tell(split.question.client, fault_text(asked.id, *fault));
  if (!fault && !more) tell_split(split);
  if (fault || !more) splits_.erase(one);
}

void Session::Impl::tell_split(const Split& split) {
  const WhyQuestion& asked = split.question.asked;
  const ErrorSplit result = split.causes.result();
  Json causes = Json::array();
  for (const ErrorCause& one : result.causes)
    causes.push(Json::object().set("cause", one.cause).set("mm", 1e3 * one.error_m).set("changes", !(std::abs(one.error_m) <= 0)));
  Json json = Json::object();
  json.set("type", "why").set("id", asked.id).set("side", name_of(asked.side));
  json.set("generation", split.generation).set("frame", split.frame);
  if (asked.region)
    json.set("region", Json::list(std::array{asked.u0, asked.v0, asked.u1, asked.v1}));
  else
    json.set("u", asked.u0).set("v", asked.v0);
  json.set("pixels", result.valid).set("count", result.pixels).set("error_m", result.error_m).set("sigma_m", result.sigma_m);
  out_->tell(split.question.client, files::json_text(json.set("causes", std::move(causes)).set("rest_mm", 1e3 * result.rest_m)));
}

void Session::Impl::answer(const Mail::Asked& asked) {
  const auto fault = fault_of([&] {
    const State& state = side(asked.query.side).state;
    if (asked.query.kind == Query::Kind::controls) return out_->tell(asked.client, controls_text(state, asked.query));
    refuse(state, "save");
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
    const auto found = std::find_if(scales_.ranges.begin(), scales_.ranges.end(), [&](const auto& one) { return one.first == array; });
    const Whole* of = found == scales_.ranges.end() ? nullptr : whole(a_, a_.state.frame);
    if (found == scales_.ranges.end() || found->second.is_null())
      throw Error(ErrorKind::bad_input, "error: no pane has a range of colours for " + base::in_quotes(array));
    if (of == nullptr) return;
    found->second = *scale_json(of->frame, array);
    out_->tell_all(files::json_text(Json::object().set("type", "scale").set("array", array).set("scale", found->second)));
  });
  if (fault) out_->tell(client, fault_text({}, *fault));
}

}  // namespace tofray::view
