#pragma once
// A point cloud as files have it: rows of numbers, of which some columns are known.
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "defray/splat.h"

namespace defray {

/// By its extension: what read_point_cloud() reads.
bool is_cloud_name(const std::string& path);

/// Throws Error(input) where that many points need more memory than the machine has.
void check_memory_for(std::uint64_t points, const std::string& path,
                      const std::string& how_known = "says it has");

/// Rows to points.
class CloudColumns {
 public:
  /// `names` of the columns, in any case; of colours `whole_numbers` go from 0 to this, and are
  /// sRGB-encoded; 0: they are linear. Throws Error(input) without x, y and z.
  CloudColumns(const std::vector<std::string>& names, const std::vector<double>& whole_numbers,
               const std::string& path);

  void reserve(std::size_t points);
  void add(std::span<const double> row);

  /// Places from the middle of all.
  PointCloud take() &&;

 private:
  using Group = std::optional<std::array<std::size_t, 3>>;  ///< Three columns that go together.
  Group group(const std::vector<std::string>& names, std::array<const char*, 3> wanted) const;
  void note_unused(const std::vector<std::string>& names);
  /// Of its type's largest; of floats the value.
  double share(std::span<const double> row, std::size_t column) const;
  float colour(std::span<const double> row, std::size_t column) const;

  std::array<std::size_t, 3> place_{};
  Group normal_, colour_;
  std::optional<std::size_t> alpha_, radius_;
  std::vector<double> whole_numbers_;
  std::string path_;
  std::vector<std::array<double, 3>> places_;
  PointCloud cloud_;
};

/// The rest of a stream of so many bytes, by its format. Throws Error(input) that names `path`.
PointCloud read_ply(std::istream& file, std::uint64_t bytes, const std::string& path);
PointCloud read_text_cloud(std::istream& file, std::uint64_t bytes, const std::string& path);

}  // namespace defray
