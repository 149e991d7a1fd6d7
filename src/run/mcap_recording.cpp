// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "run/mcap_recording.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "base/bytes.h"
#include "base/text.h"
#include "files/data_limits.h"
#include "files/json.h"
#include "files/npz.h"
#include "tofray/error.h"

namespace tofray::run {

namespace {

/// Takes a message of plain CDR, little endian, apart. Where it ends early, good() is false from then on and all is 0.
class CdrTake {
 public:
  explicit CdrTake(std::string_view message) : good_(message.size() >= 4 && message.substr(0, 2) == std::string_view("\0\1", 2)) {
    if (good_) body_ = message.substr(4);
  }
  template <class T>
  T number() {
    at_ += (sizeof(T) - at_ % sizeof(T)) % sizeof(T);
    const std::string_view bytes = raw(sizeof(T));
    return good_ ? base::read_bytes_as<T>(bytes.data()) : T{};
  }
  std::string_view text() {
    const std::string_view all = raw(number<std::uint32_t>());
    return all.empty() ? all : all.substr(0, all.size() - 1);
  }
  std::string_view bytes() { return raw(number<std::uint32_t>()); }
  [[nodiscard]] bool good() const { return good_; }

 private:
  std::string_view raw(std::size_t size) {
    if (!good_ || at_ > body_.size() || size > body_.size() - at_) {
      good_ = false;
      return {};
    }
    at_ += size;
    return body_.substr(at_ - size, size);
  }
  std::string_view body_;
  std::size_t at_ = 0;
  bool good_;
};

struct RawImage {
  std::size_t width = 0, height = 0;
  std::string codes;  ///< uint16, little endian, rows without gaps
};

/// When all images have come and how they were exposed.
struct RawFrameSet {
  std::map<std::string, RawImage> images;  ///< by topic
  std::optional<files::Json> meta;
  std::uint64_t first = 0;  ///< where the first of them is in the file
};

/// Is told of each frame that is whole. @return whether more are wanted
using TakePlace = std::function<bool(const Film::Place&, const std::function<Recording()>& recording)>;

class FilmReader {
 public:
  /// @param meta  of the film, where it was read before
  FilmReader(std::string where, TakePlace take, std::string meta = {})
      : where_(std::move(where)), shown_(base::printable(where_)), meta_(std::move(meta)), take_(std::move(take)) {
    reading_.metadata = [&](std::string_view name, const mcap::Pairs& pairs) {
      for (const auto& [key, value] : pairs)
        if (name == "tofray" && key == "meta") meta_ = value;
    };
    reading_.message = [&](const mcap::SeenMessage& message) {
      if (wanted_) see(message);
    };
  }

  FilmRead read(mcap::Source& source) {
    mcap::Ended ended = mcap::read(source, where_, reading_);
    out_.complete = ended.complete, channels_ = std::move(ended.channels);
    return out_;
  }
  void read(mcap::Source& source, const mcap::Part& part) { mcap::read_part(source, where_, reading_, part); }

  [[nodiscard]] const std::string& meta() const { return meta_; }
  [[nodiscard]] const std::map<std::uint16_t, mcap::Channel>& channels() const { return channels_; }

 private:
  [[noreturn]] void refuse(const std::string& topic, const std::string& what, const std::string& expected) const {
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: error: a message of {} {}\n  expected {}", shown_, base::printable(topic), what, expected));
  }

  void see(const mcap::SeenMessage& message) {
    const std::string& topic = message.channel.topic;
    if (message.channel.schema.name == "sensor_msgs/msg/Image") {
      if (out_.raw_topics_of.empty()) out_.raw_topics_of = topic;
      if (topic.find("/raw/p") != std::string::npos) see_image(message);
    } else if (message.channel.schema.name == "std_msgs/msg/String" && topic.ends_with("/raw/meta")) {
      CdrTake from(message.data);
      const std::string_view text = from.text();
      if (!from.good()) refuse(topic, "is not the CDR of a std_msgs/msg/String", "plain CDR, little endian");
      RawFrameSet& set = set_of(message);
      set.meta = files::parse_json(text, shown_ + ": " + base::printable(topic));
      complete(message, topic);
    }
  }

  void see_image(const mcap::SeenMessage& message) {
    const std::string& topic = message.channel.topic;
    CdrTake from(message.data);
    from.number<std::uint32_t>(), from.number<std::uint32_t>(), from.text();  // header
    RawImage image;
    image.height = from.number<std::uint32_t>(), image.width = from.number<std::uint32_t>();
    const std::string_view encoding = from.text();
    const bool big_endian = from.number<std::uint8_t>() != 0;
    const std::size_t step = from.number<std::uint32_t>();
    const std::string_view data = from.bytes();
    if (!from.good()) refuse(topic, "is not the CDR of a sensor_msgs/msg/Image", "plain CDR, little endian");
    if (encoding != "mono16" && encoding != "16UC1")
      refuse(topic, "has the encoding " + base::in_quotes(encoding), "mono16: codes of the ADC");
    if (image.width < 1 || image.height < 1 || image.width > files::max_image_side || image.height > files::max_image_side ||
        step < 2 * image.width || data.size() != step * image.height)
      refuse(topic, fmt::format("has {} bytes for {} x {} pixels in rows of {}", data.size(), image.width, image.height, step),
             "2 bytes each, 1 to 16384 pixels along each side");
    image.codes.reserve(2 * image.width * image.height);
    for (std::size_t v = 0; v < image.height; ++v) image.codes.append(data.substr(v * step, 2 * image.width));
    if (big_endian)
      for (std::size_t i = 0; i + 1 < image.codes.size(); i += 2) std::swap(image.codes[i], image.codes[i + 1]);
    set_of(message).images[topic] = std::move(image);
    complete(message, topic);
  }

  /// Messages of a frame have one log time.
  RawFrameSet& set_of(const mcap::SeenMessage& message) {
    constexpr std::size_t most_open = 16;  // frames that lack something do not fill the memory
    const bool known = open_.contains(message.log_ns);
    if (!known && open_.size() >= most_open) open_.erase(open_.begin());
    RawFrameSet& set = open_[message.log_ns];
    if (!known) set.first = message.at;
    return set;
  }

  void complete(const mcap::SeenMessage& message, const std::string& topic) {
    const RawFrameSet& set = open_[message.log_ns];
    if (!set.meta) return;
    const files::Json* topics = set.meta->find("topics");
    const files::Json::Array* names = topics == nullptr ? nullptr : topics->items();
    if (names == nullptr || names->empty() || names->size() > files::max_phases)
      refuse(topic, "does not say which topics have the raw frames", "\"topics\": a list of them");
    for (const files::Json& name : *names)
      if (!name.is_string() || !set.images.contains(*name.string())) return;  // it is still to come
    std::uint64_t index = out_.frames;
    if (const files::Json* said = set.meta->find("frame"); said != nullptr) said->unsigned_integer(index);
    ++out_.frames;
    wanted_ = take_({index, message.log_ns, set.first, message.at}, [&] { return recording_of(set, *names, topic); });
    open_.erase(message.log_ns);
  }

  /// As a file of its own; what is wrong with the numbers is said by whoever reads it.
  [[nodiscard]] Recording recording_of(const RawFrameSet& set, const files::Json::Array& names, const std::string& topic) const {
    const RawImage& first = set.images.at(*names[0].string());
    std::string codes;
    for (const files::Json& name : names) {
      const RawImage& one = set.images.at(*name.string());
      if (one.width != first.width || one.height != first.height)
        refuse(*name.string(), fmt::format("has {} x {} pixels", one.width, one.height),
               fmt::format("{} x {}, as {} has", first.width, first.height, base::printable(*names[0].string())));
      codes += one.codes;
    }
    std::vector<files::NpyView> views = {{"raw", files::npy_type_of<std::uint16_t>(), {names.size(), first.height, first.width}, codes}};
    std::map<std::string, std::vector<double>> lists;
    for (const char* name : {"modulation_frequency_hz", "reference_phase_rad", "integration_time_s", "start_time_s", "lit"}) {
      const files::Json* list = set.meta->find(name);
      if (list == nullptr || list->items() == nullptr) refuse(topic, fmt::format("lacks {}", name), "a number for each raw frame");
      std::vector<double>& values = lists[name];
      for (const files::Json& one : *list->items()) {
        double value = std::nan("");
        if (one.boolean() != nullptr)
          value = *one.boolean() ? 1 : 0;
        else
          one.number(value);
        values.push_back(value);
      }
    }
    std::vector<std::uint8_t> lit;
    for (const double one : lists["lit"]) lit.push_back(one != 0 ? 1 : 0);
    for (const auto& [name, values] : lists)
      if (name != "lit") views.push_back(files::npy_view(name, {values.size()}, values));
    views.push_back(files::npy_view("lit", {lit.size()}, lit, files::npy_type_of<bool>()));
    return {where_, files::npz_bytes(views), meta_};
  }

  std::string where_, shown_, meta_;
  TakePlace take_;
  mcap::Reading reading_;
  std::map<std::uint16_t, mcap::Channel> channels_;
  std::map<std::uint64_t, RawFrameSet> open_;
  FilmRead out_;
  bool wanted_ = true;
};

}  // namespace

bool is_film(const std::string& path) { return path.ends_with(".mcap"); }

FilmRead read_film(mcap::Source& source, const std::string& where, const std::function<bool(std::uint64_t, const Recording&)>& take) {
  return FilmReader(where,
                    [&](const Film::Place& place, const std::function<Recording()>& recording) { return take(place.index, recording()); })
      .read(source);
}

void refuse_film_without_raw(const std::string& path) {
  throw Error(ErrorKind::bad_input, base::printable(path) +
                                        ": error: there are no raw frames in it\n  expected the topics raw/p0, … and raw/meta of "
                                        "`tofray render --emit mcap`, which --topics may leave out");
}

Film::Film(std::string path, std::unique_ptr<mcap::Source> source) : path_(std::move(path)), source_(std::move(source)) {
  FilmReader reader(path_, [&](const Place& place, const std::function<Recording()>&) {
    places_.push_back(place);
    return true;
  });
  complete_ = reader.read(*source_).complete;
  meta_ = reader.meta(), channels_ = reader.channels();
  if (places_.empty()) refuse_film_without_raw(path_);
}

Recording Film::frame(std::uint64_t number) const {
  const Place& wanted = places_[number];
  std::optional<Recording> found;
  FilmReader reader(
      path_,
      [&](const Place& place, const std::function<Recording()>& recording) {
        if (place.log_ns == wanted.log_ns) found = recording();
        return !found;
      },
      meta_);
  reader.read(*source_, {wanted.first, wanted.last, channels_});
  if (!found)
    throw Error(ErrorKind::bad_input, base::printable(path_) + ": error: the file has changed since it was opened\n  open it again");
  return std::move(*found);
}

}  // namespace tofray::run
