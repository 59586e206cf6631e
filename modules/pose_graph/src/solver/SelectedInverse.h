#pragma once

#include <vector>

#include "solver/BlockCholesky.h"

namespace lamp {

/** The blocks of a matrix's inverse where its factor has blocks, in the factor's order: all pairs
 * of the matrix, and more (Erisman, Tinney, "On computing certain elements of the inverse of a
 * sparse matrix", CACM 1975). Takes about twice as long as a factorisation. */
template <int kSize>
std::vector<typename BlockMatrix<kSize>::Block> selectedInverse(
    const BlockCholesky<kSize>& cholesky);

extern template std::vector<BlockMatrix<3>::Block> selectedInverse(const BlockCholesky<3>&);
extern template std::vector<BlockMatrix<6>::Block> selectedInverse(const BlockCholesky<6>&);

}  // namespace lamp
