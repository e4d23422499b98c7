// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// Counts allocations, to show that the tracker makes none once it is warm.
#include "tracking/target.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <new>
#include <vector>

namespace {

long allocations = 0;

}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) {
    return memory;
  }
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  const auto align = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(align, (size + align - 1) / align * align)) {
    return memory;
  }
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }

namespace heel {
namespace {

TEST(Allocation, IsSeenByThisTest) {
  const long before = allocations;
  const std::vector<int> control(10);
  EXPECT_EQ(allocations, before + 1);
}

TEST(Allocation, TrackingMakesNoneOnceWarm) {
  TargetTracker target({}, {}, allOf({tooClose(0.3), insideBounds({-9, -9}, {9, 9})}));
  std::vector<Observation> all;
  long before = 0;
  for (int k = 0; k < 600; ++k) {
    all.clear();
    for (int person = 0; person < 6; ++person) {
      // People come and go, so that tracks are born, coast, end, and are searched for.
      if ((k / 20 + person) % 4 != 0) {
        all.push_back({{2.0 + std::sin(0.05 * k + person), 1.0 * person}, 10.0, 0.15 * person});
      }
    }
    if (k == 300) {
      before = allocations;
    }
    target.step(0.1 * k, all);
  }
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace heel
