// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

/// @file
/// A page as a tree.
#pragma once

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>
#include <pugixml.hpp>

#include <string>

namespace heel::test {

inline constexpr const char* kHostile = "<script>alert('x')</script>\"&]]>{{style}}\x01";

/// Fails the test if the page is not well-formed, or has an address of anything outside of it.
inline void parseSelfContained(std::string page, pugi::xml_document& document) {
  const std::string upstream = "https://github.com/leeoniya/uPlot";  // in its first comment
  if (const auto at = page.find(upstream); at != std::string::npos) page.erase(at, upstream.size());
  EXPECT_THAT(page, testing::Not(testing::HasSubstr("http")));
  EXPECT_THAT(page, testing::Not(testing::HasSubstr("url(")));
  EXPECT_THAT(page, testing::Not(testing::HasSubstr("@import")));
  const auto result = document.load_string(page.c_str(), pugi::parse_default | pugi::parse_doctype);
  ASSERT_TRUE(result) << result.description() << " at "
                      << page.substr(static_cast<std::size_t>(result.offset), 80);
  ASSERT_TRUE(document.child("html").child("body"));
  for (const auto& node : document.select_nodes("//@src | //@href")) {
    EXPECT_THAT(std::string(node.attribute().value()), testing::StartsWith("data:"));
  }
  EXPECT_THAT(page, testing::HasSubstr("Permission is hereby granted")) << "uPlot's licence";
}

inline std::size_t countOf(const pugi::xml_document& document, const char* xpath) {
  return document.select_nodes(xpath).size();
}

/// What the page's script works on.
inline nlohmann::json dataOf(const pugi::xml_document& document) {
  return nlohmann::json::parse(
      document.select_node("//script[@id='run']").node().text().as_string());
}

}  // namespace heel::test
