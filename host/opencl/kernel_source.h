#pragma once
// The text of one OpenCL program out of the files of kernels/.
#include <string>
#include <vector>

namespace defray {

/// A change of the kernels' text, for experiments and for faults that tests must find.
struct Substitution {
  std::string from, to;
  bool everywhere = false;  ///< Otherwise `from` must be there exactly once.
};

/// The .cl files of this name ("chain/fill.cl"; none: all) with the headers that they include, each
/// once. #line says where every line is from: build errors name file and line.
std::string kernel_source(const std::vector<std::string>& names,
                          const std::vector<Substitution>& substitutions);

/// A build log of this program, with file and line wherever it counts the program's lines, as
/// NVIDIA's compiler ("<kernel>:838:1: error") and Oclgrind's do, whatever #line says.
std::string with_places(std::string log, const std::string& program);

}  // namespace defray
