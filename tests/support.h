#pragma once
// What several tests share: the device under test, inputs that hurt, and a folder to write in.
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "base/error.h"
#include "device/device_backend.h"

namespace defray::test {

/// The device that tests run on: $DEFRAY_TEST_DEVICE, else the default.
DeviceInfo device_under_test();

/// A session on it, shared by all tests of the process.
Session& session();

/// The same, without 64-bit atomics.
Session& session_without_int64();

/// The stages on that session, and by the twins; both, one after the other.
DeviceBackend& device();
Backend& twins();
std::vector<Backend*> device_and_twins();

/// A session that works on copies, in bands that fit so many bytes, until this ends.
class InBands {
 public:
  InBands(Session& session, std::size_t memory_bytes) : session_(session) {
    session_.set_copies(true);
    session_.set_memory(memory_bytes);
  }
  ~InBands() {
    session_.set_copies(false);
    session_.set_memory(default_memory_bytes);
  }
  InBands(const InBands&) = delete;
  InBands& operator=(const InBands&) = delete;

 private:
  Session& session_;
};

/// True where every work-item costs a thousand times more (Oclgrind): fewer cells, same sizes.
bool is_slow_device();

struct Size {
  int width, height;
};

/// 1x1, a column, a row, odd, prime, and in a full run a picture.
std::vector<Size> awkward_sizes();

/// Depths 1...9 with many ties, some background.
Plane random_depth(Size size, std::uint32_t seed);

/// Signed radii up to `largest_px`, whole, half and odd ones, both signs.
std::vector<std::int32_t> random_coc(Size size, double largest_px, std::uint32_t seed);

/// Colours of several magnitudes.
Plane random_plane(Size size, std::uint32_t seed);

/// FNV-1a over the bytes of planes.
std::uint64_t hash_of(const std::vector<Plane>& planes);
std::uint64_t hash_of_planes(const Planes& planes);

/// A folder of this test's own, removed with it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// The data folder beside the project, or an empty string: tests that need it skip themselves.
std::string shared_folder();

/// Whether tests may take their time: `run.sh --full`.
bool takes_long_tests();

#define SKIP_UNLESS_FULL() \
  if (!defray::test::takes_long_tests()) GTEST_SKIP() << "long: run.sh --full runs it"

#define SKIP_WITHOUT_SHARED() \
  if (defray::test::shared_folder().empty()) GTEST_SKIP() << "no ../shared beside the project"

/// Expects an Error of this kind whose message contains each of the words.
template <typename Call>
void expect_error(ErrorKind kind, const std::vector<std::string>& words, const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind) << error.what();
    for (const std::string& word : words) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
          << "'" << word << "' is not in: " << error.what();
    }
    return;
  }
  ADD_FAILURE() << "no error was thrown";
}

}  // namespace defray::test
