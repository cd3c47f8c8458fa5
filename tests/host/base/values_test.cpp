// Values that host and device share.
#include "frame/values.h"

#include <gtest/gtest.h>

#include "frame/frame.h"

namespace defray::test::values_test {
namespace {

/// A device that has the numbers from 1 on, and counts how often they are fetched.
class Counting : public DeviceValues {
 public:
  Counting(std::size_t count, int& fetched) : count_(count), fetched_(fetched) {}
  void fetch(void* host) override {
    ++fetched_;
    for (std::size_t i = 0; i < count_; ++i) static_cast<int*>(host)[i] = static_cast<int>(i + 1);
  }

 private:
  std::size_t count_;
  int& fetched_;
};

TEST(Values, AreFetchedOnceWhenTheHostAsks) {
  int fetched = 0;
  const auto values = Values<int>::on(std::make_unique<Counting>(3, fetched), 3);
  const Values<int> copy = values;
  EXPECT_EQ(values.size(), 3u);
  EXPECT_EQ(fetched, 0);
  EXPECT_EQ(copy[2], 3);
  EXPECT_EQ(values[0], 1);
  EXPECT_EQ(fetched, 1);
}

TEST(Values, WhoChangesThemHasHisOwn) {
  Values<int> a{1, 2, 3}, b = a;
  b.edit()[1] = 7;
  EXPECT_EQ(a, (Values<int>{1, 2, 3}));
  EXPECT_EQ(b, (Values<int>{1, 7, 3}));
  const int* const place = b.begin();
  b.edit()[0] = 5;
  EXPECT_EQ(b.begin(), place) << "one's own are changed in place";
}

TEST(Values, SomebodyElsesMemoryIsNotWritten) {
  const std::vector<int> memory{1, 2};
  auto view = Values<int>::view(memory.data(), memory.size());
  EXPECT_EQ(view.begin(), memory.data());
  view.edit()[0] = 9;
  EXPECT_EQ(memory[0], 1);
  EXPECT_EQ(view[0], 9);
}

TEST(Values, ChangedOnTheHostTheyAreNoLongerTheDevices) {
  int fetched = 0;
  auto values = Values<int>::on(std::make_unique<Counting>(2, fetched), 2);
  values.edit()[0] = 8;
  EXPECT_EQ(values.device(), nullptr);
  EXPECT_EQ(values, (Values<int>{8, 2}));
  EXPECT_EQ(fetched, 1);
}

TEST(Values, TakenAsAVectorTheyMoveIfTheyCan) {
  Values<int> values{4, 5};
  const int* const place = values.begin();
  const Values<int> other = values;
  EXPECT_NE(std::move(values).take().data(), place);
  Values<int> alone{4, 5};
  const int* const own = alone.begin();
  EXPECT_EQ(std::move(alone).take().data(), own);
}

TEST(Frame, PlacesOfLayers) {
  Frame f;
  f.width = 5;
  f.height = 3;
  f.layers = 2;
  EXPECT_EQ(f.index(2, 1, 1), 17u);
  EXPECT_EQ(f.front_of(7), 12u);
  EXPECT_EQ(f.data_pixel(17), 7u);
  EXPECT_EQ(f.surfaces(), 30u);
  f.margin = 1;
  EXPECT_TRUE(f.is_in_margin(5));
  EXPECT_FALSE(f.is_in_margin(6));
  EXPECT_TRUE(f.is_in_margin(9));
}

}  // namespace
}  // namespace defray::test::values_test
