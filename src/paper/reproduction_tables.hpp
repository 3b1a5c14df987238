#pragma once

#include <string>
#include <vector>

#include "claims.hpp"
#include "reproduction.hpp"

namespace slalom::paper {

// The tables of the comparison page as HTML, ours | paper's.
std::string claims_table(const std::vector<Judged>& claims);
std::string outcome_table(const std::vector<ReproducedDrive>& drives, const PaperData& paper);
std::string effort_table(const std::vector<ReproducedDrive>& drives, const PaperData& paper);
std::string speed_table(const std::vector<ReproducedDrive>& drives, const PaperData& paper);
std::string solve_time_table(const std::vector<ReproducedDrive>& drives);
std::string position_table(const std::vector<ReproducedDrive>& drives, const PaperData& paper);

}  // namespace slalom::paper
