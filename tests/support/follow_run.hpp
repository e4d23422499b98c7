// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A made-up run of following through a flat of five rooms, for the tests of reports.
#pragma once

#include <heel/apps/film/follow_video.hpp>
#include <heel/apps/results/follow_episodes.hpp>
#include <heel/apps/results/follow_log.hpp>

namespace heel::test {

/// The flat's walls with doorways and some furniture, 10 m x 8 m, in cells of 5 cm.
OccupancyGrid flatMap();

/// A robot that goes behind a person through the flat, loses them twice and finds them again, while
/// somebody else walks about. The same on every call.
FollowLog flatRun();

/// The paper's three experiments and a hundred episodes with two plans, a few of which failed.
FollowExperiment followExperiment();

/// The film's frame of one sample of a run.
FollowVideoFrame videoFrame(const FollowLog& log, std::size_t sample);

}  // namespace heel::test
