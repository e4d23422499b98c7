// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The standard messages of robots that we read and write, each described once.
///
/// `fields(message, archive)` names a message's fields in their order. From it alone come reading
/// and writing in both forms (message_archives.hpp) and the definitions that ROS 1 bags carry
/// (message_definition.hpp).
#pragma once

#include <heel/apps/bag/diagnostic_messages.hpp>
#include <heel/apps/bag/geometry_messages.hpp>
#include <heel/apps/bag/marker_messages.hpp>
#include <heel/apps/bag/navigation_messages.hpp>
#include <heel/apps/bag/sensor_messages.hpp>
