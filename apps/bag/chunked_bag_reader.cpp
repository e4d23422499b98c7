// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include <heel/apps/bag/chunked_bag_reader.hpp>

#include <algorithm>
#include <tuple>
#include <utility>

namespace heel {
namespace {

/// Of the chunks that are open at a time. Those beyond it are unpacked more than once.
constexpr std::size_t kMostBytes = 256U << 20U;

bool overlaps(const BagQuery& query, std::int64_t first_ns, std::int64_t last_ns) {
  return first_ns <= query.to_ns && last_ns >= query.from_ns;
}

}  // namespace

/// Of messages of one time, the one that is first in the file comes first.
bool ChunkedBagReader::Place::operator>(const Place& other) const {
  return std::tie(entry.stamp_ns, chunk, entry.at) >
         std::tie(other.entry.stamp_ns, other.chunk, other.entry.at);
}

void ChunkedBagReader::setIndex(std::vector<Chunk> chunks, std::vector<std::size_t> counts) {
  chunks_ = std::move(chunks);
  std::stable_sort(chunks_.begin(), chunks_.end(),
                   [](const Chunk& a, const Chunk& b) { return a.first_ns < b.first_ns; });
  counts_ = std::move(counts);
  counts_.resize(topics_.size());
  has_index_ = true;
}

void ChunkedBagReader::lose(const std::string& what) {
  ++damages_;
  lost_ = file_.name() + ": " + what + "; what else is there was read";
  if (damages_ > 1) {
    lost_ = file_.name() + ": the bag is damaged at " + std::to_string(damages_) +
            " places; what else is there was read";
  }
}

const BagIndex* ChunkedBagReader::index() {
  if (has_index_ && !index_) {
    const auto told = std::pair(lost_, damages_);
    measure();
    std::tie(lost_, damages_) = told;
  }
  return index_ ? &*index_ : nullptr;
}

/// The index tells the times of chunks; those of a topic are in the first and last that have it.
void ChunkedBagReader::measure() {
  BagIndex index;
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> first(topics_.size(), kNone), last(topics_.size(), kNone);
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    const Chunk& chunk = chunks_[i];
    index.first_ns = i == 0 ? chunk.first_ns : std::min(index.first_ns, chunk.first_ns);
    index.last_ns = i == 0 ? chunk.last_ns : std::max(index.last_ns, chunk.last_ns);
    for (const std::size_t topic : chunk.topics) {
      if (first[topic] == kNone) first[topic] = i;
      if (last[topic] == kNone || chunk.last_ns >= chunks_[last[topic]].last_ns) last[topic] = i;
    }
  }
  index.topics.resize(topics_.size());
  std::vector<std::size_t> ends = first;
  ends.insert(ends.end(), last.begin(), last.end());
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  std::vector<bool> is_met(topics_.size(), false);
  for (const std::size_t i : ends) {
    if (i == kNone) continue;
    for (const Entry& entry : opened(i).entries) {
      BagIndex::Topic& topic = index.topics[entry.topic];
      const bool met = is_met[entry.topic];
      is_met[entry.topic] = true;
      topic.first_ns = met ? std::min(topic.first_ns, entry.stamp_ns) : entry.stamp_ns;
      topic.last_ns = met ? std::max(topic.last_ns, entry.stamp_ns) : entry.stamp_ns;
    }
  }
  for (std::size_t i = 0; i < topics_.size(); ++i) index.topics[i].count = counts_[i];
  index_ = std::move(index);
}

void ChunkedBagReader::select(const BagQuery& query) {
  query_ = query;
  lost_.clear();
  damages_ = 0;
  next_chunk_ = 0;
  open_.clear();
  queue_ = {};
  if (!has_index_) rewindScan();
}

const ChunkedBagReader::Opened& ChunkedBagReader::opened(std::size_t chunk) {
  // What is damaged is told of again.
  if (last_.chunk == chunk && !last_.is_damaged) return last_;
  last_ = {chunk, std::make_shared<BagBytes>(), {}};
  const std::uint64_t damages = damages_;
  openChunk(chunks_[chunk], *last_.bytes, last_.entries);
  last_.is_damaged = damages_ > damages;
  return last_;
}

void ChunkedBagReader::open(std::size_t chunk) {
  const Chunk& about = chunks_[chunk];
  const bool is_wanted = overlaps(query_, about.first_ns, about.last_ns) &&
                         std::any_of(about.topics.begin(), about.topics.end(),
                                     [&](std::size_t topic) { return wants(topics_[topic].name); });
  if (!is_wanted) return;
  const Opened& now = opened(chunk);
  Open kept;
  kept.is_in_file = now.bytes->empty();
  kept.bytes = now.bytes;
  for (const Entry& entry : now.entries) {
    if (!wants(topics_[entry.topic].name, entry.stamp_ns)) continue;
    queue_.push({entry, chunk});
    ++kept.left;
  }
  if (kept.left == 0) return;
  open_[chunk] = std::move(kept);
  keepWithinLimit(chunk);
}

/// Gives back the bytes of other chunks than this one, if there are too many.
void ChunkedBagReader::keepWithinLimit(std::size_t chunk) {
  std::size_t held = 0;
  for (const auto& [number, opened] : open_) held += opened.bytes ? opened.bytes->size() : 0;
  for (auto it = open_.rbegin(); it != open_.rend() && held > kMostBytes; ++it) {
    if (it->first == chunk || !it->second.bytes) continue;
    held -= it->second.bytes->size();
    it->second.bytes.reset();
  }
}

/// Null if they are not there any more.
const std::uint8_t* ChunkedBagReader::bytesOf(const Place& place) {
  const auto found = open_.find(place.chunk);
  Open& chunk = found->second;
  if (chunk.is_in_file) {
    if (--chunk.left == 0) open_.erase(found);
    return file_.read(place.entry.at, place.entry.size, piece_) ? piece_.data() : nullptr;
  }
  if (!chunk.bytes) {
    const auto told = std::pair(lost_, damages_);
    chunk.bytes = opened(place.chunk).bytes;
    std::tie(lost_, damages_) = told;
    keepWithinLimit(place.chunk);
  }
  given_ = chunk.bytes;
  if (--chunk.left == 0) open_.erase(found);
  if (place.entry.at + place.entry.size > given_->size()) return nullptr;
  return given_->data() + place.entry.at;
}

bool ChunkedBagReader::next(BagMessage& message) {
  if (!has_index_) {
    while (scanNext(message)) {
      if (wants(topics_[message.topic].name, message.stamp_ns)) return true;
    }
    return false;
  }
  while (true) {
    while (next_chunk_ < chunks_.size() && chunks_[next_chunk_].first_ns <= query_.to_ns &&
           (queue_.empty() || chunks_[next_chunk_].first_ns <= queue_.top().entry.stamp_ns)) {
      open(next_chunk_++);
    }
    if (queue_.empty()) return false;
    const Place place = queue_.top();
    queue_.pop();
    const std::uint8_t* bytes = bytesOf(place);
    if (bytes == nullptr && place.entry.size > 0) continue;
    message = {place.entry.topic, place.entry.stamp_ns, bytes, place.entry.size};
    return true;
  }
}

}  // namespace heel
