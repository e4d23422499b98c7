// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/heel/commands.hpp>
#include <heel/apps/heel/shared/terminal.hpp>
#include <heel/apps/output/run_end.hpp>
#include <heel/cloud/typos.hpp>

#include <CLI/CLI.hpp>
#include <opencv2/core.hpp>
#include <pcl/console/print.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <iterator>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

/// What one of must be named after `app`.
std::vector<std::string> verbsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(verb->get_name());
  }
  return names;
}

std::vector<std::string> optionsOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// What was wrong with the call, in one sentence, and where to read more.
std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App* called = &app;
  std::string name = app.get_name();
  while (!called->get_subcommands().empty()) {
    called = called->get_subcommands().front();
    name += " " + called->get_name();
  }
  const std::vector<std::string> verbs = verbsOf(*called);
  std::string what = error.what();
  const auto others = called->remaining();
  const auto unknown = std::find_if(others.begin(), others.end(), [](const std::string& word) {
    return word.size() > 1 && word.front() == '-';
  });
  if (unknown != others.end()) {
    // Rather than that another is missing.
    const std::string written = unknown->substr(0, unknown->find('='));
    what = "there is no option " + written + heel::didYouMean(written, optionsOf(*called));
  } else if (!verbs.empty() && error.get_name() == "RequiredError") {
    what = others.empty() ? "name a verb" : "there is no verb '" + others.front() + "'";
    const std::string meant = others.empty() ? "" : heel::didYouMean(others.front(), verbs);
    what += meant.empty() ? "; there are " + CLI::detail::join(verbs, ", ") : meant;
  }
  return what + " ('" + name + " --help' tells more)";
}

/// Ends the program with a sentence.
int fail(heel::ExitCode code, const std::string& sentence) {
  heel::tell(sentence);
  return static_cast<int>(code);
}

/// What the exception that is being handled says of why the run ended.
int failFor(const CLI::App& app) {
  using heel::ExitCode;
  try {
    throw;
  } catch (const CLI::ParseError& error) {
    return error.get_exit_code() == 0 ? app.exit(error)
                                      : fail(ExitCode::kUsage, explain(app, error));
  } catch (const heel::Stopped& error) {
    return fail(ExitCode::kStopped, error.what());
  } catch (const heel::NothingFound& error) {
    return fail(ExitCode::kNothingFound, error.what());
  } catch (const heel::OutputError& error) {
    return fail(ExitCode::kFault, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(ExitCode::kUsage, error.what());
  } catch (const cv::Exception& error) {
    return fail(ExitCode::kFault, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return fail(ExitCode::kBadInput,
                error.path1().string() + " cannot be read: " + error.code().message());
  } catch (const std::runtime_error& error) {
    return fail(ExitCode::kBadInput, error.what());
  } catch (const std::bad_alloc&) {
    return fail(ExitCode::kBadInput, "there is not enough memory for this");
  } catch (const std::exception& error) {
    return fail(ExitCode::kFault, error.what());
  }
}

/// Keeps libraries from writing to the console: what went wrong, we say ourselves, in a sentence.
void silenceLibraries() {
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);  // FFmpeg's "quiet"
  std::cerr.rdbuf(nullptr);                   // OpenCV's image readers; we use stderr
}

}  // namespace

int main(int argc, char** argv) {
  silenceLibraries();
  const heel::TerminalOutput output;
  std::signal(SIGXFSZ, SIG_IGN);  // a limit on a file's size is then an error like a full disk
  heel::endOnSignals();
  CLI::App app{
      "heel: a mobile robot follows one person.\n"
      "\n"
      "Phase 1, learn, finds out who to follow; phase 2, track, where they are.\n"
      "A RECORDING is a folder (stereo images with a calibration, RGB-D images in the TUM layout\n"
      "with a camera.yaml, or PCD files), or a bag of ROS 1 or ROS 2.\n"
      "'heel VERB --help' tells more.\n",
      "heel"};
  app.set_version_flag("--version", std::string("heel ") + HEEL_VERSION);
  app.footer(
      "Example:\n"
      "  heel simulate wardrobe --out recordings/wardrobe\n"
      "  heel learn recordings/wardrobe --out person.yaml\n"
      "  heel track recordings/wardrobe --model person.yaml --out out/wardrobe\n"
      "  heel evaluate out/wardrobe/tracks.csv recordings/wardrobe/truth.csv\n"
      "Exit codes: 0 done; 1 a fault of ours or of the machine (a full disk); 2 a wrong call, or\n"
      "results may not go there; 3 bad input; 4 nothing found; 130 stopped by a signal: what was\n"
      "done until then is written, with \"complete\": false in summary.json.");
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  heel::addLearn(app);
  heel::addTrack(app);
  heel::addFilter(app);
  heel::addFollow(app);
  heel::addInspect(app);
  heel::addJoin(app);
  heel::addLive(app);
  heel::addLocalize(app);
  heel::addMap(app);
  heel::addPlan(app);
  heel::addPlanView(app);
  heel::addSimulate(app);
  heel::addCapture(app);
  heel::addView(app);
  heel::addEvaluate(app);
  heel::addSummarize(app);
  heel::addExperiment(app);
  heel::addConfig(app);
  heel::completeVerbs(app);
  heel::addCompletion(app);
  std::vector<std::string> words(std::make_reverse_iterator(argv + argc),
                                 std::make_reverse_iterator(argv + std::min(argc, 1)));
  if (!words.empty() && words.back() == "help") {  // 'heel help track' is 'heel track --help'
    words.pop_back();
    words.insert(words.begin(), "--help");
  }
  try {
    app.parse(std::move(words));
  } catch (...) {
    return failFor(app);
  }
  if (std::fflush(stdout) != 0) {
    return fail(heel::ExitCode::kFault,
                "the output cannot be written: " + std::string(std::strerror(errno)));
  }
  return 0;
}
