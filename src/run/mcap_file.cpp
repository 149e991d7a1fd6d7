// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/core.h>

#include <map>

#include "base/text.h"
#include "base/version.h"
#include "mcap/writer.h"
#include "results/meta.h"
#include "results/meta_camera.h"
#include "run/manifest.h"
#include "tofray/error.h"
#include "tofray/mcap.h"

namespace tofray {

namespace {

mcap::WriterOptions film_options(const McapOptions& options) {
  const bool zstd = options.compression == McapCompression::zstd;
  if (zstd && !mcap::has_zstd())
    throw Error(ErrorKind::bad_input, "error: this tofray was built without libzstd\n  expected McapCompression::none");
  return {"ros2", fmt::format("tofray {}", base::version()), zstd};
}

std::string media_type_of(const std::string& name) {
  return name.ends_with(".json") ? "application/json" : name.ends_with(".yaml") ? "application/yaml" : "text/plain";
}

}  // namespace

McapCompression usual_mcap_compression() { return mcap::has_zstd() ? McapCompression::zstd : McapCompression::none; }

struct McapWriter::Impl {
  Messages messages;
  Scene scene;
  mcap::GrowingFile file;
  mcap::Writer writer;
  std::vector<std::uint16_t> channels;  ///< by topic
  std::vector<Message> memory;
  bool begun = false, closed = false, failed = false;

  Impl(const std::filesystem::path& path, const Scene& of, const Camera& camera, const McapOptions& options,
       const SimulatorOptions& simulated)
      : messages(of, camera, options.messages), scene(of), file(path), writer(file, film_options(options)) {
    const std::string meta = results::frame_meta(of, camera, simulated, 0);
    writer.attach("camera.yaml", "application/yaml", results::profile_of_meta(meta, "camera"));
    for (const auto& [name, text] : options.attachments) writer.attach(name, media_type_of(name), text);
    const MessageOptions& how = messages.options();
    writer.add_metadata("tofray", {{"version", base::version()},
                                   {"seed", std::to_string(simulated.seed)},
                                   {"noise", results::noise_name(simulated.noise)},
                                   {"scene", of.name},
                                   {"camera", camera.name},
                                   {"mode", camera.mode.name},
                                   {"driver", run::driver_words()[static_cast<std::size_t>(how.driver)]},
                                   {"stamp", run::stamp_words()[static_cast<std::size_t>(how.stamp)]},
                                   {"amplitude_step_e", base::number_text(how.amplitude_step_e)},
                                   {"epoch_s", base::number_text(how.epoch_s)},
                                   {"meta", meta}});
    std::map<std::string, std::uint16_t> schemas;
    for (const Topic& topic : messages.topics()) {
      if (!schemas.contains(topic.type)) schemas[topic.type] = writer.add_schema(topic.type, "ros2msg", message_definition(topic.type));
      channels.push_back(writer.add_channel(schemas[topic.type], topic.name, "cdr", {{"offered_qos_profiles", ""}}));
    }
  }
  void put(const std::vector<Message>& all) {
    for (const Message& one : all) {
      const auto when = static_cast<std::uint64_t>(one.publish_ns);
      writer.message(channels[one.topic], when, when, one.data);
    }
  }
};

McapWriter::McapWriter(const std::filesystem::path& file, const Scene& scene, const Camera& camera, const McapOptions& options,
                       const SimulatorOptions& simulated)
    : impl_(std::make_unique<Impl>(file, scene, camera, options, simulated)) {}

McapWriter::~McapWriter() {
  if (!impl_ || impl_->closed || (impl_->failed && impl_->begun)) return;
  if (!impl_->begun) {
    impl_->file.discard();
    return;
  }
  try {
    impl_->writer.end_chunk();
  } catch (const Error&) {
    // what is there stays
  }
}
McapWriter::McapWriter(McapWriter&&) noexcept = default;
McapWriter& McapWriter::operator=(McapWriter&&) noexcept = default;

const Messages& McapWriter::messages() const { return impl_->messages; }

void McapWriter::write(const Frame& frame) { write(frame, impl_->scene); }

void McapWriter::write(const Frame& frame, const Scene& seen) {
  impl_->messages.of(frame, seen, impl_->memory);
  write(frame, impl_->memory);
}

void McapWriter::write(const Frame& frame, const std::vector<Message>& messages) {
  if (impl_->closed) throw Error(ErrorKind::bad_input, "error: the file is closed\n  expected write() before close()");
  try {
    if (!impl_->begun) impl_->put(impl_->messages.before(frame));
    impl_->begun = true;
    impl_->put(messages);
  } catch (...) {
    impl_->failed = true;
    throw;
  }
}

FileRecord McapWriter::close() {
  if (impl_->closed) throw Error(ErrorKind::bad_input, "error: the file is closed already\n  expected one close()");
  impl_->closed = true;
  impl_->writer.finish();
  return impl_->file.finish();
}

}  // namespace tofray
