// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// How the chunks of bags are packed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace heel {

using BagBytes = std::vector<std::uint8_t>;

/// Whether we can unpack it: "none" or "", "bz2", "lz4" (its frames) and "zstd".
bool isKnownPacking(std::string_view packing);

/// Unpacks a chunk as far as that goes, piece by piece: memory grows with what is really there.
/// @param unpacked  Out: what could be unpacked, no more than `size`.
/// @return whether all was.
bool unpackChunk(std::string_view packing, const std::uint8_t* packed, std::size_t packed_size,
                 std::size_t size, BagBytes& unpacked);

/// Packs by zstd; false, and nothing, if the result is hardly smaller.
bool packByZstd(const BagBytes& bytes, BagBytes& packed);

}  // namespace heel
