#pragma once

#include <cstddef>
#include <cstdint>

namespace lamp {

/** Compiles a function for several instruction sets; the loader takes the best one that the
 * machine has. GCC with glibc only: others lack the attribute, these values of it, or the loader's
 * part. Not under sanitizers, which cannot run before the choice is made. */
#if defined(__x86_64__) && defined(__GLIBC__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define LAMP_FOR_SEVERAL_INSTRUCTION_SETS \
  __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define LAMP_FOR_SEVERAL_INSTRUCTION_SETS
#endif

/** result[j] = Σ_k weights[k] · rows[k · columns + j]: one row of a product of matrices. */
void weightedRowSum(const float* rows, size_t columns, const float* weights, size_t count,
                    float* result);

/** Whether match `i` and each match after it may belong to one rigid motion.
 * \param columns arrays of `count` each: x, y, z of the source points, of the target points, of the
 *   source normals, of the target normals.
 * \param distance by how much lengths may differ, metres; \param angle by how much angles, rad.
 * \param[out] consistent 1 or 0 for each match; those up to `i` are not written. */
void consistentWith(const float* columns, size_t count, size_t i, float distance, float angle,
                    int32_t* consistent);

/** How many bits two sets share. */
size_t countCommon(const uint64_t* a, const uint64_t* b, size_t words);

struct Connections {
  uint32_t vertex = 0;
  size_t count = 0;
};

/** The vertex of a set that is connected with most of the set, the first of equals. \param rows a
 * row of bits a vertex, `words` each; \param set not empty. */
Connections mostConnected(const uint64_t* rows, size_t words, const uint64_t* set);

}  // namespace lamp
