// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "apps/follower/attention.hpp"

#include <gtest/gtest.h>

namespace heel {
namespace {

TEST(Attention, NobodyWasLookedAtEnoughAtFirst) { EXPECT_FALSE(Attention().isEnough(1)); }

TEST(Attention, IsEnoughOnceTheSharesMakeAWhole) {
  Attention attention;
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(attention.isEnough(7));
    attention.pay(7, 0.375);
  }
  EXPECT_TRUE(attention.isEnough(7));
}

TEST(Attention, IsPaidToEachForThemselves) {
  Attention attention;
  attention.pay(1, 1.0);
  attention.pay(2, 0.5);
  EXPECT_TRUE(attention.isEnough(1));
  EXPECT_FALSE(attention.isEnough(2));
}

TEST(Attention, ForgetsEverybody) {
  Attention attention;
  attention.pay(1, 1.0);
  attention.clear();
  EXPECT_FALSE(attention.isEnough(1));
}

}  // namespace
}  // namespace heel
