// Cases of 'defray validate': their text, the grids they come from, the planes they stand for.
#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "lens/coc.h"
#include "reference/reference.h"
#include "support.h"
#include "validation/arithmetic.h"
#include "validation/grid.h"

namespace defray::test::validation_case_test {
namespace {

using namespace defray::validation;

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Every field anywhere in its range.
Case any_case(std::mt19937& random) {
  const auto whole = [&](int least, int most) {
    return std::uniform_int_distribution<int>(least, most)(random);
  };
  const auto real = [&](double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  };
  Case c;
  c.width = whole(1, 128);
  c.height = whole(1, 128);
  c.pattern = static_cast<Pattern>(whole(0, static_cast<int>(Pattern::sparse)));
  c.colours = static_cast<Colours>(whole(0, static_cast<int>(Colours::nonfinite)));
  c.coc_px = whole(0, 3) == 0 ? whole(0, 4194303) : std::exp(real(-300, 15));
  c.channels = whole(1, 4);
  c.cells = whole(1, 64);
  c.samples = whole(1, 1024);
  c.jitter = whole(0, 1) == 1;
  c.band_rows = whole(0, 3) == 0 ? 0 : whole(1, 65536);
  if (whole(0, 3) > 0) {
    c.group_x = whole(1, 4096);
    c.group_y = whole(1, 4096);
  }
  c.focus = whole(0, 3) == 0 ? infinite : real(0.0501, 1e6);
  c.seed = static_cast<std::uint32_t>(random());
  return c;
}

/// The default, but for one field at a time.
std::vector<Case> one_change_each() {
  std::vector<Case> cases(13);
  cases[1].width = 65;
  cases[2].height = 49;
  cases[3].pattern = Pattern::checker;
  cases[4].coc_px = 0.1;
  cases[5].colours = Colours::wild;
  cases[6].channels = 3;
  cases[7].cells = 5;
  cases[8].samples = 9;
  cases[9].jitter = true;
  cases[10].band_rows = 1;
  cases[11].group_x = cases[11].group_y = 2;
  cases[12].focus = infinite;
  cases.emplace_back().seed = 4294967295u;
  return cases;
}

std::vector<Case> grid_here(const KernelCheck& check, Level level = Level::quick) {
  return grid(level, check, session().info().max_work_group);
}

TEST(Case, TextNamesEveryField) {
  std::set<std::string> texts;
  for (const Case& c : one_change_each()) {
    EXPECT_TRUE(texts.insert(to_string(c)).second) << to_string(c);
    EXPECT_EQ(parse_case(to_string(c)), c) << to_string(c);
  }
}

TEST(Case, TextGivesTheSameCaseBack) {
  std::mt19937 random(7);
  for (int i = 0; i < 20000; ++i) {
    const Case c = any_case(random);
    ASSERT_EQ(parse_case(to_string(c)), c) << to_string(c);
  }
  for (const KernelCheck& check : kernel_checks()) {
    for (const Level level : {Level::tiny, Level::quick, Level::full}) {
      for (const Case& c : grid_here(check, level)) {
        ASSERT_EQ(parse_case(to_string(c)), c) << to_string(c);
      }
    }
  }
}

TEST(Case, WhatIsNotSaidKeepsItsDefault) {
  EXPECT_EQ(parse_case("64x48"), Case());
  Case c;
  c.cells = 3;
  EXPECT_EQ(parse_case("cells=3"), c);
}

TEST(Case, RefusesWhatItDoesNotKnow) {
  const auto refused = [](const std::string& text, std::vector<std::string> words) {
    words.push_back("case");
    expect_error(ErrorKind::usage, words, [&] { parse_case(text); });
  };
  refused("", {"empty"});
  refused("64x48,,ties", {"''"});
  refused("64x48,spars", {"'spars'", "Did you mean 'sparse'", "WIDTHxHEIGHT"});
  refused("64x48,jiter", {"Did you mean 'jitter'"});
  refused("64x48,cels=4", {"'cels=4'", "Did you mean 'cells'"});
  refused("64x48,WILD", {"Did you mean 'wild'"});
  for (const std::string word : {"64", "64x", "x48", "64x48x3", "0x48", "64x-1", "65537x1",
                                 "group=7", "group=0x1", "group=1x", "group=4097x1", "group="}) {
    refused(word, {word});
  }
  for (const std::string word : {"coc=-1",       "coc=nan",    "coc=4194304", "coc=8px",
                                 "coc=",         "coc= 8",     "channels=0",  "channels=5",
                                 "channels=1.5", "cells=0",    "cells=65",    "samples=0",
                                 "samples=1025", "band=-1",    "band=65537",  "focus=0.05",
                                 "focus=nan",    "focus=-inf", "seed=-1",     "seed=4294967296"}) {
    refused("64x48," + word, {word, "must be a number from"});
  }
  refused("64x48,coc", {"'coc'", "needs a value"});
  refused("64x48,jitter=2", {"'jitter=2'", "takes no value"});
  for (const std::string words : {"64x48,5x5", "seed=3,seed=4", "ties,random", "wild,plain"}) {
    refused(words, {"for the second time"});
  }
  refused("65536x1,cells=64", {"64x64 cells", "2^26"});
  refused("4096x4096", {"4096x4096", "2^22"});
  EXPECT_NO_THROW(parse_case("4096x1024"));
  refused("4096x1025", {"2^22"});
}

/// What the cases of a grid contain.
struct Contents {
  std::set<Pattern> patterns;
  std::set<Colours> colours;
  std::set<int> channels, bands;
  std::set<std::pair<int, int>> groups;
  std::set<bool> jitter;
};

Contents contents_of(const std::vector<Case>& cases) {
  Contents all;
  for (const Case& c : cases) {
    all.patterns.insert(c.pattern);
    all.colours.insert(c.colours);
    all.channels.insert(c.channels);
    all.bands.insert(c.band_rows);
    all.groups.insert({c.group_x, c.group_y});
    all.jitter.insert(c.jitter);
  }
  return all;
}

TEST(Grid, TriesEverythingOnEveryKernel) {
  for (const KernelCheck& check : kernel_checks()) {
    const Contents all = contents_of(grid(Level::quick, check, 4096));
    EXPECT_EQ(all.patterns.size(), 8u) << check.name;
    EXPECT_EQ(all.colours.size(), 4u) << check.name;
    EXPECT_EQ(all.channels, (std::set<int>{1, 2, 3, 4})) << check.name;
    EXPECT_EQ(all.jitter.size(), 2u) << check.name;
    EXPECT_EQ(all.bands, (std::set<int>{0, 1, 2, 5, 46})) << check.name;
    EXPECT_EQ(all.groups, (std::set<std::pair<int, int>>{{0, 0}, {1, 1}, {7, 3}, {32, 2}, {64, 1}}))
        << check.name;
  }
}

TEST(Grid, FitsTheDeviceAndIsTheSameListEveryTime) {
  for (const KernelCheck& check : kernel_checks()) {
    for (const Level level : {Level::tiny, Level::quick, Level::full}) {
      EXPECT_EQ(grid(level, check, 4096), grid(level, check, 4096)) << check.name;
      for (const int most : {1, 21, 63}) {
        for (const Case& c : grid(level, check, static_cast<std::size_t>(most))) {
          ASSERT_LE(c.group_x * c.group_y, most) << check.name << " " << to_string(c);
        }
      }
    }
    EXPECT_GT(grid(Level::tiny, check, 4096).size(), 10u) << check.name;
    EXPECT_GT(grid(Level::full, check, 4096).size(), grid(Level::quick, check, 4096).size());
  }
}

void expect_shape(const Case& c, const Input& in) {
  const auto pixels = static_cast<std::size_t>(c.width) * static_cast<std::size_t>(c.height);
  ASSERT_EQ(in.coc_quanta.size(), pixels);
  ASSERT_EQ(in.depth.size(), pixels);
  ASSERT_EQ(in.channels.size(), static_cast<std::size_t>(c.channels));
  for (const Plane& plane : in.channels) ASSERT_EQ(plane.size(), pixels);
}

void expect_promises(const Case& c) {
  SCOPED_TRACE(to_string(c));
  const Input in = make_input(c);
  expect_shape(c, in);
  const double largest_quanta = std::round(256 * c.coc_px);
  for (const std::int32_t q : in.coc_quanta) ASSERT_LE(std::fabs(q), largest_quanta);
  for (const float z : in.depth) ASSERT_GT(z, 0);
  const double from_lens =
      std::fabs(reference::coc_px(in.lens, c.width, std::isinf(c.focus) ? 1 : infinite));
  EXPECT_NEAR(from_lens, c.coc_px, 1e-12 * c.coc_px);
  const Input again = make_input(c);
  EXPECT_EQ(again.coc_quanta, in.coc_quanta);
  EXPECT_EQ(again.depth, in.depth);
  EXPECT_EQ(hash_of(again.channels), hash_of(in.channels));
}

TEST(Input, KeepsItsPromises) {
  const KernelCheck& all_cases = find_check("coc");  // the cheapest: its grid leaves nothing out
  for (const Case& c : grid(Level::quick, all_cases, 4096)) expect_promises(c);
}

TEST(Input, PatternsReachTheLargestCocAndColoursAreOfTheirKind) {
  Case c;
  for (const Pattern pattern : {Pattern::constant, Pattern::steps, Pattern::converging,
                                Pattern::checker, Pattern::sparse}) {
    c.pattern = pattern;
    EXPECT_EQ(largest_coc(make_input(c).coc_quanta), 256 * c.coc_px) << to_string(c);
  }
  const auto share = [&](Colours colours, auto has) {
    c.colours = colours;
    const Plane plane = make_input(c).channels[0];
    return static_cast<double>(std::count_if(plane.begin(), plane.end(), has)) /
           static_cast<double>(plane.size());
  };
  EXPECT_EQ(share(Colours::plain, [](float v) { return v >= 0 && v < 1; }), 1);
  EXPECT_GT(share(Colours::wild, [](float v) { return v < 0; }), 0.05);
  EXPECT_GT(share(Colours::extreme, [](float v) { return v > 1e38f; }), 0.05);
  EXPECT_GT(share(Colours::extreme, [](float v) { return std::fpclassify(v) == FP_SUBNORMAL; }),
            0.1);
  EXPECT_GT(share(Colours::nonfinite, [](float v) { return std::isnan(v); }), 0.002);
  EXPECT_GT(share(Colours::nonfinite, [](float v) { return std::isinf(v); }), 0.005);
}

}  // namespace
}  // namespace defray::test::validation_case_test
