// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/recording/pcd_file.hpp"

namespace heel {

void checkPcd(const std::filesystem::path& file) { needColors(file, checkPcdFile(file)); }

PcdFile readPcd(const std::filesystem::path& file) {
  checkPcd(file);
  return readCloud(file);
}

void writePcd(const std::filesystem::path& file, const PcdFile& pcd) { writeCloud(file, pcd); }

}  // namespace heel
