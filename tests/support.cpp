#include "support.h"

#include <unistd.h>

#include <cstdlib>
#include <cstring>
#include <limits>
#include <memory>
#include <optional>
#include <random>

#include "reference/twin_backend.h"
#include "validation/oclgrind_log.h"

namespace defray::test {

DeviceInfo device_under_test() {
  const char* name = std::getenv("DEFRAY_TEST_DEVICE");
  return select_device(name ? name : "");
}

namespace {

/// Sessions end with the tests: an OpenCL runtime may be gone when static objects are destroyed.
class Sessions : public testing::Environment {
 public:
  std::unique_ptr<Session> with_int64, without_int64;
  void TearDown() override {
    with_int64.reset();
    without_int64.reset();
  }
};

Sessions& sessions() {
  static auto* const environment =
      static_cast<Sessions*>(testing::AddGlobalTestEnvironment(new Sessions));
  return *environment;
}

// Registered before the tests run: gtest ignores an environment that comes later.
[[maybe_unused]] const Sessions& registered = sessions();

/// What the user keeps in the cache folder, work-groups and costs, tests neither see nor change.
/// Kernels that were compiled are found where they are. Before main, which may fork.
class CacheFolder : public testing::Environment {
 public:
  CacheFolder() {
    const char *cache = std::getenv("XDG_CACHE_HOME"), *home = std::getenv("HOME");
    const std::string users = cache ? cache : std::string(home ? home : "/tmp") + "/.cache";
    setenv("POCL_CACHE_DIR", (users + "/pocl/kcache").c_str(), 0);
    setenv("MESA_SHADER_CACHE_DIR", users.c_str(), 0);
    folder_.emplace();
    setenv("XDG_CACHE_HOME", folder_->path().c_str(), 1);
  }
  void TearDown() override { folder_.reset(); }

 private:
  std::optional<Folder> folder_;
};

[[maybe_unused]] const auto* const own_cache = testing::AddGlobalTestEnvironment(new CacheFolder);

}  // namespace

Session& session() {
  auto& shared = sessions().with_int64;
  if (!shared) shared = std::make_unique<Session>(device_under_test());
  return *shared;
}

Session& session_without_int64() {
  auto& shared = sessions().without_int64;
  SessionOptions options;
  options.use_int64_atomics = false;
  if (!shared) shared = std::make_unique<Session>(device_under_test(), options);
  return *shared;
}

DeviceBackend& device() {
  static DeviceBackend backend(session());
  return backend;
}

Backend& twins() {
  static reference::TwinBackend backend;
  return backend;
}

std::vector<Backend*> device_and_twins() { return {&device(), &twins()}; }

bool is_slow_device() { return validation::is_simulator(device_under_test()); }

bool takes_long_tests() { return std::getenv("DEFRAY_TEST_LONG") != nullptr; }

std::vector<Size> awkward_sizes() {
  std::vector<Size> sizes{{1, 1}, {1, 17}, {17, 1}, {13, 7}, {257, 89}};
  if (takes_long_tests()) sizes.push_back({101, 300});
  return sizes;
}

namespace {

std::size_t pixels(Size size) {
  return static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
}

}  // namespace

Plane random_depth(Size size, std::uint32_t seed) {
  std::mt19937 random(seed);
  Plane plane(pixels(size));
  for (float& z : plane) {
    const auto step = random() % 40;  // few values: many ties
    z = step == 0 ? std::numeric_limits<float>::infinity() : 1.0f + 0.2f * static_cast<float>(step);
  }
  return plane;
}

std::vector<std::int32_t> random_coc(Size size, double largest_px, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(-1, 1);
  std::vector<std::int32_t> coc(pixels(size));
  for (std::int32_t& q : coc) {
    q = static_cast<std::int32_t>(256 * largest_px * share(random));
    if (random() % 4 == 0) q = q / 128 * 128;  // whole and half pixels: rays on pixel borders
    if (random() % 8 == 0) q = 0;
  }
  return coc;
}

Plane random_plane(Size size, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> exponent(-6, 6);
  Plane plane(pixels(size));
  for (float& c : plane) c = std::exp2(exponent(random)) * (random() % 8 == 0 ? -1.0f : 1.0f);
  return plane;
}

std::uint64_t hash_of(const std::vector<Plane>& planes) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const Plane& plane : planes) {
    for (const float value : plane) {
      std::uint32_t bits;
      std::memcpy(&bits, &value, sizeof(bits));
      hash = (hash ^ bits) * 0x100000001b3u;
    }
  }
  return hash;
}

std::uint64_t hash_of_planes(const Planes& planes) {
  std::vector<Plane> copies;
  for (const Values<float>& plane : planes) copies.emplace_back(plane.begin(), plane.end());
  return hash_of(copies);
}

Folder::Folder() {
  std::string path = (std::filesystem::temp_directory_path() / "defray-test-XXXXXX").string();
  if (!mkdtemp(path.data())) throw std::runtime_error("cannot make a temporary folder");
  path_ = path;
}

Folder::~Folder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

std::string shared_folder() {
  const std::filesystem::path folder = std::filesystem::path(DEFRAY_SOURCE_DIR) / ".." / "shared";
  return std::filesystem::exists(folder) ? folder.string() : "";
}

}  // namespace defray::test
