// Where tuning is kept: whole at any moment, shared by several tuners, nothing taken on trust.
#include "tuning/tuning_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "image/safe_output.h"
#include "support.h"

namespace defray::test::tuning_file_test {
namespace {

using nlohmann::json;
using tuning::Key;
using tuning::Shape;
using tuning::Validity;
using Results = std::vector<tuning::Result>;

class TuningFile : public testing::Test {
 protected:
  Folder folder;
  const std::string path = folder / "cache/tuning.json";
  const Key key{"a device", "a platform", "driver 1", "00ff"};
  const std::size_t most_items = 256;

  tuning::Result result(const Shape& shape, std::vector<double> run_ms,
                        const std::string& kernel = "fill") const {
    return {{"hd narrow", "a picture", kernel}, shape, Validity::correct, std::move(run_ms)};
  }
  tuning::Tuning read() const { return tuning::read(path, key, most_items); }
  json text() const { return json::parse(std::ifstream(path)); }

  /// The file as `change` leaves it is not used, and the notice says this.
  void expect_unused(const std::function<void(json&)>& change, const std::string& why) {
    tuning::add(path, key, most_items, {result({16, 1}, {2.5})});
    json changed = text();
    change(changed);
    write_text(path, changed.dump());
    const tuning::Tuning tuning = read();
    EXPECT_TRUE(tuning.results.empty()) << why;
    EXPECT_NE(tuning.notice.find(why), std::string::npos) << tuning.notice;
    EXPECT_NE(tuning.notice.find(path), std::string::npos);
    EXPECT_NE(tuning.notice.find("'defray tune' makes it anew"), std::string::npos);
    // The next tuner starts anew.
    EXPECT_EQ(tuning::add(path, key, most_items, {result({8, 1}, {1})}).size(), 1u) << why;
    EXPECT_EQ(read().notice, "");
    std::filesystem::remove(path);
  }
};

TEST_F(TuningFile, KeepsWhatWasFound) {
  EXPECT_TRUE(read().results.empty());
  EXPECT_EQ(read().notice, "");
  EXPECT_EQ(tuning::add(path, key, most_items, {result({16, 2}, {2.5})}).size(), 1u);
  tuning::add(path, key, most_items, {result({16, 2}, {2.25}), result({8, 1}, {3}, "coc")});
  tuning::add(path, key, most_items,
              {{{"hd narrow", "a picture", "split"}, {4, 4}, Validity::runtime, {}}});
  const Results all = read().results;
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[0].place, (tuning::Place{"hd narrow", "a picture", "fill"}));
  EXPECT_EQ(all[0].shape, (Shape{16, 2}));
  EXPECT_EQ(all[0].run_ms, (std::vector<double>{2.5, 2.25}));
  EXPECT_EQ(all[1].place.kernel, "coc");
  EXPECT_EQ(all[2].validity, Validity::runtime);
}

TEST_F(TuningFile, IsWhatTunersRead) {
  tuning::add(path, key, most_items,
              {result({16, 2}, {2.5, 3.5, 9}),
               {{"uhd wide", "p", "coc"}, {8, 1}, Validity::correctness, {}}});
  const json file = text();
  EXPECT_EQ(file["schema_version"], "1.0.0");
  EXPECT_EQ(file["metadata"], (json{{"device", "a device"},
                                    {"platform", "a platform"},
                                    {"driver", "driver 1"},
                                    {"kernels", "00ff"}}));
  const json& first = file["results"][0];
  EXPECT_EQ(first["configuration"], (json{{"kernel", "fill"},
                                          {"frame_class", "hd narrow"},
                                          {"picture", "a picture"},
                                          {"work_group_x", 16},
                                          {"work_group_y", 2}}));
  EXPECT_EQ(first["times"]["runtimes"], (json{2.5, 3.5, 9.0}));
  EXPECT_EQ(first["invalidity"], "correct");
  EXPECT_EQ(first["correctness"], 1.0);
  EXPECT_EQ(first["objectives"], json{"time"});
  EXPECT_EQ(first["measurements"],
            (json::array({{{"name", "time"}, {"value", 2.5}, {"unit", "ms"}}})));
  EXPECT_TRUE(std::string(first["timestamp"]).ends_with("Z"));
  const json& second = file["results"][1];
  EXPECT_EQ(second["invalidity"], "correctness");
  EXPECT_EQ(second["correctness"], 0.0);
  EXPECT_TRUE(second["measurements"].empty());
}

TEST_F(TuningFile, OfOthersIsNotUsed) {
  const auto with = [](const char* name) {
    return [name](json& file) { file["metadata"][name] = "another"; };
  };
  expect_unused(with("device"), "is of another device");
  expect_unused(with("platform"), "is of another platform");
  expect_unused(with("driver"), "is of another driver");
  expect_unused(with("kernels"), "is of another version of the kernels and not used");
}

TEST_F(TuningFile, ThatIsDamagedIsNotUsed) {
  const auto with = [](const char* part, const char* name, const json& value) {
    return [=](json& file) { file["results"][0][part][name] = value; };
  };
  const std::string damaged = "is damaged and not used (";
  expect_unused([](json& file) { file.erase("metadata"); }, damaged);
  expect_unused([](json& file) { file["results"] = 5; }, damaged);
  expect_unused(with("configuration", "kernel", "none"),
                "kernel 'none' is not in the launch table");
  expect_unused(with("configuration", "work_group_x", 0), "work-group 0x1");
  expect_unused(with("configuration", "work_group_y", 0), "work-group 16x0");
  expect_unused(with("configuration", "work_group_x", 257), "work-group 257x1");
  expect_unused(with("configuration", "work_group_y", 17), "work-group 16x17");
  expect_unused(with("configuration", "work_group_x", "4"), damaged);
  expect_unused(with("times", "runtimes", {0.0}), "a runtime is 0 ms");
  expect_unused(with("times", "runtimes", {-1}), "a runtime is -1 ms");
  expect_unused([](json& file) { file["results"][0]["invalidity"] = "fine"; },
                "invalidity is 'fine'");
}

TEST_F(TuningFile, CutOffOrHugeIsNotUsed) {
  tuning::add(path, key, most_items, {result({16, 1}, {2.5})});
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  EXPECT_NE(read().notice.find("is damaged"), std::string::npos) << read().notice;
  std::filesystem::resize_file(path, std::uintmax_t{1} << 30);
  EXPECT_NE(read().notice.find("it has 1024 MiB"), std::string::npos) << read().notice;
}

TEST_F(TuningFile, TakesFromSeveralTunersAtOnce) {
  std::vector<std::thread> tuners;
  for (std::size_t t = 0; t < 4; ++t) {
    tuners.emplace_back([&, t] {
      for (int i = 0; i < 10; ++i) {
        tuning::add(path, key, most_items, {result({std::size_t{1} << t, 1}, {1.0 + i})});
      }
    });
  }
  for (std::thread& tuner : tuners) tuner.join();
  const Results all = read().results;
  ASSERT_EQ(all.size(), 4u);
  for (const tuning::Result& r : all) EXPECT_EQ(r.run_ms.size(), 10u) << to_string(r.shape);
}

TEST_F(TuningFile, IsNotWrittenWhereItCannotBe) {
  std::ofstream(folder / "file") << "no folder";
  try {
    tuning::add(folder / "file/tuning.json", key, most_items, {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::output) << error.what();
  }
  std::filesystem::create_directories(path + ".lock");
  expect_error(ErrorKind::output, {path + ".lock cannot be written"},
               [&] { tuning::add(path, key, most_items, {}); });
}

TEST(TuningPath, IsOfTheDeviceInTheCacheFolder) {
  const auto path_in = [](const char* cache, const char* home, const Key& key) {
    const auto set = [](const char* name, const char* value) {
      value ? setenv(name, value, 1) : unsetenv(name);
    };
    const char* before[] = {std::getenv("XDG_CACHE_HOME"), std::getenv("HOME")};
    const std::optional<std::string> kept[] = {
        before[0] ? std::optional<std::string>(before[0]) : std::nullopt,
        before[1] ? std::optional<std::string>(before[1]) : std::nullopt};
    set("XDG_CACHE_HOME", cache);
    set("HOME", home);
    const std::string path = tuning::path_of(key);
    set("XDG_CACHE_HOME", kept[0] ? kept[0]->c_str() : nullptr);
    set("HOME", kept[1] ? kept[1]->c_str() : nullptr);
    return path;
  };
  const Key key{"GPU  (TM) 7", "platform", "", ""};
  const std::string path = path_in("/c", "/h", key);
  EXPECT_TRUE(path.starts_with("/c/defray/tuning-gpu-tm-7-")) << path;
  EXPECT_TRUE(path.ends_with(".json"));
  EXPECT_EQ(path_in(nullptr, "/h", key), "/h/.cache" + path.substr(2));
  EXPECT_EQ(path_in("", "/h", key), "/h/.cache" + path.substr(2));
  EXPECT_EQ(path_in(nullptr, nullptr, key), "");
  EXPECT_NE(path_in("/c", "/h", {"GPU (TM) 7", "platform", "", ""}), path);
  EXPECT_NE(path_in("/c", "/h", {"GPU  (TM) 7", "other", "", ""}), path);
  EXPECT_EQ(path_in("/c", "/h", {"GPU  (TM) 7", "platform", "2", "3"}), path);
}

TEST(TuningKey, IsOfThisDevice) {
  const DeviceInfo info = device_under_test();
  const Key key = tuning::key_of(info);
  EXPECT_EQ(key.device, info.name);
  EXPECT_EQ(key.platform, info.platform);
  EXPECT_EQ(key.driver, info.version);
  EXPECT_EQ(key.kernels.size(), 16u);
}

}  // namespace
}  // namespace defray::test::tuning_file_test
