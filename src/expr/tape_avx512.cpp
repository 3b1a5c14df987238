#include "tape_block.hpp"

#ifdef __AVX512F__
#define SLALOM_SLEEF(function) Sleef_finz_##function##d8_u10avx512f

#include "tape_vector.hpp"

namespace slalom::expr {

void run_block_avx512(const Tape& tape, double* const* rows, std::size_t width) {
  if (width < Vector::size) return run_block_avx2(tape, rows, width);
  run_block<Vector>(tape, rows, width);
}

}  // namespace slalom::expr

#else  // a processor of another kind, on which no one calls this

namespace slalom::expr {

void run_block_avx512(const Tape& tape, double* const* rows, std::size_t width) {
  run_block_baseline(tape, rows, width);
}

}  // namespace slalom::expr

#endif
