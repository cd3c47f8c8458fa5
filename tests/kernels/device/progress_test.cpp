// Progress goes from above 0 to 1, never back, with every method on device and twins.
#include "methods/method.h"
#include "support.h"

namespace defray::test::progress_test {
namespace {

void expect_progress(const MethodSettings& settings, Backend& backend, const std::string& what) {
  const Size size{40, 90};
  const std::vector<Plane> channels = {random_plane(size, 1), random_plane(size, 2)};
  const Frame frame{size.width, size.height, random_coc(size, 5, 3), random_depth(size, 4),
                    channels};
  std::vector<double> shares;
  apply_method(frame, settings, backend, false, [&](double share) { shares.push_back(share); });
  ASSERT_GE(shares.size(), 2u) << what;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    EXPECT_GE(shares[i], i == 0 ? 0 : shares[i - 1]) << what;
    EXPECT_LE(shares[i], 1) << what;
  }
  EXPECT_NEAR(shares.back(), 1, 1e-9) << what;
  EXPECT_LT(shares.front(), 0.9) << what;
}

TEST(Progress, GoesToOneAndNeverBack) {
  MethodSettings chain, linear, gather;
  chain.chain = ChainSettings{};
  linear.method = Method::linear;
  gather.method = Method::gather;
  gather.gather.passes = 3;
  for (const GatherKind kind : {GatherKind::literal, GatherKind::aware}) {
    gather.gather.kind = kind;
    expect_progress(gather, device(), "gather");
  }
  expect_progress(linear, device(), "linear");
  for (Backend* backend : device_and_twins()) {
    const InBands bands(session(), 1 << 17);  // several passes
    const std::string where = backend == &device() ? " on the device" : " by the twins";
    expect_progress({}, *backend, "literal" + where);
    expect_progress(chain, *backend, "rdb" + where);
  }
}

}  // namespace
}  // namespace defray::test::progress_test
