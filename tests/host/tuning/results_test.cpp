// What follows from times of work-groups, and which are tried.
#include "tuning/results.h"

#include <cmath>
#include <set>

#include "base/random.h"
#include "opencl/launch_table.h"
#include "support.h"
#include "tuning/shapes.h"

namespace defray::test::tuning_results_test {
namespace {

using tuning::Finding;
using tuning::Place;
using tuning::Shape;
using tuning::Validity;
using Results = std::vector<tuning::Result>;

const Place place{"hd narrow", "a picture", "fill"};

tuning::Result result(const Shape& shape, std::vector<double> run_ms, const Place& at = place) {
  return {at, shape, Validity::correct, std::move(run_ms)};
}

const Shape own{8, 1};  // of `fill`

TEST(FrameClass, IsOfPixelsAndRadius) {
  EXPECT_EQ(tuning::frame_class(640 * 480, 3), "small narrow");
  EXPECT_EQ(tuning::frame_class(500'000, 16), "small narrow");
  EXPECT_EQ(tuning::frame_class(500'001, 16.01), "hd wide");
  EXPECT_EQ(tuning::frame_class(1920 * 1080, 0), "hd narrow");
  EXPECT_EQ(tuning::frame_class(4'000'000, 100), "hd wide");
  EXPECT_EQ(tuning::frame_class(4'000'001, 100), "uhd wide");
  EXPECT_EQ(tuning::cloud_class(1920 * 1080), "hd cloud");
}

TEST(Shapes, OfEachKernelFitTheDeviceAndBeginWithItsOwn) {
  EXPECT_GT(launch_table().size(), 20u);
  for (const Launch& launch : launch_table()) {
    const auto shapes = tuning::shapes_of(launch.kernel, {512});
    EXPECT_EQ(shapes.front(), tuning::own_shape(launch.kernel, false)) << launch.kernel;
    EXPECT_EQ(std::set<Shape>(shapes.begin(), shapes.end()).size(), shapes.size());
    bool has_rows = false;
    for (const Shape& s : shapes) {
      EXPECT_LE(s.x * s.y, 512u) << launch.kernel << " " << to_string(s);
      EXPECT_GE(s.x * s.y, 1u);
      has_rows |= s.y > 1;
    }
    EXPECT_EQ(has_rows, launch.group.y != 0) << launch.kernel;
  }
  EXPECT_EQ(tuning::shapes_of("coc", {4096}).size(), 9u);
  EXPECT_THROW(tuning::shapes_of("none", {64}), Error);
}

TEST(Shapes, GpusHaveOneForAllKernelsOfTwoDimensions) {
  const Shape on_gpus{gpu_group.x, gpu_group.y};
  EXPECT_EQ(tuning::own_shape("fill", true), on_gpus);
  EXPECT_EQ(tuning::shapes_of("fill", {512, true}).front(), on_gpus);
  EXPECT_EQ(tuning::own_shape("coc", true), tuning::own_shape("coc", false));
  const Results results{result(own, {1, 1, 1, 1, 1}), result(on_gpus, {4, 4, 4, 4, 4}),
                        result({32, 1}, {2, 2, 2, 2, 2})};
  EXPECT_EQ(tuning::adopted(results, place.frame_class, true),
            (std::map<std::string, Shape>{{"fill", own}}));
  EXPECT_EQ(tuning::adopted(results, place.frame_class, false).size(), 0u);
  EXPECT_EQ(tuning::next_to_explore({}, place, {64, true}), on_gpus);
  EXPECT_EQ(tuning::next_to_confirm({}, place, true), on_gpus);
}

TEST(Exploring, TriesEveryShapeOnceAndItsOwnFirst) {
  Results results;
  std::vector<Shape> order;
  while (const auto next = tuning::next_to_explore(results, place, {64})) {
    order.push_back(*next);
    const auto count = static_cast<double>(order.size());
    tuning::merge(results, {result(*next, {std::fmod(5 * count, 7.0) + 0.01 * count})});
  }
  EXPECT_EQ(order.front(), own);
  EXPECT_EQ(std::set<Shape>(order.begin(), order.end()).size(), order.size());
  EXPECT_EQ(order.size(), tuning::shapes_of("fill", {64}).size());
  // Where it was left: the same next one, in any order of what is known.
  results.resize(7);
  const auto next = tuning::next_to_explore(results, place, {64});
  std::reverse(results.begin(), results.end());
  EXPECT_EQ(tuning::next_to_explore(results, place, {64}), next);
  EXPECT_EQ(next, order[7]);
}

TEST(Exploring, LooksBesideTheBestInEveryOtherTry) {
  // Own is known alone: the next lies beside it, half or twice a side.
  const auto beside = tuning::next_to_explore({result(own, {1})}, place, {64});
  ASSERT_TRUE(beside);
  const double x = static_cast<double>(beside->x) / static_cast<double>(own.x);
  const double y = static_cast<double>(beside->y) / static_cast<double>(own.y);
  EXPECT_TRUE((x == 1 && (y == 2 || y == 0.5)) || (y == 1 && (x == 2 || x == 0.5)) ||
              (x * y == 1 && (x == 2 || y == 2)))
      << to_string(*beside);
  // Of another place nothing is known here.
  EXPECT_EQ(
      tuning::next_to_explore({result(own, {1}, {"hd narrow", "other", "fill"})}, place, {64}),
      own);
}

TEST(Exploring, TriesAllThatLieBesideTheBestBeforeLong) {
  Results results;
  std::set<Shape> tried;
  while (results.size() < 10) {
    const Shape next = *tuning::next_to_explore(results, place, {256});
    tried.insert(next);
    tuning::merge(results, {result(next, {next == own ? 1.0 : 2.0})});
  }
  ASSERT_EQ(tuning::own_shape("fill", false), own);
  for (const Shape& beside : {Shape{4, 1}, Shape{16, 1}, Shape{8, 2}, Shape{4, 2}}) {
    EXPECT_TRUE(tried.contains(beside)) << to_string(beside);
  }
}

TEST(Exploring, LeavesOutWhatDidNotWork) {
  Results results{result(own, {1})};
  const Shape wrong{16, 2};
  results.push_back({place, wrong, Validity::runtime, {}});
  while (const auto next = tuning::next_to_explore(results, place, {64})) {
    EXPECT_NE(*next, wrong);
    tuning::merge(results, {result(*next, {1})});
  }
}

TEST(Confirming, TakesOwnAndTheTwoFastestInTurn) {
  Results results{result({16, 1}, {3}), result({32, 1}, {2}), result(own, {5}),
                  result({64, 1}, {4})};
  EXPECT_EQ(tuning::next_to_confirm({}, place, false), own);
  std::map<Shape, int> counts;
  for (int i = 0; i < 12; ++i) {
    const Shape next = tuning::next_to_confirm(results, place, false);
    ++counts[next];
    tuning::merge(results, {result(next, {next == own ? 5.0 : next.x == 32 ? 2.0 : 3.0})});
  }
  EXPECT_EQ(counts, (std::map<Shape, int>{{own, 4}, {{16, 1}, 4}, {{32, 1}, 4}}));
}

TEST(Merging, KeepsTheLatestRunsAndWhatWentWrong) {
  Results results;
  for (int i = 0; i < 20; ++i) tuning::merge(results, {result(own, {double(i)})});
  ASSERT_EQ(results.size(), 1u);
  EXPECT_EQ(results[0].run_ms.size(), 15u);
  EXPECT_EQ(results[0].run_ms.front(), 5);
  EXPECT_EQ(results[0].run_ms.back(), 19);
  tuning::merge(results, {{place, own, Validity::correctness, {}}});
  tuning::merge(results, {result(own, {1})});
  EXPECT_EQ(results[0].validity, Validity::correctness);
  EXPECT_TRUE(tuning::findings(results, false).empty());
}

TEST(Merging, ForgetsTheOldestPicturesOfAClass) {
  Results results;
  for (const char* picture : {"1", "2", "3", "4", "1", "5"}) {
    tuning::merge(results, {result(own, {1}, {"hd narrow", picture, "fill"})});
  }
  tuning::merge(results, {result(own, {1}, {"hd wide", "2", "fill"})});
  std::vector<std::string> left;
  for (const auto& r : results) left.push_back(r.place.frame_class + r.place.picture);
  EXPECT_EQ(left, (std::vector<std::string>{"hd narrow3", "hd narrow4", "hd narrow1", "hd narrow5",
                                            "hd wide2"}));
}

/// What becomes of five runs each of a kernel's own work-group, and another.
Finding found(const std::vector<double>& own_ms, const std::vector<double>& other_ms) {
  const auto all = tuning::findings({result(own, own_ms), result({32, 1}, other_ms)}, false);
  EXPECT_EQ(all.size(), 1u);
  return all.at(0);
}

TEST(Findings, AreShortestRunsAndQuartilesOfPairs) {
  const Finding f = found({11, 10, 10, 12, 10}, {9, 9, 8, 9, 9});
  EXPECT_EQ(f.own, own);
  EXPECT_EQ(f.best, (Shape{32, 1}));
  EXPECT_EQ(f.own_ms, 10);
  EXPECT_EQ(f.best_ms, 8);
  EXPECT_EQ(f.tried, 2u);
  EXPECT_DOUBLE_EQ(f.low, 8.0 / 10);
  EXPECT_DOUBLE_EQ(f.high, 9.0 / 10);
  EXPECT_NEAR(f.gain(), 0.2, 1e-12);
  EXPECT_TRUE(f.is_adopted);
}

TEST(Findings, PairTheLatestRuns) {
  const Finding f = found({100, 100, 10, 10, 10, 10, 10}, {9, 9, 9, 9, 9});
  EXPECT_DOUBLE_EQ(f.high, 0.9);
  EXPECT_DOUBLE_EQ(f.low, 0.9);
}

TEST(Findings, AreUsedOnlyWhereTheyAreSure) {
  EXPECT_TRUE(found({10, 10, 10, 10, 10}, {9.7, 9.7, 9.7, 9.7, 9.7}).is_adopted);
  EXPECT_FALSE(found({10, 10, 10, 10, 10}, {9.8, 9.8, 9.8, 9.8, 9.8}).is_adopted);  // too little
  EXPECT_FALSE(found({10, 10, 10, 10}, {8, 8, 8, 8}).is_adopted);                   // too few
  EXPECT_EQ(found({10, 10, 10, 10}, {8, 8, 8, 8}).runs_missing, 1u);
  EXPECT_EQ(found({10, 10, 10, 10, 10}, {8}).runs_missing, 4u);
  EXPECT_EQ(found({10, 10, 10, 10, 10}, {8, 8, 8, 8, 8}).runs_missing, 0u);
  EXPECT_EQ(found({10}, {9.8}).runs_missing, 0u) << "nothing to be sure of";
  EXPECT_EQ(found({10}, {11}).runs_missing, 0u) << "own is best";
  // Shorter at its shortest, slower in two of five pairs.
  EXPECT_FALSE(found({10, 10, 10, 10, 10}, {8, 8, 8, 11, 11}).is_adopted);
  EXPECT_FALSE(found({10, 10, 10, 10, 10}, {11, 11, 11, 11, 11}).is_adopted);  // own is best
}

/// Times of 200 kernels, each explored and confirmed as a tuner does: how many get another
/// work-group than their own. `gain`: of one of them, by which alone it differs.
template <typename Time>
int adopted_of_200(const Time& time, double gain) {
  const Shape fast{32, 2};
  int count = 0;
  for (int kernel = 0; kernel < 200; ++kernel) {
    Results results;
    for (int run = 0; run < 85; ++run) {
      const auto next = tuning::next_to_explore(results, place, {256});
      const Shape shape = next ? *next : tuning::next_to_confirm(results, place, false);
      Random random(kernel, run, 1);
      tuning::merge(results, {result(shape, {time(random) * (shape == fast ? 1 - gain : 1)})});
    }
    const auto used = tuning::adopted(results, place.frame_class, false);
    count += gain > 0 ? used == std::map<std::string, Shape>{{"fill", fast}} : !used.empty();
  }
  return count;
}

// The experiment that chose the rule.
TEST(Chance, AloneSeldomChoosesAWorkGroup) {
  // As short kernels were seen to take here: 8 or 12 ms, and a little more or less.
  const auto two_modes = [](Random& r) {
    return (r.next() < 0.5 ? 8.4 : 12.5) * (1 + 0.03 * r.next());
  };
  const auto delayed = [](Random& r) {
    return 10 * (1 + 0.06 * r.next()) * (r.next() < 0.1 ? 1.4 : 1);
  };
  EXPECT_LE(adopted_of_200(two_modes, 0), 10);
  EXPECT_LE(adopted_of_200(delayed, 0), 10);
  EXPECT_GE(adopted_of_200(delayed, 0.1), 160);
}

TEST(Findings, NeedTheOwnWorkGroup) {
  EXPECT_TRUE(tuning::findings({result({32, 1}, {1, 1, 1, 1, 1})}, false).empty());
}

TEST(Adopted, IsOfTheClassAndTheLatestPicture) {
  const Place other{"hd narrow", "another picture", "fill"};
  Results results{result(own, {9, 9, 9, 9, 9}, other), result({16, 1}, {5, 5, 5, 5, 5}, other),
                  result(own, {9, 9, 9, 9, 9}), result({32, 1}, {5, 5, 5, 5, 5})};
  using Shapes = std::map<std::string, Shape>;
  EXPECT_EQ(tuning::adopted(results, "hd narrow", false), (Shapes{{"fill", {32, 1}}}));
  EXPECT_EQ(tuning::adopted(results, "hd wide", false), Shapes());
  tuning::merge(results, {result(own, {9}, other)});
  EXPECT_EQ(tuning::adopted(results, "hd narrow", false), (Shapes{{"fill", {16, 1}}}));
  // The latest found nothing: what an older one found is not used.
  const Place third{"hd narrow", "a third", "fill"};
  tuning::merge(results, {result(own, {9}, third)});
  EXPECT_EQ(tuning::adopted(results, "hd narrow", false), Shapes());
}

}  // namespace
}  // namespace defray::test::tuning_results_test
