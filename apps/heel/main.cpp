// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/heel/commands.hpp"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  CLI::App app{
      "heel: a mobile robot follows one person.\n"
      "\n"
      "  heel learn RECORDING --out person.yaml             who to follow (phase 1)\n"
      "  heel track RECORDING --model person.yaml --out DIR where they are (phase 2)\n"
      "\n"
      "A RECORDING is a folder: stereo images with a calibration, RGB-D images in the TUM layout\n"
      "with a camera.yaml, or PCD files. 'heel VERB --help' tells more.\n",
      "heel"};
  app.set_version_flag("--version", std::string("heel ") + HEEL_VERSION);
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  heel::addLearn(app);
  heel::addTrack(app);
  heel::addFilter(app);
  heel::addInspect(app);
  heel::addSimulate(app);
  heel::addEvaluate(app);
  heel::addExperiment(app);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "heel: %s\n", error.what());
    return 1;
  }
  return 0;
}
