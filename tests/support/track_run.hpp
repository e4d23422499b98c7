// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A made-up recording with somebody who was followed through it, for the tests of reports.
#pragma once

#include <heel/apps/results/track_log.hpp>

namespace heel::test {

/// 20 s at 10 Hz: the target comes after 2 s, is out of sight from 8 to 11 s, and predicted before
/// that for 1 s. Somebody else (track 4) is there from 5 to 15 s, a thing (track 9) all the time.
TrackLog trackRun();

}  // namespace heel::test
