// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// The verbs of the heel command. Each adds its options to the application and, when it is the one
/// that was called, does its work: options in, library call, result out.
///
/// A verb throws std::runtime_error or std::invalid_argument with one sentence when it can't go on.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace heel {

/// Users read and write angles in degrees: so many are one radian.
constexpr double kDegrees = 57.29577951308232;

/// Tells a user what they should know, on stderr; the work goes on.
void warn(const std::string& warning);

void addCapture(CLI::App& app);
void addConfig(CLI::App& app);
void addLearn(CLI::App& app);
void addTrack(CLI::App& app);
void addFilter(CLI::App& app);
void addFollow(CLI::App& app);
void addInspect(CLI::App& app);
void addJoin(CLI::App& app);
void addLive(CLI::App& app);
void addLocalize(CLI::App& app);
void addMap(CLI::App& app);
void addPlan(CLI::App& app);
void addPlanView(CLI::App& app);
void addSimulate(CLI::App& app);
void addSummarize(CLI::App& app);
void addView(CLI::App& app);
void addEvaluate(CLI::App& app);
void addExperiment(CLI::App& app);

/// Gives each verb the options that all have (--threads, --progress, --resume, --max-memory), and
/// lets it refuse numbers that are not finite; call it when all these verbs are there.
void completeVerbs(CLI::App& app);

/// The verb that prints what completes the calls of all verbs in a shell.
void addCompletion(CLI::App& app);

}  // namespace heel
