// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
// fast_dds_reader DOMAIN QOS TOPIC=TYPE…: subscribes by eProsima's Fast DDS, which shares no line with what tofray sends by, on loopback.
// Says on stdout "ready"; then, of each writer that it finds, "writer TOPIC TYPE USER_DATA RELIABILITY DURABILITY", and, of each message,
// "message TOPIC BYTES SHA256", of the bytes with zeros up to a multiple of 4; ends when its input ends, with "end". TOPIC and TYPE are
// DDS's names. QOS is lasting (reliable, transient local) or sensor (best effort, volatile).
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <openssl/evp.h>
#include <unistd.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <iostream>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

std::mutex talk;

void tell(const std::string& line) {
  const std::scoped_lock lock(talk);
  std::cout << line << std::endl;
}

std::string sha256(const std::string& bytes) {
  unsigned char digest[EVP_MAX_MD_SIZE];
  unsigned size = 0;
  EVP_Digest(bytes.data(), bytes.size(), digest, &size, EVP_sha256(), nullptr);
  std::string out;
  char two[3];
  for (unsigned i = 0; i < size; ++i) std::snprintf(two, sizeof two, "%02x", digest[i]), out += two;
  return out;
}

/// Messages as they come.
class AsTheyAre : public fast::TopicDataType {
 public:
  explicit AsTheyAre(const std::string& type) {
    setName(type.c_str());
    m_typeSize = 1 << 24;
  }
  bool serialize(void*, rtps::SerializedPayload_t*) override { return false; }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<std::string*>(data)->assign(reinterpret_cast<const char*>(payload->data), payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return 0u; };
  }
  void* createData() override { return new std::string; }
  void deleteData(void* data) override { delete static_cast<std::string*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

class Reader : public fast::DataReaderListener {
 public:
  explicit Reader(std::string topic) : topic_(std::move(topic)) {}
  void on_data_available(fast::DataReader* reader) override {
    std::string bytes;
    fast::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      bytes.resize((bytes.size() + 3) / 4 * 4, '\0');
      tell("message " + topic_ + " " + std::to_string(bytes.size()) + " " + sha256(bytes));
    }
  }

 private:
  std::string topic_;
};

class Finder : public fast::DomainParticipantListener {
  void on_publisher_discovery(fast::DomainParticipant*, rtps::WriterDiscoveryInfo&& found) override {
    if (found.status != rtps::WriterDiscoveryInfo::DISCOVERED_WRITER) return;
    const auto& data = found.info.m_qos.m_userData.data_vec();
    const auto& qos = found.info.m_qos;
    tell("writer " + std::string(found.info.topicName().c_str()) + " " + found.info.typeName().c_str() + " " +
         std::string(data.begin(), data.end()) + (data.empty() ? "-" : "") +
         (qos.m_reliability.kind == fast::RELIABLE_RELIABILITY_QOS ? " reliable" : " best_effort") +
         (qos.m_durability.kind == fast::TRANSIENT_LOCAL_DURABILITY_QOS ? " transient_local" : " volatile"));
  }
};

fast::DomainParticipantQos on_loopback() {
  fast::DomainParticipantQos qos = fast::PARTICIPANT_QOS_DEFAULT;
  const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.emplace_back("127.0.0.1");
  constexpr unsigned buffer = 4u << 20;
  udp->receiveBufferSize = buffer;
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  qos.transport().listen_socket_buffer_size = buffer;
  return qos;
}

fast::DataReaderQos quality(bool lasting) {
  fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
  qos.reliability().kind = lasting ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = lasting ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
  qos.history().kind = fast::KEEP_ALL_HISTORY_QOS;
  qos.endpoint().history_memory_policy = rtps::DYNAMIC_RESERVE_MEMORY_MODE;
  return qos;
}

}  // namespace

int main(int count, char** words) {
  if (count < 4) return std::fprintf(stderr, "fast_dds_reader DOMAIN lasting|sensor TOPIC=TYPE...\n"), 2;
  Finder finder;
  const fast::StatusMask none = fast::StatusMask::none();
  auto* const factory = fast::DomainParticipantFactory::get_instance();
  fast::DomainParticipant* participant =
      factory->create_participant(static_cast<unsigned>(std::atoi(words[1])), on_loopback(), &finder, none);
  if (participant == nullptr) return std::fprintf(stderr, "no participant\n"), 1;
  fast::Subscriber* subscriber = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  std::vector<std::unique_ptr<Reader>> readers;
  for (int i = 3; i < count; ++i) {
    const std::string word = words[i], topic = word.substr(0, word.find('=')), type = word.substr(word.find('=') + 1);
    fast::TypeSupport(new AsTheyAre(type)).register_type(participant);
    readers.push_back(std::make_unique<Reader>(topic));
    fast::Topic* described = participant->create_topic(topic, type, fast::TOPIC_QOS_DEFAULT);
    if (subscriber->create_datareader(described, quality(std::strcmp(words[2], "lasting") == 0), readers.back().get()) == nullptr)
      return std::fprintf(stderr, "no reader of %s\n", topic.c_str()), 1;
  }
  tell("ready");
  char rest[256];
  while (::read(0, rest, sizeof rest) > 0) {}
  participant->delete_contained_entities();
  factory->delete_participant(participant);
  tell("end");
  return 0;
}
