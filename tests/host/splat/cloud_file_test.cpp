// Point clouds from files: PLY and text, and what is wrong with them.
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "base/srgb.h"
#include "defray/splat.h"
#include "support.h"

namespace defray::test::cloud_file_test {
namespace {

class CloudFile : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
    return folder_ / name;
  }
  void expect_error(const std::string& name, const std::string& bytes,
                    const std::string& words) const {
    try {
      read_point_cloud(write(name, bytes));
      ADD_FAILURE() << "not refused: " << words;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input);
      const std::string what = error.what();
      EXPECT_NE(what.find(words), std::string::npos) << what;
      EXPECT_NE(what.find(name), std::string::npos) << what;
    }
  }
  Folder folder_;
};

const std::string coloured_header =
    "ply\nformat ascii 1.0\ncomment made by hand\nelement vertex 2\nproperty float x\nproperty "
    "float y\nproperty float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

TEST_F(CloudFile, AsciiPly) {
  const PointCloud cloud = read_point_cloud(
      write("a.ply", coloured_header + "1 2 3 255 0 128\n1.5 2 nan 0 0 0\n3 0 1 1\n"));
  ASSERT_EQ(cloud.positions.size(), 2u);
  EXPECT_EQ(cloud.origin, (std::array<double, 3>{1, 2, 3}));
  EXPECT_EQ(cloud.positions[0], (std::array<float, 3>{0, 0, 0}));
  EXPECT_EQ(cloud.positions[1][0], 0.5f);
  EXPECT_TRUE(std::isnan(cloud.positions[1][2]));
  EXPECT_EQ(cloud.colours[0][0], 1);
  EXPECT_FLOAT_EQ(cloud.colours[0][2], static_cast<float>(srgb_decode(128.0 / 255)));
  EXPECT_TRUE(cloud.normals.empty());
  EXPECT_TRUE(cloud.radii.empty());
  EXPECT_EQ(cloud.notes, std::vector<std::string>{"not used: element face"});
}

/// Values of any type as bytes of either order.
template <typename T>
std::string bytes_of(T value, bool is_big) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return is_big ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

TEST_F(CloudFile, BinaryPlyOfEitherOrder) {
  for (const bool is_big : {false, true}) {
    std::string bytes = std::string("ply\r\nformat ") +
                        (is_big ? "binary_big_endian" : "binary_little_endian") +
                        " 1.0\r\nelement camera 1\r\nproperty short id\r\nproperty list uint8 "
                        "float32 k\r\nelement vertex 1\r\nproperty double x\r\nproperty float64 "
                        "y\r\nproperty int z\r\nproperty float nx\r\nproperty float ny\r\nproperty "
                        "float nz\r\nproperty float radius\r\nproperty ushort alpha\r\nproperty "
                        "char confidence\r\nproperty list uchar uchar tags\r\nproperty float r\r\n"
                        "property float g\r\nproperty float b\r\nend_header\r\n";
    const auto add = [&](auto value) { bytes += bytes_of(value, is_big); };
    add(std::int16_t{-3});
    add(std::uint8_t{2});
    add(1.0f);
    add(2.0f);
    add(500000.125);
    add(4000000.5);
    add(std::int32_t{-7});
    add(0.0f);
    add(-1.0f);
    add(0.0f);
    add(0.25f);
    add(std::uint16_t{65535});
    add(std::int8_t{-1});
    add(std::uint8_t{1});
    add(std::uint8_t{9});
    add(0.5f);
    add(2.0f);
    add(0.0f);
    const PointCloud cloud = read_point_cloud(write("b.ply", bytes));
    ASSERT_EQ(cloud.positions.size(), 1u);
    EXPECT_EQ(cloud.origin, (std::array<double, 3>{500000.125, 4000000.5, -7}));
    EXPECT_EQ(cloud.normals[0], (std::array<float, 3>{0, -1, 0}));
    EXPECT_EQ(cloud.radii[0], 0.25f);
    EXPECT_EQ(cloud.alpha[0], 1);
    EXPECT_EQ(cloud.colours[0], (std::array<float, 3>{0.5f, 2, 0})) << "floats are linear";
  }
}

TEST_F(CloudFile, FloatsNearNothingStayWhatTheyAre) {
  std::string rows;
  for (int i = 0; i < 50; ++i)
    rows += fmt::format("{} {} {}\n", 0.1f * float(i), 0.3f - float(i), 1e-7f * float(i));
  const PointCloud cloud = read_point_cloud(write("near.xyz", rows));
  for (int i = 0; i < 50; ++i) {
    const std::array<float, 3> place{0.1f * float(i), 0.3f - float(i), 1e-7f * float(i)};
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(
          static_cast<float>(cloud.origin[k] + static_cast<double>(cloud.positions[size(i)][k])),
          place[k]);
    }
  }
}

/// Floats hold what lies around the origin: a few points far away do not move it.
TEST_F(CloudFile, PlacesAreFromTheMiddle) {
  std::string rows = "0 0 0\nnan 0 0\n0 0 0\n";
  for (int i = 0; i < 7; ++i) rows += fmt::format("500000.0625 {}.001 -7\n", 4000000 + i);
  const PointCloud cloud = read_point_cloud(write("far.xyz", rows + "1e12 1e12 1e12\n"));
  EXPECT_EQ(cloud.origin, (std::array<double, 3>{500000.0625, 4000002.001, -7}));
  EXPECT_EQ(cloud.positions[5][0], 0);
  EXPECT_EQ(cloud.positions[5][1], 0);
  EXPECT_EQ(cloud.positions[9][1], 4);
  EXPECT_EQ(cloud.positions[0][0], -500000.0625f);
  EXPECT_TRUE(std::isnan(cloud.positions[1][0]));
}

TEST_F(CloudFile, PlacesThatFloatsDoNotHoldAreNoted) {
  const auto notes = [&](double offset, bool as_floats, double size) {
    std::string text;
    for (int i = 0; i < 500; ++i) {
      const double x = offset + size * ((i * 37) % 500) / 500.0;
      text += fmt::format("{:.9f} {} 0\n",
                          as_floats ? static_cast<double>(static_cast<float>(x)) : x, i % 25);
    }
    return read_point_cloud(write("far.xyz", text)).notes;
  };
  const auto noted = notes(4e6, true, 10);
  ASSERT_EQ(noted.size(), 1u);
  EXPECT_EQ(noted[0].find("places are in steps of 0.25 units: floats have no more digits so far"),
            0u)
      << noted[0];
  EXPECT_TRUE(notes(4e6, false, 10).empty());
  EXPECT_TRUE(notes(4e6, true, 4000).empty());
  EXPECT_TRUE(notes(0, true, 500).empty());
}

TEST_F(CloudFile, Text) {
  const PointCloud plain = read_point_cloud(write("a.xyz", "# a scan\n1 2 3\n\n4;5\t6\n"));
  EXPECT_EQ(plain.positions[1], (std::array<float, 3>{3, 3, 3}));
  const PointCloud coloured = read_point_cloud(write("a.pts", "2\n1 2 3 255 0 0\n1 2 4 0 0 255\n"));
  EXPECT_EQ(coloured.colours[1], (std::array<float, 3>{0, 0, 1}));
  const PointCloud turned = read_point_cloud(write("b.xyz", "1 2 3 0.6 0 -0.8\n1 2 4 0 0 1\n"));
  EXPECT_EQ(turned.normals[0][2], -0.8f);
  const PointCloud all = read_point_cloud(write("c.txt", "1 2 3 0.6 0 0.8 10 20 255\n"));
  EXPECT_EQ(all.normals[0][0], 0.6f);
  EXPECT_EQ(all.colours[0][2], 1);
  const PointCloud swapped = read_point_cloud(write("d.txt", "1 2 3 10 20 255 0.6 0 0.8\n"));
  EXPECT_EQ(swapped.normals[0][0], 0.6f);
  const PointCloud named = read_point_cloud(
      write("e.csv", "\"X\",\"Y\",\"Z\",\"radius\",\"R\",\"G\",\"B\"\n1,2,3,0.5,0.25,1,0\n"));
  EXPECT_EQ(named.radii[0], 0.5f);
  EXPECT_EQ(named.colours[0][0], 0.25f);
  const PointCloud marked = read_point_cloud(write("f.csv", "\xef\xbb\xbfx;y;z;\n1;2;3;\n"));
  EXPECT_EQ(marked.positions.size(), 1u);
}

/// Colours are what all rows together are: the first may well be black or white.
TEST_F(CloudFile, AllRowsSayWhatColumnsAre) {
  const std::string names = "x y z r g b\n";
  for (const std::string first : {"0 0 0", "1 1 1", "0 0 1"}) {
    const PointCloud floats =
        read_point_cloud(write("a.xyz", names + "1 2 3 " + first + "\n1 2 4 0.8 0.4 1\n"));
    EXPECT_EQ(floats.colours[1][0], 0.8f);
    EXPECT_TRUE(floats.colours[0][2] == 0 || floats.colours[0][2] == 1) << first;
    const PointCloud bytes =
        read_point_cloud(write("a.xyz", names + "1 2 3 " + first + "\n1 2 4 255 0 1\n"));
    EXPECT_EQ(bytes.colours[1][0], 1);
    EXPECT_LT(bytes.colours[0][2], 0.01f);
  }
  EXPECT_EQ(read_point_cloud(write("b.xyz", names + "1 2 3 1 0 0\n")).colours[0][0], 1)
      << "nothing but 0 and 1: pure colours";
  const PointCloud facing = read_point_cloud(write("c.xyz", "1 2 3 0 0 1\n1 2 4 0 0 1\n"));
  EXPECT_TRUE(facing.colours.empty());
  EXPECT_EQ(facing.normals[0][2], 1);
}

TEST_F(CloudFile, ColoursOfATypeAreWithinIt) {
  for (const std::string colour : {"300 0 0", "0 -20 0", "0 0 nan"}) {
    expect_error("a.ply", coloured_header + "1 2 3 1 2 3\n1 2 3 " + colour + "\n3 0 1 1\n",
                 "point 1 has the colour");
  }
}

TEST_F(CloudFile, WhatIsWrongIsSaid) {
  expect_error("a.obj", "", "point clouds are .ply");
  expect_error("a.ply", "", "is empty");
  expect_error("a.ply", "pl", "ends within its PLY header, in line 1");
  expect_error("a.ply", "plx\n", "no PLY file: it does not begin with a line 'ply'");
  expect_error("a.ply", "ply\nformat ascii 1.0\n", "ends within its PLY header, in line 3");
  expect_error("a.ply", "ply\nend_header\n", "has no format");
  expect_error("a.ply", "ply\nformat middle 1.0\n", "the format 'middle' in line 2");
  expect_error("a.ply", "ply\nfoo\n", "'foo' in line 2");
  expect_error("a.ply", "ply\nproperty float x\n", "a property before every element");
  expect_error("a.ply", "ply\nelement vertex -3\n", "the count '-3' of element 'vertex'");
  expect_error("a.ply", "ply\nelement vertex 3\nproperty real x\n", "the type 'real'");
  expect_error("a.ply", "ply\nelement vertex 3\nproperty list float int x\n",
               "the type 'float' of a list's length");
  expect_error("a.ply", "ply\nelement vertex 3\nproperty float\n", "a property without a name");
  expect_error("a.ply", "ply\n" + std::string(5000, 'c') + "\n", "no end in line 2");
  expect_error("a.ply", "ply\nformat ascii 1.0\nelement face 0\nend_header\n",
               "no element 'vertex'");
  expect_error("a.ply",
               "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n1\n",
               "points need x, y and z; it has x");
  const std::string xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";
  expect_error("a.ply", "ply\nformat ascii 1.0\nelement vertex 1000000000000\n" + xyz + "1 2 3\n",
               "says 1000000000000 points");
  expect_error("a.ply", "ply\nformat binary_little_endian 1.0\nelement vertex 2\n" + xyz + "123",
               "it is cut off");
  expect_error("a.ply", "ply\nformat ascii 1.0\nelement vertex 2\n" + xyz + "1 2 3 4.0000 5\n",
               "ends within element 'vertex', at 1 of 2");
  expect_error("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz + "1 two 3\n",
               "line 8 has 'two' where a number of element 'vertex' should be");
  expect_error("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\n" + xyz + "1 2 3\n4 5 6\n7 8 9x",
               "line 10 has '9x' where a number of element 'vertex' should be");
  expect_error("a.ply", "ply\nformat ascii 1.0\nelement vertex 1\n" + xyz + "1 2 3\n4 5 6\n",
               "goes on after the 1 rows of element 'vertex': its header is wrong");
  const std::string binary = "ply\nformat binary_little_endian 1.0\nelement vertex 1\n" + xyz;
  expect_error("a.ply", binary + std::string(24, '\0'), "goes on after the 1 rows");
  EXPECT_EQ(
      read_point_cloud(write("n.ply", binary + std::string(12, '\0') + "\r\n")).positions.size(),
      1u);
  expect_error("a.xyz", "", "is empty");
  expect_error("a.xyz", "# nothing\n", "holds no points: a line each, of numbers x y z");
  expect_error("a.pts", "3\n1 2 3\n4 5 6\n", "its first line says 3 points, it has 2");
  expect_error("a.csv", "x,y,z\n1,,2,3\n", "line 2 is no row of numbers: '1,,2,3'");
  expect_error("a.csv", "x;y;z\n0,10;0,00;0,00\n",
               "line 2 has commas and semicolons: decimals need a point");
  expect_error("a.xyz", "1 2\n", "has 2 columns");
  expect_error("a.xyz", "1 2 3\n1 2\n", "line 2 has 2 columns, others have 3");
  expect_error("a.xyz", "1 2 3\nfour five six\n", "line 2 is no row of numbers");
  expect_error("a.csv", "a,b,c\n1,2,3\n", "points need x, y and z; it has a b c");
  try {
    read_point_cloud(folder_ / "none.ply");
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("no such file"), std::string::npos) << error.what();
  }
}

TEST_F(CloudFile, MorePointsThanMemoryAreRefusedBeforeTheyAreRead) {
  // A sparse file as long as its header says.
  const std::string name =
      write("huge.ply",
            "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty uchar "
            "x\nproperty uchar y\nproperty uchar z\nend_header\n");
  std::filesystem::resize_file(name, 12000001000);
  try {
    read_point_cloud(name);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("need about 1525879 MiB"), std::string::npos)
        << error.what();
  }
}

/// Of text by the length of its first point's line.
TEST_F(CloudFile, MorePointsThanMemoryAreRefusedAtTheFirstLine) {
  const std::string name = write("huge.xyz", "# x y z, and a long line of comment\n0 0 0\n1 0 0\n");
  std::filesystem::resize_file(name, 600000000000);
  try {
    read_point_cloud(name);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what())
                  .find("has, if lines are as long as the first, 100000000000 points, which need"),
              std::string::npos)
        << error.what();
  }
}

TEST(PointCloudModels, AreWhatTheirNamesSay) {
  for (const std::string name : {"plane", "figure", "crossing", "mask"}) {
    const PointCloud cloud = make_point_cloud(name, 900);
    EXPECT_GT(cloud.positions.size(), 600u);
    EXPECT_LT(cloud.positions.size(), 1100u);
    EXPECT_EQ(cloud.normals.size(), cloud.positions.size());
    EXPECT_EQ(cloud.colours.size(), cloud.positions.size());
  }
  EXPECT_EQ(make_point_cloud("plane").positions.size(), 262144u);
  EXPECT_EQ(make_point_cloud("figure").positions.size(), 81458u);
  EXPECT_THROW(make_point_cloud("figur"), Error);
}

}  // namespace
}  // namespace defray::test::cloud_file_test
