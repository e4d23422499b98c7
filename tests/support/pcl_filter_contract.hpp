// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// What any pcl::FilterIndices must do, whatever it selects by: a GoogleTest suite for every
/// filter.
///
/// The type parameter is a struct that names the filter and sets it up:
///
///     struct MyCase {
///       using Point = pcl::PointXYZRGB;
///       using Filter = MyFilter<Point>;
///       static void setUp(Filter& filter);  // so that it keeps some points of makeScene and not
///       others
///     };
///     INSTANTIATE_TYPED_TEST_SUITE_P(MyFilter, PclFilterContract, MyCase);
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <pcl/common/point_tests.h>
#include <pcl/console/print.h>
#include <pcl/for_each_type.h>
#include <pcl/point_cloud.h>
#include <pcl/type_traits.h>
#include <pcl/types.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <random>
#include <string>

namespace heel::test {

/// Keeps PCL from printing the errors that a test provokes.
class QuietPcl {
 public:
  QuietPcl() : level_(pcl::console::getVerbosityLevel()) {
    pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);
  }
  ~QuietPcl() { pcl::console::setVerbosityLevel(level_); }
  QuietPcl(const QuietPcl&) = delete;
  QuietPcl& operator=(const QuietPcl&) = delete;

 private:
  pcl::console::VERBOSITY_LEVEL level_;
};

/// An organized cloud, 8 x 12: x, y, z in [-1, 1), any colour, one coordinate of one point in seven
/// not finite.
template <typename PointT>
typename pcl::PointCloud<PointT>::Ptr makeScene(unsigned seed) {
  std::mt19937 random(seed);
  const auto coordinate = [&] { return static_cast<float>(random() % 2000) / 1000.0F - 1.0F; };
  const auto channel = [&] { return static_cast<std::uint8_t>(random() % 256); };
  auto cloud = pcl::make_shared<pcl::PointCloud<PointT>>(8, 12);
  for (PointT& p : *cloud) {
    p.x = coordinate();
    p.y = coordinate();
    p.z = coordinate();
    p.r = channel();
    p.g = channel();
    p.b = channel();
    if (random() % 7 == 0) {
      const float bad = random() % 2 == 0 ? std::numeric_limits<float>::quiet_NaN()
                                          : std::numeric_limits<float>::infinity();
      float* const coordinates[] = {&p.x, &p.y, &p.z};
      *coordinates[random() % 3] = bad;
    }
  }
  cloud->is_dense = false;
  cloud->header.frame_id = "base";
  cloud->header.stamp = 42;
  cloud->sensor_origin_ = {1.0F, 2.0F, 3.0F, 1.0F};
  return cloud;
}

/// Whether two points agree, bit by bit, in the fields that PCL knows: all, or all but x, y, z.
template <typename PointT>
class SameFields {
 public:
  SameFields(const PointT& a, const PointT& b, bool also_xyz)
      : a_(reinterpret_cast<const char*>(&a)),
        b_(reinterpret_cast<const char*>(&b)),
        also_xyz_(also_xyz) {
    pcl::for_each_type<typename pcl::traits::fieldList<PointT>::type>(*this);
  }
  explicit operator bool() const { return *same_; }

  template <typename Field>
  void operator()() {
    const std::string name = pcl::traits::name<PointT, Field>::value;
    if (!also_xyz_ && (name == "x" || name == "y" || name == "z")) return;
    constexpr auto kOffset = pcl::traits::offset<PointT, Field>::value;
    using Type = typename pcl::traits::datatype<PointT, Field>::type;
    if (std::memcmp(a_ + kOffset, b_ + kOffset, sizeof(Type)) != 0) *same_ = false;
  }

 private:
  const char* a_;
  const char* b_;
  bool also_xyz_;
  // for_each_type works on copies of its functor: they share the answer.
  std::shared_ptr<bool> same_ = std::make_shared<bool>(true);
};

/// A filter of the case, set up on a cloud.
template <typename Case>
class Run {
 public:
  using Cloud = pcl::PointCloud<typename Case::Point>;

  explicit Run(const typename Cloud::ConstPtr& cloud, bool negative = false) : filter(true) {
    Case::setUp(filter);
    filter.setNegative(negative);
    if (cloud != nullptr) filter.setInputCloud(cloud);
  }
  pcl::Indices kept() {
    pcl::Indices indices;
    filter.filter(indices);
    return indices;
  }
  pcl::Indices removed() { return *filter.getRemovedIndices(); }

  typename Case::Filter filter;
};

inline pcl::Indices allIndices(std::size_t n) {
  pcl::Indices indices(n);
  for (std::size_t i = 0; i < n; ++i) indices[i] = static_cast<pcl::index_t>(i);
  return indices;
}

/// The first law: each index ends in exactly one of the two lists. A function, so that a control
/// can show that it may fail.
template <typename Case>
testing::AssertionResult keptAndRemovedPartitionTheInput() {
  for (const unsigned seed : {1U, 2U, 3U}) {
    for (const bool negative : {false, true}) {
      const auto cloud = makeScene<typename Case::Point>(seed);
      Run<Case> run(cloud, negative);
      pcl::Indices both = run.kept();
      const auto kept = both.size();
      const pcl::Indices removed = run.removed();
      if (kept == 0 || removed.empty()) {
        return testing::AssertionFailure() << "the scene does not try the filter: seed " << seed;
      }
      both.insert(both.end(), removed.begin(), removed.end());
      std::sort(both.begin(), both.end());
      if (both != allIndices(cloud->size())) {
        return testing::AssertionFailure()
               << kept << " kept and " << removed.size() << " removed of " << cloud->size()
               << " points, seed " << seed << (negative ? ", negative" : "");
      }
    }
  }
  return testing::AssertionSuccess();
}

template <typename Case>
class PclFilterContract : public testing::Test {
 protected:
  using Point = typename Case::Point;
  using Cloud = pcl::PointCloud<Point>;

  static void expectCloudHolds(const Cloud& out, const Cloud& in, const pcl::Indices& indices) {
    ASSERT_EQ(out.size(), indices.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
      EXPECT_TRUE(bool(SameFields<Point>(out[i], in[indices[i]], true))) << "point " << i;
    }
  }

  typename Cloud::Ptr cloud_ = makeScene<Point>(1);
};

TYPED_TEST_SUITE_P(PclFilterContract);

TYPED_TEST_P(PclFilterContract, KeptAndRemovedPartitionTheInput) {
  EXPECT_TRUE(keptAndRemovedPartitionTheInput<TypeParam>());
}

TYPED_TEST_P(PclFilterContract, NeverKeepsNonFinite) {
  for (const bool negative : {false, true}) {
    for (const auto i : Run<TypeParam>(this->cloud_, negative).kept()) {
      EXPECT_TRUE(pcl::isFinite((*this->cloud_)[i])) << i;
    }
  }
}

TYPED_TEST_P(PclFilterContract, NegativeIsTheComplementAmongFinite) {
  pcl::Indices both = Run<TypeParam>(this->cloud_, false).kept();
  const pcl::Indices negative = Run<TypeParam>(this->cloud_, true).kept();
  both.insert(both.end(), negative.begin(), negative.end());
  std::sort(both.begin(), both.end());
  pcl::Indices finite;
  for (const auto i : allIndices(this->cloud_->size())) {
    if (pcl::isFinite((*this->cloud_)[i])) finite.push_back(i);
  }
  EXPECT_EQ(both, finite);
}

TYPED_TEST_P(PclFilterContract, HonoursIndicesAndTheirOrder) {
  // Every other point, from the last to the first, one of them twice.
  pcl::Indices subset;
  for (pcl::index_t i = 90; i >= 0; i -= 2) subset.push_back(i);
  subset.push_back(subset.front());
  const pcl::Indices kept_of_all = Run<TypeParam>(this->cloud_).kept();
  pcl::Indices kept;
  pcl::Indices removed;
  for (const auto i : subset) {
    const bool keep = std::count(kept_of_all.begin(), kept_of_all.end(), i) != 0;
    (keep ? kept : removed).push_back(i);
  }
  Run<TypeParam> run(this->cloud_);
  run.filter.setIndices(pcl::make_shared<pcl::Indices>(subset));
  EXPECT_EQ(run.kept(), kept);
  EXPECT_EQ(run.removed(), removed);
}

TYPED_TEST_P(PclFilterContract, OutputMayAliasTheIndices) {
  const auto shared = pcl::make_shared<pcl::Indices>(allIndices(this->cloud_->size()));
  Run<TypeParam> run(this->cloud_);
  run.filter.setIndices(shared);
  run.filter.filter(*shared);
  EXPECT_EQ(*shared, Run<TypeParam>(this->cloud_).kept());
}

TYPED_TEST_P(PclFilterContract, CloudOutMatchesIndicesOut) {
  for (const bool negative : {false, true}) {
    Run<TypeParam> run(this->cloud_, negative);
    typename TestFixture::Cloud out;
    run.filter.filter(out);
    this->expectCloudHolds(out, *this->cloud_, Run<TypeParam>(this->cloud_, negative).kept());
    EXPECT_EQ(out.header.frame_id, "base");
    EXPECT_EQ(out.header.stamp, 42U);
    EXPECT_EQ(out.sensor_origin_, this->cloud_->sensor_origin_);
  }
}

TYPED_TEST_P(PclFilterContract, WorksInPlace) {
  const typename TestFixture::Cloud before = *this->cloud_;
  const pcl::Indices kept = Run<TypeParam>(this->cloud_).kept();
  Run<TypeParam> run(this->cloud_);
  run.filter.filter(*this->cloud_);
  this->expectCloudHolds(*this->cloud_, before, kept);
}

TYPED_TEST_P(PclFilterContract, KeepOrganizedBlanksOnlyXyzOfRemoved) {
  for (const float value : {std::numeric_limits<float>::quiet_NaN(), 7.0F}) {
    Run<TypeParam> run(this->cloud_);
    const pcl::Indices kept = run.kept();
    run.filter.setKeepOrganized(true);
    run.filter.setUserFilterValue(value);
    typename TestFixture::Cloud out;
    run.filter.filter(out);
    ASSERT_EQ(out.width, this->cloud_->width);
    ASSERT_EQ(out.height, this->cloud_->height);
    for (const auto i : allIndices(out.size())) {
      const auto& a = (*this->cloud_)[i];
      const auto& b = out[i];
      const bool is_kept = std::binary_search(kept.begin(), kept.end(), i);
      EXPECT_TRUE(bool(SameFields<typename TypeParam::Point>(a, b, is_kept))) << i;
      if (is_kept) continue;
      for (const float blank : {b.x, b.y, b.z}) {
        EXPECT_EQ(std::memcmp(&blank, &value, sizeof value), 0) << i;
      }
    }
  }
}

TYPED_TEST_P(PclFilterContract, AnEmptyCloudGivesEmptyLists) {
  Run<TypeParam> run(pcl::make_shared<typename TestFixture::Cloud>());
  EXPECT_TRUE(run.kept().empty());
  EXPECT_TRUE(run.removed().empty());
}

TYPED_TEST_P(PclFilterContract, AnEmptyIndexListKeepsNothing) {
  Run<TypeParam> run(this->cloud_);
  run.filter.setIndices(pcl::make_shared<pcl::Indices>());
  EXPECT_TRUE(run.kept().empty());
  EXPECT_TRUE(run.removed().empty());
}

TYPED_TEST_P(PclFilterContract, WithoutInputTheOutputStaysAsItWas) {
  const QuietPcl quiet;
  Run<TypeParam> run(nullptr);
  pcl::Indices indices = {3, 1};
  run.filter.filter(indices);
  EXPECT_EQ(indices, (pcl::Indices{3, 1}));
}

TYPED_TEST_P(PclFilterContract, UnorganisedIsAsOrganised) {
  const auto flat = pcl::make_shared<typename TestFixture::Cloud>(*this->cloud_);
  flat->width = static_cast<std::uint32_t>(flat->size());
  flat->height = 1;
  EXPECT_EQ(Run<TypeParam>(flat).kept(), Run<TypeParam>(this->cloud_).kept());
}

TYPED_TEST_P(PclFilterContract, TwiceInARowIsAsOnce) {
  Run<TypeParam> run(this->cloud_);
  const pcl::Indices kept = run.kept();
  const pcl::Indices removed = run.removed();
  EXPECT_EQ(run.kept(), kept);
  EXPECT_EQ(run.removed(), removed);

  // A smaller cloud after a larger one: nothing of the larger is left.
  const auto one = pcl::make_shared<typename TestFixture::Cloud>();
  one->push_back((*this->cloud_)[kept.front()]);
  run.filter.setInputCloud(one);
  EXPECT_EQ(run.kept(), pcl::Indices{0});
  EXPECT_TRUE(run.removed().empty());
}

REGISTER_TYPED_TEST_SUITE_P(PclFilterContract, KeptAndRemovedPartitionTheInput, NeverKeepsNonFinite,
                            NegativeIsTheComplementAmongFinite, HonoursIndicesAndTheirOrder,
                            OutputMayAliasTheIndices, CloudOutMatchesIndicesOut, WorksInPlace,
                            KeepOrganizedBlanksOnlyXyzOfRemoved, AnEmptyCloudGivesEmptyLists,
                            AnEmptyIndexListKeepsNothing, WithoutInputTheOutputStaysAsItWas,
                            UnorganisedIsAsOrganised, TwiceInARowIsAsOnce);

}  // namespace heel::test
