#pragma once
// Convergence: the same gear on finer and finer meshes, and how its numbers settle.
//
//     kind = "convergence"
//     [[refine]]                                  # all of these move together, level by level
//     path = "mesh.per_pitch"
//     values = [4, 6, 8]                          # coarse to fine
//     [[refine]]
//     path = "mesh.along_face"
//     values = [4, 6, 8]
//     [convergence]
//     outputs = ["peak_force_n"]                  # absent: all that the loads give
//
// Row i is the gear on mesh i. The size of its elements is 1 on the first mesh and follows the counts: with K
// keys that grow h_i = ∏ (n_k0/n_ki)^(1/K). Counts that do not grow in proportion make h a mean, and the
// order a rough one.

#include "strainwave/studies/tables/row_kind.hpp"

#include <string>
#include <vector>

namespace strainwave {

struct MeshRefinement {
  std::string path; ///< a key of the mesh
  std::vector<double> values;
};

struct StudyConvergence {
  std::vector<std::string> outputs; ///< empty: all that the loads give
};

struct ConvergencePart : StudyPart {
  std::vector<MeshRefinement> refinements; ///< never empty, all of one length
  StudyConvergence convergence;
  std::unique_ptr<StudyPart> copy() const override { return std::make_unique<ConvergencePart>(*this); }
};

const RowKind& convergence_kind();

/// Size of the elements of every level, 1 on the first.
std::vector<double> element_sizes(const ConvergencePart& part);

} // namespace strainwave
