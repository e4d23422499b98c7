// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Options that several verbs share, to name what is in a bag.
#pragma once

#include "apps/recording/bag_topics.hpp"
#include "apps/recording/time_span.hpp"

#include <filesystem>

namespace CLI {
class App;
}

namespace heel {

/// Topics of images and clouds, and the base frame.
void addCameraTopics(CLI::App& verb, BagTopics& topics);

/// The part of a recording that is read.
void addTimeSpan(CLI::App& verb, TimeSpan& span);

/// The topic of odometry.
void addOdometryTopic(CLI::App& verb, BagTopics& topics);

/// Topics of odometry and truth.
void addPoseTopics(CLI::App& verb, BagTopics& topics);

/// Topics of scans, odometry and truth, and the base frame.
void addLaserTopics(CLI::App& verb, BagTopics& topics);

/// The bag to write the results to.
void addResultBag(CLI::App& verb, std::filesystem::path& bag);

}  // namespace heel
