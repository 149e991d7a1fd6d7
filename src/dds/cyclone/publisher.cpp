// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "dds/publisher.h"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <stdexcept>
#include <vector>

#include "dds/cyclone/raw_type.h"

namespace tofray::dds {

namespace {

/// What Cyclone DDS says of errors, to be part of ours.
class Log {
 public:
  Log() {
    dds_set_log_mask(DDS_LC_FATAL | DDS_LC_ERROR);
    dds_set_log_sink(take, this);
  }
  ~Log() { dds_set_log_sink(nullptr, nullptr); }
  Log(const Log&) = delete;
  Log& operator=(const Log&) = delete;
  [[nodiscard]] std::string text() const {
    const std::scoped_lock lock(mutex_);
    return said_.empty() ? "" : "  Cyclone DDS says: " + said_;
  }

 private:
  static void take(void* self, const dds_log_data_t* entry) {
    auto* const log = static_cast<Log*>(self);
    const std::scoped_lock lock(log->mutex_);
    constexpr std::size_t enough = 1000;
    if (log->said_.size() < enough) log->said_.append(entry->message + entry->hdrsize, entry->size - entry->hdrsize);
  }
  mutable std::mutex mutex_;
  std::string said_;
};

/// A quality of service, until the end of its scope.
struct Qos {
  dds_qos_t* const get = dds_create_qos();
  Qos() = default;
  ~Qos() { dds_delete_qos(get); }
  Qos(const Qos&) = delete;
  Qos& operator=(const Qos&) = delete;
};

/// Of a writer whose readers are behind. Another one than the 100 ms that are usual: Cyclone DDS tells others nothing of what is usual, and
/// not all of them (npm's @foxglove/rtps) know what that is.
constexpr dds_duration_t patience = DDS_MSECS(50);

void set_quality(dds_qos_t* qos, bool lasting, int history) {
  dds_qset_reliability(qos, lasting ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT, patience);
  dds_qset_durability(qos, lasting ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, history);
  constexpr std::int32_t any = DDS_LENGTH_UNLIMITED;
  dds_qset_durability_service(qos, 0, DDS_HISTORY_KEEP_LAST, history, any, any, any);
  dds_qset_writer_data_lifecycle(qos, false);
}

std::string interface_element(const std::string& name) {
  if (name == "auto") return "<NetworkInterface autodetermine=\"true\"/>";
  const bool address = name.find_first_not_of("0123456789.") == std::string::npos || name.find(':') != std::string::npos;
  const std::string multicast = name == "lo" ? " multicast=\"true\"" : "";  // which Linux has there, and does not say
  return "<NetworkInterface " + std::string(address ? "address" : "name") + "=\"" + name + "\"" + multicast + "/>";
}

/// On loopback others are found by multicast and, as ROS's nodes that stay on a machine do it, by knocking at the first ports; datagrams
/// are as large as they can be. More than 64 MB that a reader has not taken hold a writer up.
std::string network_config(const Settings& settings) {
  if (!settings.config.empty()) return settings.config;
  const bool local = settings.interface == "lo";
  const std::string general = "<General><Interfaces>" + interface_element(settings.interface) + "</Interfaces>" +
                              (local ? "<AllowMulticast>spdp</AllowMulticast><MaxMessageSize>65500B</MaxMessageSize>"
                                       "<FragmentSize>63000B</FragmentSize>"
                                     : "") +
                              "</General>";
  const std::string discovery = local ? "<Discovery><ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>32"
                                        "</MaxAutoParticipantIndex><Peers><Peer address=\"127.0.0.1\"/></Peers></Discovery>"
                                      : "";
  const std::string internal = "<Internal><Watermarks><WhcHigh>64MB</WhcHigh></Watermarks></Internal>";
  return "<CycloneDDS><Domain>" + general + discovery + internal + "</Domain></CycloneDDS>";
}

class CyclonePublisher : public stream::Publisher {
 public:
  explicit CyclonePublisher(const Settings& settings) : settings_(settings) {
    domain_ = checked(dds_create_domain(static_cast<dds_domainid_t>(settings.domain), network_config(settings).c_str()), "start");
    try {
      participant_ = checked(dds_create_participant(static_cast<dds_domainid_t>(settings.domain), nullptr, nullptr), "join its domain");
    } catch (const std::runtime_error&) {
      dds_delete(domain_);
      throw;
    }
  }
  ~CyclonePublisher() override { dds_delete(domain_); }
  CyclonePublisher(const CyclonePublisher&) = delete;
  CyclonePublisher& operator=(const CyclonePublisher&) = delete;

  int offer(const stream::TopicForm& form) override {
    const Qos qos;
    set_quality(qos.get, form.lasting, settings_.history);
    ddsi_sertype* type = make_raw_type(dds_type(form.type).c_str());
    const dds_entity_t topic = dds_create_topic_sertype(participant_, dds_topic(form.name).c_str(), &type, qos.get, nullptr, nullptr);
    if (topic < 0) ddsi_sertype_unref(type);
    checked(topic, "offer " + form.name);
    const std::string hash = "typehash=" + form.type_hash + ";";
    dds_qset_userdata(qos.get, hash.data(), hash.size());
    const dds_entity_t writer = checked(dds_create_writer(participant_, topic, qos.get, nullptr), "offer " + form.name);
    writers_.push_back({writer, type, form.lasting});
    return static_cast<int>(writers_.size() - 1);
  }

  bool send(int topic, std::string_view cdr, std::int64_t) override {
    const Writer& writer = writers_.at(static_cast<std::size_t>(topic));
    const dds_return_t sent = dds_writecdr(writer.entity, make_raw_data(writer.type, cdr));
    if (sent == DDS_RETCODE_TIMEOUT) return false;
    checked(sent, "send");
    return true;
  }

  int readers() override {
    int all = 0;
    for (const Writer& writer : writers_) {
      dds_publication_matched_status_t status{};
      checked(dds_get_publication_matched_status(writer.entity, &status), "count readers");
      all += static_cast<int>(status.current_count);
    }
    return all;
  }

  bool delivered(double at_most_s) override {
    using Clock = std::chrono::steady_clock;
    const Clock::time_point end = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(at_most_s));
    return std::all_of(writers_.begin(), writers_.end(), [&](const Writer& writer) {
      if (!writer.reliable) return true;
      const auto left = std::chrono::duration_cast<std::chrono::nanoseconds>(end - Clock::now()).count();
      return dds_wait_for_acks(writer.entity, std::max<dds_duration_t>(left, 0)) == DDS_RETCODE_OK;
    });
  }

 private:
  struct Writer {
    dds_entity_t entity;
    const ddsi_sertype* type;  ///< of its topic
    bool reliable;
  };
  dds_entity_t checked(dds_entity_t result, const std::string& what) const {
    if (result >= 0) return result;
    const std::string where = settings_.config.empty() ? "on the interface " + settings_.interface : "with this CYCLONEDDS_URI";
    throw std::runtime_error("error: DDS cannot " + what + " (" + dds_strretcode(result) + "), " + where + "\n" + log_.text());
  }

  Settings settings_;
  Log log_;
  dds_entity_t domain_ = 0, participant_ = 0;
  std::vector<Writer> writers_;
};

}  // namespace

extern "C" __attribute__((visibility("default"))) const char* tofray_dds_identity() { return TOFRAY_DDS_IDENTITY; }
extern "C" __attribute__((visibility("default"))) stream::Publisher* tofray_dds_open(const Settings& settings) {
  return new CyclonePublisher(settings);
}

}  // namespace tofray::dds
