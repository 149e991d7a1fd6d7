// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/frame_files.h"

#include <fmt/core.h>

#include <algorithm>

#include "base/text.h"
#include "files/json.h"
#include "results/array_table.h"
#include "results/ply.h"
#include "tofray/error.h"

namespace tofray::run {

namespace {

/// Bytes that are not UTF-8 replaced as JSON replaces them: a scene that comes from a manifest has the same caption.
std::string as_utf8(const std::string& name) { return *files::parse_json(files::json_text(files::Json(name)), "name").string(); }

/// What `emit` may have.
void refuse_kinds(const std::vector<std::string>& emit) {
  for (const std::string& kind : emit)
    if (kind != "npz" && kind != "png" && kind != "ply" && kind != "mcap")
      throw Error(ErrorKind::bad_input,
                  fmt::format("error: {} is no kind of file that a frame gets\n  expected npz, png, ply or mcap", base::in_quotes(kind)));
}

}  // namespace

std::string caption_of(const std::string& scene, const std::string& camera, const std::string& mode, std::uint64_t frame, bool numbered) {
  std::string text = fmt::format("{} seen by {}", as_utf8(scene), camera);
  if (!mode.empty()) text += " " + mode;
  if (numbered || frame > 0) text += fmt::format(", frame {}", frame);
  return text;
}

FrameFiles::FrameFiles(const FrameFileRequest& request, const std::vector<std::string>& otherwise, const Loaded& from,
                       const SimulatorOptions& wanted)
    : emit(request.emit.value_or(otherwise)),
      inputs(from),
      meta(from.scene, from.camera, wanted),
      theme(request.light_theme ? pictures::Theme::light : pictures::Theme::dark),
      scale(request.scale),
      messages(request.messages),
      compression(request.compression.value_or(usual_mcap_compression())) {
  refuse_kinds(emit);
  if (scale < 1 || scale > 8)
    throw Error(ErrorKind::bad_input, fmt::format("error: scale cannot be {}\n  expected a whole number of 1 to 8", scale));
  if (!request.arrays.empty()) npz.arrays = results::ArrayChoice(request.arrays);
  npz.kept = from.kept;
  npz.packing = request.compress ? files::Packing::deflated : files::Packing::stored;
  if ((!request.arrays.empty() || request.compress) && std::find(emit.begin(), emit.end(), "npz") == emit.end())
    throw Error(ErrorKind::bad_input,
                "error: --arrays and --compress are of npz files, and --emit leaves these out\n  expected npz in --emit");
  if (!emits("mcap") && (request.messages != MessageOptions{} || request.compression))
    throw Error(ErrorKind::bad_input,
                "error: --driver, --topics, --stamp, --camera-name, --depth-encoding, --unorganized, --amplitude-step, --epoch and "
                "--mcap-compression are of MCAP files\n  expected mcap in --emit");
  if (emits("mcap")) {
    if (compression == McapCompression::zstd && usual_mcap_compression() != compression)
      throw Error(ErrorKind::bad_input, "error: this tofray was built without libzstd\n  expected --mcap-compression none");
    needed_messages = Messages(from.scene, from.camera, messages).arrays();
  }
}

std::vector<std::string> FrameFiles::needed_arrays() const {
  if (emits("npz") && npz.arrays.is_all()) return {};
  std::vector<std::string> names;
  for (const results::ArrayRow& row : results::array_table()) {
    const bool filed = emits("npz") && npz.arrays.has(row), by_frequency = row.shape.starts_with("[frequency");
    const bool told = row.from == "depth" && !by_frequency;
    const bool drawn = emits("png") && (row.name == "raw" || row.name == "gt_z_m" || row.name == "gt_multipath_m");
    // What no bin holds is told beside what the bins hold.
    const bool counted = need_transient() && row.name.starts_with("transient_");
    // Why pixels have no depth.
    const bool seen = row.name == "gt_object_id" || row.name == "gt_range_m";
    const bool sent = std::find(needed_messages.begin(), needed_messages.end(), row.name) != needed_messages.end();
    if (row.is_image() && (filed || told || drawn || counted || seen || sent)) names.push_back(row.name);
  }
  return names;
}

bool FrameFiles::emits(std::string_view kind) const { return std::find(emit.begin(), emit.end(), kind) != emit.end(); }

bool FrameFiles::need_transient() const {
  const auto shown = [&](const char* name) { return npz.arrays.has(*results::find_array(name)); };
  return emits("npz") && (shown("transient_e_per_s") || shown("transient_lost_e_per_s"));
}

std::vector<Remark> depth_png_remarks(const FrameFiles& what, std::size_t pixels) {
  if (pixels == 0 || std::find(what.emit.begin(), what.emit.end(), "png") == what.emit.end()) return {};
  return {{true, "",
           fmt::format("depth.png is 0 in {} pixel{} whose z is beyond 65.535 m, the farthest that 16 bits of mm hold", pixels,
                       pixels == 1 ? "" : "s"),
           fmt::format("z_m in frame.npz has {}", pixels == 1 ? "it" : "them")}};
}

std::vector<FileRecord> write_frame(const files::OutputFolder& folder, const FrameFiles& what, const std::string& suffix,
                                    const Frame& frame, std::string& memory) {
  std::vector<FileRecord> files;
  const auto put = [&](const char* stem, const char* extension, std::string_view bytes) {
    files.push_back(folder.put(stem + suffix + extension, bytes));
  };
  const Loaded& in = what.inputs;
  for (const std::string& kind : what.emit) {
    if (kind == "npz") {
      results::frame_npz_bytes(frame, in.camera, in.pose.value_or(camera_pose(in.scene, frame.truth.time_s)), what.meta.of(frame.index),
                               what.npz, memory);
      put("frame", ".npz", memory);
    } else if (kind == "png") {
      put("depth", ".png", pictures::depth_png(frame.depth));
      put("amplitude", ".png", pictures::amplitude_png(frame.depth));
      put("raw", ".png", pictures::raw_png(frame.raw, what.theme, what.scale));
      const std::string caption = caption_of(in.scene.name, in.camera.name, in.camera.mode.name, frame.index, !suffix.empty());
      put("preview", ".png", pictures::preview_png(frame.depth, frame.truth, frame.raw, caption, what.theme, what.scale));
    } else if (kind == "ply") {
      put("cloud", ".ply", results::cloud_ply(frame.depth));
    }
  }
  return files;
}

void write_frame(files::OutputFolder& folder, const FrameFiles& what, const Frame& frame) {
  std::string memory;
  for (const FileRecord& file : write_frame(folder, what, "", frame, memory)) folder.add(file);
}

}  // namespace tofray::run
