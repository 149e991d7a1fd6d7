// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <array>
#include <utility>

#include "base/text.h"
#include "cli/requests.h"
#include "pictures/pictures.h"
#include "run/frame_files.h"
#include "view/answer_arrays.h"
#include "view/measure.h"
#include "view/region.h"
#include "view/session_impl.h"
#include "view/wire.h"

namespace tofray::view {

namespace {

constexpr std::uint8_t first_answer_channel = 2;

std::uint8_t channel_of(Side side) { return static_cast<std::uint8_t>(first_answer_channel + static_cast<std::uint8_t>(side)); }

/// Arrays of a page that a later answer's come in place of.
enum class Kind : std::uint8_t { scene, series, picture };
std::uint8_t number_of(Kind kind, Side side) { return static_cast<std::uint8_t>(2 * static_cast<int>(kind) + static_cast<int>(side)); }

bool deforms(const Scene& scene) {
  for (const Object& one : scene.objects)
    if (const auto* mesh = std::get_if<Mesh>(&one.shape); mesh != nullptr && mesh->motion != nullptr) return true;
  return false;
}

Json answer_json(const char* type, std::uint64_t id, Side side) {
  return Json::object().set("type", type).set("id", id).set("side", name_of(side));
}

const char* type_of(const Inquiry& what) {
  struct Name {
    const char* operator()(const SceneQuestion&) const { return "view3d"; }
    const char* operator()(const Drag&) const { return "drag"; }
    const char* operator()(const Place& one) const { return one.object ? "place" : "camera"; }
    const char* operator()(const Measure&) const { return "measure"; }
    const char* operator()(const RegionQuestion&) const { return "region"; }
    const char* operator()(const Temporal&) const { return "temporal"; }
    const char* operator()(const Screenshot&) const { return "screenshot"; }
    const char* operator()(const Restore&) const { return "restore"; }
  };
  return std::visit(Name(), what);
}

template <class Of>
std::uint64_t id_of(const Of& inquiry) {
  return std::visit([](const auto& one) { return one.id; }, inquiry);
}

}  // namespace

void Session::Impl::ask_again(const Inquired& inquired) {
  post([&](Mail& later, Demand&) {
    later.inquiries.emplace(std::pair{inquired.client, inquired.what.index()}, inquired);
    return false;
  });
}

void Session::Impl::forget(std::uint64_t client) {
  splits_.erase(client), series_.erase(client), held_.erase(client);
  recorder_->stop(client);
  for (const Side one : {Side::a, Side::b}) drawn_.erase({client, one});
}

void Session::Impl::answer(const Inquired& inquired) {
  const auto fault = fault_of([&] { answer_what(inquired); });
  if (fault) out_->tell(inquired.client, fault_text(id_of(inquired.what), *fault));
}

void Session::Impl::answer_what(const Inquired& inquired) {
  SideOfSession& on = side(inquired.side);
  const std::uint64_t index = frame_asked(inquired, on.state);
  refuse(on.state, type_of(inquired.what));
  if (const auto* drag = std::get_if<Drag>(&inquired.what)) {
    const Held* from = held(inquired, drag->base, drag->object, drag->from_u, drag->from_v);
    if (from == nullptr) return ask_again(inquired);
    return tell_moved(inquired, "drag", drag->id, from->generation,
                      dragged({from->scene, from->camera, from->set, from->time_s}, from->truth, *drag));
  }
  if (const auto* place = std::get_if<Place>(&inquired.what)) {
    const Held* from = held(inquired, place->base, place->object.value_or(-1), -1, -1);
    if (from == nullptr) return ask_again(inquired);
    return tell_moved(inquired, place->object ? "place" : "camera", place->id, from->generation,
                      placed({from->scene, from->camera, from->set, from->time_s}, *place));
  }
  if (const auto* restore = std::get_if<Restore>(&inquired.what)) return tell_restored(inquired, *restore);
  const bool of_truth = std::holds_alternative<SceneQuestion>(inquired.what) || std::holds_alternative<Temporal>(inquired.what);
  const Whole* of = of_truth ? seen(on, index) : whole(on, index);
  if (of == nullptr) return ask_again(inquired);
  if (const auto* scene = std::get_if<SceneQuestion>(&inquired.what)) return tell_scene(inquired, *scene, of->frame.truth.time_s);
  if (const auto* temporal = std::get_if<Temporal>(&inquired.what)) return begin_series(inquired, *temporal, of->frame.truth.time_s);
  if (std::holds_alternative<Screenshot>(inquired.what)) return tell_picture(inquired, *of);
  const bool measures = std::holds_alternative<Measure>(inquired.what);
  Json json = answer_json(measures ? "measure" : "region", id_of(inquired.what), inquired.side);
  json.set("generation", on.state.generation).set("frame", index);
  if (measures)
    put_measure(json, of->frame, on.state.in.scene, std::get<Measure>(inquired.what));
  else
    put_region(json, of->frame, std::get<RegionQuestion>(inquired.what));
  out_->tell(inquired.client, files::json_text(json));
}

const Drawing& Session::Impl::drawing_of(SideOfSession& on, const SceneAt& at) {
  const bool known =
      on.drawing && on.drawing->generation == on.state.generation && (on.drawing->time_s == at.time_s || !deforms(on.state.in.scene));
  if (known) return *on.drawing;
  Drawing fresh{on.state.generation, at.time_s, 0, geometry_of(at)};
  fresh.number = on.drawing && same(on.drawing->geometry, fresh.geometry) ? on.drawing->number : ++drawings_;
  return on.drawing.emplace(std::move(fresh));
}

void Session::Impl::tell_scene(const Inquired& inquired, const SceneQuestion& asked, double time_s) {
  SideOfSession& on = side(inquired.side);
  const State& state = on.state;
  const std::uint64_t index = frame_asked(inquired, state);
  const SceneAt at{state.in.scene, state.in.camera, state.options.set, time_s};
  const Drawing& drawing = drawing_of(on, at);
  std::uint64_t& drawn = drawn_[{inquired.client, inquired.side}];
  const bool fresh = drawn != drawing.number;
  Json json = answer_json("view3d", asked.id, inquired.side);
  json.set("generation", state.generation).set("frame", index).set("static", fresh);
  if (fresh) json.set("arrays", Json::list(drawing_arrays));
  put_scene(json, at, drawing.geometry);
  if (!fresh) return out_->tell(inquired.client, files::json_text(json));
  const WireHead head{channel_of(inquired.side), 0, state.generation, static_cast<std::uint32_t>(asked.id), time_s, 0};
  out_->give(inquired.client, files::json_text(json), drawing_bytes(head, index, drawing.geometry), number_of(Kind::scene, inquired.side));
  drawn = drawing.number;
}

const Held* Session::Impl::held(const Inquired& inquired, std::optional<std::uint32_t> base, int object, int u, int v) {
  SideOfSession& on = side(inquired.side);
  const State& state = on.state;
  const std::uint32_t wanted = base.value_or(state.generation);
  const auto found = held_.find(inquired.client);
  if (found != held_.end() && found->second.side == inquired.side && found->second.generation == wanted) {
    const Held& known = found->second;
    if (wanted != state.generation || (known.object == object && known.u == u && known.v == v)) return &known;
  }
  if (wanted != state.generation)
    throw Error(ErrorKind::bad_input, "error: the state has changed since this was taken hold of\n  let it go, and take it again");
  const Whole* of = seen(on, frame_asked(inquired, state));
  if (of == nullptr) return nullptr;
  Held fresh{
      inquired.side, wanted, state.in.scene, state.in.camera, state.options.set, of->frame.truth.time_s, of->frame.truth, object, u, v};
  return &held_.insert_or_assign(inquired.client, std::move(fresh)).first->second;
}

void Session::Impl::tell_moved(const Inquired& inquired, const char* type, std::uint64_t id, std::uint32_t base, const Moved& moved) {
  Json sets = Json::array();
  for (const auto& [key, text] : moved.sets) sets.push(Json::object().set("key", key).set("text", text));
  Json json = answer_json(type, id, inquired.side);
  json.set("base", base).set("sets", std::move(sets)).set("unsets", Json::list(moved.unsets));
  out_->tell(inquired.client, files::json_text(json.set("what", moved.what)));
}

/// preview.png as `tofray render` draws it, with the state in it.
void Session::Impl::tell_picture(const Inquired& inquired, const Whole& of) {
  const State& state = side(inquired.side).state;
  const Camera& camera = state.in.camera;
  const Frame& frame = of.frame;
  const std::string caption = run::caption_of(state.in.scene.name, camera.name, camera.mode.name, of.index, true);
  const std::string drawn = pictures::preview_png(frame.depth, frame.truth, frame.raw, caption);
  const std::string text = png_with_text(drawn, picture_keyword, picture_text(picture_state(state, of.index)));
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  const std::uint64_t id = id_of(inquired.what);
  Json json = answer_json("screenshot", id, inquired.side);
  json.set("generation", state.generation).set("frame", of.index).set("name", fmt::format("{}_{:04}.png", state.in.scene.name, of.index));
  json.set("static", true).set("arrays", Json::list(std::array{"png"}));
  const StaticArray arrays[] = {array_of(u8_type, bytes, 1, {bytes.size(), 0, 0})};
  const WireHead head{channel_of(inquired.side), 0, state.generation, static_cast<std::uint32_t>(id), 0, 0};
  out_->give(inquired.client, files::json_text(json), encoded(head, of.index, 0, 0, arrays), number_of(Kind::picture, inquired.side));
}

/// What a picture that may be a stranger's says, for the page to set.
void Session::Impl::tell_restored(const Inquired& inquired, const Restore& asked) {
  const PictureState then = parse_picture_text(asked.text), now = picture_state(a_.state, a_.state.frame);
  const bool same_scene = then.scene == now.scene && then.scene_sha256.empty() == now.scene_sha256.empty();
  const bool same_settings = then.noise == now.noise && then.exposure_samples == now.exposure_samples && then.subpixel == now.subpixel;
  if (!same_scene || !same_settings)
    throw Error(ErrorKind::bad_input,
                fmt::format("error: the picture is of {}, and this viewer has {}\n  `{}` opens it",
                            same_scene ? "other settings of `tofray view`" : "the scene " + base::in_quotes(then.scene),
                            same_scene ? "--noise, --exposure-samples or --subpixel otherwise" : base::in_quotes(now.scene),
                            base::printable(live_command(then))));
  Json overrides = Json::array();
  for (const auto& [key, text] : then.overrides) overrides.push(Json::object().set("key", key).set("text", text));
  Json json = answer_json("restore", asked.id, Side::a);
  json.set("overrides", std::move(overrides)).set("seed", then.seed).set("frame", then.frame);
  if (then.scene_sha256 != now.scene_sha256)
    json.set("note", fmt::format("{} has changed since the picture was taken", now.scene));
  else if (then.version != now.version)
    json.set("note",
             fmt::format("tofray {} made the picture, this is {}: the bytes may differ", base::printable(then.version), now.version));
  out_->tell(inquired.client, files::json_text(json));
}

void Session::Impl::take(const Mail::Ordered& ordered) {
  const Order& order = ordered.order;
  if (order.kind == Order::Kind::stop) return recorder_->stop(ordered.client);
  const auto fault = fault_of([&] {
    refuse(side(order.side).state, order.kind == Order::Kind::record ? "record" : "export");
    recorder_->take(ordered.client, order, side(order.side).state, *out_);
  });
  if (fault) out_->tell(ordered.client, fault_text(order.id, *fault));
}

/// In place of what the page asked before.
void Session::Impl::begin_series(const Inquired& inquired, const Temporal& asked, double time_s) {
  const State& state = side(inquired.side).state;
  SimulatorOptions simulated = app::simulator_options(state.options);
  simulated.arrays = {"z_m", "range_m", "noise_m", "flags"}, simulated.truth = false, simulated.progress = &progress_;
  Scene scene = analysis::standing_still(state.in.scene, time_s);
  scene.transport.transient = {};
  series_.insert_or_assign(
      inquired.client,
      Series{inquired.client, asked, state.generation, frame_asked(inquired, state), Simulator(scene, state.in.camera, simulated), {}, {}});
}

/// A few frames of each; what comes in meanwhile, and frames that are due, go first.
void Session::Impl::go_on_with_series() {
  for (auto one = series_.begin(); one != series_.end();) {
    Series& series = one->second;
    bool done = false;
    const auto fault = fault_of([&] { done = step(series); });
    if (fault) out_->tell(series.client, fault_text(series.asked.id, *fault));
    if (done) tell_series(series, true);
    one = fault || done ? series_.erase(one) : std::next(one);
  }
}

bool Session::Impl::step(Series& series) {
  constexpr auto at_once = std::chrono::milliseconds(25), between_words = std::chrono::milliseconds(200);
  if (side(series.asked.side).state.generation != series.generation)
    throw Error(ErrorKind::bad_input, "error: the state has changed while its noise was measured\n  the question is to be asked again");
  const Clock::time_point until = Clock::now() + at_once;
  do {
    {
      const std::lock_guard lock(mutex_);
      if (!mail_.empty()) return false;
      computing_ = true, progress_.stop = false;
    }
    const std::uint64_t index = series.first + static_cast<std::uint64_t>(series.noise.frames());
    const auto failed = fault_of([&] { series.simulator.frame(index, series.frame); });
    bool stopped = false;
    {
      const std::lock_guard lock(mutex_);
      computing_ = false, stopped = progress_.stop;
    }
    if (failed) throw Error(ErrorKind::bad_input, *failed);
    if (stopped) return false;
    series.noise.add(series.frame.depth);
  } while (series.noise.frames() < series.asked.frames && Clock::now() < until);
  if (series.noise.frames() >= series.asked.frames) return true;
  if (const Clock::time_point now = Clock::now(); now - series.told >= between_words) series.told = now, tell_series(series, false);
  return false;
}

void Session::Impl::tell_series(const Series& series, bool done) {
  const Side of = series.asked.side;
  Json json = answer_json("temporal", series.asked.id, of);
  json.set("generation", series.generation).set("frame", series.first).set("frames", series.asked.frames);
  json.set("done", series.noise.frames());
  if (!done) return out_->tell(series.client, files::json_text(json));
  const analysis::NoiseSummary summary = series.noise.summary();
  json.set("fill", summary.fill).set("sigma_median_m", summary.sigma_median_m).set("predicted_median_m", summary.predicted_median_m);
  json.set("chi2", summary.chi2).set("static", true);
  json.set("arrays", Json::list(std::array{"temporal_sigma_m", "temporal_mean_m", "temporal_count", "temporal_predicted_m"}));
  const auto width = static_cast<std::size_t>(series.noise.width()), height = static_cast<std::size_t>(series.noise.height());
  const std::array<std::size_t, 3> extents{height, width, 0};
  const auto sigma = series.noise.sigma_m(), mean = series.noise.mean_m(), predicted = series.noise.predicted_m();
  const auto counts = series.noise.counts();
  const StaticArray arrays[] = {array_of(f32_type, sigma, 2, extents), array_of(f32_type, mean, 2, extents),
                                array_of(u32_type, counts, 2, extents), array_of(f32_type, predicted, 2, extents)};
  const WireHead head{channel_of(of), 0, series.generation, static_cast<std::uint32_t>(series.asked.id), 0, 0};
  out_->give(series.client, files::json_text(json),
             encoded(head, series.first, static_cast<std::uint32_t>(width), static_cast<std::uint32_t>(height), arrays),
             number_of(Kind::series, of));
}

}  // namespace tofray::view
