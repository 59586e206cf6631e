#pragma once

#include <vector>

#include "solver/BlockCholesky.h"
#include "solver/PoseTerm.h"

namespace lamp {

/** PoseProblem::leaveOneOut2(), from the factorised normal equations at `poses`.
 * \param row of each pose in the equations, -1 for what is held. */
template <class Space>
std::vector<double> leaveOneOut2(const std::vector<PoseTerm<Space>>& terms,
                                 const std::vector<typename Space::Pose>& poses,
                                 const std::vector<int>& row,
                                 const BlockCholesky<Space::kDof>& cholesky,
                                 const std::vector<EdgeIndex>& edges);

extern template std::vector<double> leaveOneOut2<Se2>(const std::vector<PoseTerm<Se2>>&,
                                                      const std::vector<Se2::Pose>&,
                                                      const std::vector<int>&,
                                                      const BlockCholesky<3>&,
                                                      const std::vector<EdgeIndex>&);
extern template std::vector<double> leaveOneOut2<Se3>(const std::vector<PoseTerm<Se3>>&,
                                                      const std::vector<Se3::Pose>&,
                                                      const std::vector<int>&,
                                                      const BlockCholesky<6>&,
                                                      const std::vector<EdgeIndex>&);

}  // namespace lamp
