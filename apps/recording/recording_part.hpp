// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A part of a recording whose frames are files.
#pragma once

#include <heel/apps/recording/recording.hpp>
#include <heel/apps/recording/time_span.hpp>

#include <memory>

namespace heel {

/// Gives the frames of a span; those before it are read, and passed over.
class RecordingPart final : public Recording {
 public:
  RecordingPart(std::unique_ptr<Recording> whole, const TimeSpan& span);

  bool next(Frame& frame) override;
  std::optional<RobotMotion> readMotion() const override { return whole_->readMotion(); }

 private:
  std::unique_ptr<Recording> whole_;
  double first_s_, last_s_;
};

}  // namespace heel
