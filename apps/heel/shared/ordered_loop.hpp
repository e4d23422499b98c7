// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A loop on all cores whose results come in order.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace heel {

/// Calls `work(i)` for i = 0, 1, ... below `count` on so many threads, and `take(i, result)` on the
/// calling one, in order: what comes out does not depend on the number of threads.
///
/// No more than two results a thread wait to be taken, however long one of them takes. An exception
/// of either ends the loop and comes out of it.
/// @param threads  0: as many as the machine has cores.
template <typename Work, typename Take>
void loopInOrder(std::size_t count, unsigned threads, const Work& work, const Take& take) {
  using Result = decltype(work(std::size_t{}));
  if (threads == 0) threads = std::thread::hardware_concurrency();
  if (threads == 0) threads = 1;
  std::mutex mutex;
  std::condition_variable changed;
  std::map<std::size_t, Result> done;  // results that are not taken yet
  std::size_t started = 0, taken = 0;
  std::exception_ptr error;

  const auto worker = [&] {
    std::unique_lock lock(mutex);
    while (true) {
      changed.wait(lock, [&] {
        return error != nullptr || started == count || started < taken + 2 * threads;
      });
      if (error != nullptr || started == count) return;
      const std::size_t i = started++;
      lock.unlock();
      try {
        Result result = work(i);
        lock.lock();
        done.emplace(i, std::move(result));
      } catch (...) {
        if (!lock.owns_lock()) lock.lock();
        if (error == nullptr) error = std::current_exception();
      }
      changed.notify_all();
    }
  };
  std::vector<std::thread> pool;
  for (unsigned i = 0; i < threads && i < count; ++i) pool.emplace_back(worker);

  std::unique_lock lock(mutex);
  while (taken < count) {
    changed.wait(lock, [&] { return error != nullptr || done.count(taken) > 0; });
    if (error != nullptr) break;
    auto result = done.extract(taken);
    lock.unlock();
    try {
      take(result.key(), std::move(result.mapped()));
      lock.lock();
      ++taken;
    } catch (...) {
      lock.lock();
      error = std::current_exception();
    }
    changed.notify_all();
  }
  lock.unlock();
  for (std::thread& thread : pool) thread.join();
  if (error != nullptr) std::rethrow_exception(error);
}

}  // namespace heel
