// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/live/find_robot.hpp>
#include <heel/apps/recording/bags/bag_recording.hpp>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

namespace heel {
namespace {

constexpr double kLeast_s = 2.0;  // Rates, and what moves, are told from so much.
constexpr double kTurn_s = 1.0;

bool isRead(const BagTopic& t) {
  return t.holds<ImageMsg>() || t.holds<CompressedImageMsg>() || t.holds<CameraInfoMsg>() ||
         t.holds<PointCloud2Msg>() || t.holds<LaserScanMsg>() || t.holds<OdometryMsg>() ||
         t.holds<TFMessageMsg>();
}

bool isStatic(const BagTopic& t) { return t.name.find("tf_static") != std::string::npos; }

/// What came lately.
class Lately {
 public:
  void add(LiveMessage message) {
    const std::size_t most = message.topic.holds<TFMessageMsg>() ? 1000 : 50;
    std::vector<LiveMessage>& messages = topics_[message.topic.name];
    messages.push_back(std::move(message));
    if (messages.size() > most) messages.erase(messages.begin());
  }

  /// All of it, in the order of time.
  void feed(FedBagReader& reader) const {
    std::vector<const LiveMessage*> all;
    for (const auto& [name, messages] : topics_) {
      for (const LiveMessage& message : messages) all.push_back(&message);
    }
    std::stable_sort(all.begin(), all.end(), [](const LiveMessage* a, const LiveMessage* b) {
      return a->stamp_ns < b->stamp_ns;
    });
    for (const LiveMessage* m : all) reader.feed(m->topic, m->stamp_ns, m->bytes);
  }

 private:
  std::map<std::string, std::vector<LiveMessage>> topics_;
};

}  // namespace

FoundRobot findRobot(LiveNetwork& network, const BagTopics& topics,
                     const CameraSetupParams& camera_setup, bool knows_scanner,
                     const std::function<bool(const std::string&)>& goes_on) {
  std::set<std::string> subscribed;
  Lately lately;
  double first_s = 0.0;
  std::string missing = "nothing is sent on the network";
  for (double turn_s = steadyClock_s();; turn_s = steadyClock_s()) {
    while (steadyClock_s() < turn_s + kTurn_s) {
      for (const BagTopic& topic : network.topics()) {
        if (!isRead(topic) || subscribed.count(topic.name) > 0) continue;
        network.subscribe(topic, isStatic(topic) ? Delivery::kLatched : Delivery::kAsSent);
        subscribed.insert(topic.name);
      }
      auto message = network.next(0.1);
      if (!message) continue;
      if (first_s == 0.0) first_s = steadyClock_s();
      lately.add(std::move(*message));
    }
    if (first_s > 0.0 && steadyClock_s() - first_s > kLeast_s) {
      try {
        FedBagReader messages(network.form());
        lately.feed(messages);
        const BagSurvey survey = surveyMessages(messages, "the network");
        FoundRobot robot;
        robot.readings = std::make_unique<LiveReadings>(survey, topics);
        const std::string unplaced = robot.readings->laser().unplaced();
        if (!knows_scanner && !unplaced.empty()) throw std::runtime_error(unplaced);
        auto again = std::make_unique<FedBagReader>(network.form());
        FedBagReader& replayed = *again;
        RecordingParams opening;
        opening.topics = topics;
        const auto beginning = BagRecording::openLive(survey, std::move(again), opening);
        lately.feed(replayed);
        robot.camera = findCameraSetup(*beginning, camera_setup);
        const auto& needed = robot.readings->topics();
        for (const std::string& name : subscribed) {
          if (std::find(needed.begin(), needed.end(), name) == needed.end()) {
            network.unsubscribe(name);
          }
        }
        return robot;
      } catch (const std::runtime_error& error) {
        missing = error.what();
      }
    }
    const std::string trouble = network.trouble();
    const std::string& reason = trouble.empty() ? missing : trouble;
    if (!goes_on(reason)) throw std::runtime_error(reason);
  }
}

}  // namespace heel
