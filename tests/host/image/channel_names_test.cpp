// What channels' names say of them.
#include "image/channel_names.h"

#include "support.h"

namespace defray::test::channel_names_test {
namespace {

PartInfo part(const std::vector<std::string>& channels, const std::string& name = "") {
  return {name, "", {}, channels, {0, 0, 4, 4}, {0, 0, 4, 4}};
}

bool is_data(const std::string& full) { return is_data_channel(channel_names({part({full})})[0]); }

TEST(ChannelNames, DataByTheirNames) {
  for (const char* name : {"N.X",
                           "N.Y",
                           "N.Z",
                           "P.X",
                           "Z",
                           "depth",
                           "depth.Z",
                           "Normal.X",
                           "ViewLayer.Normal.Z",
                           "ViewLayer.Depth.Z",
                           "ViewLayer.IndexOB.X",
                           "ViewLayer.IndexMA.X",
                           "ViewLayer.Vector.W",
                           "ViewLayer.UV.U",
                           "ViewLayer.CryptoObject00.R",
                           "crypto_object00.red",
                           "uCryptomatte00.blue",
                           "objectId",
                           "materialID",
                           "MtlID",
                           "id",
                           "st.R",
                           "motionvector.R",
                           "velocity.X",
                           "VRayZDepth.R",
                           "ViewLayer.Denoising Normal.X",
                           "anything.X"}) {
    EXPECT_TRUE(is_data(name)) << name;
  }
  for (const char* name :
       {"diffuse.R", "diffuse_direct.G", "specular.B", "ViewLayer.DiffCol.R", "ViewLayer.Emit.B",
        "ViewLayer.Combined.A", "AO", "Y", "opacity.R", "normalised_light.R.R", "pass.R",
        "Nebula.R", "stone.R", "grid.R", "shadow", "humid"}) {
    EXPECT_FALSE(is_data(name)) << name;
  }
  EXPECT_TRUE(is_data_channel(channel_names({part({"R", "G", "B"}), part({"R"}, "normals")})[3]));
  for (const char* word : {"crypto", "uv", "normal", "integers"}) {
    EXPECT_NE(data_channel_rules().find(word), std::string::npos) << word;
  }
}

TEST(ChannelNames, Globs) {
  for (const auto& [name, pattern] :
       std::vector<std::pair<std::string, std::string>>{{"diffuse.R", "diffuse.*"},
                                                        {"diffuse.R", "*"},
                                                        {"diffuse.R", "*.R"},
                                                        {"diffuse.R", "d*f*e.?"},
                                                        {"a", "a"},
                                                        {"", "*"},
                                                        {"aab", "*ab"},
                                                        {"a.b.c", "a*c*"}}) {
    EXPECT_TRUE(matches_glob(name, pattern)) << name << " " << pattern;
  }
  for (const auto& [name, pattern] :
       std::vector<std::pair<std::string, std::string>>{{"diffuse.R", "diffuse"},
                                                        {"diffuse.R", "*.G"},
                                                        {"a", "??"},
                                                        {"a", ""},
                                                        {"", "?"},
                                                        {"aab", "*aa"},
                                                        {"diffuse.R", "DIFFUSE.R"}}) {
    EXPECT_FALSE(matches_glob(name, pattern)) << name << " " << pattern;
  }
}

}  // namespace
}  // namespace defray::test::channel_names_test
