// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/live/ros1_network.hpp>

#include <ros/callback_queue.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <map>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

namespace heel {

/// Bytes that are a message already, of any type.
struct Ros1Bytes {
  std::vector<std::uint8_t> bytes;
};

}  // namespace heel

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<heel::Ros1Bytes> {
  static const char* value() { return "*"; }
  static const char* value(const heel::Ros1Bytes& /*message*/) { return "*"; }
};
template <>
struct DataType<heel::Ros1Bytes> : MD5Sum<heel::Ros1Bytes> {};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<heel::Ros1Bytes> {
  template <class Stream>
  static void write(Stream& stream, const heel::Ros1Bytes& message) {
    const std::uint32_t size = serializedLength(message);
    std::memcpy(stream.advance(size), message.bytes.data(), size);
  }
  template <class Stream>
  static void read(Stream& stream, heel::Ros1Bytes& message) {
    message.bytes.assign(stream.getData(), stream.getData() + stream.getLength());
  }
  static std::uint32_t serializedLength(const heel::Ros1Bytes& message) {
    return static_cast<std::uint32_t>(message.bytes.size());
  }
};

}  // namespace serialization
}  // namespace ros

namespace heel {

/// The queue is roscpp's own: messages wait in it, and next() calls them out of it.
struct Ros1Network::State {
  explicit State(std::string name_before) : before(std::move(name_before)) {
    node.setCallbackQueue(&queue);
  }

  /// A topic as ROS knows it.
  std::string fullName(const std::string& topic) const {
    return topic == "/tf" || topic == "/tf_static" ? topic : before + topic;
  }

  /// As it is called here; empty if it is not in the namespace.
  std::string ownName(const std::string& full) const {
    if (fullName(full) == full) return full;
    const std::string own = full.substr(std::min(before.size(), full.size()));
    return own.rfind('/', 0) == 0 && fullName(own) == full ? own : "";
  }

  void take(const std::string& topic, const ros::MessageEvent<const Ros1Bytes>& event) {
    ros::M_string& about = event.getConnectionHeader();
    came = {{topic, about["type"], about["md5sum"]},
            static_cast<std::int64_t>(event.getReceiptTime().toNSec()),
            event.getConstMessage()->bytes};
  }

  /// Asks what is sent. A master that was gone is told what we send and hear: it may be a new one.
  void askMaster() {
    const std::optional<XmlRpc::XmlRpcValue> answer = asked("getPublishedTopics", {""});
    if (answer && !has_answered) registerAgain();
    has_answered = answer.has_value();
    if (!answer) return;
    XmlRpc::XmlRpcValue published = *answer;
    std::vector<BagTopic> found;
    for (int i = 0; i < published.size(); ++i) {
      const std::string name = ownName(published[i][0]);
      if (!name.empty()) found.push_back({name, published[i][1], {}});
    }
    const std::lock_guard<std::mutex> lock(mutex);
    topics = std::move(found);
    answered_s = steadyClock_s();
  }

  /// The master's answer, if it gives one.
  static std::optional<XmlRpc::XmlRpcValue> asked(const char* method,
                                                  const std::vector<std::string>& arguments) {
    XmlRpc::XmlRpcValue call, whole, answer;
    call[0] = ros::this_node::getName();
    for (const std::string& argument : arguments) call[call.size()] = argument;
    if (!ros::master::execute(method, call, whole, answer, false)) return std::nullopt;
    return answer;
  }

  void registerAgain() {
    const std::string uri = ros::XMLRPCManager::instance()->getServerURI();
    ros::V_string sent, heard;
    ros::this_node::getAdvertisedTopics(sent);
    ros::this_node::getSubscribedTopics(heard);
    for (const std::string& name : sent) asked("registerPublisher", {name, typeSent(name), uri});
    for (const std::string& name : heard) asked("registerSubscriber", {name, "*", uri});
  }

  /// In a thread of its own: a machine that is gone may take minutes to refuse.
  void askAgainAndAgain() {
    std::unique_lock<std::mutex> lock(mutex);
    while (!wakes.wait_for(lock, std::chrono::milliseconds(500), [this] { return ends; })) {
      lock.unlock();
      askMaster();
      lock.lock();
    }
  }

  std::string typeSent(const std::string& full) const {
    const std::lock_guard<std::mutex> lock(mutex);
    const auto type = types_sent.find(full);
    return type == types_sent.end() ? "*" : type->second;
  }

  bool isMasterThere() const {
    constexpr double kSilent_s = 2.0;
    const std::lock_guard<std::mutex> lock(mutex);
    return steadyClock_s() - answered_s < kSilent_s;
  }

  const std::string before;  // all names
  ros::CallbackQueue queue;
  ros::NodeHandle node;  // The first one begins what roscpp does, and the last one ends it.
  std::map<std::string, ros::Subscriber> subscribers;
  std::optional<LiveMessage> came;
  bool has_answered = true;  // the master, the last time

  mutable std::mutex mutex;  // guards what follows
  std::condition_variable wakes;
  bool ends = false;
  std::vector<BagTopic> topics;
  std::map<std::string, std::string> types_sent;  // by the full names of topics
  double answered_s = 0.0;                        // the master, on the steady clock
  std::thread asking;
};

namespace {

class Ros1Writer final : public BagWriter {
 public:
  using Advertise = std::function<ros::Publisher(ros::AdvertiseOptions)>;
  explicit Ros1Writer(Advertise advertise) : advertise_(std::move(advertise)) {}

  BagForm form() const override { return BagForm::kRos1; }
  void commit(bool) override {}

 private:
  void add(std::size_t topic) override {
    const Topic& about = topics_[topic];
    constexpr std::uint32_t kDepth = 4;
    ros::AdvertiseOptions options(about.name, kDepth, about.md5, about.type, about.definition);
    options.latch = about.latched;
    publishers_.push_back(advertise_(std::move(options)));
  }
  void put(std::size_t topic, std::int64_t, const std::vector<std::uint8_t>& bytes) override {
    publishers_[topic].publish(Ros1Bytes{bytes});
  }
  bool isHeard(std::size_t topic) const override {
    return publishers_[topic].getNumSubscribers() > 0;
  }

  Advertise advertise_;
  std::vector<ros::Publisher> publishers_;
};

std::runtime_error noRoscore(const char* what) {
  return std::runtime_error("ROS 1: " + std::string(what) + " at " + ros::master::getURI() +
                            " (ROS_MASTER_URI)");
}

}  // namespace

Ros1Network::Ros1Network(const LiveNetworkParams& params) {
  if (const char* uri = std::getenv("ROS_MASTER_URI"); uri != nullptr) {
    std::string host;
    std::uint32_t port = 0;
    if (!ros::network::splitURI(uri, host, port)) {
      throw std::invalid_argument("ROS_MASTER_URI must be like http://localhost:11311");
    }
  }
  using namespace ros::init_options;
  ros::init(ros::M_string(), "heel", AnonymousName | NoSigintHandler | NoRosout);
  // What matters of roscpp's own sentences is in ours.
  ros::console::set_logger_level(ROSCONSOLE_ROOT_LOGGER_NAME, ros::console::levels::Fatal);
  ros::console::notifyLoggerLevelsChanged();
  ros::master::setRetryTimeout(ros::WallDuration(2.0));
  if (!ros::master::check()) throw noRoscore("no roscore");
  std::string before = params.ros_namespace;
  if (before.empty()) before = ros::this_node::getNamespace();
  state_ = std::make_unique<State>(before == "/" ? "" : before);
  state_->askMaster();
  state_->asking = std::thread([this] { state_->askAgainAndAgain(); });
}

Ros1Network::~Ros1Network() {
  {
    const std::lock_guard<std::mutex> lock(state_->mutex);
    state_->ends = true;
  }
  state_->wakes.notify_one();
  state_->asking.join();
}

std::vector<BagTopic> Ros1Network::topics() const {
  if (!state_->isMasterThere()) return {};
  const std::lock_guard<std::mutex> lock(state_->mutex);
  return state_->topics;
}

void Ros1Network::subscribe(const BagTopic& topic, Delivery /*delivery*/, std::size_t depth) {
  ros::SubscribeOptions options;
  options.initByFullCallbackType<const ros::MessageEvent<const Ros1Bytes>&>(
      state_->fullName(topic.name), static_cast<std::uint32_t>(depth),
      [state = state_.get(), name = topic.name](const auto& event) { state->take(name, event); });
  options.transport_hints.tcpNoDelay();
  const ros::Subscriber subscriber = state_->node.subscribe(options);
  if (!subscriber) {
    throw std::runtime_error("ROS 1: the topic " + topic.name + " can't be listened to");
  }
  state_->subscribers[topic.name] = subscriber;
}

void Ros1Network::unsubscribe(const std::string& topic) { state_->subscribers.erase(topic); }

std::optional<LiveMessage> Ros1Network::next(double timeout_s) {
  const double until_s = steadyClock_s() + timeout_s;
  for (double left_s = timeout_s;; left_s = until_s - steadyClock_s()) {
    state_->came.reset();
    state_->queue.callOne(ros::WallDuration(std::max(left_s, 0.0)));
    if (!ros::ok()) throw std::runtime_error("ROS 1: this node was told to shut down");
    if (state_->came && state_->isMasterThere()) return std::move(state_->came);
    if (left_s <= 0.0) return std::nullopt;
  }
}

std::unique_ptr<BagWriter> Ros1Network::writer() {
  return std::make_unique<Ros1Writer>([state = state_.get()](ros::AdvertiseOptions options) {
    options.topic = state->fullName(options.topic);
    {
      const std::lock_guard<std::mutex> lock(state->mutex);
      state->types_sent[options.topic] = options.datatype;
    }
    const ros::Publisher publisher = state->node.advertise(options);
    if (!publisher) throw std::runtime_error("ROS 1: nothing can be sent on " + options.topic);
    return publisher;
  });
}

std::string Ros1Network::trouble() const {
  return state_->isMasterThere() ? "" : noRoscore("roscore does not answer").what();
}

}  // namespace heel
