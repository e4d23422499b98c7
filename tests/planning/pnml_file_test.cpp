// SPDX-FileCopyrightText: 2026 The Heel authors
// SPDX-License-Identifier: BSD-3-Clause

#include "tests/support/temp_folder.hpp"
#include <heel/planning/plan_file.hpp>

#include <gtest/gtest.h>

namespace heel {
namespace {

std::string net(const std::string& elements) {
  return "<pnml><net id='n'>" + elements + "</net></pnml>";
}

const std::string kStart =
    "<place id='p1'><name><value>begin</value></name>"
    "<initialMarking><value>1</value></initialMarking></place>";
const std::string kSecond = "<place id='p2'><name><value>goal</value></name></place>";
const std::string kStep = "<transition id='t1'><name><value>go</value></name></transition>";

class PnmlFile : public testing::Test {
 protected:
  PetriNet read(const std::string& text) { return readPnml(folder_.write("plan.pnml", text)); }

  /// The error, without the file's name at its beginning.
  std::string error(const std::string& text) {
    const std::string message = test::messageOf([&] { read(text); });
    const std::string file = (folder_ / "plan.pnml").string() + ": ";
    EXPECT_EQ(message.rfind(file, 0), 0U) << message;
    EXPECT_EQ(message.find('\n'), std::string::npos);
    return message.substr(std::min(message.size(), file.size()));
  }

  test::TempFolder folder_;
};

TEST_F(PnmlFile, ReadsTheDialectOfPetriNetPlans) {
  const PetriNet n = read(net(
      "<name><value>Plan</value></name>"
      "<place id='p1'><graphics><position x='10' y='20'/></graphics>"
      "<name><value> walk.exec </value><graphics><offset x='1' y='-2'/></graphics></name>"
      "<initialMarking><value>Default,2</value></initialMarking></place>" +
      kStep +
      "<arc id='a1' source='p1' target='t1'><inscription><value>2</value></inscription></arc>"
      "<arc id='a2' source='t1' target='p1'><graphics><position x='5' y='6'/></graphics></arc>"));
  EXPECT_EQ(n.name, "Plan");
  ASSERT_EQ(n.places.size(), 1U);
  EXPECT_EQ(n.places[0].name, "walk.exec");
  EXPECT_EQ(n.places[0].tokens, 2);
  EXPECT_EQ(*n.places[0].graphics.position, Eigen::Vector2d(10, 20));
  EXPECT_EQ(n.places[0].graphics.label_offset, Eigen::Vector2d(1, -2));
  ASSERT_EQ(n.transitions.size(), 1U);
  EXPECT_EQ(n.transitions[0].takes.at(0).weight, 2);
  EXPECT_EQ(n.transitions[0].gives.at(0).weight, 1);
  EXPECT_EQ(n.transitions[0].gives[0].bends.at(0), Eigen::Vector2d(5, 6));
}

TEST_F(PnmlFile, ReadsTheStandardsDialect) {
  const PetriNet n = read(
      "<?xml version='1.0'?><pnml xmlns='http://www.pnml.org/version-2009/grammar/pnml'>"
      "<net id='n' type='http://www.pnml.org/version-2009/grammar/ptnet'><page id='g'>"
      "<place id='p1'><name><text>begin</text></name>"
      "<initialMarking><text>1</text></initialMarking></place>"
      "<arc id='a1' source='p1' target='t1'/>"
      "<transition id='t1'><name><text>go</text></name></transition></page></net></pnml>");
  EXPECT_EQ(n.places.at(0).name, "begin");
  EXPECT_EQ(n.places[0].tokens, 1);
  EXPECT_EQ(n.transitions.at(0).takes.size(), 1U);
}

TEST_F(PnmlFile, WritesWhatItReads) {
  PetriNet n;
  n.id = "n";
  n.name = "A <net> & more";
  n.places = {{"p1", "walk.exec", 2, {Eigen::Vector2d(1.5, 2), Eigen::Vector2d(0, 7)}},
              {"p2", "goal", 0, {}}};
  n.transitions = {
      {"t1", "walk.end [near]", {}, {{"a1", 0, 2, {{3, 4}, {5, 6}}}}, {{"a2", 1, 1, {}}}}};
  const std::string text = toPnml(n);
  const PetriNet again = read(text);
  EXPECT_EQ(toPnml(again), text);
  EXPECT_EQ(again.name, n.name);
  EXPECT_EQ(again.places[0].tokens, 2);
  EXPECT_EQ(*again.places[0].graphics.position, Eigen::Vector2d(1.5, 2));
  EXPECT_FALSE(again.places[1].graphics.position.has_value());
  EXPECT_EQ(again.transitions.at(0).takes.at(0).weight, 2);
  EXPECT_EQ(again.transitions[0].takes[0].bends.at(1), Eigen::Vector2d(5, 6));
}

TEST_F(PnmlFile, SaysWhatIsWrongWithTheFile) {
  EXPECT_EQ(test::messageOf([] { readPnml("/nowhere/plan.pnml"); }),
            "/nowhere/plan.pnml: there is no such file");
  EXPECT_EQ(error("hello"), "this is not XML (No document element found)");
  EXPECT_EQ(error("<pnml><net></pnml>").rfind("this is not XML (", 0), 0U);
  EXPECT_EQ(error("<svg/>"), "this is not PNML: it has no <pnml>");
  EXPECT_EQ(error("<pnml/>"), "there is no <net> in it");
  EXPECT_EQ(error("<pnml><net id='a'/><net id='b'/></pnml>"),
            "there are two nets in it; a plan is one");
  EXPECT_EQ(error(net("")), "the net has no places");
}

TEST_F(PnmlFile, SaysWhatIsWrongWithAnElement) {
  EXPECT_EQ(error(net(kSecond + kStep)),
            "no place has a token in its <initialMarking>, so nothing can ever happen");
  EXPECT_EQ(error(net("<place id='p'/>")), "place 'p' has no name");
  EXPECT_EQ(error(net("<place/>")), "a place has no id");
  EXPECT_EQ(error(net(kStart + kStart)), "place 'p1' has an id that is used twice");
  EXPECT_EQ(error(net("<place id='p'><name/><initialMarking><value>-1</value></initialMarking>"
                      "</place>")),
            "place 'p' has the initialMarking '-1', which is not a number from 0 to 1000000");
  EXPECT_EQ(error(net("<place id='p'><graphics><position x='1'/></graphics><name/></place>")),
            "place 'p' is drawn at a place that is no place");
  EXPECT_EQ(
      error(net("<place id='p'><graphics><position x='1' y='-3e9'/></graphics><name/></place>")),
      "place 'p' is drawn further away than 4000");
}

TEST_F(PnmlFile, SaysWhatIsWrongWithAnArc) {
  const std::string nodes = kStart + kSecond + kStep;
  EXPECT_EQ(error(net(nodes + "<arc id='a' source='p1' target='p9'/>")),
            "arc 'a' has the target 'p9', which is nothing in this net");
  EXPECT_EQ(error(net(nodes + "<arc id='a' source='p1' target='p2'/>")),
            "arc 'a' joins two places");
  EXPECT_EQ(error(net(nodes + "<arc id='a' source='t1' target='t1'/>")),
            "arc 'a' joins two transitions");
  EXPECT_EQ(error(net(nodes + "<arc id='a' source='p1' target='t1'/>"
                              "<arc id='b' source='p1' target='t1'/>")),
            "arc 'b' joins what another arc joins already; write an inscription instead");
  EXPECT_EQ(error(net(nodes + "<arc id='a' source='p1' target='t1'>"
                              "<inscription><value>0</value></inscription></arc>")),
            "arc 'a' has the inscription '0', which is not a number from 1 to 1000000");
}

}  // namespace
}  // namespace heel
