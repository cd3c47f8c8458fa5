// The tuner at work: what counts, what is tried alone, where it goes on.
#include "tune/tuner.h"

#include <chrono>
#include <thread>

#include "command/program.h"
#include "tuning/shapes.h"

namespace defray::test::tuner_test {
namespace {

using cli::Drawn;
using cli::Tuner;
using cli::Workload;
using tuning::Validity;

/// Linear filtering of a small picture, whose n-th drawing on the device may go wrong.
class TunerAtWork : public testing::Test {
 protected:
  Folder folder;
  const std::string path = folder / "tuning.json";
  Device device = Device::open(device_under_test().name, {Math::strict, false, true});
  const Plane colour = random_plane({48, 32}, 1), depth = random_depth({48, 32}, 2);
  int drawn = 0;
  std::function<void(int, Drawn&)> spoil = [](int, Drawn&) {};

  Drawn picture(Device& d) const {
    Picture p;
    p.data = {0, 0, 48, 32};
    p.colour = {colour};
    p.depth = depth;
    Lens lens;
    lens.focus_distance_units = 3;
    lens.aperture_diameter_mm = 50;
    return render(d, p, lens, cli::options_of("linear")).colour;
  }

  Workload workload() {
    return {"a picture", "small narrow",
            [this](Device& d) {
              Drawn p = picture(d);
              spoil(++drawn, p);
              return p;
            },
            [this](Device& d) { return picture(d); }};
  }

  /// Until so many pictures are drawn.
  std::vector<tuning::Result> tune(int pictures, const std::vector<std::string>& kernels = {}) {
    Tuner tuner(device, path, kernels);
    drawn = 0;
    struct Enough {};
    try {
      tuner.run(workload(), 1e9, [&](double, const std::string&) {
        if (drawn >= pictures) throw Enough();
      });
    } catch (const Enough&) {
    }
    return tuner.results();
  }

  static std::size_t count(const std::vector<tuning::Result>& results, Validity validity) {
    return static_cast<std::size_t>(
        std::count_if(results.begin(), results.end(),
                      [&](const tuning::Result& r) { return r.validity == validity; }));
  }
};

TEST_F(TunerAtWork, TriesAShapeOfEachKernelInEachPicture) {
  const auto results = tune(12, {"linear_psf", "coc"});
  std::map<std::string, int> shapes;
  for (const tuning::Result& r : results) {
    ++shapes[r.place.kernel];
    EXPECT_EQ(r.place.frame_class, "small narrow");
    EXPECT_EQ(r.place.picture, "a picture");
    EXPECT_EQ(r.validity, Validity::correct);
    EXPECT_GE(r.run_ms.size(), 1u);
    for (const double ms : r.run_ms) EXPECT_GT(ms, 0);
  }
  EXPECT_EQ(shapes.size(), 2u);
  EXPECT_GE(shapes["linear_psf"], 4);
  EXPECT_EQ(shapes["coc"], shapes["linear_psf"]);
}

TEST_F(TunerAtWork, GoesOnWhereItWasLeft) {
  const auto first = tune(8, {"linear_psf"});
  const auto second = tune(8, {"linear_psf"});
  EXPECT_GT(second.size(), first.size());
  for (const tuning::Result& r : first) {
    EXPECT_TRUE(std::any_of(second.begin(), second.end(), [&](const tuning::Result& other) {
      return other.shape == r.shape && other.run_ms == r.run_ms;
    })) << to_string(r.shape);
  }
}

TEST_F(TunerAtWork, TakesKernelsOfTwoPerCentOrMore) {
  for (const tuning::Result& r : tune(6)) {
    EXPECT_TRUE(r.place.kernel == "linear_psf" || r.place.kernel == "coc") << r.place.kernel;
  }
}

TEST_F(TunerAtWork, WhatGivesOtherBitsCountsForNothing) {
  // 1 is what is expected, 2 its timing, 3 and 4 are of the kernels' own shapes; 5 is of another
  // shape each, and then each alone: 6 of coc's, 7 and 8 of linear_psf's.
  spoil = [](int n, Drawn& p) {
    if (n == 5 || n == 6) p[0][7] += 1e-6f;
  };
  const auto results = tune(16, {"linear_psf", "coc"});
  EXPECT_EQ(count(results, Validity::correctness), 1u);
  for (const tuning::Result& r : results) {
    if (r.validity == Validity::correctness) EXPECT_TRUE(r.run_ms.empty());
  }
}

TEST_F(TunerAtWork, WhatTheDeviceDoesNotRunCountsForNothing) {
  spoil = [](int n, Drawn&) {
    if (n == 5 || n == 6) fail(ErrorKind::device, "clEnqueueNDRangeKernel: invalid work-group");
  };
  const auto results = tune(16, {"linear_psf", "coc"});
  EXPECT_EQ(count(results, Validity::runtime), 1u);
}

TEST_F(TunerAtWork, OtherErrorsEndIt) {
  spoil = [](int n, Drawn&) {
    if (n == 5) fail(ErrorKind::input, "gone");
  };
  expect_error(ErrorKind::input, {"gone"}, [&] { tune(16, {"linear_psf"}); });
}

TEST_F(TunerAtWork, EndsAtItsTime) {
  Tuner tuner(device, path, {"linear_psf"});
  double last = 0;
  tuner.run(workload(), 0.5, [&](double seconds, const std::string&) { last = seconds; });
  EXPECT_LT(last, 0.5);
  EXPECT_GT(drawn, 4);
  drawn = 0;
  tuner.run(workload(), 1e-9, [](double, const std::string&) {});
  EXPECT_LE(drawn, 4);  // once
  EXPECT_GE(drawn, 3);
}

/// A step is not begun that would end after the time if it took as long as the last.
TEST_F(TunerAtWork, StepsThatTakeTheirTimeEndWithinIt) {
  spoil = [](int, Drawn&) { std::this_thread::sleep_for(std::chrono::milliseconds(100)); };
  Tuner tuner(device, path, {"linear_psf"});
  tuner.run(workload(), 1.05, [](double, const std::string&) {});
  EXPECT_LE(drawn, 10);
}

TEST_F(TunerAtWork, ADeviceThatIsWrongFromTheStartIsRefused) {
  Workload wrong = workload();
  wrong.draw_small = [&](Device& d) {
    Drawn p = picture(d);
    if (d.name() != device.name()) p[0][0] += 1;
    return p;
  };
  Tuner tuner(device, path, {});
  expect_error(ErrorKind::device, {device.name(), "scalar twins", "defray validate"},
               [&] { tuner.run(wrong, 1, [](double, const std::string&) {}); });
}

}  // namespace
}  // namespace defray::test::tuner_test
