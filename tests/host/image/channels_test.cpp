// Choosing colour and depth by channel names.
#include "image/channels.h"

#include "support.h"

namespace defray::test::channels_test {
namespace {

PartInfo part(std::vector<std::string> channels, std::string name = "", std::string view = "",
              std::vector<std::string> views = {}) {
  return {name, view, views, channels, {0, 0, 4, 4}, {0, 0, 4, 4}};
}

ColourChoice colour(const std::vector<PartInfo>& parts, const ChannelRequest& request = {}) {
  return choose_colour("f.exr", parts, request);
}

std::string depth(const std::vector<PartInfo>& parts, const ChannelRequest& request = {}) {
  return choose_depth("f.exr", parts, request, colour(parts, request)).full;
}

TEST(Channels, PlainFile) {
  const std::vector<PartInfo> parts{part({"A", "B", "G", "R", "Z"})};
  EXPECT_EQ(colour(parts).channels, (std::vector<int>{3, 2, 1, 0}));
  EXPECT_EQ(depth(parts), "Z");
}

TEST(Channels, BlenderLayers) {
  const std::vector<PartInfo> parts{
      part({"ViewLayer.Combined.A", "ViewLayer.Combined.B", "ViewLayer.Combined.G",
            "ViewLayer.Combined.R", "ViewLayer.Depth.Z", "ViewLayer.Denoising Depth.Z",
            "ViewLayer.DiffCol.R", "ViewLayer.DiffCol.G", "ViewLayer.DiffCol.B",
            "ViewLayer.Normal.X", "ViewLayer.Normal.Y", "ViewLayer.Normal.Z"})};
  EXPECT_EQ(colour(parts).layer, "ViewLayer.Combined");
  EXPECT_EQ(depth(parts), "ViewLayer.Depth.Z");
  EXPECT_EQ(colour(parts, {"DiffCol", "", ""}).layer, "ViewLayer.DiffCol");
  EXPECT_EQ(depth(parts, {"", "", "ViewLayer.Denoising Depth.Z"}), "ViewLayer.Denoising Depth.Z");
}

TEST(Channels, PicturesThatNoNameTellsApart) {
  const std::vector<PartInfo> pages(2, part({"R", "G", "B"}));
  expect_error(ErrorKind::input,
               {"f.exr: holds 2 pictures that no name tells apart; give it a file each"},
               [&] { colour(pages); });
}

TEST(Channels, DepthOfTheColoursOwnViewLayer) {
  const std::vector<PartInfo> parts{
      part({"A.Combined.R", "A.Combined.G", "A.Combined.B", "A.Depth.Z", "B.Combined.R",
            "B.Combined.G", "B.Combined.B", "B.Depth.Z"})};
  expect_error(ErrorKind::input, {"A.Combined", "B.Combined", "layer"}, [&] { colour(parts); });
  EXPECT_EQ(depth(parts, {"B", "", ""}), "B.Depth.Z");
  EXPECT_EQ(depth(parts, {"A.Combined", "", ""}), "A.Depth.Z");
}

TEST(Channels, OtherNamesOfDepth) {
  for (const std::string name : {"depth.Z", "depth", "Depth.z", "ZDepth", "VRayZDepth.R", "Pz"}) {
    EXPECT_EQ(depth({part({"R", "G", "B", name})}), name);
  }
}

TEST(Channels, AVectorsZIsNoDepth) {
  expect_error(
      ErrorKind::input,
      {"no depth", "N.Z", "Name its file with depth, or its channel with depth_channel. It has"},
      [] {
        depth({part({"R", "G", "B", "N.X", "N.Y", "N.Z"})});
      });
  EXPECT_EQ(depth({part({"R", "G", "B", "N.X", "N.Y", "N.Z", "Z"})}), "Z");
}

TEST(Channels, SeveralDepthsAreAmbiguous) {
  expect_error(ErrorKind::input, {"depth.Z", "zdepth.Z", "depth_channel"}, [] {
    depth({part({"R", "G", "B", "depth.Z", "zdepth.Z"})});
  });
}

TEST(Channels, TheDepthNearestToTheColourIsTaken) {
  // The surer the earlier; what stands in one line is as sure as each other.
  const std::vector<std::vector<std::string>> ranks = {{"L.rgb.Z", "L.rgb.depth"},
                                                       {"L.depth.Z", "L.zdepth.R", "depth.Y"},
                                                       {"Z", "zdepth"},
                                                       {"M.depth.Z", "M.pz.V"},
                                                       {"M.rgb.Z", "M.other.pz"}};
  const auto chosen = [](const std::string& a, const std::string& b) {
    return depth({part({"L.rgb.R", "L.rgb.G", "L.rgb.B", a, b})}, {"L.rgb", "", ""});
  };
  for (std::size_t i = 0; i < ranks.size(); ++i) {
    for (const std::string& surer : ranks[i]) {
      for (const std::string& equal : ranks[i]) {
        if (equal == surer) continue;
        expect_error(ErrorKind::input, {surer, equal, "depth could be"},
                     [&] { chosen(surer, equal); });
      }
      for (std::size_t k = i + 1; k < ranks.size(); ++k) {
        for (const std::string& other : ranks[k]) {
          EXPECT_EQ(chosen(surer, other), surer) << other;
          EXPECT_EQ(chosen(other, surer), surer) << other;
        }
      }
    }
  }
}

TEST(Channels, TheBeautyIsTakenBeforeOtherLayers) {
  for (const std::string beauty :
       {"rgba", "RGB", "beauty", "V.Combined", "c", "colour", "color", "main"}) {
    std::vector<std::string> names;
    for (const std::string& layer : {std::string("diffuse"), beauty, std::string("zzz")}) {
      for (const char* base : {".R", ".G", ".B"}) names.push_back(layer + base);
    }
    EXPECT_EQ(colour({part(names)}).layer, beauty);
  }
  // What is in no layer comes first of all.
  EXPECT_EQ(colour({part({"R", "G", "B", "rgba.R", "rgba.G", "rgba.B"})}).layer, "");
  EXPECT_EQ(colour({part({"Red", "green", "BLUE", "alpha"})}).channels,
            (std::vector<int>{0, 1, 2, 3}));
}

TEST(Channels, SinglePartStereo) {
  const std::vector<PartInfo> parts{part(
      {"R", "G", "B", "Z", "left.R", "left.G", "left.B", "left.Z"}, "", "", {"right", "left"})};
  EXPECT_EQ(colour(parts).view, "right");  // the file's default view
  EXPECT_EQ(depth(parts), "Z");
  EXPECT_EQ(depth(parts, {"", "left", ""}), "left.Z");
  EXPECT_EQ(colour(parts, {"", "left", ""}).channels, (std::vector<int>{4, 5, 6}));
  expect_error(ErrorKind::input, {"view 'middle'", "right", "left"}, [&] {
    colour(parts, {"", "middle", ""});
  });
}

TEST(Channels, MultiPartStereo) {
  const std::vector<PartInfo> parts{
      part({"R", "G", "B"}, "rgba_right", "right"), part({"Z"}, "depth_left", "left"),
      part({"R", "G", "B"}, "rgba_left", "left"), part({"Z"}, "depth_right", "right")};
  expect_error(ErrorKind::input, {"view 'right'", "view 'left'", "view"}, [&] { colour(parts); });
  const ChannelRequest left{"", "left", ""};
  EXPECT_EQ(colour(parts, left).part, 2);
  EXPECT_EQ(choose_depth("f.exr", parts, left, colour(parts, left)).part, 1);
  // Asking for "Z" by name still means the chosen view's.
  const ChannelRequest right{"", "right", "Z"};
  EXPECT_EQ(choose_depth("f.exr", parts, right, colour(parts, right)).part, 3);
}

TEST(Channels, ANameThatSeveralPartsHaveIsAmbiguous) {
  const std::vector<PartInfo> parts{part({"R", "G", "B"}, "rgba"), part({"Z"}, "left"),
                                    part({"Z"}, "right")};
  expect_error(ErrorKind::input,
               {"f.exr: several channels are called 'Z'; choose with", "one of left.Z, right.Z"},
               [&] {
                 depth(parts, {"", "", "Z"});
               });
  for (const int wanted : {1, 2}) {
    const ChannelRequest request{"", "", wanted == 1 ? "left.Z" : "right.Z"};
    EXPECT_EQ(choose_depth("f.exr", parts, request, colour(parts)).part, wanted);
  }
  expect_error(ErrorKind::input, {"depth could be left.Z, right.Z; choose with"},
               [&] { depth(parts); });
  expect_error(ErrorKind::input, {"has no channel 'righ.Z'", "right.Z"}, [&] {
    depth(parts, {"", "", "righ.Z"});
  });
}

TEST(Channels, NamesOfPartsTellTheViewsWhereAllEndInOne) {
  std::vector<PartInfo> parts{part({"R", "G", "B"}, "rgba.left"), part({"Z"}, "depth.left"),
                              part({"R", "G", "B"}, "rgba.right"), part({"Z"}, "depth.right")};
  expect_error(ErrorKind::input, {"view 'left'", "view 'right'"}, [&] { colour(parts); });
  const ChannelRequest right{"", "right", ""};
  EXPECT_EQ(colour(parts, right).part, 2);
  EXPECT_EQ(colour(parts, right).layer, "rgba");
  EXPECT_EQ(choose_depth("f.exr", parts, right, colour(parts, right)).part, 3);
  // Two lights, not two views.
  parts.push_back(part({"R", "G", "B"}, "beauty"));
  EXPECT_EQ(colour(parts, {"rgba.right", "", ""}).part, 2);
  expect_error(ErrorKind::input, {"no colour in view 'right'"}, [&] { colour(parts, right); });
}

TEST(Channels, OfManyThatAreNoColourTwoDozenAreNamed) {
  std::vector<std::string> names;
  for (int i = 0; i < 27; ++i) names.push_back(fmt::format("c{:02}", i));
  const auto message = [&](std::size_t count) {
    try {
      colour({part({names.begin(), names.begin() + static_cast<std::ptrdiff_t>(count)})});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_TRUE(message(27).ends_with("It has: c00 " + message(24).substr(message(24).find("c01")) +
                                    " and 3 more"))
      << message(27);
  EXPECT_TRUE(message(24).ends_with(" c22 c23")) << message(24);
}

/// Only "_left" and ".left" at a name's end are the view's.
TEST(Channels, ViewsInNamesOfParts) {
  for (const auto& [name, layer] : {std::pair{"rgba_left", "rgba"},
                                    {"rgba.LEFT", "rgba"},
                                    {"my_tone", "my_tone"},
                                    {"bleft", "bleft"},
                                    {"left", "left"},
                                    {"a-left", "a-left"},
                                    {"_left", ""}}) {
    const std::vector<PartInfo> parts{part({"R", "G", "B"}, name, "left"),
                                      part({"Z"}, "depth_left", "left")};
    EXPECT_EQ(colour(parts).layer, layer) << name;
  }
}

TEST(Channels, PartsNamedAsLayers) {
  const std::vector<PartInfo> parts{part({"R", "G", "B"}, "beauty"),
                                    part({"R", "G", "B"}, "diffuse"), part({"Z"}, "depth")};
  EXPECT_EQ(colour(parts).layer, "beauty");
  EXPECT_EQ(colour(parts, {"diffuse", "", ""}).part, 1);
  EXPECT_EQ(depth(parts), "Z");
}

TEST(Channels, WithoutRgbTheLuminanceIsGrey) {
  using Channels = std::vector<int>;
  EXPECT_EQ(colour({part({"Y", "Z"})}).channels, Channels{0});
  EXPECT_EQ(colour({part({"A", "Y", "Z"})}).channels, (Channels{1, 0}));
  EXPECT_EQ(colour({part({"beauty.Y", "beauty.Z"})}).layer, "beauty");
  EXPECT_EQ(colour({part({"Y", "R", "G", "B"})}).channels, (Channels{1, 2, 3}));
  // Among several, as with colours.
  EXPECT_EQ(colour({part({"fog.Y", "Y", "Z"})}).channels, Channels{1});
  EXPECT_EQ(colour({part({"fog.Y", "Y", "Z"})}, {"fog", "", ""}).channels, Channels{0});
  expect_error(ErrorKind::input, {"no colour in layer 'mist'", "no layer"}, [&] {
    colour({part({"Y", "Z"})}, {"mist", "", ""});
  });
  // Of a vector, and of a depth.
  for (const auto& channels : {std::vector<std::string>{"N.X", "N.Y", "N.Z"}, {"depth.Y", "Z"}}) {
    expect_error(ErrorKind::input, {"no colour"}, [&] { colour({part(channels)}); });
  }
}

TEST(Channels, WhatIsColourIsNoDepth) {
  for (const auto& names :
       {std::vector<std::string>{"Y"}, {"A", "Y"}, {"depth.R", "depth.G", "depth.B"}}) {
    const std::vector<PartInfo> parts{part(names)};
    expect_error(ErrorKind::input, {"no depth", names.front()}, [&] { depth(parts); });
    EXPECT_TRUE(depth_candidates(parts, colour(parts)).empty()) << names.front();
  }
  // Of a file of its own, and by its name, it is.
  EXPECT_EQ(choose_depth("f.exr", {part({"Y"})}, {}, {}).full, "Y");
  EXPECT_EQ(depth({part({"Y"})}, {"", "", "Y"}), "Y");
}

TEST(Channels, MistByItsNames) {
  const auto is_mist_name = [](const std::string& full) {
    return is_mist(channel_names({part({full})})[0]);
  };
  for (const char* name : {"Mist.Z", "ViewLayer.Mist.Z", "VRayMist.Z", "VRayMist.Y", "VRayFog.R",
                           "VRayAtmosphere.Z", "AtmosphericEffects.Z", "Atmospheric Effects.R",
                           "VRayAtmospheric_Effects.Z", "fog", "mist"}) {
    EXPECT_TRUE(is_mist_name(name)) << name;
  }
  for (const char* name : {"Z", "VRayZDepth.R", "misty.Z", "VRay.Z"}) {
    EXPECT_FALSE(is_mist_name(name)) << name;
  }
}

TEST(Channels, ErrorsListWhatThereIs) {
  expect_error(ErrorKind::input, {"no colour", "V", "Z"}, [] { colour({part({"V", "Z"})}); });
  expect_error(ErrorKind::input, {"layer 'specular'"}, [] {
    colour({part({"R", "G", "B"})}, {"specular", "", ""});
  });
  expect_error(ErrorKind::input, {"no channel 'depht.Z'", "Did you mean 'depth.Z'?"}, [] {
    depth({part({"R", "G", "B", "depth.Z"})}, {"", "", "depht.Z"});
  });
  // Any letter is one edit from Z: no suggestion.
  expect_error(ErrorKind::input, {"no channel '['. It has: R G B Z"}, [] {
    depth({part({"R", "G", "B", "Z"})}, {"", "", "["});
  });
}

}  // namespace
}  // namespace defray::test::channels_test
