// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "films.h"

#include <optional>

#include "convert.h"
#include "frames.h"
#include "simulator.h"

namespace tofray::python {

namespace {

template <class T>
void take_film_word(const py::dict& words, const char* name, T& into) {
  if (words.contains(name) && !words[name].is_none()) from_python(words[name], into, {nullptr, name});
}

std::unique_ptr<McapWriter> writer_of(const std::string& file, const py::object& scene, const py::object& camera, const py::dict& words,
                                      const py::dict& simulated) {
  Scene of;
  Camera by;
  from_python(scene, of, {nullptr, "scene"}), from_python(camera, by, {nullptr, "camera"});
  const SimulatorOptions options = options_from_python(simulated);
  McapOptions how;
  std::optional<McapCompression> compression;
  take_film_words(words, how.messages, compression);
  if (compression) how.compression = *compression;
  const py::gil_scoped_release free;
  return std::make_unique<McapWriter>(file, of, by, how, options);
}

/// @param seen  the frame's own scene, or None
void write_frame(McapWriter& writer, const py::object& frame, const py::object& seen) {
  const std::shared_ptr<Frame> one = frame_from_python(frame);
  std::optional<Scene> scene;
  if (!seen.is_none()) from_python(seen, scene.emplace(), {nullptr, "scene"});
  const py::gil_scoped_release free;
  if (scene)
    writer.write(*one, *scene);
  else
    writer.write(*one);
}

py::dict contents_of(const std::string& file) {
  McapContents contents;
  {
    const py::gil_scoped_release free;
    contents = mcap_contents(file);
  }
  py::dict out, topics, attachments, metadata;
  for (const McapContents::Channel& one : contents.channels) {
    py::dict topic;
    topic["type"] = one.type, topic["encoding"] = one.encoding, topic["messages"] = one.messages, topic["bytes"] = one.bytes;
    topic["rate_hz"] = one.rate_hz, topic["first_ns"] = one.first_ns, topic["last_ns"] = one.last_ns;
    topics[py::str(one.topic)] = topic;
  }
  for (const auto& [name, bytes] : contents.attachments) attachments[py::str(name)] = bytes;
  for (const auto& [name, pairs] : contents.metadata) {
    py::dict values;
    for (const auto& [key, value] : pairs) values[py::str(key)] = value;
    metadata[py::str(name)] = values;
  }
  out["profile"] = contents.profile, out["library"] = contents.library, out["complete"] = contents.complete;
  out["bytes"] = contents.bytes, out["lost_bytes"] = contents.lost_bytes, out["chunks"] = contents.chunks;
  out["compression"] = contents.compression, out["messages"] = contents.messages;
  out["first_ns"] = contents.first_ns, out["last_ns"] = contents.last_ns;
  out["topics"] = topics, out["attachments"] = attachments, out["metadata"] = metadata;
  return out;
}

}  // namespace

void take_film_words(const py::dict& words, MessageOptions& messages, std::optional<McapCompression>& compression) {
  take_film_word(words, "driver", messages.driver), take_film_word(words, "stamp", messages.stamp),
      take_film_word(words, "name", messages.name);
  take_film_word(words, "topics", messages.topics), take_film_word(words, "depth_encoding", messages.depth_encoding);
  take_film_word(words, "unorganized", messages.unorganized), take_film_word(words, "amplitude_step_e", messages.amplitude_step_e);
  take_film_word(words, "epoch_s", messages.epoch_s);
  if (words.contains("compression") && !words["compression"].is_none())
    from_python(words["compression"], compression.emplace(), {nullptr, "compression"});
}

void bind_films(py::module_& module) {
  py::class_<McapWriter>(module, "McapFile").def(py::init(&writer_of)).def("write", &write_frame).def("close", [](McapWriter& writer) {
    FileRecord record;
    {
      const py::gil_scoped_release free;
      record = writer.close();
    }
    return to_python(record);
  });
  module.def("mcap_contents", &contents_of);
}

}  // namespace tofray::python
