#ifdef __x86_64__
#define SLALOM_SLEEF(function) Sleef_cinz_##function##d2_u10sse2
#else  // the same bits
#define SLALOM_SLEEF(function) Sleef_cinz_##function##d2_u10advsimdnofma
#endif

#include "tape_block.hpp"
#include "tape_vector.hpp"

namespace slalom::expr {

void run_block_baseline(const Tape& tape, double* const* rows, std::size_t width) {
  run_block<Vector>(tape, rows, width);
}

}  // namespace slalom::expr
