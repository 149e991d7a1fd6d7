// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/mcap_sink.h"

#include <fmt/core.h>

#include <algorithm>

#include "load/builtin.h"
#include "results/manifest.h"
#include "run/manifest.h"
#include "tofray/error.h"

namespace tofray::run {

namespace {

/// A part of a longer run does not take the place of the part before.
std::string name_of(const RunRequest& request) {
  return request.first_frame == 0 ? "run.mcap" : fmt::format("run_{:04}.mcap", request.first_frame);
}

/// What made the file, for `render --from`: without other kinds of files, what it ran on, how long it took and where it went, so that the film
/// has the same bytes each time.
std::string manifest_for(const RunRequest& request, const std::vector<InputFile>& inputs) {
  RunRequest film = request;
  film.files = {};
  film.files.emit = std::vector<std::string>{"mcap"};
  film.files.messages = request.files.messages, film.files.compression = request.files.compression;
  results::Manifest manifest = manifest_of(film);
  manifest.command.clear();
  manifest.inputs = inputs;
  return results::manifest_text(manifest);
}

McapOptions options_for(const FrameFiles& what, const RunRequest& request) {
  McapOptions out{what.messages, what.compression, {}};
  for (const InputFile& file : what.inputs.files)
    if (file.role == "scene") {
      const load::Builtin* builtin = load::find_builtin(load::builtin_scenes(), file.name);
      const std::string text = file.text.empty() && builtin != nullptr ? std::string(builtin->text) : file.text;
      if (!text.empty()) out.attachments.emplace_back("scene.yaml", text);
    }
  out.attachments.emplace_back("manifest.json", manifest_for(request, what.inputs.files));
  return out;
}

}  // namespace

McapSink::McapSink(const files::OutputFolder& folder, const FrameFiles& what, const RunRequest& request)
    : what_(what),
      writer_(folder.path() / name_of(request), what.inputs.scene, what.inputs.camera, options_for(what, request), request.simulator) {}

void McapSink::write(std::uint64_t number, const Frame& frame) {
  thread_local std::vector<Message> messages;  // memory that is used again
  writer_.messages().of(frame, what_.inputs.scene, messages);
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] { return number > given_up_ || next_ == number; });
  if (number > given_up_) throw Error(ErrorKind::io, "error: a frame before could not be written");
  writer_.write(frame, messages);  // who calls gives the frame up where this fails
  ++next_;
  changed_.notify_all();
}

void McapSink::give_up(std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  given_up_ = std::min(given_up_, number);
  changed_.notify_all();
}

}  // namespace tofray::run
