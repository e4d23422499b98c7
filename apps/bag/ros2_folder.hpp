// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What bags of ROS 2 share, in whatever storage: files, names of types, quality of service.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace heel {

/// X.db3 or X.mcap.
bool isRos2File(const std::filesystem::path& path);

/// The files of a bag, in their order: that file, or those of a folder that its metadata.yaml
/// lists, else all that there are. All are of one kind.
/// @throws std::runtime_error  one sentence, if there is none, or they are in another storage.
std::vector<std::filesystem::path> ros2Files(const std::filesystem::path& path);

/// "sensor_msgs/Image" as "sensor_msgs/msg/Image", and back.
std::string withMsg(std::string type);
std::string withoutMsg(std::string type);

/// Quality of service, as rosbag2 writes it: reliable; who comes late gets the last message if
/// `latched`.
std::string ros2Qos(bool latched);

}  // namespace heel
