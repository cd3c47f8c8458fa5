// What a frame's tiles are said to hold.
#include "chain/tiles/tile_classes.h"

#include "support.h"

namespace defray::test::tile_classes_test {
namespace {

/// 40x20 pixels with a margin of 2: 3x2 tiles.
Frame frame_with_margin() {
  Frame f{44, 24};
  f.margin = 2;
  f.coc_quanta = Quanta(f.pixels(), 127);
  return f;
}

TEST(TileClasses, TheLastThatIsTrueCounts) {
  Frame f = frame_with_margin();
  f.coc_quanta.edit()[f.index(2 + 16, 2)] = -128;  // second tile
  f.coc_quanta.edit()[f.index(0, 0)] = 1000;       // margin
  std::vector<std::uint32_t> mixed(f.pixels());
  mixed[f.index(2 + 32, 2)] = 1;  // third
  mixed[f.index(2, 2 + 19)] = 1;  // fourth, and hidden
  Plane inverse(f.pixels(), -1);
  inverse[f.index(2, 2 + 16)] = 0;
  inverse[f.index(43, 23)] = 1;  // margin
  TileClasses tiles(f);
  const Words flags = mixed;
  for (const Rows rows : {Rows{0, 7}, {7, 20}, {20, 24}}) {  // bands
    tiles.add_hidden(inverse, rows);
    f.wanted = rows;
    tiles.add_surfaces(f, flags);
  }
  LightSources lights;
  lights.where = {
      {2 + 20, 2 + 18, 300, 0}, {1, 5, 300, 0}, {2 + 36, 22, 300, 0}};  // fifth, and margins
  tiles.add(lights);
  const Plane picture = tiles.picture();
  ASSERT_EQ(picture.size(), 800u);
  const auto at = [&](int x, int y) { return picture[static_cast<std::size_t>(y * 40 + x)]; };
  EXPECT_EQ((Plane{at(0, 0), at(16, 0), at(39, 15), at(15, 19), at(16, 16), at(32, 16)}),
            (Plane{0, 1, 2, 3, 4, 0}));
  EXPECT_EQ(at(15, 15), 0);
  const TileShares shares = tiles.shares();
  EXPECT_EQ(shares.tiles, 6u);
  EXPECT_DOUBLE_EQ(shares.in_focus, 2 / 6.0);
  for (const double share : {shares.smooth, shares.mixed, shares.hidden, shares.lights}) {
    EXPECT_DOUBLE_EQ(share, 1 / 6.0);
  }
}

TEST(TileClasses, LightsOfThePicturesCornersCountAndThoseBesideThemDoNot) {
  for (const auto& [x, y, is_inside] : {std::tuple{2, 2, true},
                                        {41, 2, true},
                                        {2, 21, true},
                                        {41, 21, true},
                                        {1, 2, false},
                                        {2, 1, false},
                                        {42, 21, false},
                                        {41, 22, false}}) {
    TileClasses tiles(frame_with_margin());
    LightSources lights;
    lights.where = {{x, y, 300, 0}};
    tiles.add(lights);
    EXPECT_EQ(tiles.shares().lights, is_inside ? 1 / 6.0 : 0) << x << " " << y;
  }
}

TEST(TileClasses, AreShownTwiceAsLarge) {
  Frame f{40, 20};
  f.coc_quanta = Quanta(f.pixels(), 127);
  f.coc_quanta.edit()[f.index(16, 16)] = 128;
  TileClasses tiles(f);
  tiles.add_surfaces(f, Words(f.pixels()));
  tiles.double_size(79, 40);
  const Plane picture = tiles.picture();
  ASSERT_EQ(picture.size(), 79u * 40);
  for (int y = 0; y < 40; ++y) {
    for (int x = 0; x < 79; ++x) {
      const bool is_smooth = y >= 32 && x >= 32 && x < 64;
      EXPECT_EQ(picture[static_cast<std::size_t>(y * 79 + x)], is_smooth ? 1 : 0) << x << " " << y;
    }
  }
}

}  // namespace
}  // namespace defray::test::tile_classes_test
