// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/live/ros2_network.hpp>

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <deque>
#include <map>
#include <mutex>
#include <stdexcept>

#ifdef __SANITIZE_ADDRESS__
// Fast DDS deletes its readers as one of their bases, which has no virtual destructor.
extern "C" const char* __asan_default_options() { return "new_delete_type_mismatch=0"; }
#endif

namespace heel {

namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using Bytes = std::vector<std::uint8_t>;

/// "sensor_msgs/Image" as DDS calls it in ROS 2.
std::string ddsType(const std::string& type) {
  const auto slash = type.find('/');
  return type.substr(0, slash) + "::msg::dds_::" + type.substr(slash + 1) + "_";
}

/// And back; empty for what is no message of ROS 2.
std::string rosType(const std::string& dds_type) {
  const std::string middle = "::msg::dds_::";
  const auto at = dds_type.find(middle);
  if (at == std::string::npos || dds_type.back() != '_') return {};
  const auto name = at + middle.size();
  return dds_type.substr(0, at) + "/" + dds_type.substr(name, dds_type.size() - name - 1);
}

/// Bytes that are a message already.
class PackedType : public dds::TopicDataType {
 public:
  explicit PackedType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 4;  // of what is allocated at first
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }

  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    if (bytes.size() > payload->max_size) return false;
    std::memcpy(payload->data, bytes.data(), bytes.size());
    payload->length = static_cast<std::uint32_t>(bytes.size());
    payload->encapsulation = CDR_LE;
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    const auto size = static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size());
    return [size] { return size; };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

}  // namespace

/// Callbacks come in threads of DDS: they take the mutex, and nothing else of ours waits in it.
struct Ros2Network::State final : dds::DomainParticipantListener {
  /// What comes on one topic.
  struct Inbox final : dds::DataReaderListener {
    Inbox(State& owner, BagTopic what, std::size_t most)
        : state(owner), topic(std::move(what)), depth(most) {}
    void on_data_available(dds::DataReader* from) override {
      Bytes bytes;
      dds::SampleInfo info;
      while (from->take_next_sample(&bytes, &info) == ReturnCode_t::RETCODE_OK) {
        if (info.valid_data) state.put(*this, std::move(bytes));
        bytes.clear();
      }
    }
    State& state;
    BagTopic topic;
    std::size_t depth;
    std::size_t waiting = 0;
    dds::DataReader* reader = nullptr;
  };

  void put(Inbox& inbox, Bytes bytes) {
    using namespace std::chrono;
    const auto now = duration_cast<nanoseconds>(system_clock::now().time_since_epoch()).count();
    const std::lock_guard<std::mutex> lock(mutex);
    if (inbox.waiting == inbox.depth) {
      const auto oldest = std::find_if(messages.begin(), messages.end(), [&](const LiveMessage& m) {
        return m.topic.name == inbox.topic.name;
      });
      messages.erase(oldest);
      --inbox.waiting;
    }
    messages.push_back({inbox.topic, now, std::move(bytes)});
    ++inbox.waiting;
    came.notify_one();
  }

  void on_publisher_discovery(dds::DomainParticipant*, rtps::WriterDiscoveryInfo&& found) override {
    using Info = rtps::WriterDiscoveryInfo;
    const std::string type = rosType(found.info.typeName().to_string());
    const std::string name = found.info.topicName().to_string();
    const std::string before = "rt" + params.ros_namespace;
    if (type.empty() || name.rfind(before + "/", 0) != 0) return;
    const std::lock_guard<std::mutex> lock(mutex);
    Writers& these = writers[name.substr(before.size())];
    these.type = type;
    these.is_reliable = found.info.m_qos.m_reliability.kind == dds::RELIABLE_RELIABILITY_QOS;
    if (found.status == Info::DISCOVERED_WRITER) ++these.count;
    if (found.status == Info::REMOVED_WRITER && these.count > 0) --these.count;
  }

  /// Of one topic.
  struct Writers {
    std::string type;
    int count = 0;
    bool is_reliable = false;  // the last one
  };

  dds::Topic* topicOf(const std::string& name, const std::string& type) {
    const std::string dds_name = "rt" + params.ros_namespace + name;
    if (auto* known = dynamic_cast<dds::Topic*>(participant->lookup_topicdescription(dds_name))) {
      return known;
    }
    dds::TypeSupport(new PackedType(ddsType(type))).register_type(participant);
    dds::Topic* topic = participant->create_topic(dds_name, ddsType(type), dds::TOPIC_QOS_DEFAULT);
    if (topic == nullptr) throw std::runtime_error("ROS 2: no topic " + name + " can be made");
    return topic;
  }

  LiveNetworkParams params;
  dds::DomainParticipant* participant = nullptr;
  dds::Publisher* publisher = nullptr;
  dds::Subscriber* subscriber = nullptr;
  std::vector<std::unique_ptr<Inbox>> inboxes;  // they do not move

  mutable std::mutex mutex;  // guards what follows, and `waiting` of the inboxes
  std::condition_variable came;
  std::deque<LiveMessage> messages;
  std::map<std::string, Writers> writers;  // by the topic, as ROS tells it
};

namespace {

class Ros2Writer final : public BagWriter {
 public:
  using MakeWriter = std::function<dds::DataWriter*(const std::string&, const std::string&, bool)>;
  explicit Ros2Writer(MakeWriter make) : make_(std::move(make)) {}

  BagForm form() const override { return BagForm::kRos2; }
  void commit(bool) override {}

 private:
  void add(std::size_t topic) override {
    writers_.push_back(make_(topics_[topic].name, topics_[topic].type, topics_[topic].latched));
  }
  void put(std::size_t topic, std::int64_t, const Bytes& bytes) override {
    writers_[topic]->write(const_cast<Bytes*>(&bytes));
  }
  bool isHeard(std::size_t topic) const override {
    dds::PublicationMatchedStatus matched;
    writers_[topic]->get_publication_matched_status(matched);
    return matched.current_count > 0;
  }

  MakeWriter make_;
  std::vector<dds::DataWriter*> writers_;
};

}  // namespace

Ros2Network::Ros2Network(const LiveNetworkParams& params) : state_(std::make_unique<State>()) {
  state_->params = params;
  dds::DomainParticipantQos qos;
  qos.name("heel");
  if (params.localhost_only) {
    auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    udp->interfaceWhiteList = {"127.0.0.1"};
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports = {udp};
  }
  state_->participant = dds::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<std::uint32_t>(params.domain), qos, state_.get(), dds::StatusMask::none());
  if (state_->participant == nullptr) {
    throw std::runtime_error("ROS 2: there is no way into domain " + std::to_string(params.domain));
  }
  state_->publisher = state_->participant->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  state_->subscriber = state_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
}

Ros2Network::~Ros2Network() {
  state_->participant->set_listener(nullptr);
  for (const auto& inbox : state_->inboxes) inbox->reader->set_listener(nullptr);
  state_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(state_->participant);
}

std::vector<BagTopic> Ros2Network::topics() const {
  const std::lock_guard<std::mutex> lock(state_->mutex);
  std::vector<BagTopic> topics;
  for (const auto& [name, these] : state_->writers) {
    if (these.count > 0) topics.push_back({name, these.type, {}});
  }
  return topics;
}

void Ros2Network::subscribe(const BagTopic& topic, Delivery delivery, std::size_t depth) {
  State::Inbox& inbox =
      *state_->inboxes.emplace_back(std::make_unique<State::Inbox>(*state_, topic, depth));
  dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
  // Who asks for more than the writer promises hears nothing.
  bool is_reliable = delivery != Delivery::kAsSent;
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    is_reliable = is_reliable || state_->writers[topic.name].is_reliable;
  }
  qos.reliability().kind =
      is_reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = delivery == Delivery::kLatched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS
                                                         : dds::VOLATILE_DURABILITY_QOS;
  qos.history().depth = static_cast<int>(depth);
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  inbox.reader =
      state_->subscriber->create_datareader(state_->topicOf(topic.name, topic.type), qos, &inbox);
  if (inbox.reader == nullptr) {
    throw std::runtime_error("ROS 2: the topic " + topic.name + " can't be listened to");
  }
}

void Ros2Network::unsubscribe(const std::string& topic) {
  const auto found = std::find_if(state_->inboxes.begin(), state_->inboxes.end(),
                                  [&](const auto& inbox) { return inbox->topic.name == topic; });
  if (found == state_->inboxes.end()) return;
  (*found)->reader->set_listener(nullptr);
  state_->subscriber->delete_datareader((*found)->reader);
  const std::lock_guard<std::mutex> lock(state_->mutex);
  auto& messages = state_->messages;
  messages.erase(std::remove_if(messages.begin(), messages.end(),
                                [&](const LiveMessage& m) { return m.topic.name == topic; }),
                 messages.end());
  state_->inboxes.erase(found);
}

std::optional<LiveMessage> Ros2Network::next(double timeout_s) {
  std::unique_lock<std::mutex> lock(state_->mutex);
  state_->came.wait_for(lock, std::chrono::duration<double>(timeout_s),
                        [&] { return !state_->messages.empty(); });
  if (state_->messages.empty()) return std::nullopt;
  LiveMessage message = std::move(state_->messages.front());
  state_->messages.pop_front();
  for (const auto& inbox : state_->inboxes) {
    if (inbox->topic.name == message.topic.name) --inbox->waiting;
  }
  return message;
}

std::unique_ptr<BagWriter> Ros2Network::writer() {
  return std::make_unique<Ros2Writer>(
      [state = state_.get()](const std::string& name, const std::string& type, bool latched) {
        dds::DataWriterQos qos = dds::DATAWRITER_QOS_DEFAULT;
        qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
        qos.durability().kind =
            latched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
        qos.history().depth = latched ? 1 : 4;
        qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
        qos.data_sharing().off();
        // Who sends does not wait for who listens.
        qos.publish_mode().kind = dds::ASYNCHRONOUS_PUBLISH_MODE;
        dds::DataWriter* writer =
            state->publisher->create_datawriter(state->topicOf(name, type), qos);
        if (writer == nullptr) throw std::runtime_error("ROS 2: nothing can be sent on " + name);
        return writer;
      });
}

}  // namespace heel
