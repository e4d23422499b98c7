// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/chunk_packing.hpp>

#include <bzlib.h>
#include <lz4frame.h>
#include <zstd.h>

#include <algorithm>

namespace heel {
namespace {

/// Memory grows with what is really there, not with what a damaged header promises.
constexpr std::size_t kPiece = 1U << 20U;

bool unpackBz2(const std::uint8_t* packed, std::size_t packed_size, std::size_t size,
               BagBytes& unpacked) {
  bz_stream stream{};
  if (BZ2_bzDecompressInit(&stream, 0, 0) != BZ_OK) return false;
  // It is only read, though bzlib does not say so.
  stream.next_in = const_cast<char*>(reinterpret_cast<const char*>(packed));
  stream.avail_in = static_cast<unsigned>(packed_size);
  int result = BZ_OK;
  std::size_t done = 0;
  while (result == BZ_OK && done < size) {
    unpacked.resize(std::min(size, done + kPiece));
    stream.next_out = reinterpret_cast<char*>(&unpacked[done]);
    stream.avail_out = static_cast<unsigned>(unpacked.size() - done);
    result = BZ2_bzDecompress(&stream);
    const std::size_t now = unpacked.size() - stream.avail_out;
    if (now == done && stream.avail_in == 0) break;
    done = now;
  }
  BZ2_bzDecompressEnd(&stream);
  unpacked.resize(done);
  return done == size;
}

bool unpackLz4(const std::uint8_t* packed, std::size_t packed_size, std::size_t size,
               BagBytes& unpacked) {
  LZ4F_dctx* context = nullptr;
  if (LZ4F_isError(LZ4F_createDecompressionContext(&context, LZ4F_VERSION)) != 0) return false;
  std::size_t done = 0, used = 0;
  while (done < size && used < packed_size) {
    unpacked.resize(std::min(size, done + kPiece));
    std::size_t out = unpacked.size() - done, in = packed_size - used;
    const std::size_t result =
        LZ4F_decompress(context, &unpacked[done], &out, &packed[used], &in, nullptr);
    if (LZ4F_isError(result) != 0) break;
    done += out;
    used += in;
    if (result == 0 || (out == 0 && in == 0)) break;
  }
  LZ4F_freeDecompressionContext(context);
  unpacked.resize(done);
  return done == size;
}

bool unpackZstd(const std::uint8_t* packed, std::size_t packed_size, std::size_t size,
                BagBytes& unpacked) {
  ZSTD_DCtx* context = ZSTD_createDCtx();
  if (context == nullptr) return false;
  ZSTD_inBuffer in{packed, packed_size, 0};
  std::size_t done = 0;
  while (done < size) {
    unpacked.resize(std::min(size, done + kPiece));
    ZSTD_outBuffer out{unpacked.data(), unpacked.size(), done};
    const std::size_t before = in.pos, result = ZSTD_decompressStream(context, &out, &in);
    const bool went_on = out.pos > done || in.pos > before;
    done = out.pos;
    if (ZSTD_isError(result) != 0 || !went_on) break;
  }
  ZSTD_freeDCtx(context);
  unpacked.resize(done);
  return done == size;
}

}  // namespace

bool isKnownPacking(std::string_view packing) {
  return packing.empty() || packing == "none" || packing == "bz2" || packing == "lz4" ||
         packing == "zstd";
}

bool unpackChunk(std::string_view packing, const std::uint8_t* packed, std::size_t packed_size,
                 std::size_t size, BagBytes& unpacked) {
  unpacked.clear();
  if (packing.empty() || packing == "none") {
    unpacked.assign(packed, packed + packed_size);
    return packed_size == size;
  }
  if (packing == "bz2") return unpackBz2(packed, packed_size, size, unpacked);
  if (packing == "lz4") return unpackLz4(packed, packed_size, size, unpacked);
  if (packing == "zstd") return unpackZstd(packed, packed_size, size, unpacked);
  return false;
}

bool packByZstd(const BagBytes& bytes, BagBytes& packed) {
  constexpr int kFast = 1;
  packed.resize(ZSTD_compressBound(bytes.size()));
  const std::size_t size =
      ZSTD_compress(packed.data(), packed.size(), bytes.data(), bytes.size(), kFast);
  const bool is_worth_it = ZSTD_isError(size) == 0 && size < bytes.size() / 16 * 15;
  packed.resize(is_worth_it ? size : 0);
  return is_worth_it;
}

}  // namespace heel
