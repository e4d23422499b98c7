// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Files: how much one that is read may ask for, and how one is written whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace heel {

/// The product, or the largest number if it is more than that: never too small.
std::size_t timesAtMost(std::size_t a, std::size_t b);

/// The most memory that may be taken at once because a file says so: 512 MiB, or 64 times what the
/// file holds if that is more, but no more than half of the machine's memory. A limit that was set
/// for the process (setMemoryLimit, or the shell's `ulimit -d`) takes their place.
std::size_t memoryLimit(std::size_t file_bytes = 0);

/// Sets the process's limit, for all of its memory and thus for what a file asks for, too.
/// @throws std::runtime_error  if the system does not let it.
void setMemoryLimit(std::size_t bytes);

/// Before memory is taken: is it within the limit?
/// @param what        Asks for it: "map.png: the image of 30000x30000 pixels".
/// @param file_bytes  Of the file that says so.
/// @throws std::runtime_error  one sentence that begins with `what`, if it is not.
void checkMemory(const std::string& what, std::size_t bytes, std::size_t file_bytes = 0);

/// Refuses pipes, sockets and devices: a pipe would be waited for, and a device may never end.
/// @throws std::runtime_error  if `file` is one of these.
void checkIsFile(const std::filesystem::path& file);

/// All bytes of a file.
/// @throws std::runtime_error  with one sentence that names the file and the reason.
std::string readWholeFile(const std::filesystem::path& file);

/// Writes beside the file, then gives it its name: what was there before stays until all is
/// written.
/// @throws std::runtime_error  with one sentence that names the file and the reason.
void writeWholeFile(const std::filesystem::path& file, std::string_view bytes);

}  // namespace heel
